/// \file
/// The part of a structure's history that one equivalence describes.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "ops/cells/structure.hpp"
#include "sparse/contract.hpp"
#include "sparse/growing_array.hpp"
#include "sparse/hash_index.hpp"

namespace sesame::engine {

using ops::CellId;
using ops::LinkId;
using ops::Structure;

/// All of a history, or what has happened since a moment. In the latter case the object of that moment is where the
/// history begins: its cells count as made then, one after the other by dimension, with the faces that they had, each
/// a class of its own; what made them so, their removals, moves and copies, is no part of it, and lazy cells are cells
/// like others. So an equivalence can be begun afresh from the object as it is, and knows nothing of how it came about.
///
/// Cost of every query that is not said: that of the same query of the structure, restricted to the window.
///
/// Threads: one at a time, as queries keep what they find.
class Window {
 public:
  using Copy = ops::SplitHistory::Copy;
  using MadeMove = ops::SplitHistory::MadeMove;

  /// All of the history.
  explicit Window(const Structure& structure) : structure_{&structure} {}
  /// What follows the present. `cells`: the current cells, each after its faces. Cost: their number, times their faces.
  Window(const Structure& structure, std::vector<CellId> cells);

  [[nodiscard]] const Structure& structure() const { return *structure_; }
  [[nodiscard]] const ops::Moment& begin() const { return begin_; }
  /// The position of the journal at the beginning.
  [[nodiscard]] ops::Journal::Position start() const { return start_; }
  /// The cells that the object had at the beginning, as far as it was not empty.
  [[nodiscard]] const std::vector<CellId>& cells() const { return cells_; }
  /// The place of one of them in that list.
  [[nodiscard]] std::uint32_t place(CellId first_cell) const {
    const std::uint32_t found = find_place(first_cell);
    sparse::expects(found != ops::none, "a cell of the window's beginning has a place there");
    return found;
  }
  [[nodiscard]] bool is_cell_of_beginning(CellId c) const { return find_place(c) != ops::none; }
  /// Whether a node that the window knows was there at the beginning.
  [[nodiscard]] bool is_first(CellId c) const { return begin_.knew(c); }

  /// The node that the window knows for any node: of those made before, the cell that it was at the beginning, or none.
  [[nodiscard]] CellId known(CellId node) const {
    return is_first(node) ? structure_->forest().find_at(node, begin_.links) : node;
  }

  /// Calls visit(node, sign) for each face of a cell as it was when it was made or the window began, with its sign in
  /// the boundary; not for those that were degenerate at the beginning of the window.
  template <class Visit>
  void for_each_first_face(CellId c, Visit&& visit) const {
    if (is_first(c)) {
      const std::uint32_t at = place(c);
      for (std::uint32_t k = first_face_[at]; k < first_face_[at + 1]; ++k) {
        if (faces_[k] != ops::none) {
          visit(faces_[k], coefficient(k));
        }
      }
      return;
    }
    const auto faces = structure_->cells().faces(c);
    for (std::uint32_t k = 0; k < faces.size(); ++k) {
      visit(faces[k], structure_->faces().sign_as_created(c, k));
    }
  }
  /// Calls visit(node, sign, links) for what the faces of a cell were in the window, up to a moment: each node with the
  /// number of links at which it was given up for the next.
  template <class Visit>
  void for_each_face_of_history(CellId c, const ops::Moment& moment, Visit&& visit) const {
    const auto arity = static_cast<std::uint32_t>(structure_->cells().type(c).faces.size());
    const bool is_first = this->is_first(c);
    const std::uint32_t first = is_first ? first_face_[place(c)] : 0;
    for (std::uint32_t k = 0; k < arity; ++k) {
      CellId node = is_first ? faces_[first + k] : structure_->cells().faces(c)[k];
      int sign = is_first ? coefficient(first + k) : structure_->faces().sign_as_created(c, k);
      structure_->splits().for_each_move_of(c, k, begin_.moves, moment.moves, [&](const MadeMove& made) {
        if (node != ops::none) {
          visit(node, sign, made.links);
        }
        node = made.after;
        sign = structure_->faces().sign_after(made);
      });
      if (node != ops::none) {
        visit(node, sign, moment.links);
      }
    }
  }

