/// \file
/// What nodes are by now, as values: current cells in an order of their vertices, and degenerate cells.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "ops/cells/cell_store.hpp"
#include "ops/cells/faces.hpp"
#include "ops/cells/forest.hpp"
#include "ops/cells/journal.hpp"
#include "ops/cells/plan.hpp"
#include "ops/cells/value.hpp"

namespace sesame::ops {

/// The normal forms of values, and their faces. Cost of what is not said: O(log nodes) for each time that what the
/// value is of has become degenerate.
///
/// Threads: one at a time, as queries keep what they find.
class Values {
 public:
  Values(VertexMaps& maps, CellStore& cells, Forest& forest, const Faces& faces, Journal& journal)
      : maps_{maps}, cells_{cells}, forest_{forest}, faces_{faces}, journal_{journal} {}

  /// A node, whatever it is by now, in its own order.
  [[nodiscard]] Value plain(CellId c) const { return {c, cells_.type_id(c), 0}; }
  /// The normal form of what c is now.
  [[nodiscard]] Value of(CellId c) const { return normal_form(plain(c)); }
  /// The same for a value whose cell is any node. What is deleted, or degenerate over that, stays a value of the
  /// deleted cell.
  [[nodiscard]] Value normal_form(Value v) const;
  /// Face k of a value in normal form, in normal form. Cost O(dimension), amortised.
  [[nodiscard]] Value face(const Value& v, std::uint32_t k) const {
    return maps_.face(v, k, [this](CellId c, std::uint32_t number) { return face_of_cell(c, number); });
  }
  /// Face k of a cell, in normal form.
  [[nodiscard]] Value face_of_cell(CellId c, std::uint32_t k) const;
  /// A value in normal form as a face: a cell in an order, or a node that is degenerate from the start. This is made
  /// when it is asked for first: knowledge, not state.
  [[nodiscard]] Incidence incidence_of(const Value& v) const;

  /// Forgets a node that is degenerate from the start, the last one of all nodes.
  void undo_degenerate(CellId node);
  /// Makes the index of degenerate nodes anew, after those have been loaded; fails when two of them are one.
  void load(sparse::ArchiveReader& from);

 private:
  void advance_to_root(Value& v) const;

  VertexMaps& maps_;
  CellStore& cells_;
  Forest& forest_;
  const Faces& faces_;
  Journal& journal_;
  mutable std::unordered_map<Value, CellId, ValueHash> degenerate_index_;
};

}  // namespace sesame::ops
