#include "sparse/integer.hpp"

#include <gmp.h>

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

/// The plain twin: a GMP number without a small case.
class Plain {
 public:
  Plain() { mpz_init(number); }
  explicit Plain(const Integer& a) { mpz_init_set_str(number, a.to_string().c_str(), 10); }
  Plain(const Plain&) = delete;
  Plain& operator=(const Plain&) = delete;
  ~Plain() { mpz_clear(number); }
  [[nodiscard]] std::string text() const {
    char* digits = mpz_get_str(nullptr, 10, number);
    std::string result{digits};
    void (*release)(void*, std::size_t) = nullptr;
    mp_get_memory_functions(nullptr, nullptr, &release);
    release(digits, result.size() + 1);
    return result;
  }
  mpz_t number;
};

/// Small, near the ends of the small range and of the machine word, and far beyond; each with both signs.
std::vector<Integer> samples() {
  std::vector<Integer> values;
  for (const int n : {0, 1, 2, 3, 7, 12, 1000}) {
    values.emplace_back(n);
  }
  for (const int bits : {31, 32, 61, 62, 63, 64, 100, 200}) {
    Integer power = 1;
    for (int i = 0; i < bits; ++i) {
      power *= 2;
    }
    for (const int shift : {-1, 0, 1}) {
      values.push_back(power + shift);
    }
  }
  std::mt19937_64 random{7};
  for (int i = 0; i < 12; ++i) {
    values.emplace_back(static_cast<std::int64_t>(random() >> (i * 5)));
    values.push_back(values.back() * static_cast<std::int64_t>(random()));
  }
  const std::size_t half = values.size();
  for (std::size_t i = 0; i < half; ++i) {
    values.push_back(-values[i]);
  }
  return values;
}

bool is_canonical(const Integer& a) {
  const bool fits = a >= Integer{-(std::int64_t{1} << 62)} && a < Integer{std::int64_t{1} << 62};
  return a.is_large() != fits;
}

}  // namespace

TEST_CASE("arithmetic agrees with GMP on all pairs of awkward values", "[sparse][twin]") {
  const auto values = samples();
  Plain expected;
  std::size_t wrong = 0;
  const auto check = [&](const Integer& value) {
    wrong += value.to_string() != expected.text() || !is_canonical(value) ? 1 : 0;
  };
  for (const Integer& a : values) {
    const Plain x{a};
    for (const Integer& b : values) {
      const Plain y{b};
      mpz_add(expected.number, x.number, y.number);
      check(a + b);
      mpz_sub(expected.number, x.number, y.number);
      check(a - b);
      mpz_mul(expected.number, x.number, y.number);
      check(a * b);
      mpz_gcd(expected.number, x.number, y.number);
      check(gcd(a, b));
      const int order = mpz_cmp(x.number, y.number);
      wrong += (a == b) != (order == 0) || (a < b) != (order < 0) || (a > b) != (order > 0) ? 1 : 0;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("division leaves a remainder from 0 up to below the size of the divisor", "[sparse][law]") {
  const auto values = samples();
  std::size_t wrong = 0;
  for (const Integer& a : values) {
    for (const Integer& b : values) {
      if (b.is_zero()) {
        continue;
      }
      const auto [q, r] = divide(a, b);
      wrong += q * b + r != a || r < Integer{0} || r >= abs(b) || !is_canonical(q) || !is_canonical(r) ? 1 : 0;
    }
  }
  CHECK(wrong == 0);
  CHECK_THROWS_AS(divide(1, 0), ContractViolation);
}

TEST_CASE("the coefficients of Bezout give the greatest common divisor", "[sparse][law]") {
  const auto values = samples();
  std::size_t wrong = 0;
  for (const Integer& a : values) {
    for (const Integer& b : values) {
      const auto [g, x, y] = extended_gcd(a, b);
      wrong += g != gcd(a, b) || x * a + y * b != g || g.sign() < 0 ? 1 : 0;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("numbers survive being written and read", "[sparse][law]") {
  for (const Integer& a : samples()) {
    const auto again = Integer::parse(a.to_string());
    REQUIRE(again.has_value());
    CHECK(*again == a);
    CHECK(is_canonical(*again));
  }
  CHECK(Integer::parse("+12") == Integer{12});
  CHECK(Integer::parse("-0") == Integer{0});
  CHECK(Integer::parse("000000000000000000000000000000007") == Integer{7});
  for (const char* text : {"", "-", "+", "1 ", " 1", "1.0", "0x1", "--1", "1e3", "one"}) {
    CAPTURE(text);
    CHECK_FALSE(Integer::parse(text).has_value());
  }
}

TEST_CASE("an operation with itself on both sides is right", "[sparse]") {
  for (const Integer& a : samples()) {
    Integer sum = a, difference = a, product = a, same = a;
    sum += *&sum;
    difference -= *&difference;
    product *= *&product;
    same = *&same;
    CHECK(sum == a * 2);
    CHECK(difference.is_zero());
    CHECK(product == a * Integer{a});
    CHECK(same == a);
    Integer moved = a;
    Integer target = Integer{std::numeric_limits<std::int64_t>::max()};
    target = std::move(moved);
    CHECK(target == a);
  }
}

TEST_CASE("the ends of the small range and of the machine word are exact", "[sparse]") {
  const std::int64_t small_end = std::int64_t{1} << 62;
  CHECK_FALSE(Integer{small_end - 1}.is_large());
  CHECK(Integer{small_end}.is_large());
  CHECK_FALSE(Integer{-small_end}.is_large());
  CHECK(Integer{-small_end - 1}.is_large());
  CHECK((-Integer{-small_end}).to_string() == "4611686018427387904");
  CHECK_FALSE((Integer{small_end} - 1).is_large());
  CHECK(divide(Integer{-small_end}, -1).quotient.to_string() == "4611686018427387904");

  const auto lowest = std::numeric_limits<std::int64_t>::min();
  CHECK(Integer{lowest}.to_int64() == lowest);
  CHECK(Integer{lowest}.to_string() == "-9223372036854775808");
  CHECK_FALSE((Integer{lowest} - 1).to_int64().has_value());
  CHECK_FALSE((-Integer{lowest}).to_int64().has_value());
}

TEST_CASE("modulo is never negative", "[sparse]") {
  for (const Integer& a : samples()) {
    for (const std::uint32_t m : {1u, 2u, 7u, 2147483647u, 4294967295u}) {
      CHECK(Integer{std::int64_t{a.modulo(m)}} == divide(a, Integer{std::int64_t{m}}).remainder);
    }
  }
}
