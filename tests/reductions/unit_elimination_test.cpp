#include "reductions/unit_elimination.hpp"

#include <algorithm>
#include <vector>

#include "reductions/elimination.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using reductions::Reduction;
using reductions::UnitElimination;

namespace {

/// The plain twin: one reduction after the other, each by a pair, in the order in which UnitElimination finds them.
template <Ring R>
class PairByPair {
 public:
  explicit PairByPair(const ChainComplex<R>& complex) : reduction_{reductions::identity_reduction(complex)} {
    for (int p = 0; p <= complex.top(); ++p) {
      std::vector<Index>& ids = ids_.emplace_back();
      for (Index x = 0; x < complex.size(p); ++x) {
        ids.push_back(x);
      }
    }
    for (int p = 1; p <= complex.top(); ++p) {
      eliminate_degree(p, complex.size(p));
    }
  }
  [[nodiscard]] const Reduction<R>& reduction() const { return reduction_; }

 private:
  void eliminate_degree(int p, Index size) {
    std::vector<Index> left;
    for (Index x = 0; x < size; ++x) {
      if (!settle(p, x)) {
        left.push_back(x);
      }
    }
    while (std::erase_if(left, [&](Index x) { return settle(p, x); }) != 0) {
    }
  }

  /// Pairs generator x, by its first number, with the last one that has a unit coefficient in its boundary.
  bool settle(int p, Index x) {
    std::vector<Index>& above = ids_[static_cast<std::size_t>(p)];
    std::vector<Index>& below = ids_[static_cast<std::size_t>(p) - 1];
    const auto at = std::find(above.begin(), above.end(), x);
    const auto b = static_cast<Index>(at - above.begin());
    const Terms<R> boundary = reduction_.small.boundary(p).column(b);
    const auto pivot = std::find_if(boundary.rbegin(), boundary.rend(), [&](const auto& term) {
      return reduction_.small.ring().is_unit(term.coefficient);
    });
    if (pivot == boundary.rend()) {
      return false;
    }
    reduction_ = eliminate_pair(reduction_, p - 1, pivot->index, b).value();
    below.erase(below.begin() + pivot->index);
    above.erase(at);
    return true;
  }

  Reduction<R> reduction_;
  std::vector<std::vector<Index>> ids_;  ///< per degree: the first numbers of those that are left
};

}  // namespace

TEMPLATE_TEST_CASE("UnitElimination: is what eliminating the same pairs one by one gives", "[reductions][twin]",
                   Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  const unsigned seed = GENERATE(range(0U, 60U));
  CAPTURE(seed);
  Random random(seed);
  const auto complex = random_complex(ring, random).complex;
  const PairByPair<TestType> twin(complex);
  const UnitElimination<TestType> elimination(complex, UnitElimination<TestType>::Keep::traces);
  CHECK(elimination.small() == twin.reduction().small);
  CHECK(elimination.f() == twin.reduction().f);
  CHECK(elimination.g() == twin.reduction().g);
  CHECK(elimination.h() == twin.reduction().h);
}

TEMPLATE_TEST_CASE("UnitElimination: without traces there is the same small complex, and no map", "[reductions]",
                   Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto complex = random_complex(ring, random).complex;
    const UnitElimination<TestType> all(complex, UnitElimination<TestType>::Keep::traces);
    const UnitElimination<TestType> few(complex, UnitElimination<TestType>::Keep::boundaries);
    CHECK(few.small() == all.small());
    if (few.small().total_size() != 0) {
      CHECK_THROWS_AS(few.g(), sparse::ContractViolation);
    }
  }
}

TEST_CASE("UnitElimination: a unit that a later pair makes is found", "[reductions]") {
  // d x = 2 a + 3 b, d y = a + b: once y has gone, d x = b (or -a).
  const auto complex = complex_of(Integers{}, {2, 2}, {{{{0, 2}, {1, 3}}, {{0, 1}, {1, 1}}}});
  const UnitElimination<Integers> elimination(complex, UnitElimination<Integers>::Keep::boundaries);
  CHECK(elimination.small().total_size() == 0);
}
