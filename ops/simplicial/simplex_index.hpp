/// \file
/// Simplices by their vertices: a hash from sets of vertices, and the stars of vertices.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ops/ids.hpp"
#include "sparse/archive.hpp"
#include "sparse/hash_index.hpp"

namespace sesame::ops {

/// The simplices of a complex that somebody else keeps the books of. A simplex has a *slot*, a number among those of
/// its dimension, and its vertices in an order. Both are the choice of who includes it: AbstractComplex uses no slot
/// twice, so that it can go back, and has the vertices in the order of the faces; TowerComplex uses slots again, and
/// has the vertices ascending.
///
/// A contraction of two vertices moves the one with the smaller star, and `change_of` tells what becomes of each
/// simplex of that star. Who carries the changes out one by one, and keeps them, can take them back in reverse order.
///
/// Threads: one at a time, as queries keep what they find.
class SimplexIndex {
 public:
  using Vertex = VertexId;
  using Slot = std::uint32_t;
  static constexpr std::uint32_t nothing = sparse::HashIndex::nothing;

  /// Different vertices in any order, and the hash of their set.
  struct Key {
    std::span<const Vertex> vertices;
    std::uint64_t hash;
  };
  /// The hash of a set is the sum of these.
  [[nodiscard]] static std::uint64_t word(Vertex v) { return sparse::spread_bits(v); }
  [[nodiscard]] static Key key(std::span<const Vertex> vertices);

  /// What becomes of a simplex when a vertex is contracted into another one.
  enum class Fate : std::uint8_t {
    renamed,   ///< it has the other vertex instead, and stays
    merged,    ///< into the simplex that it would become, which is there
    squashed,  ///< it had both vertices
  };
  struct Change {
    Fate fate;
    std::uint8_t moved_at;  ///< the place of the moved vertex among its vertices
    Slot survivor;          ///< when merged
  };

  // ---- questions
  /// All slots of a dimension, those of simplices that are gone among them, are below this.
  [[nodiscard]] Slot slots(std::size_t dimension) const {
    return dimension < layers_.size() ? static_cast<Slot>(layers_[dimension].vertices.size() / (dimension + 1)) : 0;
  }
  /// All dimensions that had a simplex are below this.
  [[nodiscard]] std::size_t dimensions() const { return layers_.size(); }
  /// The vertices of a simplex, in its order; of one that is gone, those that it had. Valid until the next change.
  [[nodiscard]] std::span<const Vertex> vertices(std::size_t dimension, Slot slot) const {
    return {layers_[dimension].vertices.data() + (dimension + 1) * slot, dimension + 1};
  }
  /// The simplex on these vertices, or `nothing`. Cost: their number, or the square of it when its order is another.
  [[nodiscard]] Slot find(const Key& key) const;
  /// The simplex on all of these vertices but the one at `without`, or `nothing`. Requires: there is more than one.
  [[nodiscard]] Slot find_facet(const Key& key, std::size_t without) const;

  /// The number of simplices that have a vertex. Requires, like all that is said of stars: there are stars.
  [[nodiscard]] std::uint32_t star_size(Vertex v) const { return v < star_size_.size() ? star_size_[v] : 0; }
  /// Calls visit(dimension, slot) for each of them; those included or renamed last come first in their dimension.
  template <class Visit>
  void for_each_in_star(Vertex v, Visit&& visit) const;
  /// What becomes of a simplex that has the vertex `moved` when that becomes `kept`. Cost: its vertices.
  [[nodiscard]] Change change_of(std::size_t dimension, Slot slot, Vertex moved, Vertex kept) const;
  /// The incidences that `change_of` has read: what contractions have cost. Only grows.
  [[nodiscard]] std::uint64_t touched() const { return touched_; }

  // ---- change
  /// From now on there are stars. `gone`: slots, per dimension, of simplices that are gone. Cost, at the first call:
  /// the simplices.
  void build_stars(std::span<const std::vector<Slot>> gone = {});
  /// Requires: no simplex has these vertices; the slot is the next one of the dimension, or that of one that is gone.
  void include(const Key& key, Slot slot);
  /// The simplex is gone. Its slot keeps the vertices.
  void exclude(std::size_t dimension, Slot slot);
  /// The last one in a slot is there again.
  void include_again(std::size_t dimension, Slot slot);
  /// The simplex has these vertices from now on. Requires: no simplex has them.
  void rename(std::size_t dimension, Slot slot, std::span<const Vertex> vertices);
  /// Takes the last slot of a dimension back. Requires: its simplex is gone.
  void drop_last_slot(std::size_t dimension);

  // ---- to an archive, and into a new index from one, which fails when it is unsound; with stars
  void save(sparse::ArchiveWriter& to) const;
  /// `vertices`: all are below this.
  void load(sparse::ArchiveReader& from, std::size_t vertices);

 private:
  /// The simplices of a dimension.
  struct Layer {
    std::vector<Vertex> vertices;  ///< of slot after slot
    sparse::HashIndex index;
    // Stars as doubly linked lists, if there are any: a link for each vertex of each slot.
    std::vector<std::uint32_t> next, previous;  ///< links, or `nothing`
    std::vector<std::uint32_t> first;           ///< per vertex, as far as needed
  };

  void link(std::size_t dimension, Slot slot);
  void unlink(std::size_t dimension, Slot slot);
  void make_room(Layer& layer, Vertex v);
  void load_simplices(sparse::ArchiveReader& from, std::size_t dimension, std::size_t vertices);
  void load_stars(sparse::ArchiveReader& from, std::size_t dimension);

  std::vector<Layer> layers_;  ///< per dimension
  bool has_stars_ = false;
  std::vector<std::uint32_t> star_size_;  ///< per vertex, as far as needed
  mutable std::uint64_t touched_ = 0;
};

inline SimplexIndex::Slot SimplexIndex::find(const Key& key) const {
  const std::size_t dimension = key.vertices.size() - 1;
  if (dimension >= layers_.size()) {
    return nothing;
  }
  return layers_[dimension].index.find(key.hash, [&](Slot slot) {
    const auto own = vertices(dimension, slot);
    return std::is_permutation(own.begin(), own.end(), key.vertices.begin());  // begins with what is equal
  });
}

inline SimplexIndex::Slot SimplexIndex::find_facet(const Key& key, std::size_t without) const {
  const std::size_t dimension = key.vertices.size() - 2;
  if (dimension >= layers_.size()) {
    return nothing;
  }
  const Vertex* all = key.vertices.data();
  const std::size_t size = key.vertices.size();
  return layers_[dimension].index.find(key.hash - word(all[without]), [&](Slot slot) {
    const Vertex* own = vertices(dimension, slot).data();
    return (std::equal(all, all + without, own) && std::equal(all + without + 1, all + size, own + without)) ||
           std::all_of(own, own + size - 1,
                       [&](Vertex v) { return v != all[without] && std::find(all, all + size, v) != all + size; });
  });
}

template <class Visit>
void SimplexIndex::for_each_in_star(Vertex v, Visit&& visit) const {
  for (std::size_t dimension = 0; dimension < layers_.size(); ++dimension) {
    const Layer& layer = layers_[dimension];
    if (v >= layer.first.size()) {
      continue;
    }
    for (std::uint32_t where = layer.first[v]; where != nothing; where = layer.next[where]) {
      visit(dimension, static_cast<Slot>(where / (dimension + 1)));
    }
  }
}

}  // namespace sesame::ops
