/// \file
/// `Integer`: a machine word that goes on in arbitrary precision when it overflows.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sparse/contract.hpp"
#include "sparse/growing_array.hpp"

namespace sesame::sparse {

/// An integer of any size in one 64-bit word.
///
/// Values in [-2^62, 2^62) are stored in the word itself, shifted left by one: no allocation, and every operation on
/// them is a machine operation with an overflow check. Any other value lives in a GMP number on the heap, whose
/// address (tagged with a 1 in the lowest bit) is the word. The form is canonical: a value that fits is never on the
/// heap, so two small values are equal exactly when their words are.
///
/// Cost: O(1) for small values, that of GMP for large ones. No operation loses a digit.
class Integer {
 public:
  constexpr Integer() noexcept = default;
  Integer(std::int64_t value) : word_{0} {  // NOLINT(google-explicit-constructor): a number is a number
    if (value >= min_small && value <= max_small) [[likely]] {
      word_ = value * 2;
    } else {
      set_large(value);
    }
  }
  Integer(int value) : word_{std::int64_t{value} * 2} {}  // NOLINT(google-explicit-constructor)
  Integer(const Integer& other) : word_{other.word_} {
    if (is_large()) [[unlikely]] {
      clone_from(other);
    }
  }
  Integer(Integer&& other) noexcept : word_{std::exchange(other.word_, 0)} {}
  Integer& operator=(const Integer& other) {
    if (((word_ | other.word_) & 1) == 0) [[likely]] {
      word_ = other.word_;
    } else if (this != &other) {
      Integer copy{other};
      std::swap(word_, copy.word_);
    }
    return *this;
  }
  Integer& operator=(Integer&& other) noexcept {
    std::swap(word_, other.word_);
    return *this;
  }
  ~Integer() {
    if (is_large()) [[unlikely]] {
      free_large();
    }
  }

  /// Decimal digits with an optional leading sign; nothing else. Empty when `digits` is not such a text.
  static std::optional<Integer> parse(std::string_view digits);

  /// True when the value is held on the heap. For tests and statistics; arithmetic hides the difference.
  [[nodiscard]] bool is_large() const { return (word_ & 1) != 0; }
  /// The machine words that the value takes: what arithmetic with it costs.
  [[nodiscard]] std::size_t words() const { return is_large() ? large_words() : 1; }
  [[nodiscard]] bool is_zero() const { return word_ == 0; }
  /// True for 1 and -1, the units of Z.
  [[nodiscard]] bool is_unit() const { return word_ == 2 || word_ == -2; }
  /// -1, 0 or 1.
  [[nodiscard]] int sign() const { return is_large() ? large_sign() : (word_ > 0) - (word_ < 0); }
  /// The value as a machine word, or empty when it does not fit.
  [[nodiscard]] std::optional<std::int64_t> to_int64() const;
  [[nodiscard]] std::string to_string() const;
  /// The remainder of the value by m, in [0, m). Requires m > 0.
  [[nodiscard]] std::uint32_t modulo(std::uint32_t m) const;

  Integer& operator+=(const Integer& other) {
    std::int64_t sum = 0;
    if (((word_ | other.word_) & 1) == 0 && !__builtin_add_overflow(word_, other.word_, &sum)) [[likely]] {
      word_ = sum;
    } else {
      add_large(other);
    }
    return *this;
  }
  Integer& operator-=(const Integer& other) {
    std::int64_t difference = 0;
    if (((word_ | other.word_) & 1) == 0 && !__builtin_sub_overflow(word_, other.word_, &difference)) [[likely]] {
      word_ = difference;
    } else {
      subtract_large(other);
    }
    return *this;
  }
  Integer& operator*=(const Integer& other) {
    std::int64_t product = 0;
    if (((word_ | other.word_) & 1) == 0 && !__builtin_mul_overflow(word_ / 2, other.word_, &product)) [[likely]] {
      word_ = product;
    } else {
      multiply_large(other);
    }
    return *this;
  }
  friend Integer operator+(Integer a, const Integer& b) { return a += b; }
  friend Integer operator-(Integer a, const Integer& b) { return a -= b; }
  friend Integer operator*(Integer a, const Integer& b) { return a *= b; }
  Integer operator-() const { return Integer{} -= *this; }

  friend bool operator==(const Integer& a, const Integer& b) {
    return a.word_ == b.word_ || (a.is_large() && b.is_large() && compare_large(a, b) == 0);
  }
  friend std::strong_ordering operator<=>(const Integer& a, const Integer& b) {
    if (((a.word_ | b.word_) & 1) == 0) [[likely]] {
      return a.word_ <=> b.word_;
    }
    return compare_large(a, b) <=> 0;
  }

 private:
  static constexpr std::int64_t max_small = (std::int64_t{1} << 62) - 1;
  static constexpr std::int64_t min_small = -(std::int64_t{1} << 62);

  void set_large(std::int64_t value);
  void clone_from(const Integer& other);
  void free_large() noexcept;
  void add_large(const Integer& other);
  void subtract_large(const Integer& other);
  void multiply_large(const Integer& other);
  [[nodiscard]] int large_sign() const;
  [[nodiscard]] std::size_t large_words() const;
  static int compare_large(const Integer& a, const Integer& b);

  friend struct IntegerAccess;  // integer.cpp: the GMP side

  std::int64_t word_ = 0;
};

/// Its word or the address that it has are all there is.
template <>
inline constexpr bool is_relocatable<Integer> = true;

[[nodiscard]] Integer abs(const Integer& a);

/// Euclidean division: a = quotient * b + remainder with 0 <= remainder < |b|. Requires b != 0.
struct Division {
  Integer quotient;
  Integer remainder;
};
[[nodiscard]] Division divide(const Integer& a, const Integer& b);

/// The greatest common divisor, never negative; gcd(0, 0) = 0.
[[nodiscard]] Integer gcd(const Integer& a, const Integer& b);

/// g = gcd(a, b) = x a + y b.
struct Bezout {
  Integer g;
  Integer x;
  Integer y;
};
[[nodiscard]] Bezout extended_gcd(const Integer& a, const Integer& b);

}  // namespace sesame::sparse
