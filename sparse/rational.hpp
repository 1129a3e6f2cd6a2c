/// \file
/// `Rational`: exact fractions of Integers.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "sparse/integer.hpp"

namespace sesame::sparse {

/// A fraction in lowest terms, its denominator positive. Also the type of coefficients as they are printed: over every
/// ring but Q these are integers, and a Rational is made of an Integer without a word.
///
/// Cost: that of the operations on Integers, and of a greatest common divisor unless both are integers.
class Rational {
 public:
  Rational() = default;
  Rational(const Rational&) = default;
  Rational(Rational&& other) noexcept
      : numerator_{std::move(other.numerator_)}, denominator_{std::exchange(other.denominator_, Integer{1})} {}
  Rational& operator=(const Rational&) = default;
  Rational& operator=(Rational&&) noexcept = default;
  ~Rational() = default;
  // Numbers are numbers.
  Rational(Integer value) : numerator_{std::move(value)} {}  // NOLINT(google-explicit-constructor)
  Rational(std::int64_t value) : numerator_{value} {}        // NOLINT(google-explicit-constructor)
  Rational(int value) : numerator_{value} {}                 // NOLINT(google-explicit-constructor)
  /// Requires: a denominator other than 0.
  Rational(Integer numerator, Integer denominator);

  [[nodiscard]] const Integer& numerator() const { return numerator_; }
  [[nodiscard]] const Integer& denominator() const { return denominator_; }
  [[nodiscard]] bool is_integer() const { return denominator_ == Integer{1}; }
  [[nodiscard]] bool is_zero() const { return numerator_.is_zero(); }
  /// -1, 0 or 1.
  [[nodiscard]] int sign() const { return numerator_.sign(); }
  /// The value as a machine word, or empty when it is none.
  [[nodiscard]] std::optional<std::int64_t> to_int64() const {
    return is_integer() ? numerator_.to_int64() : std::nullopt;
  }
  /// "3", "-1/2".
  [[nodiscard]] std::string to_string() const;
  /// Requires: not 0.
  [[nodiscard]] Rational inverse() const { return {denominator_, numerator_}; }

  Rational& operator+=(const Rational& other);
  Rational& operator-=(const Rational& other) { return *this += -other; }
  Rational& operator*=(const Rational& other);
  friend Rational operator+(Rational a, const Rational& b) { return a += b; }
  friend Rational operator-(Rational a, const Rational& b) { return a -= b; }
  friend Rational operator*(Rational a, const Rational& b) { return a *= b; }
  Rational operator-() const {
    Rational opposite = *this;
    opposite.numerator_ = -numerator_;
    return opposite;
  }

  friend bool operator==(const Rational&, const Rational&) = default;
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
    return a.numerator_ * b.denominator_ <=> b.numerator_ * a.denominator_;
  }

 private:
  void reduce();

  Integer numerator_;
  Integer denominator_ = 1;
};

template <>
inline constexpr bool is_relocatable<Rational> = true;

[[nodiscard]] Rational abs(const Rational& a);

}  // namespace sesame::sparse
