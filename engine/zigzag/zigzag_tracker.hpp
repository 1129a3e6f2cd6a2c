/// \file
/// Who follows a zigzag of simplicial complexes, and the barcode of one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/towers/barcode.hpp"
#include "ops/simplicial/tower_complex.hpp"
#include "sparse/rational_chain.hpp"
#include "sparse/ring.hpp"

namespace sesame::engine {

/// When something happens: the operation, counted from 0, and its time. Several inclusions and exclusions may be one
/// operation.
struct Moment {
  std::uint64_t operation;
  Time time;
};

/// A class of one dimension that lived from one moment on until another.
struct MomentBar {
  int dimension;
  Moment birth, death;
};

/// A chain of cells of one dimension, each called by how many of them were included before it; these increase.
using ZigzagChain = sparse::RationalChain<std::uint64_t>;

/// What the cycle of a bar is after an operation and the next ones, until the next piece or the end of the bar.
struct CyclePiece {
  Moment from;
  ZigzagChain cycle;
};

/// Is told of the cells of a zigzag that come and go, one by one.
class ZigzagTracker {
 public:
  using Slot = ops::TowerComplex::Slot;

  virtual ~ZigzagTracker() = default;

  /// A cell is added, with boundary sum (-1)^k facets[k], slots of cells of one dimension less that are there; a slot
  /// may have been that of a cell that is gone. Moments must not decrease.
  virtual void include(int dimension, Slot slot, std::span<const Slot> facets, Moment moment) = 0;
  /// A cell that is there is taken out. Requires: it is no facet of another one.
  virtual void exclude(int dimension, Slot slot, Moment moment) = 0;
};

/// The barcode of a zigzag, kept current at every change. Over a field.
///
/// A class that is born and dies in one operation is nobody's: it has no bar, and is not counted.
class ZigzagBarcode : public ZigzagTracker {
 public:
  /// Called when a class dies whose birth was another operation.
  using OnBar = std::function<void(const MomentBar&)>;

  /// The number of classes alive, per dimension, up to the largest that has one.
  [[nodiscard]] virtual std::vector<std::uint64_t> betti() const = 0;
  /// Visits the classes that are alive, by dimension and birth; the death is `never`.
  virtual void for_each_open_bar(const OnBar& visit) const = 0;

  /// Works out the cycles of a bar, in order. Together those of all bars are an interval decomposition: after each
  /// operation the cycles of the bars that are alive are a basis of the homology; a map of the zigzag sends the cycle
  /// of a bar to one that is homologous to its next one (a deletion: the next one to such a one as is before it), and
  /// the first and last ones that no neighbour has to 0, or they have no preimage.
  using Pieces = std::function<std::vector<CyclePiece>()>;
  /// Called like OnBar, and when the pieces can be had: during this call.
  using OnCycles = std::function<void(const MomentBar&, const Pieces&)>;
  /// Visits the classes that are alive as for_each_open_bar does, with their cycles, if they are kept.
  virtual void for_each_open_cycle(const OnCycles& visit) const = 0;

  [[nodiscard]] virtual const sparse::AnyRing& ring() const = 0;
  /// Terms of chains read or written, and those that are held.
  struct Work {
    std::uint64_t terms_touched = 0, terms_held = 0;
  };
  [[nodiscard]] virtual Work work() const = 0;
};

/// One that keeps a basis of the present chains and nothing of the past: see CycleBasis. Memory is that of the present
/// complex and its basis. Cost of a change: the chains that have to be added up, and of an exclusion those that have
/// the cell. Requires: the ring is a field.
[[nodiscard]] std::unique_ptr<ZigzagBarcode> make_online_zigzag_barcode(const sparse::AnyRing& ring,
                                                                        ZigzagBarcode::OnBar on_bar);

/// One that also keeps what the cycles of bars of the dimensions that `wants` says have been: see CycleHistory. Each
/// change of cycles is one of their pasts, too, which grow with the number of changes while a bar is alive.
[[nodiscard]] std::unique_ptr<ZigzagBarcode> make_online_zigzag_barcode(const sparse::AnyRing& ring,
                                                                        ZigzagBarcode::OnBar on_bar,
                                                                        ZigzagBarcode::OnCycles on_cycles,
                                                                        std::function<bool(int dimension)> wants);

}  // namespace sesame::engine
