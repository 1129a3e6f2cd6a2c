/// \file
/// Inputs that behave as a test says: they come in pieces, fail, or are stopped.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "replay/text/byte_source.hpp"
#include "tests/support/catch.hpp"

namespace sesame::tests {

/// How an input ends.
enum class End { whole, stopped, failed };

/// Yields the pieces one by one, and then ends as it should.
class PieceInput final : public replay::ByteInput {
 public:
  PieceInput(std::vector<std::string> pieces, End end) : pieces_{std::move(pieces)}, end_{end} {}

  Result<std::size_t> read(std::span<char> to) override {
    while (next_ < pieces_.size() && pieces_[next_].empty()) {
      ++next_;
    }
    if (next_ == pieces_.size()) {
      if (end_ == End::failed) {
        return Error{Errc::io, "cannot read the input: it broke"};
      }
      return std::size_t{0};
    }
    std::string& piece = pieces_[next_];
    const std::size_t size = std::min(piece.size(), to.size());
    std::memcpy(to.data(), piece.data(), size);
    piece.erase(0, size);
    return size;
  }
  [[nodiscard]] bool is_stopped() const override { return end_ == End::stopped && next_ == pieces_.size(); }

 private:
  std::vector<std::string> pieces_;
  End end_;
  std::size_t next_ = 0;
};

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
