/// \file
/// Where to look for the cells that have a cell as a face, however often it has been glued and split.
#pragma once

#include <cstdint>
#include <vector>

#include "ops/cells/cell_store.hpp"
#include "ops/cells/cones.hpp"
#include "ops/cells/faces.hpp"
#include "ops/cells/forest.hpp"
#include "ops/cells/per_node.hpp"
#include "ops/cells/values.hpp"
#include "ops/ids.hpp"
#include "sparse/growing_array.hpp"

namespace sesame::ops {

/// For each current cell a list of *entries*: nodes among whose cells are all that steps made and that have the cell,
/// or something degenerate over it, as a face; and the *origins*, those of its members and of what is degenerate over
/// it that are lazy or the apex of a cone, from which lazy cofaces follow.
///
/// It is made when it is asked for the first time and follows the structure from then on, through undo to that moment;
/// undo beyond it forgets all of it. A removed cell keeps its list as it was, for undo, and the cell that it became
/// gets a copy. Lists may have entries too many: these go when a list is read, and when they become the greater part.
/// What made an entry superfluous and is undone makes it anew.
///
/// Cost: amortised, the faces of what a step makes and moves, and the lists of what it removes, each entry of which is
/// copied as often as its class doubles. Of the first query: the incidences of the object.
///
/// Threads: one at a time, as queries keep what they find.
class CofaceIndex {
 public:
  CofaceIndex(const CellStore& cells, const Forest& forest, const Faces& faces, const Values& values,
              const Cones& cones)
      : cells_{cells}, forest_{forest}, faces_{faces}, values_{values}, cones_{cones} {}

  /// The entries of a current cell, none of them superfluous, each once; an entry that is no origin is a current cell.
  /// Cost: their number and that of those added since the last time.
  [[nodiscard]] std::vector<CellId> entries(CellId current) const;
  /// How many it has with those that are superfluous.
  [[nodiscard]] std::size_t held(CellId current) const { return list(current).size; }
  /// Whether a node has lazy cells around it: it is one, or the apex of a cone.
  [[nodiscard]] bool is_origin(CellId node) const { return cells_.lazy(node) != none || cones_.from(node) != nullptr; }
  /// Whether a node, looked up in the forest, has a current cell as a face, or something degenerate over it.
  [[nodiscard]] bool is_coface(CellId cell, CellId current) const;

  // ---- to be called when the structure changes, from the first query on
  void on_new_cell(CellId node) {
    if (is_made_) {
      add_cell(node);
    }
  }
  /// Before the cell goes.
  void on_undo_of_cell(CellId node);
  /// Before a removal. `becomes`: the current cell that it will be, or be degenerate over.
  void before_removal(CellId removed, CellId becomes);
  /// Before a cell is taken away.
  void before_deletion() {
    if (is_made_) {
      removals_.push_back({0, 0, none});
    }
  }
  /// After the removal of a cell is undone, or its deletion.
  void on_undo_of_removal(CellId current);
  /// A cell has got a node as a face, by a move or because one is undone.
  void on_new_face(CellId cell, CellId face) {
    if (is_made_) {
      push(values_.of(face).cell, cell);
    }
  }
  /// At the end of a step.
  void on_end_of_step();

 private:
  static constexpr std::uint32_t most_entries_unread = 16;  ///< in a list that is as short as can be
  struct Entry {
    CellId node;
    std::uint32_t next;
  };
  struct List {
    std::uint32_t first = none;
    std::uint32_t size = 0;
    std::uint32_t size_when_tidy = 0;
    std::uint32_t times_tidied = 0;

    [[nodiscard]] bool is_overfull() const { return size >= 2 * size_when_tidy + most_entries_unread; }
  };
  /// The list that a removal added to, as it was; of a deletion there is none.
  struct Removal {
    std::uint32_t size, times_tidied;
    CellId becomes;
  };

  void make() const;
  void forget();
  void add_cell(CellId node) const;
  [[nodiscard]] List& list(CellId current) const;
  void push(CellId current, CellId node) const;
  void pop(List& list) const;
  void tidy(CellId current) const;
  template <class Visit>
  void for_each(const List& list, Visit&& visit) const {
    for (std::uint32_t at = list.first; at != none; at = pool_[at].next) {
      visit(pool_[at].node);
    }
  }

  const CellStore& cells_;
  const Forest& forest_;
  const Faces& faces_;
  const Values& values_;
  const Cones& cones_;
  mutable bool is_made_ = false;
  mutable LinkId links_when_made_ = 0;
  mutable PerNode<List> lists_;
  mutable sparse::GrowingArray<Entry> pool_;
  mutable std::uint32_t free_ = none;       ///< the first of the pool's entries that are in no list
  mutable std::vector<CellId> overfull_;    ///< current cells, maybe, with lists to be tidied
  mutable std::vector<CellId> kept_;        ///< memory of `tidy`
  sparse::GrowingArray<Removal> removals_;  ///< those since `links_when_made_`
};

}  // namespace sesame::ops
