/// \file
/// The simplices of one dimension that an insertion adds.
#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <span>
#include <vector>

#include "sparse/hash_index.hpp"

namespace sesame::ops {

/// Simplices with as many vertices each, numbered from 0 as they come, none twice. Their vertices are numbers, here
/// called positions, and ascend.
class MissingSimplices {
 public:
  using Position = std::uint32_t;
  static constexpr std::uint32_t nothing = sparse::HashIndex::nothing;

  explicit MissingSimplices(std::size_t vertices) : vertices_{vertices} {}

  /// The hash of a simplex is the sum of these.
  [[nodiscard]] static std::uint64_t word(Position position) { return sparse::spread_bits(position); }
  [[nodiscard]] static std::uint64_t hash_of(std::span<const Position> simplex) {
    std::uint64_t hash = 0;
    for (const Position position : simplex) {
      hash += word(position);
    }
    return hash;
  }

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(positions_.size() / vertices_); }
  /// Valid until the next one is added.
  [[nodiscard]] std::span<const Position> operator[](std::uint32_t number) const {
    return {positions_.data() + vertices_ * number, vertices_};
  }
  /// The number of a simplex, or `nothing`.
  [[nodiscard]] std::uint32_t find(std::span<const Position> simplex, std::uint64_t hash) const {
    return find_if(hash, [&](std::uint32_t number) { return std::ranges::equal(operator[](number), simplex); });
  }
  /// The number of the face without the vertex number k of a simplex, or `nothing`; the hash is that of the face.
  [[nodiscard]] std::uint32_t find_face(std::span<const Position> simplex, std::size_t k, std::uint64_t hash) const {
    return find_if(hash, [&](std::uint32_t number) {
      const Position* own = operator[](number).data();
      const Position* all = simplex.data();
      return std::equal(all, all + k, own) && std::equal(all + k + 1, all + simplex.size(), own + k);
    });
  }
  /// Adds the simplex, or its face without the vertex number k; the hash is that of what is added. Returns its number.
  /// Requires: it is not there.
  std::uint32_t add(std::span<const Position> simplex, std::uint64_t hash);
  std::uint32_t add_face(std::span<const Position> simplex, std::size_t k, std::uint64_t hash);

  /// Their numbers in the lexicographic order of the simplices.
  [[nodiscard]] std::vector<std::uint32_t> sorted() const;

 private:
  /// So many are looked at one by one.
  static constexpr std::uint32_t few = 8;

  template <class IsIt>
  [[nodiscard]] std::uint32_t find_if(std::uint64_t hash, IsIt&& is_it) const {
    if (size() > few) {
      return index_.find(hash, is_it);
    }
    for (std::uint32_t number = 0; number < size(); ++number) {
      if (is_it(number)) {
        return number;
      }
    }
    return nothing;
  }
  std::uint32_t note_last(std::uint64_t hash);

  std::size_t vertices_;
  boost::container::small_vector<Position, 4> positions_;  ///< of one simplex after the other
  sparse::HashIndex index_;                                ///< when they are more than few
};

}  // namespace sesame::ops
