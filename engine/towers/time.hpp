/// \file
/// Times of towers: whole numbers exactly, others as doubles.
#pragma once

#include <cmath>
#include <compare>
#include <concepts>
#include <cstdint>
#include <utility>

namespace sesame::engine {

/// A time, or the length of an interval of times: any whole number of 64 bits, signed or not, or any double. They are
/// compared by their values, exactly.
///
/// It is held as the nearest double and, for a whole number beyond 2^53, what that lacks. Rounding is monotonic, so the
/// order of these pairs is the order of the values.
class Time {
 public:
  constexpr Time() = default;
  constexpr Time(double x) : nearest_{x} {}  // NOLINT(google-explicit-constructor): a number is a number
  template <std::integral Whole>
  constexpr Time(Whole x)  // NOLINT(google-explicit-constructor)
      : nearest_{static_cast<double>(x)} {
    constexpr std::int64_t two_to_53 = std::int64_t{1} << 53;
    if (std::cmp_greater(x, two_to_53) || std::cmp_less(x, -two_to_53)) [[unlikely]] {
      rest_ = static_cast<std::int16_t>(static_cast<std::uint64_t>(x) - modulo_2_64(nearest_));
      is_large_ = true;
    }
  }

  /// The double nearest to it.
  [[nodiscard]] constexpr double nearest() const { return nearest_; }
  /// Whether it is a whole number beyond 2^53 in size that was given as one, and not as a double.
  [[nodiscard]] constexpr bool is_large() const { return is_large_; }
  [[nodiscard]] bool is_finite() const { return std::isfinite(nearest_); }
  /// Whether it is a whole number of 64 bits that is known exactly: a double beyond 2^53 may have been rounded.
  [[nodiscard]] bool is_whole() const {
    return is_large_ || (std::abs(nearest_) <= largest_small &&
                         nearest_ == static_cast<double>(static_cast<std::int64_t>(nearest_)));
  }
  /// Of a whole number. So a negative one is this, taken as a signed number.
  [[nodiscard]] constexpr std::uint64_t modulo_2_64() const {
    return modulo_2_64(nearest_) + static_cast<std::uint64_t>(std::int64_t{rest_});
  }

  /// Exact for whole numbers when the difference is one of 64 bits; else the double nearest to it.
  friend Time operator-(Time a, Time b) {
    const double difference = a.nearest_ - b.nearest_;
    const bool is_easy = !a.is_large_ && !b.is_large_ && std::abs(difference) < largest_small;  // not even rounded
    return is_easy ? Time{difference} : exact_difference(a, b);
  }
  /// Half of it; exact for even whole numbers, else the nearest double.
  [[nodiscard]] Time half() const;

  friend constexpr bool operator==(Time a, Time b) { return a.nearest_ == b.nearest_ && a.rest_ == b.rest_; }
  friend constexpr std::partial_ordering operator<=>(Time a, Time b) {
    return a.nearest_ != b.nearest_ ? a.nearest_ <=> b.nearest_ : a.rest_ <=> b.rest_;
  }

 private:
  static constexpr double largest_small = 9007199254740992.0;  // 2^53: up to here all whole numbers are doubles

  /// Of a whole number from -2^63 to 2^64.
  static constexpr std::uint64_t modulo_2_64(double x) {
    constexpr double two_to_64 = 18446744073709551616.0;
    if (x < 0) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(x));
    }
    return x < two_to_64 ? static_cast<std::uint64_t>(x) : 0;
  }
  static Time exact_difference(Time a, Time b);

  double nearest_ = 0;
  std::int16_t rest_ = 0;  ///< at most half of the distance of doubles below 2^64, which is 2^11
  bool is_large_ = false;
};

}  // namespace sesame::engine
