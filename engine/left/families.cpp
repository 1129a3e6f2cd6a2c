#include "engine/left/families.hpp"

#include <algorithm>

#include "engine/left/saturating.hpp"

namespace sesame::engine {

template <Ring R>
void Families<R>::add_F(CellId cell, const Element& factor, RawTerms<R, GeneratorId>& out) const {
  maps_of(cell).add_F(cell, factor, out);
  if (!gains_.empty()) {
    subtract_gains_of_K(gains_, cell, factor, out);
  }
}

/// -chi(K c) times a factor, for a lazy cell c.
template <Ring R>
void Families<R>::subtract_gains_of_K(const GainsByPlace& gains, CellId cell, const Element& factor,
                                      RawTerms<R, GeneratorId>& out) const {
  const auto [family, dimension] = place_of(cell);
  const auto concerned = gains.find({family, dimension + 1});
  if (concerned == gains.end()) {
    return;
  }
  std::vector<CellId> cells;
  for (const auto& gain : concerned->second) {
    cells.push_back(gain.first);
  }
  RawTerms<R, CellId> bounded;
  maps(family).add_K_at(cell, cells, ring_.negate(factor), bounded);
  for (const auto& [gained, coefficient] : bounded) {
    for (const auto& [generator, part] : concerned->second.at(gained)) {
      shifts_.add_as_created(generator, ring_.multiply(coefficient, part), out);
    }
  }
}

template <Ring R>
std::span<const sparse::Term<R, CellId>> Families<R>::attached_to(GeneratorId generator) const {
  const auto at = std::lower_bound(attached_.begin(), attached_.end(), generator,
                                   [](const auto& attached, GeneratorId g) { return attached.first < g; });
  return at != attached_.end() && at->first == generator ? at->second : std::span<const sparse::Term<R, CellId>>{};
}

template <Ring R>
void Families<R>::add_K_of_attached(GeneratorId generator, const Element& factor, RawTerms<R, CellId>& out) const {
  for (const auto& [cell, coefficient] : attached_to(generator)) {
    add_K(cell, ring_.multiply(factor, coefficient), out);
  }
}

template <Ring R>
std::uint64_t Families<R>::terms_of_K_of_attached(GeneratorId generator) const {
  std::uint64_t terms = 0;
  for (const auto& term : attached_to(generator)) {
    terms = saturating_sum(terms, maps_of(term.index).terms_of_K(term.index));
  }
  return terms;
}

template <Ring R>
void Families<R>::add_gains(const Gains& gains, std::map<GeneratorId, Terms<R, GeneratorId>>& changes) {
  if (gains.empty()) {
    return;
  }
  GainsByPlace by_place;
  for (const auto& [cell, gain] : gains) {
    for (const auto& [generator, coefficient] : maps_of(cell).transposed_G(cell)) {
      sparse::add_multiple<R>(ring_, changes[generator], coefficient, gain);
    }
    by_place[place_of(cell)].emplace(cell, gain);
  }
  for (const auto& [generator, lazy_cells] : attached_) {
    RawTerms<R, GeneratorId> sum;
    for (const auto& [cell, coefficient] : lazy_cells) {
      subtract_gains_of_K(by_place, cell, coefficient, sum);
    }
    const Terms<R, GeneratorId> change = std::move(sum).normal(ring_);
    if (!change.empty()) {
      sparse::add_multiple<R>(ring_, changes[generator], ring_.one(), change);
    }
  }
  for (const auto& [place, gained] : by_place) {
    for (const auto& [cell, gain] : gained) {
      sparse::add_multiple<R>(ring_, gains_[place][cell], ring_.one(), gain);
      gained_.emplace_back(place, cell);
    }
  }
}

template <Ring R>
void Families<R>::truncate(const Mark& mark, GeneratorId first) {
  while (!attached_.empty() && attached_.back().first >= first) {
    attached_.pop_back();
  }
  for (; gained_.size() > mark.gained; gained_.pop_back()) {
    const auto& [place, cell] = gained_.back();
    Gains& of_place = gains_[place];  // a gain that is gone may have come in several steps
    Terms<R, GeneratorId>& gain = of_place[cell];
    std::erase_if(gain, [first](const sparse::Term<R, GeneratorId>& term) { return term.index >= first; });
    if (gain.empty()) {
      of_place.erase(cell);
    }
    if (of_place.empty()) {
      gains_.erase(place);
    }
  }
  maps_.resize(mark.families);
}

#define SESAME_INSTANTIATE(R) template class Families<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
