/// \file
/// Coefficients. A ring is a small value that is passed to whatever computes with its elements; the concept says what
/// it must offer, `broken_ring_law` (ring_laws.hpp) what must hold of it.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "sparse/contract.hpp"
#include "sparse/integer.hpp"
#include "sparse/rational.hpp"
#include "sparse/result.hpp"

namespace sesame::sparse {

/// A commutative Euclidean ring with 1: the integers, or a field.
///
/// `quotient(a, b)` is the q of a Euclidean division a = q b + r: r = 0 in a field, 0 <= r < |b| in Z.
/// `add_product(acc, a, b)` is acc += a b, the one operation of every inner loop.
/// `to_integer` gives the representative that is printed: the value in Z, the one in [0, p) in Z/p; in Q, where not
/// every element has one, `to_rational` (below) does.
template <class R>
concept Ring = std::copyable<R> && std::equality_comparable<R> && std::regular<typename R::Element> &&
    requires(const R k, const typename R::Element a, typename R::Element& acc, std::int64_t n, const Integer& z) {
  { R::is_field } -> std::convertible_to<bool>;
  { k.zero() } -> std::same_as<typename R::Element>;
  { k.one() } -> std::same_as<typename R::Element>;
  { k.from(n) } -> std::same_as<typename R::Element>;
  { k.from(z) } -> std::same_as<typename R::Element>;
  { k.to_integer(a) } -> std::same_as<Integer>;
  { k.add(a, a) } -> std::same_as<typename R::Element>;
  { k.subtract(a, a) } -> std::same_as<typename R::Element>;
  { k.negate(a) } -> std::same_as<typename R::Element>;
  { k.multiply(a, a) } -> std::same_as<typename R::Element>;
  { k.add_product(acc, a, a) } -> std::same_as<void>;
  { k.is_zero(a) } -> std::same_as<bool>;
  { k.is_unit(a) } -> std::same_as<bool>;
  { k.inverse(a) } -> std::same_as<typename R::Element>;      // requires is_unit(a)
  { k.quotient(a, a) } -> std::same_as<typename R::Element>;  // requires a nonzero divisor
  { k.characteristic() } -> std::same_as<std::uint32_t>;
  { k.name() } -> std::same_as<std::string>;
};

/// What the rings of exact numbers share: their elements come with the arithmetic.
template <class Number>
class ExactNumbers {
 public:
  using Element = Number;

  [[nodiscard]] Element zero() const { return {}; }
  [[nodiscard]] Element one() const { return 1; }
  [[nodiscard]] Element from(std::int64_t n) const { return n; }
  [[nodiscard]] Element from(const Integer& n) const { return n; }
  [[nodiscard]] Element add(const Element& a, const Element& b) const { return a + b; }
  [[nodiscard]] Element subtract(const Element& a, const Element& b) const { return a - b; }
  [[nodiscard]] Element negate(const Element& a) const { return -a; }
  [[nodiscard]] Element multiply(const Element& a, const Element& b) const { return a * b; }
  void add_product(Element& acc, const Element& a, const Element& b) const { acc += a * b; }
  [[nodiscard]] bool is_zero(const Element& a) const { return a.is_zero(); }
  [[nodiscard]] std::uint32_t characteristic() const { return 0; }
  friend bool operator==(const ExactNumbers&, const ExactNumbers&) = default;
};

/// The integers.
class Integers : public ExactNumbers<Integer> {
 public:
  static constexpr bool is_field = false;

  [[nodiscard]] Integer to_integer(const Element& a) const { return a; }
  [[nodiscard]] bool is_unit(const Element& a) const { return a.is_unit(); }
  [[nodiscard]] Element inverse(const Element& a) const {
    expects(a.is_unit(), "inverse in Z: only 1 and -1 have one");
    return a;
  }
  [[nodiscard]] Element quotient(const Element& a, const Element& b) const { return divide(a, b).quotient; }
  [[nodiscard]] std::string name() const { return "Z"; }
  friend bool operator==(const Integers&, const Integers&) = default;
};

/// The field with two elements.
class Z2 {
 public:
  using Element = std::uint8_t;
  static constexpr bool is_field = true;

  [[nodiscard]] Element zero() const { return 0; }
  [[nodiscard]] Element one() const { return 1; }
  [[nodiscard]] Element from(std::int64_t n) const { return static_cast<Element>(n & 1); }
  [[nodiscard]] Element from(const Integer& n) const { return static_cast<Element>(n.modulo(2)); }
  [[nodiscard]] Integer to_integer(Element a) const { return int{a}; }
  [[nodiscard]] Element add(Element a, Element b) const { return static_cast<Element>(a ^ b); }
  [[nodiscard]] Element subtract(Element a, Element b) const { return static_cast<Element>(a ^ b); }
  [[nodiscard]] Element negate(Element a) const { return a; }
  [[nodiscard]] Element multiply(Element a, Element b) const { return static_cast<Element>(a & b); }
  void add_product(Element& acc, Element a, Element b) const { acc = static_cast<Element>(acc ^ (a & b)); }
  [[nodiscard]] bool is_zero(Element a) const { return a == 0; }
  [[nodiscard]] bool is_unit(Element a) const { return a != 0; }
  [[nodiscard]] Element inverse(Element a) const {
    expects(a != 0, "inverse in Z/2: zero has none");
    return a;
  }
  [[nodiscard]] Element quotient(Element a, Element b) const {
    expects(b != 0, "quotient in Z/2: division by zero");
    return a;
  }
  [[nodiscard]] std::uint32_t characteristic() const { return 2; }
  [[nodiscard]] std::string name() const { return "Z/2"; }
  friend bool operator==(const Z2&, const Z2&) = default;
};

/// The field with p elements, p a prime below 2^31. Elements are in [0, p).
class Zp {
 public:
  using Element = std::uint32_t;
  static constexpr bool is_field = true;

