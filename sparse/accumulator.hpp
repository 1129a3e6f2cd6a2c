/// \file
/// A dense workspace for sums of sparse vectors, cleared at the cost of what was added.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "sparse/chain.hpp"
#include "sparse/growing_array.hpp"

namespace sesame::sparse {

/// Sums terms by index. One slot per index, kept between sums; a sum touches only the indices that occur in it.
/// Source: the sparse accumulator of J. Gilbert, C. Moler and R. Schreiber, "Sparse matrices in MATLAB" (1992).
template <Ring R, class Id = Index>
class Accumulator {
 public:
  using Element = typename R::Element;

  explicit Accumulator(R ring) : ring_{ring} {}

  /// Makes room for indices below a number, of which a sum has a few.
  void reserve(std::size_t indices) {
    values_.reserve(indices);
    present_.reserve(indices);
    touched_.reserve(std::min<std::size_t>(indices, 64));
  }

  /// Adds factor * coefficient at an index. True when the index is new to this sum. Cost O(1), amortised.
  bool add_product(Id index, const Element& factor, const Element& coefficient) {
    if (index >= values_.size()) [[unlikely]] {
      values_.resize(std::size_t{index} + 1);  // each new one is 0
      present_.resize(values_.size());
    }
    const bool is_new = present_[index] == 0;
    if (is_new) {
      present_[index] = 1;
      touched_.push_back(index);
    }
    ring_.add_product(values_[index], factor, coefficient);
    return is_new;
  }

  /// The sum so far at an index that is part of this sum, which is set to zero.
  Element take(Id index) { return std::exchange(values_[index], ring_.zero()); }

  /// A fresh start: the sum so far is forgotten. Cost O(n) for n indices.
  void clear() {
    for (const Id index : touched_) {
      (void)take(index);
      present_[index] = 0;
    }
    touched_.clear();
  }

  /// The sum in normal form, and a fresh start. Cost O(n log n) for n indices.
  void finish(Terms<R, Id>& out) {
    out.clear();
    std::sort(touched_.begin(), touched_.end());
    for (const Id index : touched_) {
      Element value = take(index);
      present_[index] = 0;
      if (!ring_.is_zero(value)) {
        out.push_back({index, std::move(value)});
      }
    }
    touched_.clear();
  }

 private:
  R ring_;
  GrowingArray<Element> values_;
  GrowingArray<unsigned char> present_;
  std::vector<Id> touched_;
};

}  // namespace sesame::sparse
