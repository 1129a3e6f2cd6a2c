/// \file
/// Decisions taken from the bytes of an input, so that a small change of the input is a small change of what happens.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace sesame::tests {

/// Draws numbers as tests::Random does, but from bytes; 0 when they have come to an end. Copies draw from the same.
class ByteDraws {
 public:
  explicit ByteDraws(std::string_view bytes) : bytes_{std::make_shared<std::string_view>(bytes)} {}

  [[nodiscard]] bool is_done() const { return bytes_->empty(); }
  [[nodiscard]] std::size_t left() const { return bytes_->size(); }
  std::uint8_t byte() {
    if (is_done()) {
      return 0;
    }
    const auto taken = static_cast<std::uint8_t>(bytes_->front());
    bytes_->remove_prefix(1);
    return taken;
  }
  std::uint32_t word() {
    std::uint32_t word = 0;
    for (int k = 0; k < 4; ++k) {
      word = word << 8U | byte();
    }
    return word;
  }
  /// A number in [low, high]: of one byte while that is enough.
  int in(int low, int high) {
    const auto choices = static_cast<unsigned>(high - low + 1);
    unsigned drawn = byte();
    if (choices > 256) {
      drawn = drawn << 8U | byte();
    }
    return low + static_cast<int>(drawn % choices);
  }
  bool one_in(int n) { return in(1, n) == 1; }
  /// Some of the next bytes, as text.
  std::string_view text(std::size_t most) {
    const std::string_view taken = bytes_->substr(0, most);
    bytes_->remove_prefix(taken.size());
    return taken;
  }
  std::string_view rest() { return text(left()); }

 private:
  std::shared_ptr<std::string_view> bytes_;
};

}  // namespace sesame::tests
