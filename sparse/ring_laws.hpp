/// \file
/// What must hold of every ring: the laws behind the concept `Ring`, as a check that names the first broken one.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "sparse/ring.hpp"

namespace sesame::sparse {

/// The laws that a single element has to obey.
template <Ring R>
std::optional<std::string_view> broken_ring_law(const R& k, const typename R::Element& a) {
  if (k.add(a, k.zero()) != a) {
    return "a + 0 = a";
  }
  if (k.multiply(a, k.one()) != a) {
    return "a 1 = a";
  }
  if (!k.is_zero(k.multiply(a, k.zero()))) {
    return "a 0 = 0";
  }
  if (!k.is_zero(k.add(a, k.negate(a)))) {
    return "a + (-a) = 0";
  }
  if (k.is_zero(a) != (a == k.zero())) {
    return "is_zero(a) says whether a = 0";
  }
  if (from_rational(k, to_rational(k, a)) != a) {
    return "from(to_integer(a)) = a";
  }
  if (k.is_unit(a) && k.multiply(a, k.inverse(a)) != k.one()) {
    return "a a^-1 = 1 for a unit a";
  }
  if (R::is_field && k.is_unit(a) == k.is_zero(a)) {
    return "in a field exactly the nonzero elements are units";
  }
  if (k.characteristic() != 0) {
    const Integer n = k.to_integer(a);
    if (n < Integer{0} || n >= Integer{std::int64_t{k.characteristic()}}) {
      return "0 <= to_integer(a) < characteristic";
    }
  }
  return std::nullopt;
}

/// The laws that two elements have to obey.
template <Ring R>
std::optional<std::string_view> broken_ring_law(const R& k, const typename R::Element& a,
                                                const typename R::Element& b) {
  if (k.add(a, b) != k.add(b, a)) {
    return "a + b = b + a";
  }
  if (k.multiply(a, b) != k.multiply(b, a)) {
    return "a b = b a";
  }
  if (k.subtract(a, b) != k.add(a, k.negate(b))) {
    return "a - b = a + (-b)";
  }
  if (k.is_zero(k.multiply(a, b)) != (k.is_zero(a) || k.is_zero(b))) {
    return "a b = 0 only when a = 0 or b = 0";
  }
  if (from_rational(k, to_rational(k, a) + to_rational(k, b)) != k.add(a, b)) {
    return "from(m + n) = from(m) + from(n)";
  }
  if (from_rational(k, to_rational(k, a) * to_rational(k, b)) != k.multiply(a, b)) {
    return "from(m n) = from(m) from(n)";
  }
  if (k.is_zero(b)) {
    return std::nullopt;
  }
  const typename R::Element rest = k.subtract(a, k.multiply(k.quotient(a, b), b));
  if ((R::is_field || k.is_unit(b)) && !k.is_zero(rest)) {
    return "a = quotient(a, b) b for a unit b";
  }
  if (!R::is_field) {
    const Integer r = k.to_integer(rest);
    if (r < Integer{0} || r >= abs(k.to_integer(b))) {
      return "0 <= a - quotient(a, b) b < |b|";
    }
  }
  return std::nullopt;
}

/// The laws that three elements have to obey.
template <Ring R>
std::optional<std::string_view> broken_ring_law(const R& k, const typename R::Element& a, const typename R::Element& b,
                                                const typename R::Element& c) {
  if (k.add(k.add(a, b), c) != k.add(a, k.add(b, c))) {
    return "(a + b) + c = a + (b + c)";
  }
  if (k.multiply(k.multiply(a, b), c) != k.multiply(a, k.multiply(b, c))) {
    return "(a b) c = a (b c)";
  }
  if (k.multiply(a, k.add(b, c)) != k.add(k.multiply(a, b), k.multiply(a, c))) {
    return "a (b + c) = a b + a c";
  }
  typename R::Element sum = a;
  k.add_product(sum, b, c);
  if (sum != k.add(a, k.multiply(b, c))) {
    return "add_product(a, b, c) is a + b c";
  }
  return std::nullopt;
}

/// The first law that fails for the ring itself or among the samples, or nothing. Cost O(samples^3).
template <Ring R>
std::optional<std::string_view> broken_ring_law(const R& k, std::span<const typename R::Element> samples) {
  const Integer characteristic{std::int64_t{k.characteristic()}};
  if (k.is_zero(k.one()) || !k.is_unit(k.one()) || k.is_unit(k.zero())) {
    return "0 is no unit, 1 is one";
  }
  if (!k.is_zero(k.from(characteristic))) {
    return "characteristic 1 = 0";
  }
  if (k.from(std::int64_t{0}) != k.zero() || k.from(std::int64_t{1}) != k.one()) {
    return "from(0) = 0, from(1) = 1";
  }
  if (k.from(std::int64_t{-1}) != k.negate(k.one())) {
    return "from(-1) = -1";
  }
  for (const auto& a : samples) {
    if (const auto law = broken_ring_law(k, a)) {
      return law;
    }
  }
  for (const auto& a : samples) {
    for (const auto& b : samples) {
      if (const auto law = broken_ring_law(k, a, b)) {
        return law;
      }
      for (const auto& c : samples) {
        if (const auto law = broken_ring_law(k, a, b, c)) {
          return law;
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace sesame::sparse
