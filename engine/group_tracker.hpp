/// \file
/// The homology groups of a tower over Z, kept current at every operation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/integral_classes.hpp"
#include "engine/towers/contraction_shifts.hpp"
#include "engine/towers/tower_tracker.hpp"

namespace sesame::engine {

/// Takes the operations of a tower one by one, and knows the groups over Z after each. No cells, names or chains are
/// kept; for these there is the Engine. Memory: that of the complex and its classes; once there was a boundary without
/// a unit, that of all that has happened since.
///
/// Threads: one at a time, for queries too.
class GroupTracker final : public TowerTracker {
 public:
  void include(int dimension, Slot slot, std::span<const Slot> facets, Time time) override;
  void contract(const ops::TowerComplex& complex, const ops::TowerComplex::Changes& changes, Time time) override;

  /// The groups of the dimensions below a number: Betti numbers and torsion. Valid until the next operation. Cost:
  /// those dimensions; where there is torsion, see Groups::torsion.
  [[nodiscard]] const Homology& homology(std::size_t dimensions);
  /// Whether there was a boundary without a unit.
  [[nodiscard]] bool has_core() const { return classes_.has_core(); }

 private:
  void reach(std::size_t dimension);
  void sum_with_corrections(const ops::TowerComplex& complex, std::size_t d, const ops::TowerComplex::Change& change);
  void apply(const ops::TowerComplex& complex, std::size_t d, const ops::TowerComplex::Change& change);
  void rename(const ops::TowerComplex& complex, std::size_t d, const ops::TowerComplex::Change& change);

  IntegralClasses classes_;
  std::vector<std::vector<ClassRef>> refs_;       ///< per dimension and slot
  std::vector<std::vector<std::uint64_t>> ages_;  ///< the same: the number of the inclusion
  std::uint64_t inclusions_ = 0;
  std::vector<ClassRef> facet_refs_;               ///< of the cell that is being included
  std::vector<ops::TowerComplex::Change> by_age_;  ///< of the contraction that is being made, in one dimension
  ContractionShifts shifts_;
  Homology homology_;
};

}  // namespace sesame::engine
