/// \file
/// Who follows the operations of a tower, whatever it keeps of them.
#pragma once

#include <cstdint>
#include <span>

#include "engine/towers/time.hpp"
#include "ops/simplicial/column_complex.hpp"
#include "ops/simplicial/tower_complex.hpp"

namespace sesame::engine {

/// Is told of the operations of a tower one by one.
class TowerTracker {
 public:
  using Slot = ops::TowerComplex::Slot;

  virtual ~TowerTracker() = default;

  /// A cell is added, with boundary sum (-1)^k facets[k], slots of cells of one dimension less; a slot may have been
  /// that of a cell that is gone. Times must not decrease.
  /// Cost: amortised, what has changed in the classes of the facets.
  virtual void include(int dimension, Slot slot, std::span<const Slot> facets, Time time) = 0;

  /// A contraction that the complex has worked out, and not yet carried out. Cost: as that of the changes in turn.
  virtual void contract(const ops::TowerComplex& complex, const ops::TowerComplex::Changes& changes, Time time) = 0;

  /// Begins to load what is kept of cells that may soon be facets, for a tracker with shared slots: the references of
  /// `far`, and what those of `near` refer to. Any numbers may be among them.
  virtual void prefetch(const ops::ColumnComplex&, std::span<const std::uint64_t> /*far*/,
                        std::span<const std::uint64_t> /*near*/) const {}
};

}  // namespace sesame::engine
