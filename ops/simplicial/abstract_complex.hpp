/// \file
/// Abstract simplicial complexes of cells under inclusions of simplices and contractions of vertices, which can be
/// taken back: labels, and which cell is the simplex on some vertices.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ops/ids.hpp"
#include "ops/name_table.hpp"
#include "ops/simplicial/simplex_index.hpp"
#include "sparse/archive.hpp"

namespace sesame::ops {

/// Integers, which are written in decimal without leading zeros, numerically; then other labels, bytewise.
[[nodiscard]] std::strong_ordering compare_labels(std::string_view a, std::string_view b);
/// A name without the characters { } and comma.
[[nodiscard]] bool is_label(std::string_view text);
/// The place of each vertex of a list in another list of the same vertices. Cost: their number squared.
[[nodiscard]] std::vector<std::uint8_t> places_in(std::span<const VertexId> other, std::span<const VertexId> one);

/// Which cells are simplices on which vertices. Operations call an inclusion an insertion, and a contraction a collapse
/// of a vertex. A contraction keeps the vertex with the larger star, whatever its label: labels point to vertices, so
/// nothing else needs to be renamed.
///
/// Each cell has its vertices in an order, that of its faces: face k is opposite to vertex k. A contraction changes one
/// vertex of a cell and leaves it in its place, so two orders of the same vertices may meet when cells are merged.
///
/// Append-only but for undo: a journal of changes, taken back in reverse order.
///
/// Threads: one at a time, for queries too.
class AbstractComplex {
 public:
  AbstractComplex() { simplices_.build_stars(); }

  // ---- labels and vertices; a label is made together with a vertex of the same number
  [[nodiscard]] bool empty() const { return label_of_.empty(); }
  [[nodiscard]] std::uint32_t labels() const { return static_cast<std::uint32_t>(label_of_.size()); }
  /// The label of a text, or none.
  [[nodiscard]] LabelId label(std::string_view text) const;
  [[nodiscard]] std::string_view text(LabelId label) const { return texts_[label].text; }
  /// The vertex that a label denotes now. Cost O(log labels).
  [[nodiscard]] VertexId vertex(LabelId label) const;
  /// The label that a vertex is called by now.
  [[nodiscard]] LabelId label_of(VertexId vertex) const { return label_of_[vertex]; }
  /// True when the vertex of a label is called by another one, which it was contracted into.
  [[nodiscard]] bool is_contracted(LabelId label) const { return label_of(vertex(label)) != label; }

  // ---- cells
  [[nodiscard]] bool contains(CellId cell) const { return cell < place_.size() && place_[cell].slot != none; }
  /// The vertices of a cell, in its order. Requires: contains(cell). Valid until the next change.
  [[nodiscard]] std::span<const VertexId> vertices(CellId cell) const {
    return simplices_.vertices(place_[cell].dimension, place_[cell].slot);
  }
  /// All simplices by their vertices: each that is not gone is a cell.
  [[nodiscard]] const SimplexIndex& simplices() const { return simplices_; }
  /// The simplex on some different vertices, in any order; or none. Cost: their number squared, on average.
  [[nodiscard]] CellId find(std::span<const VertexId> vertices) const;
  /// What a name {a,b,...} denotes: the simplex on the vertices that the labels have now. It is degenerate when some of
  /// them have become one vertex.
  struct Named {
    CellId cell;
    std::vector<std::uint8_t> places;  ///< per label as listed: the place of its vertex in the order of the cell
  };
  /// Nothing for a name of another form, when a label is unknown or listed twice, and when there is no such simplex.
  [[nodiscard]] std::optional<Named> find_named(std::string_view name) const;
  /// How often labels have been looked up. Only grows.
  [[nodiscard]] std::uint64_t labels_looked_up() const { return texts_.looked_up(); }
  /// The number of simplices that have a vertex.
  [[nodiscard]] std::uint32_t star_size(VertexId vertex) const { return simplices_.star_size(vertex); }
  /// Those simplices, in no particular order. Cost: their number.
  [[nodiscard]] std::vector<CellId> star(VertexId vertex) const;
  /// What becomes of a cell that has the vertex `moved` when that becomes `kept`.
  struct Fate {
    SimplexIndex::Fate fate;
    std::uint8_t moved_at;  ///< the place of the moved vertex in the order of the cell
    CellId survivor;        ///< when merged; else none
  };
  [[nodiscard]] Fate fate_of(CellId cell, VertexId moved, VertexId kept) const;

  // ---- change
  /// The vertex has the number of its label, which must be new.
  LabelId add_label(std::string_view text);
  /// The cell is the simplex on these vertices. Requires: there is none; the cell is newer than all others.
  void include(CellId cell, std::span<const VertexId> vertices);
  /// The cell, merged into another or squashed, is no simplex of its own any more.
  void exclude(CellId cell);
  /// Puts one vertex in the place of another. Requires: the simplex that the cell becomes is not there.
  void rename(CellId cell, VertexId moved, VertexId kept);
  /// From now on both labels denote the vertex `kept`, which is called `to`.
  void contract_labels(LabelId from, LabelId to, VertexId kept);

  /// The number of changes so far.
  [[nodiscard]] std::uint32_t mark() const { return static_cast<std::uint32_t>(journal_.size()); }
  /// Takes back all changes but so many. Cost: that of the changes.
  void truncate(std::uint32_t mark);

  // ---- to an archive, without the journal; and into a new complex from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  /// `is_simplex(cell, dimension)`: whether that is a cell of the structure.
  void load(sparse::ArchiveReader& from, const std::function<bool(CellId, std::size_t)>& is_simplex);

 private:
  struct Label {
    LabelId parent;           ///< labels of one vertex form a tree, linked by size
    std::uint32_t below = 1;  ///< labels in it, for a root
    VertexId vertex;          ///< for a root
  };
  struct Contraction {
    LabelId root, child;
    VertexId before;  ///< that the root denoted
    VertexId kept;
    LabelId label_before;  ///< of the vertex kept
  };
  /// Where a cell is in the index.
  struct Place {
    SimplexIndex::Slot slot = none;
    std::uint8_t dimension = 0;
  };
  struct Change {
    enum class Kind : std::uint8_t { label, inclusion, exclusion, renaming, contraction } kind;
    std::uint8_t at = 0;     ///< of a renaming: the place of the vertex
    Place place = {};        ///< of the cell
    VertexId before = none;  ///< of a renaming
  };

  [[nodiscard]] LabelId root(LabelId label) const;
  /// The vertices of the labels in a name {a,b,...}, in the order listed.
  [[nodiscard]] std::optional<std::vector<VertexId>> vertices_named(std::string_view name) const;
  void put_vertex(const Place& place, std::size_t at, VertexId vertex);
  void undo(const Change& change);
  void undo_inclusion(const Place& place);
  void undo_contraction();
  [[nodiscard]] bool is_sound(const Label& label, LabelId itself) const;

  NameTable texts_;  ///< number: label
  std::vector<Label> labels_;
  std::vector<LabelId> label_of_;  ///< per vertex
  SimplexIndex simplices_;
  std::vector<std::vector<CellId>> cells_;  ///< per dimension and slot
  std::vector<Place> place_;                ///< per cell of the structure, as far as needed
  std::vector<Change> journal_;
  std::vector<Contraction> contractions_;
};

}  // namespace sesame::ops
