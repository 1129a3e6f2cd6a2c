/// \file
/// Editing sessions: cells that are glued and split at random, and whose homology is known at every step.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "ops/vocabulary/operation.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/draws.hpp"

namespace sesame::tools {

/// Cells of one dimension that are made one and split again. All that there is to such a cell is where it is a face.
class Gluings {
 public:
  struct Incidence {
    std::uint32_t cell, face;  ///< face number `face` of a cell
  };
  struct Place {
    std::string name;
    std::vector<Incidence> incidences;
  };

  /// A cell, with one incidence. `coface_letter` + number is the name of the cell that it is a face of.
  explicit Gluings(std::string coface_letter) : letter_{std::move(coface_letter)} {}
  void add(std::string name, Incidence incidence);

  [[nodiscard]] std::size_t size() const { return present_.size(); }
  /// The k-th cell now, 0 <= k < size().
  [[nodiscard]] const Place& operator[](std::size_t k) const { return places_[present_[k]]; }

  /// The a-th cell and the b-th become one. Requires: they are different.
  ops::Operation glue(std::size_t a, std::size_t b);
  /// The incidences of the a-th cell with `goes` go to a copy. Requires: some do, not all.
  ops::Operation split(std::size_t a, const std::vector<bool>& goes);
  [[nodiscard]] std::size_t undoable() const { return changes_.size(); }
  /// Takes back the last gluings and splits.
  void undo(std::size_t changes);

 private:
  struct Change {
    std::uint32_t kept, other;  ///< places: `other` is gone, or new
    bool is_split;
    std::vector<Incidence> before;  ///< of `kept`
  };
  void remove(std::uint32_t place);
  void insert(std::uint32_t place);

  std::string letter_;
  std::vector<Place> places_;
  std::vector<std::uint32_t> present_, position_;  ///< places that are there, in any order; where each stands in it
  std::vector<Change> changes_;
  std::uint64_t copies_ = 0;
};

/// A graph under work. Edge after edge is made; then steps without end, each of which makes two vertices one or, as
/// often, splits a vertex, a random half of the ends that meet there going to the copy. With undo, one step in a
/// hundred takes back 3, 50 or 250 of them, once there are enough.
class GraphEditing {
 public:
  GraphEditing(std::uint32_t edges, bool with_undo, std::uint64_t seed)
      : edges_{edges}, with_undo_{with_undo}, draws_{seed} {}

  ops::Operation next();
  [[nodiscard]] std::uint32_t edges() const { return made_; }
  [[nodiscard]] std::uint32_t vertices() const { return static_cast<std::uint32_t>(vertices_.size()); }
  /// Cost: the edges.
  [[nodiscard]] std::uint32_t components() const;

 private:
  std::uint32_t edges_, made_ = 0;
  bool with_undo_;
  Draws draws_;
  Gluings vertices_{"e"};
};

/// An abstract graph under work: its vertices are inserted; then steps without end, nine in ten of which insert an edge
/// or, at times, a vertex, and the tenth collapses a random vertex into another.
class GraphContraction {
 public:
  GraphContraction(std::uint32_t vertices, std::uint64_t seed) : vertices_at_first_{vertices}, draws_{seed} {}

  ops::Operation next();
  [[nodiscard]] std::uint32_t vertices() const { return static_cast<std::uint32_t>(present_.size()); }
  [[nodiscard]] std::uint32_t edges() const { return edges_; }
  /// Cost: the graph.
  [[nodiscard]] std::uint32_t components() const;

 private:
  ops::Operation insert_vertex();
  ops::Operation collapse(std::size_t from, std::uint32_t to);

  std::uint32_t vertices_at_first_;
  Draws draws_;
  std::vector<std::uint32_t> present_;             ///< vertices, in any order
  std::vector<std::set<std::uint32_t>> adjacent_;  ///< per vertex that there ever was
  std::uint32_t edges_ = 0;
};

/// Some steps of one of these.
template <class Session>
[[nodiscard]] Operations steps_of(Session session, std::uint64_t steps) {
  Operations operations;
  while (operations.size() < steps) {
    operations.push_back(session.next());
  }
  return operations;
}

/// `triangles` triangles whose vertices are all made one; 10 `triangles` random gluings and splits of their sides; then
/// all that is glued is split apart. In the end H = Z, Z^(2 triangles).
[[nodiscard]] Operations glued_triangles(std::uint32_t triangles, std::uint64_t seed);

}  // namespace sesame::tools
