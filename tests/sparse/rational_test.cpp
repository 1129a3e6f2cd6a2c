#include "sparse/rational.hpp"

#include <vector>

#include "tests/support/catch.hpp"

using namespace sesame;
using sparse::Integer;
using sparse::Rational;

TEST_CASE("a fraction is in lowest terms, with a positive denominator", "[sparse]") {
  CHECK(Rational(6, -4).to_string() == "-3/2");
  CHECK(Rational(-6, -3).to_string() == "2");
  CHECK(Rational(0, -7) == Rational{});
  CHECK(Rational(0, -7).denominator() == Integer{1});
  CHECK(Rational(1, 2) == Rational(-3, -6));
  CHECK(Rational(1, 2) != Rational(1, 3));
}

TEST_CASE("fractions are added, multiplied and compared exactly, whatever their size", "[sparse]") {
  CHECK((Rational(1, 6) + Rational(1, 10)).to_string() == "4/15");
  CHECK((Rational(1, 6) - Rational(2, 12)).is_zero());
  CHECK((Rational(-4, 3) * Rational(9, 8)).to_string() == "-3/2");
  CHECK(Rational(-4, 3).inverse().to_string() == "-3/4");
  CHECK(Rational(1, 3) < Rational(2, 5));
  CHECK(Rational(-1, 3) > Rational(-2, 5));
  CHECK(abs(Rational(-1, 3)) == Rational(1, 3));
  Rational harmonic;
  for (int n = 1; n <= 100; ++n) {
    harmonic += Rational(1, n);
  }
  CHECK(harmonic.to_string() == "14466636279520351160221518043104131447711/2788815009188499086581352357412492142272");
  for (int n = 100; n >= 1; --n) {
    harmonic -= Rational(1, n);
  }
  CHECK(harmonic == Rational{});
}

TEST_CASE("a fraction may be combined with itself, and used again after it was moved from", "[sparse]") {
  Rational a(2, 3);
  a += a;
  CHECK(a == Rational(4, 3));
  a *= a;
  CHECK(a == Rational(16, 9));
  a -= a;
  CHECK(a.is_zero());
  Rational b(5, 7);
  const Rational c = std::move(b);
  b += 1;  // NOLINT(bugprone-use-after-move): that is the question
  CHECK(b == Rational{1});
  CHECK(c == Rational(5, 7));
}

TEST_CASE("a machine word is what an integer gives, and no fraction does", "[sparse]") {
  CHECK(Rational(14, 7).to_int64() == 2);
  CHECK(Rational(1, 2).to_int64() == std::nullopt);
  CHECK(Rational(*Integer::parse("100000000000000000000")).to_int64() == std::nullopt);
}