  /// Errors: bad_input when p is not a prime below 2^31.
  static Result<Zp> make(std::int64_t p);

  [[nodiscard]] Element zero() const { return 0; }
  [[nodiscard]] Element one() const { return 1; }
  [[nodiscard]] Element from(std::int64_t n) const {
    const auto p = static_cast<std::int64_t>(p_);
    const std::int64_t r = n % p;
    return static_cast<Element>(r < 0 ? r + p : r);
  }
  [[nodiscard]] Element from(const Integer& n) const { return n.modulo(p_); }
  [[nodiscard]] Integer to_integer(Element a) const { return std::int64_t{a}; }
  [[nodiscard]] Element add(Element a, Element b) const {
    const Element s = a + b;  // below 2^32: p is below 2^31
    return s >= p_ ? s - p_ : s;
  }
  [[nodiscard]] Element subtract(Element a, Element b) const { return a >= b ? a - b : a + p_ - b; }
  [[nodiscard]] Element negate(Element a) const { return a == 0 ? 0 : p_ - a; }
  [[nodiscard]] Element multiply(Element a, Element b) const { return static_cast<Element>(std::uint64_t{a} * b % p_); }
  void add_product(Element& acc, Element a, Element b) const {
    acc = static_cast<Element>((std::uint64_t{a} * b + acc) % p_);
  }
  [[nodiscard]] bool is_zero(Element a) const { return a == 0; }
  [[nodiscard]] bool is_unit(Element a) const { return a != 0; }
  [[nodiscard]] Element inverse(Element a) const;
  [[nodiscard]] Element quotient(Element a, Element b) const { return multiply(a, inverse(b)); }
  [[nodiscard]] std::uint32_t characteristic() const { return p_; }
  [[nodiscard]] std::string name() const { return "Z/" + std::to_string(p_); }
  friend bool operator==(const Zp&, const Zp&) = default;

 private:
  explicit Zp(std::uint32_t p) : p_{p} {}
  std::uint32_t p_;
};

/// The field of rational numbers, exact.
class Rationals : public ExactNumbers<Rational> {
 public:
  static constexpr bool is_field = true;

  [[nodiscard]] Integer to_integer(const Element& a) const {
    expects(a.is_integer(), "to_integer in Q: of integers only");
    return a.numerator();
  }
  [[nodiscard]] bool is_unit(const Element& a) const { return !a.is_zero(); }
  [[nodiscard]] Element inverse(const Element& a) const {
    expects(!a.is_zero(), "inverse in Q: zero has none");
    return a.inverse();
  }
  [[nodiscard]] Element quotient(const Element& a, const Element& b) const { return a * inverse(b); }
  [[nodiscard]] std::string name() const { return "Q"; }
  friend bool operator==(const Rationals&, const Rationals&) = default;
};

static_assert(Ring<Integers> && Ring<Z2> && Ring<Zp> && Ring<Rationals>);

/// An element as it is printed.
template <Ring R>
[[nodiscard]] Rational to_rational(const R& ring, const typename R::Element& a) {
  if constexpr (std::same_as<typename R::Element, Rational>) {
    return a;
  } else {
    return ring.to_integer(a);
  }
}

/// The element that a fraction is. Requires: its denominator is a unit of the ring.
template <Ring R>
[[nodiscard]] typename R::Element from_rational(const R& ring, const Rational& a) {
  const typename R::Element numerator = ring.from(a.numerator());
  return a.is_integer() ? numerator : ring.multiply(numerator, ring.inverse(ring.from(a.denominator())));
}

/// A ring chosen at run time.
using AnyRing = std::variant<Integers, Z2, Zp, Rationals>;

/// "Z", "Q" or "Z/p". Errors: bad_input, saying what would be right.
Result<AnyRing> parse_ring(std::string_view text);
[[nodiscard]] std::string ring_name(const AnyRing& ring);

}  // namespace sesame::sparse

/// Lists the explicit instantiations of a template for every ring: `SESAME_FOR_EACH_RING(X)` expands X(R) for each.
/// A new ring is one line here; forgetting it is a link error that names the type.
#define SESAME_FOR_EACH_RING(X) \
  X(::sesame::sparse::Integers) \
  X(::sesame::sparse::Z2)       \
  X(::sesame::sparse::Zp)       \
  X(::sesame::sparse::Rationals)
