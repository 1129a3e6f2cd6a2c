#include "engine/history_names.hpp"

#include <algorithm>
#include <utility>

namespace sesame::engine {

template <sparse::Ring R>
NameChain named_at(const R& ring, const ops::Structure& structure, ops::LinkId links, int degree,
                   const sparse::Terms<R, ops::CellId>& chain) {
  struct Named {
    ops::CellId oldest;
    typename R::Element coefficient;
  };
  std::vector<Named> named;
  for (const auto& [cell, coefficient] : chain) {
    const ops::CellId oldest = structure.forest().oldest_at(cell, links);
    const int sign = structure.forest().find_oriented_at(oldest, links).sign *
                     structure.maps().sign(structure.directory().order_of_own_name(oldest));
    named.push_back({oldest, sign > 0 ? coefficient : ring.negate(coefficient)});
  }
  std::sort(named.begin(), named.end(), [](const Named& a, const Named& b) { return a.oldest < b.oldest; });
  NameChain told{degree, {}};
  for (const auto& [oldest, coefficient] : named) {
    told.terms.push_back({sparse::to_rational(ring, coefficient), structure.directory().own_name(oldest)});
  }
  return told;
}

template <sparse::Ring R>
std::vector<NamedCycle> named_cycles(const R& ring, const ops::Structure& structure,
                                     const std::vector<HistoryMap>& maps, const Bar& bar,
                                     const std::vector<ChainPiece<R>>& pieces) {
  std::vector<NamedCycle> found;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const std::uint64_t step = maps[pieces[k].from].step;
    const bool is_passing = k + 1 < pieces.size() && maps[pieces[k + 1].from].step == step;
    if (is_passing || Time{step} == bar.death) {
      continue;
    }
    std::uint64_t at = pieces[k].from;  // the last map of the step
    while (at + 1 < maps.size() && maps[at + 1].step == step) {
      ++at;
    }
    NameChain cycle = named_at(ring, structure, maps[at].after.links, bar.dimension, pieces[k].chain);
    if (found.empty() || found.back().cycle != cycle) {  // what became another cell may be called the same
      found.push_back({Time{step}, std::move(cycle)});
    }
  }
  return found;
}

#define SESAME_INSTANTIATE(R)                                                                                       \
  template NameChain named_at<R>(const R&, const ops::Structure&, ops::LinkId, int,                                 \
                                 const sparse::Terms<R, ops::CellId>&);                                             \
  template std::vector<NamedCycle> named_cycles<R>(const R&, const ops::Structure&, const std::vector<HistoryMap>&, \
                                                   const Bar&, const std::vector<ChainPiece<R>>&);
SESAME_INSTANTIATE(sparse::Z2)
SESAME_INSTANTIATE(sparse::Zp)
SESAME_INSTANTIATE(sparse::Rationals)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
