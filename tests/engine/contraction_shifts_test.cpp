#include "engine/towers/contraction_shifts.hpp"

#include <map>

#include "tests/support/catch.hpp"
#include "tests/support/random_towers.hpp"

namespace sesame {
namespace {

using engine::ContractionShifts;
using ops::Label;
using ops::TowerComplex;
using Corrections = std::multimap<std::uint32_t, bool>;

/// The generator noted for the simplex in each slot of a dimension.
using Noted = std::map<TowerComplex::Slot, std::uint32_t>;

std::map<std::vector<Label>, TowerComplex::Slot> slots_by_labels(const TowerComplex& complex, int dimension) {
  std::map<std::vector<Label>, TowerComplex::Slot> slots;
  complex.for_each(dimension, [&](TowerComplex::Slot slot) {
    std::vector<Label> labels = complex.labels(dimension, slot);
    std::ranges::sort(labels);
    slots[labels] = slot;
  });
  return slots;
}

/// What a simplex should be corrected by: -(-1)^k for each facet k that was noted, if it has the moved vertex.
Corrections expected(const TowerComplex& complex, int dimension, const TowerComplex::Change& change,
                     const Noted& below) {
  const auto slots = slots_by_labels(complex, dimension - 1);
  const std::vector<Label> labels = complex.labels(dimension, change.slot);
  Corrections corrections;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    std::vector<Label> facet = labels;
    facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(k));
    std::ranges::sort(facet);
    const auto noted = below.find(slots.at(facet));
    if (k != change.moved_at && noted != below.end()) {
      corrections.emplace(noted->second, k % 2 == 0);
    }
  }
  return corrections;
}

/// Goes through a contraction, noting a generator for most simplices that go.
std::size_t check_contraction(const TowerComplex& complex, const TowerComplex::Changes& changes) {
  ContractionShifts shifts;
  Noted below, here;
  std::uint32_t generator = 0;
  std::size_t corrected = 0;
  for (std::size_t d = 0; d < changes.size(); ++d) {
    shifts.begin_dimension(d);
    below = std::move(here);
    here.clear();
    CHECK(shifts.is_idle() == below.empty());
    for (const TowerComplex::Change& change : changes[d]) {
      Corrections found;
      shifts.for_each_correction(complex, d, change, [&](const ContractionShifts::Shift& shift, bool is_negative) {
        found.emplace(shift.generator, is_negative);
        CHECK(shift.born.node() == shift.generator + 100);
      });
      CHECK(found == (d == 0 ? Corrections{} : expected(complex, static_cast<int>(d), change, below)));
      corrected += found.size();
      if (change.fate != TowerComplex::Fate::renamed && ++generator % 4 != 0) {
        shifts.note({change.slot, engine::ClassRef{generator + 100}, generator});
        here[change.slot] = generator;
      }
    }
  }
  return corrected;
}

TEST_CASE("a contraction corrects simplices by the generators of their facets that go", "[engine][tower]") {
  std::size_t corrected = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    TowerComplex complex;
    for (const tests::TowerStep& step : tests::random_tower(seed, 150, 8, 2)) {
      if (step.is_contraction) {
        corrected += check_contraction(complex, *complex.plan_contraction(step.labels[0], step.labels[1]).value());
        complex.contract();
      } else {
        tests::apply(step, complex);
      }
    }
  }
  CHECK(corrected > 50);
}

}  // namespace
}  // namespace sesame
