#include "sparse/ring.hpp"

#include <utility>

#include "sparse/quoted.hpp"

namespace sesame::sparse {
namespace {

constexpr std::int64_t modulus_end = std::int64_t{1} << 31;

/// Trial division: at most 23,170 odd candidates below 2^31, and no primality theorem to trust.
bool is_prime(std::int64_t n) {
  if (n < 4) {
    return n >= 2;
  }
  if (n % 2 == 0) {
    return false;
  }
  for (std::int64_t d = 3; d * d <= n; d += 2) {
    if (n % d == 0) {
      return false;
    }
  }
  return true;
}

Error bad_modulus(const std::string& p, const std::string& why) {
  return {Errc::bad_input, "ring Z/" + printable(p) + ": " + why + "; a modulus is a prime below 2^31"};
}

}  // namespace

Result<Zp> Zp::make(std::int64_t p) {
  if (p >= modulus_end) {
    return bad_modulus(std::to_string(p), std::to_string(p) + " is too large");
  }
  if (!is_prime(p)) {
    return bad_modulus(std::to_string(p), std::to_string(p) + " is not a prime");
  }
  return Zp{static_cast<std::uint32_t>(p)};
}

Zp::Element Zp::inverse(Element a) const {
  expects(a != 0, "inverse in Z/p: zero has none");
  std::int64_t r0 = p_, r1 = a, t0 = 0, t1 = 1;
  while (r1 != 0) {
    const std::int64_t q = r0 / r1;
    r0 = std::exchange(r1, r0 - q * r1);
    t0 = std::exchange(t1, t0 - q * t1);
  }
  return from(t0);
}

Result<AnyRing> parse_ring(std::string_view text) {
  if (text == "Z") {
    return AnyRing{Integers{}};
  }
  if (text == "Q") {
    return AnyRing{Rationals{}};
  }
  if (!text.starts_with("Z/")) {
    return Error{Errc::bad_input,
                 "unknown ring " + quoted(text) + ": a ring is Z, Q, or Z/p with p a prime below 2^31"};
  }
  const std::string modulus{text.substr(2)};
  const auto number = Integer::parse(modulus);
  if (!number || modulus.starts_with('+')) {
    return bad_modulus(modulus, quoted(modulus) + " is not a number");
  }
  if (*number == Integer{2}) {
    return AnyRing{Z2{}};
  }
  const auto p = number->to_int64();
  if (!p) {
    return bad_modulus(modulus,
                       printable(number->to_string()) + (number->sign() < 0 ? " is not a prime" : " is too large"));
  }
  auto ring = Zp::make(*p);
  if (!ring) {
    return std::move(ring).error();
  }
  return AnyRing{*ring};
}

std::string ring_name(const AnyRing& ring) {
  return std::visit([](const auto& k) { return k.name(); }, ring);
}

}  // namespace sesame::sparse