  /// Whether the boundaries of generators have been changed: by copies, moves or deletions.
  [[nodiscard]] bool has_changes() const { return has_splits() || deletions() > 0; }
  [[nodiscard]] std::uint32_t deletions() const { return structure_->forest().deletions().size() - deletions_before_; }
  /// Whether there have been copies or moves.
  [[nodiscard]] bool has_splits() const { return copies() > 0 || structure_->splits().moves() > begin_.moves; }
  [[nodiscard]] std::uint32_t copies() const { return structure_->splits().copies() - begin_.copies; }
  /// What c is a copy of, or null.
  [[nodiscard]] const Copy* copy(CellId c) const { return is_first(c) ? nullptr : structure_->splits().copy(c); }
  /// Calls visit(copy) for the copies that were made of a node itself.
  template <class Visit>
  void for_each_copy_of(CellId source, Visit&& visit) const {
    structure_->splits().for_each_copy_of(source, begin_.copies, visit);
  }
  /// Calls visit(link) for each removal in favour of a node itself.
  template <class Visit>
  void for_each_child_link(CellId node, Visit&& visit) const {
    structure_->forest().for_each_child_link(node, begin_.links, visit);
  }
  /// Calls visit(node) for each node that a current cell stands for. Cost: their number.
  template <class Visit>
  void for_each_member(CellId current, Visit&& visit) const {
    std::vector<CellId> pending{current};
    while (!pending.empty()) {
      const CellId node = pending.back();
      pending.pop_back();
      visit(node);
      for_each_child_link(node, [&](LinkId link) { pending.push_back(structure_->forest().removed(link)); });
    }
  }
  /// The places where a node was given as a face: at the beginning, at the creation of cells, and by moves. As (cell as
  /// created, number). Stops when there are more than `most`.
  [[nodiscard]] std::vector<std::pair<CellId, std::uint32_t>> places_of(CellId node, std::size_t most = SIZE_MAX) const;

  [[nodiscard]] std::uint32_t families() const { return structure_->lazy().families() - begin_.families; }
  [[nodiscard]] bool is_lazy(CellId c) const { return !is_first(c) && structure_->lazy().is_lazy(c); }

 private:
  [[nodiscard]] int coefficient(std::uint32_t face) const {
    return signs_[face] != 0 ? signs_[face] : coefficients_.at(face);
  }
  void index_cells();
  void make_cofaces() const;
  static std::uint64_t hash_of(CellId c) { return sparse::spread_bits(c); }
  /// Or none.
  [[nodiscard]] std::uint32_t find_place(CellId c) const {
    if (!place_of_.empty()) {
      return c < place_of_.size() ? place_of_[c] : std::uint32_t{ops::none};
    }
    return places_.find(hash_of(c), [&](std::uint32_t at) { return cells_[at] == c; });
  }

  const Structure* structure_;
  ops::Moment begin_;
  std::uint32_t deletions_before_ = 0;
  ops::Journal::Position start_ = 0;
  std::vector<CellId> cells_;
  // Places in `cells_`, by cell: for each node that steps had made, when these are not many more; or else by a hash.
  sparse::GrowingArray<std::uint32_t> place_of_;
  sparse::HashIndex places_;
  // Per cell of the beginning, by place: its faces, `none` for a degenerate one; and who has it as a face.
  std::vector<std::uint32_t> first_face_;
  std::vector<CellId> faces_;
  std::vector<std::int8_t> signs_;                      ///< 0 where it is one of these:
  std::map<std::uint32_t, std::int32_t> coefficients_;  ///< of faces, of cells that are known by their boundaries
  mutable std::vector<std::uint32_t> first_coface_;     ///< when asked for
  mutable std::vector<std::pair<CellId, std::uint32_t>> cofaces_;
};

}  // namespace sesame::engine
