/// \file
/// Inputs that behave as a test says: they come in pieces, fail, or are stopped.
#pragma once

#include <zlib.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "replay/text/byte_source.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/piece_input.hpp"

namespace sesame::tests {

/// A source of these pieces. Its first bytes are read at once: that has to succeed.
inline replay::ByteSource source_of(std::vector<std::string> pieces, End end, const std::string& name) {
  return replay::ByteSource::from(std::make_unique<PieceInput>(std::move(pieces), end), name).value();
}

/// A text packed as gzip data.
inline std::string gzipped(const std::string& text) {
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string input = text, packed(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

}  // namespace sesame::tests
