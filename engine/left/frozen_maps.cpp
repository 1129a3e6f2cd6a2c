#include "engine/left/frozen_maps.hpp"

namespace sesame::engine {

template <Ring R>
const Terms<R, Symbol>& FrozenMaps<R>::F(CellId cell) {
  if (const auto known = images_.find(cell); known != images_.end()) {
    return known->second;
  }
  Terms<R, Symbol> image = rewriter_.rewrite(left_.g(cell));
  images_known_.push_back(cell);
  return images_.emplace(cell, std::move(image)).first->second;
}

template <Ring R>
const Terms<R, CellId>& FrozenMaps<R>::G(Symbol symbol) {
  if (const auto known = lifts_.find(symbol); known != lifts_.end()) {
    return known->second;
  }
  Terms<R, CellId> cells = left_.f(rewriter_.lift(Terms<R, Symbol>{{symbol, ring_.one()}}));
  lifts_known_.push_back(symbol);
  return lifts_.emplace(symbol, std::move(cells)).first->second;
}

template <Ring R>
const typename FrozenMaps<R>::Homotopy& FrozenMaps<R>::homotopy(CellId cell) {
  if (const auto known = homotopies_.find(cell); known != homotopies_.end()) {
    return known->second;
  }
  const Terms<R, GeneratorId> g = left_.g(cell);
  RawTerms<R, CellId> bounded = left_.f(rewriter_.lift({}, rewriter_.trace(g)));
  left_.add_K_of_lazy_part(cell, ring_.one(), bounded);
  Terms<R, CellId> image = left_.f(rewriter_.lift(rewriter_.rewrite(g)));
  homotopies_known_.push_back(cell);
  return homotopies_.emplace(cell, Homotopy{std::move(bounded).normal(ring_), std::move(image)}).first->second;
}

template <Ring R>
std::uint64_t FrozenMaps<R>::terms_of_G(Symbol symbol) {
  const auto known = lifts_.find(symbol);
  return known != lifts_.end() ? known->second.size()
                               : left_.terms_of_f(rewriter_.lift(Terms<R, Symbol>{{symbol, ring_.one()}}));
}

template <Ring R>
void FrozenMaps<R>::truncate(const Mark& mark) {
  const auto forget = [](auto& known, std::size_t size, auto& map) {
    for (; known.size() > size; known.pop_back()) {
      map.erase(known.back());
    }
  };
  forget(images_known_, mark.images, images_);
  forget(homotopies_known_, mark.homotopies, homotopies_);
  forget(lifts_known_, mark.lifts, lifts_);
}

#define SESAME_INSTANTIATE(R) template class FrozenMaps<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
