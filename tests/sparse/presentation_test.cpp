#include "sparse/presentation.hpp"

#include <algorithm>
#include <array>

#include "sparse/smith.hpp"
#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

using Vector = Terms<Integers>;

/// All generators and relations, as they were given; names of combinations are written out.
class PlainPresentation {
 public:
  Index add_generator() {
    names_.push_back({{generators_++, 1}});
    return static_cast<Index>(names_.size() - 1);
  }
  void add_combination(const Vector& combination) { names_.push_back(written_out(combination)); }
  void add_relation(const Vector& relation) { relations_.push_back(written_out(relation)); }
  [[nodiscard]] Presentation::Group group() const {
    Matrix<Integers> matrix(Integers{}, generators_, 0);
    for (const Vector& relation : relations_) {
      matrix.append_column(relation);
    }
    std::vector<Integer> factors = invariant_factors_by_elimination(matrix);
    const std::size_t rank = factors.size();
    std::erase_if(factors, [](const Integer& factor) { return factor.is_unit(); });
    return {generators_ - rank, factors};
  }
  [[nodiscard]] Index names() const { return static_cast<Index>(names_.size()); }

 private:
  [[nodiscard]] Vector written_out(const Vector& combination) const {
    Vector sum;
    for (const auto& [name, coefficient] : combination) {
      add_multiple<Integers>(Integers{}, sum, coefficient, names_[name]);
    }
    return sum;
  }

  Index generators_ = 0;
  std::vector<Vector> names_, relations_;
};

Vector random_vector(Random& random, Index names, int most_terms, int largest) {
  RawTerms<Integers> terms;
  for (int k = 1 + static_cast<int>(below(random, static_cast<Index>(most_terms))); k > 0; --k) {
    terms.push_back(
        {below(random, names), static_cast<int>(below(random, static_cast<Index>(2 * largest + 1))) - largest});
  }
  return std::move(terms).normal(Integers{});
}

}  // namespace

TEST_CASE("Presentation: the group is the Smith form of all relations, after each of them", "[sparse][twin]") {
  Random random{GENERATE(range(0u, 80u))};
  const int largest = std::array{1, 3, 12, 1000}[below(random, 4)];
  const int most_terms = 1 + static_cast<int>(below(random, 6));
  Presentation live;
  PlainPresentation plain;
  for (int step = 0; step < 40; ++step) {
    CAPTURE(step, largest, most_terms);
    const Index kind = below(random, 6);
    if (plain.names() < 3 || kind == 0) {
      live.add_generator(plain.add_generator());
    } else if (kind == 1) {
      const Vector combination = random_vector(random, plain.names(), 3, 2);
      live.add_combination(plain.names(), combination);
      plain.add_combination(combination);
    } else {
      const Vector relation = random_vector(random, plain.names(), most_terms, largest);
      live.add_relation(relation);
      plain.add_relation(relation);
    }
    if (below(random, 3) != 0) {  // not always asked: nothing may depend on it
      const auto& group = live.group();
      const auto expected = plain.group();
      REQUIRE(group.free_rank == expected.free_rank);
      REQUIRE(group.torsion == expected.torsion);
    }
  }
}

TEST_CASE("Presentation: relations that follow from many that wait change nothing, others in their span do",
          "[sparse][twin]") {
  Random random{GENERATE(range(0u, 12u))};
  constexpr Index generators = 32;
  Presentation live;
  PlainPresentation plain;
  for (Index k = 0; k < generators; ++k) {
    live.add_generator(plain.add_generator());
  }
  const bool is_doubled = below(random, 2) == 1;
  std::vector<Vector> relations;
  const auto add = [&](const Vector& relation) {
    live.add_relation(relation);
    plain.add_relation(relation);
  };
  // Without units, and coprime: they wait. The last one perhaps twice itself first.
  for (int k = 0; k < 28; ++k) {
    RawTerms<Integers> terms;
    for (const int coefficient : {2, -3, 2, 3, -2}) {
      terms.push_back({below(random, generators), coefficient});
    }
    relations.push_back(std::move(terms).normal(Integers{}));
    if (k == 27 && is_doubled) {
      Vector twice;
      add_multiple<Integers>(Integers{}, twice, 2, relations.back());
      add(twice);
    } else {
      add(relations.back());
    }
  }
  for (int step = 0; step < 16; ++step) {
    CAPTURE(step, is_doubled);
    const auto& group = live.group();
    const auto expected = plain.group();
    REQUIRE(group.free_rank == expected.free_rank);
    REQUIRE(group.torsion == expected.torsion);
    // A combination of those that were given, or one with another entry, or in the end the last relation itself.
    Vector next;
    for (int k = 0; k < 3; ++k) {
      add_multiple<Integers>(Integers{}, next, static_cast<int>(below(random, 5)) - 2, relations[below(random, 27)]);
    }
    if (step % 4 == 3) {
      const Vector more{{below(random, generators), 5}};
      add_multiple<Integers>(Integers{}, next, 1, more);
    }
    add(step == 10 ? relations.back() : next);
  }
}

TEST_CASE("Presentation: generators that a relation names are added", "[sparse]") {
  Presentation group;
  CHECK(group.group().free_rank == 0);
  group.add_relation({{3, 2}, {7, 4}});
  CHECK(group.contains(3));
  CHECK(group.contains(7));
  CHECK(!group.contains(5));
  CHECK(group.generators() == 2);
  CHECK(group.group().free_rank == 1);
  CHECK(group.group().torsion == std::vector<Integer>{2});
  group.add_relation({{7, 3}});
  CHECK(group.group().free_rank == 0);
  CHECK(group.group().torsion == std::vector<Integer>{6});
  group.add_relation({{3, 1}, {7, 2}});
  CHECK(group.group().torsion == std::vector<Integer>{3});
}

TEST_CASE("Presentation: a relation without a divisor among its entries waits, and counts", "[sparse]") {
  Presentation group;
  group.add_relation({{0, 6}, {1, 10}, {2, 15}});
  CHECK(group.group().free_rank == 2);
  CHECK(group.group().torsion.empty());
  group.add_relation({{0, 1}, {1, 1}});
  CHECK(group.group().free_rank == 1);
  CHECK(group.group().torsion.empty());  // 4 and 15
  group.add_relation({{2, 1}});
  CHECK(group.group().free_rank == 0);
  CHECK(group.group().torsion == std::vector<Integer>{4});
}

TEST_CASE("Presentation: thousands of summands, one after the other, and orders that do not divide one another",
          "[sparse]") {
  Presentation group;
  for (Index k = 0; k < 2000; ++k) {
    group.add_relation({{k, 2}});
    REQUIRE(group.group().torsion.size() == k + 1);
  }
  group.add_relation({{2000, 3}});
  CHECK(group.group().torsion.size() == 2000);
  CHECK(group.group().torsion.back() == 6);
  CHECK(group.group().torsion.front() == 2);
}
