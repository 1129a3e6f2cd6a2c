// gzip data: they are unpacked as zlib does it, in pieces as at once, or refused with a sentence; what is packed is
// read as it was.
#include <zlib.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "replay/text/byte_source.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/piece_input.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

constexpr std::size_t most_unpacked = std::size_t{1} << 22;

struct Unpacked {
  std::string bytes;
  std::string error;  ///< or nothing
};

Unpacked read(std::string_view packed, std::size_t piece) {
  std::vector<std::string> pieces;
  for (std::size_t at = 0; at < packed.size(); at += piece) {
    pieces.emplace_back(packed.substr(at, piece));
  }
  Unpacked all;
  auto source = replay::ByteSource::from(std::make_unique<PieceInput>(std::move(pieces), End::whole), "data");
  if (!went_well(source)) {
    all.error = source.error().what;
    return all;
  }
  while (all.bytes.size() < most_unpacked) {
    all.bytes += source->window();
    source->consume(source->window().size());
    const Result<bool> more = source->more();
    if (!went_well(more)) {
      all.error = more.error().what;
      return all;
    }
    if (!*more) {
      return all;
    }
    demand(!source->window().empty(), "more is more");
  }
  return all;
}

struct Inflated {
  std::string bytes;
  std::size_t used = 0;    ///< of the input
  bool has_ended = false;  ///< and not been cut off or damaged, or longer than `most`
};

/// What the first stream in some data unpacks to, by zlib alone.
Inflated inflated(std::string_view data, int window_bits, std::size_t most) {
  Inflated found;
  std::string copy{data};
  z_stream stream{};
  demand(inflateInit2(&stream, window_bits) == Z_OK, "zlib works");
  stream.next_in = reinterpret_cast<Bytef*>(copy.data());
  stream.avail_in = static_cast<uInt>(copy.size());
  int outcome = Z_OK;
  while (outcome == Z_OK && found.bytes.size() < most) {
    std::array<char, 4096> room{};
    stream.next_out = reinterpret_cast<Bytef*>(room.data());
    stream.avail_out = room.size();
    outcome = inflate(&stream, Z_NO_FLUSH);
    found.bytes.append(room.data(), room.size() - stream.avail_out);
  }
  found.used = copy.size() - stream.avail_in;
  found.has_ended = outcome == Z_STREAM_END;
  inflateEnd(&stream);
  return found;
}

/// The members of gzip data, by zlib alone; nothing when they are damaged, cut off, or no such data.
std::optional<std::string> unpacked_by_zlib(std::string_view packed) {
  std::string bytes;
  while (!packed.empty()) {
    const Inflated member = inflated(packed, 16 + MAX_WBITS, most_unpacked - std::min(most_unpacked, bytes.size()));
    if (!member.has_ended) {
      return std::nullopt;
    }
    bytes += member.bytes;
    packed.remove_prefix(member.used);
  }
  return bytes;
}

std::string packed(std::string_view text, int level) {
  z_stream stream{};
  demand(deflateInit2(&stream, level, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY) == Z_OK, "zlib works");
  std::string input{text}, output(deflateBound(&stream, text.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(output.data());
  stream.avail_out = static_cast<uInt>(output.size());
  demand(deflate(&stream, Z_FINISH) == Z_STREAM_END, "zlib works");
  output.resize(stream.total_out);
  deflateEnd(&stream);
  return output;
}

void demand_same_as_zlib(std::string_view data) {
  const Unpacked whole = read(data, std::max<std::size_t>(data.size(), 1));
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}}) {
    const Unpacked in_pieces = read(data, piece);
    demand(in_pieces.bytes == whole.bytes && in_pieces.error == whole.error, "pieces say what the whole does");
  }
  if (whole.bytes.size() >= most_unpacked) {
    return;
  }
  const bool is_as_it_was = whole.error.empty() && whole.bytes == data;
  if (!data.starts_with("\x1F\x8B\x08")) {
    demand(is_as_it_was, "what is not packed is as it is");
  } else if (const std::optional<std::string> by_zlib = unpacked_by_zlib(data)) {
    demand(whole.error.empty() && whole.bytes == *by_zlib, "what zlib unpacks is what is read");
  } else {  // binary matrices may begin so
    demand(!whole.error.empty() || is_as_it_was, "what zlib refuses is refused");
  }
}

/// A raw stream of blocks as a gzip member with the right sums, which a fuzzer does not find.
std::string sealed(std::string_view blocks) {
  const auto [bytes, used, has_ended] = inflated(blocks, -MAX_WBITS, most_unpacked);
  std::string member{"\x1F\x8B\x08\x00\x00\x00\x00\x00\x00\x03", 10};
  member += blocks.substr(0, used);
  const auto sum = static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
  const auto size = static_cast<std::uint32_t>(bytes.size());
  for (const std::uint32_t word : {sum, size}) {
    for (int k = 0; k < 4; ++k) {
      member.push_back(static_cast<char>(word >> (8 * k) & 0xFFU));
    }
  }
  member += blocks.substr(used);
  return member;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = text_of(data, size);
  demand_same_as_zlib(bytes);
  if (size == 0) {
    return 0;
  }
  demand_same_as_zlib(sealed(bytes));
  const std::string member = packed(bytes, data[0] % 10);
  const Unpacked again = read(member, 1 + data[0] % 13);
  demand(again.error.empty() && again.bytes == bytes, "what is packed is read as it was");
  const Unpacked twice = read(member + member, 11);
  demand(twice.error.empty() && twice.bytes.size() == 2 * size, "members follow one another");
  const Unpacked cut = read(std::string_view{member}.substr(0, data[0] % member.size()), 16);
  demand(data[0] % member.size() < 3 ||  // before that it is not known for gzip data
             !cut.error.empty(),
         "what is cut off is refused");
  return 0;
}
