#include "engine/left/product_maps.hpp"

namespace sesame::engine {

template <Ring R>
void ProductMaps<R>::add_F(CellId cell, const Element& factor, RawTerms<R, GeneratorId>& out) const {
  const ops::LazyKey key = this->key(cell);
  this->add_F_of_pair(key.left.cell, key.right.cell, signed_factor(factor, key), out);
}

template <Ring R>
void ProductMaps<R>::add_K(CellId cell, const Element& factor, RawTerms<R, CellId>& out) const {
  const ops::LazyKey key = this->key(cell);
  this->add_K_of_pair(key.left.cell, key.right.cell, signed_factor(factor, key), out);
}

template <Ring R>
std::uint64_t ProductMaps<R>::terms_of_K(CellId cell) const {
  const ops::LazyKey key = this->key(cell);
  return this->terms_of_K_of_pair(key.left.cell, key.right.cell);
}

/// Only the coefficients that count: K of a cell is as long as those of its factors multiplied.
template <Ring R>
void ProductMaps<R>::add_K_at(CellId cell, std::span<const CellId> at, const Element& factor,
                              RawTerms<R, CellId>& out) const {
  const ops::LazyKey key = this->key(cell);
  const auto& left = factors_.homotopy(key.left.cell);
  const Terms<R, CellId>& right = factors_.homotopy(key.right.cell).K;
  const Element sign = ring_.from(structure_.dimension(key.left.cell) % 2 == 0 ? 1 : -1);
  const Element of_cell = signed_factor(factor, key);
  for (const CellId other : at) {
    const ops::LazyKey& over = this->key(other);
    const Element of_left = this->coefficient_at(left.GF, over.left.cell);
    const Element of_right = this->coefficient_at(right, over.right.cell);
    Element sum = ring_.multiply(sign, ring_.multiply(of_left, of_right));
    if (over.right.cell == key.right.cell) {
      sum = ring_.add(sum, this->coefficient_at(left.K, over.left.cell));
    }
    out.push_back({other, ring_.multiply(signed_factor(of_cell, over), sum)});
  }
}

template <Ring R>
void ProductMaps<R>::add_pairs(const Terms<R, CellId>& left, const Terms<R, CellId>& right, const Element& factor,
                               RawTerms<R, CellId>& out) const {
  const ops::Values& values = structure_.values();
  for (const auto& [a, coefficient_a] : left) {
    const Element scaled = ring_.multiply(factor, coefficient_a);
    for (const auto& [b, coefficient_b] : right) {
      const ops::Incidence pair =
          structure_.lazy().face(this->id_, ops::LazyPart::pair, values.plain(a), values.plain(b));
      const Element product = ring_.multiply(scaled, coefficient_b);
      out.push_back({pair.node, sign_of(pair) < 0 ? ring_.negate(product) : product});
    }
  }
}

#define SESAME_INSTANTIATE(R) template class ProductMaps<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
