/// \file
/// Products of maps: cells are pairs of cells.
#pragma once

#include <cstdint>
#include <vector>

#include "ops/maps/chain_of_maps.hpp"
#include "ops/maps/gmap.hpp"

namespace sesame::ops {

/// The darts of the product of something with darts of dimension k and something with darts of dimension l. A dart of a
/// map stands for a chain of cells, one of each dimension, each a face of the next one. Such a chain of pairs of cells
/// is one of the left cells, one of the right ones, and a *word*, which says from pair to pair whether the left or the
/// right cell becomes the next one: of k steps to the left and l to the right, in any order.
///
/// The dart (d, e, w) is number (d * right darts + e) * words + w; words are numbered lexicographically, where a step
/// to the right comes before one to the left. So number 0 first goes to the right only, then to the left only.
class ProductDarts {
 public:
  struct Place {
    Dart left, right;
    std::uint32_t word;
  };

  /// Requires: k, l >= 0, k + l at most largest_map_dimension, and `count_of_darts` is below no_dart.
  /// Cost: the words, times their length.
  ProductDarts(Dart left_darts, int k, Dart right_darts, int l);

  [[nodiscard]] int dimension() const { return k_ + l_; }
  [[nodiscard]] Dart size() const { return left_darts_ * right_darts_ * words(); }
  [[nodiscard]] std::uint32_t words() const { return static_cast<std::uint32_t>(words_.size()); }
  [[nodiscard]] Dart dart(const Place& place) const {
    return (place.left * right_darts_ + place.right) * words() + place.word;
  }
  [[nodiscard]] Place place(Dart dart) const {
    return {dart / words() / right_darts_, dart / words() % right_darts_, dart % words()};
  }

  /// Whether step i of a word, counted from 0, is one to the left.
  [[nodiscard]] bool is_left(std::uint32_t word, int i) const {
    return (words_[word] >> (dimension() - 1 - i) & 1) != 0;
  }
  /// How many of its first i steps are.
  [[nodiscard]] int left_steps(std::uint32_t word, int i) const;
  /// The number of its first i steps among the words with as many steps to each side. Cost: i.
  [[nodiscard]] std::uint32_t beginning(std::uint32_t word, int i) const;
  /// The word with step i - 1 and step i exchanged. Requires: they differ. Cost: the logarithm of the words.
  [[nodiscard]] std::uint32_t exchanged(std::uint32_t word, int i) const;

 private:
  int k_, l_;
  Dart left_darts_, right_darts_;
  std::vector<std::uint64_t> words_;  // ascending; the first step is the highest bit, 1 to the left
};

/// How many darts the product has; saturates at 2^64 - 1.
[[nodiscard]] std::uint64_t count_of_darts(Dart left_darts, int k, Dart right_darts, int l);

/// The product of a k-G-map and an l-G-map: a (k+l)-G-map, with the darts of ProductDarts. Its i-cells are the pairs of
/// an a-cell and a b-cell with a + b = i, and the i-cell of (d, e, w) is that of d, for the a steps to the left that
/// are among the first i of w, with that of e. Where step i - 1 and step i of w are to different sides, alpha_i
/// exchanges them; where both are to the left, or there is only one of them, alpha_i is alpha_a on d; so for the right
/// and e. What is free in a factor is free in the product.
///
/// Factors may be open, and need not be connected. A 0-G-map counts as its darts, each a vertex: its alpha_0, which
/// glues nothing, has no part in the product. Requires: k, l >= 0, k + l at most largest_map_dimension,
/// and so many darts that `count_of_darts` is below no_dart. Cost: (k + l)^2 times the darts.
[[nodiscard]] GMap product(const GMap& left, const GMap& right);

/// The canonical boundary of the product of two cells, whose canonical boundaries are connected maps of dimensions
/// k - 1 and l - 1: a map of dimension k + l - 1 with the darts of ProductDarts(left darts, k, right darts, l).
/// Its involutions are those of `product` but the last one. Requires and cost: the same.
[[nodiscard]] GMap boundary_of_product(const GMap& left, const GMap& right);

/// The product of two chains of maps. Level i is one after the other the products of level a and level i - a, as
/// `boundary_of_product` has their darts, by increasing a. sigma_i takes the last step of the word away, and goes to
/// that face in the factor to whose side it is. Requires and cost: the same, for each level.
[[nodiscard]] ChainOfMaps product(const ChainOfMaps& left, const ChainOfMaps& right);

/// +1 or -1: let (d, e, w) see a cell of a product as `product` says. It sees the product of the left cell as d sees it
/// and the right cell as e sees it, with the orientation of a tensor product, where
/// d(a x b) = da x b + (-1)^dim a  a x db; or the opposite one. The word with number 0 has +1. Cost: the dimension.
[[nodiscard]] int sign_of_word(const ProductDarts& darts, std::uint32_t word);

}  // namespace sesame::ops
