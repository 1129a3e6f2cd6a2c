/// \file
/// A sum of sparse vectors that is taken apart from its largest index down, while more is added below.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "sparse/chain.hpp"

namespace sesame::sparse {

/// Dense in values, and a tree of words of 64 bits over them that says where they are: O(log_64 of the largest index)
/// for everything, which is one word most of the time. Empty again once all has been taken.
/// Source: the bit tree of U. Bauer, M. Kerber, J. Reininghaus and H. Wagner, "PHAT" (2017).
template <Ring R>
class DescendingSum {
 public:
  using Element = typename R::Element;

  explicit DescendingSum(R ring) : ring_{ring} {}

  /// Adds factor * coefficient at an index.
  void add_product(Index index, const Element& factor, const Element& coefficient) {
    if (index >= values_.size()) [[unlikely]] {
      grow(index);
    }
    ring_.add_product(values_[index], factor, coefficient);
    std::size_t at = index;
    for (std::vector<std::uint64_t>& level : levels_) {
      std::uint64_t& word = level[at / 64];
      const bool was_empty = word == 0;
      word |= std::uint64_t{1} << (at % 64);
      if (!was_empty) {
        return;
      }
      at /= 64;
    }
  }

  /// Takes out the term with the largest index; nothing when the sum is 0.
  std::optional<Term<R>> take() {
    while (!values_.empty() && levels_.back()[0] != 0) {
      std::size_t at = 0;
      for (std::size_t level = levels_.size(); level-- > 0;) {
        at = at * 64 + 63 - static_cast<std::size_t>(std::countl_zero(levels_[level][at]));
      }
      const auto index = static_cast<Index>(at);
      for (std::vector<std::uint64_t>& level : levels_) {
        std::uint64_t& word = level[at / 64];
        word &= ~(std::uint64_t{1} << (at % 64));
        if (word != 0) {
          break;
        }
        at /= 64;
      }
      const Element value = std::exchange(values_[index], ring_.zero());
      if (!ring_.is_zero(value)) {
        return Term<R>{index, value};
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t height = 6;  // 64^6 is more than any index

  void grow(Index index) {
    values_.resize(std::max<std::size_t>(index + std::size_t{1}, 2 * values_.size()), ring_.zero());
    std::size_t words = values_.size();
    for (std::vector<std::uint64_t>& level : levels_) {
      words = (words + 63) / 64;
      level.resize(words, 0);
    }
  }

  R ring_;
  std::vector<Element> values_;
  std::array<std::vector<std::uint64_t>, height> levels_;  ///< bit i of a level: there is something in word i below
};

}  // namespace sesame::sparse
