#include "replay/page/packed_numbers.hpp"

#include <algorithm>
#include <bit>
#include <string>
#include <string_view>
#include <vector>

namespace sesame::replay {

namespace {

/// The last three bytes are read beyond their end as zeros.
std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [bytes](std::size_t k) {
    return k < bytes.size() ? std::uint32_t{static_cast<unsigned char>(bytes[k])} : 0U;
  };
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::uint32_t three = byte(k) << 16U | byte(k + 1) << 8U | byte(k + 2);
    for (std::uint32_t shift = 24; shift > 0;) {
      shift -= 6;
      text += digits[three >> shift & 63U];
    }
  }
  const std::size_t filled = (3 - bytes.size() % 3) % 3;
  text.replace(text.size() - filled, filled, std::string(filled, '='));
  return text;
}

void write(std::string_view kind, std::string_view bytes, ops::JsonText& out) {
  out.begin_object();
  out.field("kind", kind);
  out.field("data", base64(bytes));
  out.end_object();
}

std::string bytes_of(std::span<const std::uint32_t> numbers, std::uint32_t width) {
  std::string bytes;
  bytes.reserve(numbers.size() * width);
  for (const std::uint32_t number : numbers) {
    for (std::uint32_t k = 0; k < width; ++k) {
      bytes += static_cast<char>(number >> 8 * k & 0xffU);
    }
  }
  return bytes;
}

}  // namespace

void write_packed(std::span<const float> numbers, ops::JsonText& out) {
  std::vector<std::uint32_t> words(numbers.size());
  std::transform(numbers.begin(), numbers.end(), words.begin(),
                 [](float x) { return std::bit_cast<std::uint32_t>(x); });
  write("f32", bytes_of(words, 4), out);
}

void write_packed(std::span<const std::uint32_t> numbers, ops::JsonText& out) {
  const bool is_short = std::all_of(numbers.begin(), numbers.end(), [](std::uint32_t n) { return n < 0x10000U; });
  write(is_short ? "u16" : "u32", bytes_of(numbers, is_short ? 2 : 4), out);
}

}  // namespace sesame::replay
