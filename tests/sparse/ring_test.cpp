#include "sparse/ring.hpp"

#include <random>
#include <vector>

#include "sparse/ring_laws.hpp"
#include "tests/support/catch.hpp"

using namespace sesame;
using namespace sesame::sparse;

namespace {

template <Ring R>
std::vector<typename R::Element> samples(const R& ring) {
  std::vector<typename R::Element> elements;
  std::mt19937_64 random{11};
  for (const std::int64_t n : {0, 1, -1, 2, 3, -12}) {
    elements.push_back(ring.from(n));
  }
  Integer huge = 1;
  for (int i = 0; i < 10; ++i) {
    huge *= Integer{static_cast<std::int64_t>(random() >> 30)} - 1000;
    elements.push_back(ring.from(huge));
    elements.push_back(ring.from(static_cast<std::int64_t>(random())));
  }
  return elements;
}

template <Ring R>
std::optional<std::string_view> broken_law(const R& ring) {
  const auto elements = samples(ring);
  return broken_ring_law<R>(ring, elements);
}

/// Z/9, passed off as a field by a hasty author.
struct NoField : Z2 {
  using Element = std::uint8_t;
  Element from(std::int64_t n) const { return static_cast<Element>(((n % 9) + 9) % 9); }
  Element from(const Integer& n) const { return static_cast<Element>(n.modulo(9)); }
  Element add(Element a, Element b) const { return static_cast<Element>((a + b) % 9); }
  Element subtract(Element a, Element b) const { return static_cast<Element>((a + 9 - b) % 9); }
  Element negate(Element a) const { return static_cast<Element>((9 - a) % 9); }
  Element multiply(Element a, Element b) const { return static_cast<Element>(a * b % 9); }
  void add_product(Element& acc, Element a, Element b) const { acc = add(acc, multiply(a, b)); }
  std::uint32_t characteristic() const { return 9; }
};

/// The integers, but with a division that rounds towards zero.
struct Truncating : Integers {
  Element quotient(const Element& a, const Element& b) const {
    const Integer q = divide(abs(a), abs(b)).quotient;
    return a.sign() * b.sign() < 0 ? -q : q;
  }
};

/// The integers, but add_product forgets what was there.
struct Forgetful : Integers {
  void add_product(Element& acc, const Element& a, const Element& b) const { acc = a * b; }
};

std::string what(std::string_view text) {
  const auto ring = parse_ring(text);
  return ring ? "accepted" : ring.error().what;
}

}  // namespace

TEST_CASE("every ring passes the law check", "[sparse][law]") {
  CHECK(broken_law(Integers{}) == std::nullopt);
  CHECK(broken_law(Z2{}) == std::nullopt);
  CHECK(broken_law(Rationals{}) == std::nullopt);
  std::vector<Rational> fractions;
  for (const int denominator : {1, -2, 3, 12, 1'000'000'007}) {
    for (const int numerator : {0, 1, -1, 6, -35}) {
      fractions.emplace_back(numerator, denominator);
    }
  }
  CHECK(broken_ring_law<Rationals>(Rationals{}, fractions) == std::nullopt);
  for (const std::int64_t p : {2, 3, 5, 65537, 2147483647}) {
    CAPTURE(p);
    CHECK(broken_law(*Zp::make(p)) == std::nullopt);
  }
}

TEST_CASE("the law check names what is wrong with a ring", "[sparse]") {
  CHECK(broken_law(NoField{}) == "a a^-1 = 1 for a unit a");
  CHECK(broken_law(Truncating{}) == "0 <= a - quotient(a, b) b < |b|");
  CHECK(broken_law(Forgetful{}) == "add_product(a, b, c) is a + b c");
}

TEST_CASE("rings are read from their names", "[sparse]") {
  for (const char* name : {"Z", "Q", "Z/2", "Z/3", "Z/2147483647"}) {
    CAPTURE(name);
    REQUIRE(parse_ring(name).has_value());
    CHECK(ring_name(*parse_ring(name)) == name);
  }
  CHECK(std::holds_alternative<Integers>(*parse_ring("Z")));
  CHECK(std::holds_alternative<Rationals>(*parse_ring("Q")));
  CHECK(std::holds_alternative<Z2>(*parse_ring("Z/2")));
  CHECK(std::holds_alternative<Zp>(*parse_ring("Z/3")));
}

TEST_CASE("a name that is no ring is refused with what would be right", "[sparse]") {
  using Catch::Matchers::Contains;
  CHECK_THAT(what("Z/4"), Contains("4 is not a prime"));
  CHECK_THAT(what("Z/0"), Contains("0 is not a prime"));
  CHECK_THAT(what("Z/1"), Contains("1 is not a prime"));
  CHECK_THAT(what("Z/-3"), Contains("-3 is not a prime"));
  CHECK_THAT(what("Z/2147483659"), Contains("2147483659 is too large"));
  CHECK_THAT(what("Z/123456789012345678901234567890"), Contains("is too large"));
  CHECK_THAT(what("Z/2x"), Contains("\"2x\" is not a number"));
  CHECK_THAT(what("Z/"), Contains("is not a number"));
  for (const char* name : {"q", "", "z", "Z/4", "Z/2x", "ZZ", "Z/2147483648", "Z/+3", "Z/-99999999999999999999"}) {
    CAPTURE(name);
    REQUIRE_FALSE(parse_ring(name).has_value());
    CHECK(parse_ring(name).error().code == Errc::bad_input);
    CHECK_THAT(what(name), Contains("prime below 2^31"));
  }
}

TEST_CASE("exactly the primes are accepted as moduli", "[sparse]") {
  std::vector<bool> composite(2000);
  for (std::size_t n = 2; n < composite.size(); ++n) {
    for (std::size_t m = 2 * n; m < composite.size(); m += n) {
      composite[m] = true;
    }
    CHECK(Zp::make(static_cast<std::int64_t>(n)).has_value() == !composite[n]);
  }
  CHECK_FALSE(Zp::make(46337LL * 46327).has_value());  // a product of two large primes
  CHECK_FALSE(Zp::make(46337LL * 46337).has_value());
}
