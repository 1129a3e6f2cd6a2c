#include "engine/left/tensor_maps.hpp"

#include "engine/left/saturating.hpp"

namespace sesame::engine {

template <Ring R>
void TensorMaps<R>::add_G(GeneratorId generator, const Element& factor, RawTerms<R, CellId>& out) const {
  const auto [a, b] = pairs_.pair(generator);
  add_pairs(factors_.G(a), factors_.G(b), factor, out);
}

template <Ring R>
std::uint64_t TensorMaps<R>::terms_of_G(GeneratorId generator) const {
  const auto [a, b] = pairs_.pair(generator);
  return saturating_product(cells_of_pair(factors_.degree(a), factors_.degree(b)),
                            saturating_product(factors_.terms_of_G(a), factors_.terms_of_G(b)));
}

template <Ring R>
Terms<R, GeneratorId> TensorMaps<R>::transposed_G(CellId cell) const {
  const auto [left, right] = std::pair{key(cell).left.cell, key(cell).right.cell};
  RawTerms<R, GeneratorId> generators;
  const int sign = sign_in_pair(key(cell));
  if (sign == 0) {
    return {};
  }
  const int p = structure_.dimension(left);
  const int q = structure_.dimension(right);
  for (GeneratorId generator = pairs_.first(); generator < pairs_.end(); ++generator) {
    const auto [a, b] = pairs_.pair(generator);
    if (factors_.degree(a) == p && factors_.degree(b) == q) {
      const Element of_left = coefficient_at(factors_.G(a), left);
      const Element of_right = coefficient_at(factors_.G(b), right);
      generators.push_back({generator, ring_.multiply(ring_.from(sign), ring_.multiply(of_left, of_right))});
    }
  }
  return std::move(generators).normal(ring_);
}

template <Ring R>
void TensorMaps<R>::add_K_of_pair(CellId a, CellId b, const Element& factor, RawTerms<R, CellId>& out) const {
  const auto& of_a = factors_.homotopy(a);
  const Terms<R, CellId>& of_b = factors_.homotopy(b).K;
  add_pairs(of_a.K, {{b, ring_.one()}}, factor, out);
  add_pairs(of_a.GF, of_b, structure_.dimension(a) % 2 == 0 ? factor : ring_.negate(factor), out);
}

template <Ring R>
std::uint64_t TensorMaps<R>::terms_of_K_of_pair(CellId a, CellId b) const {
  const int p = structure_.dimension(a);
  const int q = structure_.dimension(b);
  const std::uint64_t of_b = factors_.homotopy(b).K.size();
  const auto& of_a = factors_.homotopy(a);
  const std::uint64_t first = saturating_product(of_a.K.size(), cells_of_pair(p + 1, q));
  const std::uint64_t second = saturating_product(of_a.GF.size(), of_b);
  return saturating_sum(first, saturating_product(second, cells_of_pair(p, q + 1)));
}

template <Ring R>
typename R::Element TensorMaps<R>::coefficient_at(const Terms<R, CellId>& chain, CellId cell) const {
  const sparse::Term<R, CellId>* term = sparse::find_term<R>(chain, cell);
  return term != nullptr ? term->coefficient : ring_.zero();
}

#define SESAME_INSTANTIATE(R) template class TensorMaps<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
