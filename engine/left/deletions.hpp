/// \file
/// The boundaries of the cells that were taken away, which are cells of the object still.
#pragma once

#include <cstdint>
#include <span>

#include "engine/left/generators.hpp"
#include "sparse/growing_array.hpp"
#include "sparse/hash_index.hpp"

namespace sesame::engine {

/// When a cell c without cofaces is taken away, B gains a generator e of degree dim c - 1 with f(e) = -d c: what has
/// become of c's boundary since is what has become of the faces that it had then. Here are these, of each e that a
/// window has seen; and the other way round, which e have a node in f.
///
/// Cost of every query and change: the faces concerned, amortised; `boundary` also the logarithm of the deletions.
///
/// Threads: one at a time, for queries too.
class Deletions {
 public:
  /// `window` must outlive it.
  explicit Deletions(const Window& window) : structure_{window.structure()} {}

  struct Face {
    CellId node;  ///< a current cell of that time
    int coefficient;
  };
  /// d c, for the generator e that the deletion of c has made: each cell once, none with 0.
  [[nodiscard]] std::span<const Face> boundary(GeneratorId e) const;
  /// Calls visit(e, coefficient) for each boundary that a node is in, itself, the latest first.
  template <class Visit>
  void for_each_over(CellId node, Visit&& visit) const {
    for (std::uint32_t at = last_over(node); at != ops::none; at = entries_[at].previous_over) {
      visit(entries_[at].generator, faces_[at].coefficient);
    }
  }

  /// The generator of a deletion. Requires: it is younger than the others.
  void add(GeneratorId e, LinkId link);
  /// The generators from `first` on are to go. Cost: what goes.
  void truncate(GeneratorId first);

 private:
  struct Entry {
    GeneratorId generator;
    std::uint32_t previous_over;  ///< the entry of the same node before, or none
  };
  static std::uint64_t hash_of(CellId c) { return sparse::spread_bits(c); }
  [[nodiscard]] std::uint32_t last_over(CellId node) const {
    return last_over_.find(hash_of(node), [&](std::uint32_t at) { return faces_[at].node == node; });
  }

  const Structure& structure_;
  sparse::GrowingArray<Face> faces_;     ///< of one deletion after the other
  sparse::GrowingArray<Entry> entries_;  ///< per face
  sparse::HashIndex last_over_;          ///< of nodes: the entries that have them last
};

}  // namespace sesame::engine
