/// \file
/// The small generators of a product: one for each pair of those of the factors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/right/rewriter.hpp"

namespace sesame::engine {

/// Which generator of B is which a (x) b. They are consecutive, by degree; those of one degree in the order of (a, b).
/// Cost: of a pair by its generator O(1), of a generator by its pair the logarithm of the small generators' number.
class PairTable {
 public:
  /// The table of all pairs of two sorted lists, from generator `first` on. degree_of(x): of a small generator.
  template <class DegreeOf>
  PairTable(std::vector<Symbol> left, std::vector<Symbol> right, GeneratorId first, DegreeOf degree_of);

  /// The generators of the product are [first, end).
  [[nodiscard]] GeneratorId first() const { return first_; }
  [[nodiscard]] GeneratorId end() const { return first_ + places_.size(); }
  [[nodiscard]] std::pair<Symbol, Symbol> pair(GeneratorId generator) const {
    const std::uint32_t place = places_[generator - first_];
    return {left_[place / right_.size()], right_[place % right_.size()]};
  }

  /// left (x) right times a factor, two chains in symbols of the factors, in generators, added to `out`.
  template <Ring R>
  void add_tensor(const R& ring, const Terms<R, Symbol>& left, const Terms<R, Symbol>& right,
                  const typename R::Element& factor, RawTerms<R, GeneratorId>& out) const;

 private:
  [[nodiscard]] static std::size_t index(const std::vector<Symbol>& symbols, Symbol x) {
    return static_cast<std::size_t>(std::lower_bound(symbols.begin(), symbols.end(), x) - symbols.begin());
  }

  std::vector<Symbol> left_, right_;
  GeneratorId first_;
  std::vector<std::uint32_t> places_;    ///< per generator: i * |right| + j for the pair (i, j)
  std::vector<GeneratorId> generators_;  ///< per place
};

template <class DegreeOf>
PairTable::PairTable(std::vector<Symbol> left, std::vector<Symbol> right, GeneratorId first, DegreeOf degree_of)
    : left_{std::move(left)}, right_{std::move(right)}, first_{first}, places_(left_.size() * right_.size()) {
  const auto degree_at = [&](std::uint32_t place) {
    return degree_of(left_[place / right_.size()]) + degree_of(right_[place % right_.size()]);
  };
  std::iota(places_.begin(), places_.end(), 0U);
  std::stable_sort(places_.begin(), places_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return degree_at(a) < degree_at(b); });
  generators_.resize(places_.size());
  for (std::size_t k = 0; k < places_.size(); ++k) {
    generators_[places_[k]] = first_ + k;
  }
}

template <Ring R>
void PairTable::add_tensor(const R& ring, const Terms<R, Symbol>& left, const Terms<R, Symbol>& right,
                           const typename R::Element& factor, RawTerms<R, GeneratorId>& out) const {
  for (const auto& [a, coefficient_a] : left) {
    const std::size_t row = index(left_, a) * right_.size();
    const auto scaled = ring.multiply(factor, coefficient_a);
    for (const auto& [b, coefficient_b] : right) {
      out.push_back({generators_[row + index(right_, b)], ring.multiply(scaled, coefficient_b)});
    }
  }
}

}  // namespace sesame::engine
