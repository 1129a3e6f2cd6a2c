/// \file
/// The corrections that a contraction makes to g of simplices whose facets are merged or squashed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/towers/class_space.hpp"
#include "ops/simplicial/tower_complex.hpp"

namespace sesame::engine {

/// The generator y of a merged or squashed simplex x has boundary g(x) - e g(survivor), or g(x). Every simplex with x
/// as its facet k has -(-1)^k y as a correction. Generators are noted for the dimension in hand, and read for the one
/// below.
class ContractionShifts {
 public:
  using Slot = ops::TowerComplex::Slot;
  struct Shift {
    Slot slot;                ///< of x
    ClassRef born;            ///< the class that y bears; 0 when it kills one, and is 0 in homology
    std::uint32_t generator;  ///< y, for who keeps chains of generators
  };

  /// Before the simplices of each dimension, 0 first.
  void begin_dimension(std::size_t dimension) {
    below_.swap(here_);
    here_.clear();
    if (dimension == 0) {
      below_.clear();
    }
    std::ranges::sort(below_, {}, &Shift::slot);
  }
  void note(const Shift& shift) { here_.push_back(shift); }
  /// True when nothing is corrected in this dimension.
  [[nodiscard]] bool is_idle() const { return below_.empty(); }

  /// Calls visit(shift, is_negative) for each correction of a simplex that the contraction changes, of the
  /// dimension in hand. Requires: the complex has not carried the contraction out.
  template <class Visit>
  void for_each_correction(const ops::TowerComplex& complex, std::size_t dimension,
                           const ops::TowerComplex::Change& change, Visit&& visit) const {
    if (is_idle()) {
      return;
    }
    // The facet without the moved vertex has not changed.
    complex.for_each_facet(static_cast<int>(dimension), change.slot, change.moved_at, [&](std::size_t k, Slot facet) {
      const auto at = std::ranges::lower_bound(below_, facet, {}, &Shift::slot);
      if (at != below_.end() && at->slot == facet) {
        visit(*at, k % 2 == 0);
      }
    });
  }

 private:
  std::vector<Shift> here_, below_;
};

}  // namespace sesame::engine
