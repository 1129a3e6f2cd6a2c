#include "engine/left/simplicial_product_maps.hpp"

#include <algorithm>

#include "engine/left/saturating.hpp"

namespace sesame::engine {

using ops::LazyPart;
using ops::Value;

namespace {

/// The steps of a monotone map that do not move, as collapsed directions.
ops::Degeneracy collapsed_steps(const reductions::Vertices& map) {
  ops::Degeneracy collapsed = 0;
  for (std::size_t j = 0; j + 1 < map.size(); ++j) {
    if (map[j] == map[j + 1]) {
      collapsed |= ops::Degeneracy{1} << j;
    }
  }
  return collapsed;
}

}  // namespace

/// Calls visit(a, b) for each a|b of f: a front face and a back face that are cells.
template <Ring R>
template <class Visit>
void SimplicialProductMaps<R>::for_each_in_f(CellId cell, Visit visit) const {
  const ops::LazyKey key = this->key(cell);
  for (const auto& [front, back] : reductions::alexander_whitney(structure_.dimension(cell))) {
    const Value a = restrict(key.left, front);
    const Value b = restrict(key.right, back);
    if (!a.is_degenerate() && !b.is_degenerate()) {
      visit(a.cell, b.cell);
    }
  }
}

/// The face or degeneracy of a simplex along a monotone map.
template <Ring R>
Value SimplicialProductMaps<R>::restrict(Value v, const reductions::Vertices& map) const {
  const int n = structure_.types().info(v.type).dimension;
  for (int vertex = n; vertex >= 0; --vertex) {
    if (!std::binary_search(map.begin(), map.end(), static_cast<std::uint8_t>(vertex))) {
      v = structure_.values().face(v, static_cast<std::uint32_t>(vertex));
    }
  }
  const ops::Degeneracy steps = collapsed_steps(map);
  return {v.cell, structure_.types().simplex(static_cast<int>(map.size()) - 1), ops::compose(steps, v.collapsed)};
}

/// The simplex of the product that two maps make of a pair; nothing if it is degenerate.
template <Ring R>
void SimplicialProductMaps<R>::add_simplex(const reductions::SignedPair& maps, const Value& left, const Value& right,
                                           const Element& factor, RawTerms<R, CellId>& out) const {
  const Value a = restrict(left, maps.first);
  const Value b = restrict(right, maps.second);
  if ((a.collapsed & b.collapsed) == 0) {
    const CellId cell = structure_.lazy().cell(this->id_, LazyPart::pair, a, b);
    out.push_back({cell, maps.sign > 0 ? factor : ring_.negate(factor)});
  }
}

template <Ring R>
void SimplicialProductMaps<R>::add_F(CellId cell, const Element& factor, RawTerms<R, GeneratorId>& out) const {
  for_each_in_f(cell, [&](CellId a, CellId b) { this->add_F_of_pair(a, b, factor, out); });
}

template <Ring R>
void SimplicialProductMaps<R>::add_K(CellId cell, const Element& factor, RawTerms<R, CellId>& out) const {
  const ops::LazyKey key = this->key(cell);
  for (const auto& term : factors_.formulas().shih(structure_.dimension(cell))) {
    add_simplex(term, key.left, key.right, factor, out);
  }
  for_each_in_f(cell, [&](CellId a, CellId b) { this->add_K_of_pair(a, b, factor, out); });
}

template <Ring R>
std::uint64_t SimplicialProductMaps<R>::terms_of_K(CellId cell) const {
  std::uint64_t terms = factors_.formulas().shih(structure_.dimension(cell)).size();
  for_each_in_f(cell, [&](CellId a, CellId b) { terms = saturating_sum(terms, this->terms_of_K_of_pair(a, b)); });
  return terms;
}

template <Ring R>
void SimplicialProductMaps<R>::add_pairs(const Terms<R, CellId>& left, const Terms<R, CellId>& right,
                                         const Element& factor, RawTerms<R, CellId>& out) const {
  const ops::Values& values = structure_.values();
  for (const auto& [a, coefficient_a] : left) {
    const Element scaled = ring_.multiply(factor, coefficient_a);
    for (const auto& [b, coefficient_b] : right) {
      const Element coefficient = ring_.multiply(scaled, coefficient_b);
      for (const auto& shuffle : factors_.formulas().shuffles(structure_.dimension(a), structure_.dimension(b))) {
        add_simplex(shuffle, values.plain(a), values.plain(b), coefficient, out);
      }
    }
  }
}

/// The binomial coefficient of p + q over q.
template <Ring R>
std::uint64_t SimplicialProductMaps<R>::cells_of_pair(int p, int q) const {
  std::uint64_t shuffles = 1;
  for (int k = 1; k <= q; ++k) {
    const std::uint64_t product = saturating_product(shuffles, static_cast<std::uint64_t>(p + k));
    if (product == uncountable) {
      return product;
    }
    shuffles = product / static_cast<std::uint64_t>(k);
  }
  return shuffles;
}

template <Ring R>
int SimplicialProductMaps<R>::sign_in_pair(const ops::LazyKey& key) const {
  const int p = structure_.dimension(key.left.cell);
  const int q = structure_.dimension(key.right.cell);
  for (const auto& shuffle : factors_.formulas().shuffles(p, q)) {
    if (collapsed_steps(shuffle.first) == key.left.collapsed &&
        collapsed_steps(shuffle.second) == key.right.collapsed) {
      return shuffle.sign;
    }
  }
  return 0;
}

#define SESAME_INSTANTIATE(R) template class SimplicialProductMaps<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
