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

}  // namespace sesame::engine
