/// \file
/// Abstract simplicial complexes under insertions of simplices and collapses of vertices: labels, vertex sets, stars.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ops/ids.hpp"
#include "ops/name_table.hpp"

namespace sesame::ops {

/// Integers, which are written in decimal without leading zeros, numerically; then other labels, bytewise.
[[nodiscard]] std::strong_ordering compare_labels(std::string_view a, std::string_view b);
/// A name without the characters { } and comma.
[[nodiscard]] bool is_label(std::string_view text);
/// The place of each vertex of a list in another list of the same vertices. Cost: their number squared.
[[nodiscard]] std::vector<std::uint8_t> places_in(std::span<const VertexId> other, std::span<const VertexId> one);

/// Which cells are simplices on which vertices. A collapse keeps the vertex with the larger star, whatever its label:
/// labels point to vertices, so nothing else needs to be renamed.
///
/// Each cell has its vertices in an order, that of its faces: face k is opposite to vertex k. A collapse changes one
/// vertex of a cell and leaves it in its place, so two orders of the same vertices may meet when cells are merged.
///
/// Append-only but for undo: a journal of changes, taken back in reverse order.
class AbstractComplex {
 public:
  // ---- labels and vertices; a label is made together with a vertex of the same number
  [[nodiscard]] bool empty() const { return vertices_.empty(); }
  [[nodiscard]] std::uint32_t labels() const { return static_cast<std::uint32_t>(vertices_.size()); }
  /// The label of a text, or none.
  [[nodiscard]] LabelId label(std::string_view text) const;
  [[nodiscard]] std::string_view text(LabelId label) const { return texts_[label].text; }
  /// The vertex that a label denotes now. Cost O(log labels).
  [[nodiscard]] VertexId vertex(LabelId label) const;
  /// The label that a vertex is called by now.
  [[nodiscard]] LabelId label_of(VertexId vertex) const { return vertices_[vertex].label; }
  /// True when the vertex of a label is called by another one, which it was collapsed into.
  [[nodiscard]] bool is_collapsed(LabelId label) const { return label_of(vertex(label)) != label; }

  // ---- cells
  [[nodiscard]] bool contains(CellId cell) const { return cell < number_.size() && number_[cell] != none; }
  /// The vertices of a cell, in its order. Requires: contains(cell). Valid until the next change.
  [[nodiscard]] std::span<const VertexId> vertices(CellId cell) const { return vertices_of(number_[cell]); }
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
  [[nodiscard]] std::uint32_t star_size(VertexId vertex) const { return vertices_[vertex].star_size; }
  /// Those simplices, in no particular order. Cost: their number.
  [[nodiscard]] std::vector<CellId> star(VertexId vertex) const;
  /// The incidences of a cell and a vertex that have been read or changed: what all this has cost. Only grows.
  [[nodiscard]] std::uint64_t incidences_touched() const { return touched_; }

  // ---- change
  /// The vertex has the number of its label, which must be new.
  LabelId add_label(std::string_view text);
  /// Requires: there is no simplex on these vertices; the cell is newer than all others that were added.
  void add(CellId cell, std::span<const VertexId> vertices);
  /// The cell, merged into another or squashed, is no simplex of its own any more.
  void remove(CellId cell);
  /// Puts one vertex in the place of another. Requires: the simplex that the cell becomes is not there.
  void replace(CellId cell, VertexId before, VertexId after);
  /// From now on both labels denote the vertex `kept`, which is called `to`.
  void join_labels(LabelId from, LabelId to, VertexId kept);

  /// The number of changes so far.
  [[nodiscard]] std::uint32_t mark() const { return static_cast<std::uint32_t>(journal_.size()); }
  /// Takes back all changes but so many. Cost: that of the changes.
  void truncate(std::uint32_t mark);

 private:
  struct Label {
    LabelId parent;           ///< labels of one vertex form a tree, linked by size
    std::uint32_t below = 1;  ///< labels in it, for a root
    VertexId vertex;          ///< for a root
  };
  struct Vertex {
    std::uint64_t word;
    LabelId label;
    std::uint32_t first = none;  ///< incidence of its star
    std::uint32_t star_size = 0;
  };
  /// Of a cell and a vertex. The incidences of a vertex are a doubly linked list.
  struct Incidence {
    std::uint32_t cell;  ///< by number
    std::uint32_t before, after;
  };
  struct Cell {
    CellId id;
    std::uint32_t first;  ///< incidence
    std::uint64_t sum;    ///< of the words of its vertices
  };
  struct Joint {
    LabelId root, child;
    VertexId before;  ///< that the root denoted
    VertexId kept;
    LabelId label_before;  ///< of the vertex kept
  };
  struct Change {
    enum class Kind : std::uint8_t { label, cell, removal, replacement, joint } kind;
    std::uint32_t what = 0;  ///< number of a cell, or incidence
    VertexId before = none;  ///< of a replacement
  };

  [[nodiscard]] LabelId root(LabelId label) const;
  [[nodiscard]] std::uint32_t end_of(std::uint32_t number) const;
  [[nodiscard]] std::span<const VertexId> vertices_of(std::uint32_t number) const;
  [[nodiscard]] std::uint32_t find_number(std::span<const VertexId> vertices) const;
  /// The vertices of the labels in a name {a,b,...}, in the order listed.
  [[nodiscard]] std::optional<std::vector<VertexId>> vertices_named(std::string_view name) const;
  void link(std::uint32_t incidence);
  void unlink(std::uint32_t incidence);
  void enter(std::uint32_t number);
  void leave(std::uint32_t number);
  void set_vertex(std::uint32_t incidence, VertexId vertex);
  void undo(const Change& change);

  NameTable texts_;  ///< number: label
  std::vector<Label> labels_;
  std::vector<Vertex> vertices_;
  std::vector<Cell> cells_;
  std::vector<VertexId> vertex_;  ///< per incidence
  std::vector<Incidence> incidences_;
  std::vector<std::uint32_t> number_;  ///< per cell of the structure, as far as needed
  /// Sums of words, which are random, agree by chance only: those that do are told apart by their vertices.
  std::unordered_multimap<std::uint64_t, std::uint32_t> by_sum_;
  std::vector<Change> journal_;
  std::vector<Joint> joints_;
  mutable std::uint64_t touched_ = 0;
};

}  // namespace sesame::ops
