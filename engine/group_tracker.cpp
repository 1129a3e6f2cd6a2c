#include "engine/group_tracker.hpp"

#include <algorithm>

namespace sesame::engine {

using ops::TowerComplex;

void GroupTracker::reach(std::size_t dimension) {
  if (refs_.size() < dimension + 2) {
    refs_.resize(dimension + 2);
    ages_.resize(dimension + 2);
    classes_.reach(dimension + 1);
  }
}

void GroupTracker::include(int dimension, Slot slot, std::span<const Slot> facets, Time /*time*/) {
  const auto d = static_cast<std::size_t>(dimension);
  reach(d);
  std::vector<ClassRef>& refs = refs_[d];
  if (slot >= refs.size()) {
    refs.resize(std::max<std::size_t>(slot + std::size_t{1}, refs.size() + refs.size() / 2));
    ages_[d].resize(refs.size());
  }
  ages_[d][slot] = inclusions_++;
  if (d == 0) {
    refs[slot] = classes_.append_vertex();
    return;
  }
  // Facets are anywhere in memory: all loads are begun before the first is waited for.
  facet_refs_.resize(facets.size());
  std::ranges::transform(facets, facet_refs_.begin(), [&](Slot facet) { return refs_[d - 1][facet]; });
  for (const ClassRef ref : facet_refs_) {
    classes_.prefetch(d - 1, ref);
  }
  classes_.begin_sum(d - 1);
  bool is_negative = false;
  for (const ClassRef ref : facet_refs_) {
    classes_.add(ref, is_negative);
    is_negative = !is_negative;
  }
  refs[slot] = classes_.append();
}

void GroupTracker::contract(const TowerComplex& complex, const TowerComplex::Changes& changes, Time /*time*/) {
  reach(changes.size());
  for (std::size_t d = 0; d < changes.size(); ++d) {
    shifts_.begin_dimension(d);
    // Old cells first: in another order columns of the core that young cells would end pile up, and it gets dense.
    by_age_ = changes[d];
    std::ranges::sort(by_age_, {}, [&](const TowerComplex::Change& change) { return ages_[d][change.slot]; });
    for (const TowerComplex::Change& change : by_age_) {
      if (change.fate == TowerComplex::Fate::renamed) {
        rename(complex, d, change);
      } else {
        apply(complex, d, change);
      }
    }
  }
  for (std::size_t d = 0; d < refs_.size(); ++d) {
    classes_.retire(d, refs_[d]);
  }
}

/// What g of a simplex has become by the corrections of the contraction: the sum, in the classes of its dimension.
void GroupTracker::sum_with_corrections(const TowerComplex& complex, std::size_t d,
                                        const TowerComplex::Change& change) {
  classes_.begin_sum(d);
  classes_.add(refs_[d][change.slot], false);
  shifts_.for_each_correction(complex, d, change, [&](const ContractionShifts::Shift& shift, bool is_negative) {
    classes_.add(shift.born, is_negative);
  });
}

/// A simplex is merged or squashed.
void GroupTracker::apply(const TowerComplex& complex, std::size_t d, const TowerComplex::Change& change) {
  sum_with_corrections(complex, d, change);
  if (change.fate == TowerComplex::Fate::merged) {
    classes_.add(refs_[d][change.survivor], !change.is_reversed);
  }
  refs_[d][change.slot] = {};
  const ClassRef born = classes_.append();
  if (!born.is_zero()) {
    shifts_.note({change.slot, born, 0});
  }
}

void GroupTracker::rename(const TowerComplex& complex, std::size_t d, const TowerComplex::Change& change) {
  ClassRef& ref = refs_[d][change.slot];
  if (!shifts_.is_idle()) {
    sum_with_corrections(complex, d, change);
    ref = classes_.keep_sum();
  }
  if (change.is_reversed) {
    ref = -ref;
  }
}

const Homology& GroupTracker::homology(std::size_t dimensions) {
  classes_.homology(dimensions, homology_);
  return homology_;
}

}  // namespace sesame::engine
