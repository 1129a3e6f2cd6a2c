#include "engine/left/basis_shifts.hpp"

#include <algorithm>

namespace sesame::engine {

template <Ring R>
void BasisShifts<R>::add_as_created(GeneratorId generator, const typename R::Element& factor,
                                    RawTerms<R, GeneratorId>& out) const {
  if (const auto at = as_created_.empty() ? as_created_.end() : as_created_.find(generator); at != as_created_.end()) {
    for (const auto& [index, coefficient] : at->second) {
      out.push_back({index, ring_.multiply(factor, coefficient)});
    }
    return;
  }
  out.push_back({generator, factor});
}

template <Ring R>
std::vector<GeneratorId> BasisShifts<R>::generators_of(CellId node) const {
  const auto at = generators_of_.find(node);
  return at != generators_of_.end() ? at->second : std::vector<GeneratorId>{generators_.of(node)};
}

template <Ring R>
void BasisShifts<R>::shift(CellId node, CellId copy) {
  const GeneratorId e = generators_.of(copy);
  std::vector<GeneratorId> generators = generators_of(node);
  for (const GeneratorId generator : generators) {
    added_to_[generator].push_back(e);
    with_[e].push_back(generator);
    substitute(generator, generator, e);
    if (const auto keys = in_as_created_.find(generator); keys != in_as_created_.end()) {
      for (const GeneratorId key : std::set<GeneratorId>{keys->second}) {
        substitute(key, generator, e);
      }
    }
  }
  std::vector<GeneratorId>& of_copy = generators_of_.try_emplace(copy, std::vector<GeneratorId>{e}).first->second;
  of_copy.insert(of_copy.end(), generators.begin(), generators.end());
  generators_of_[node].clear();
  shifts_.push_back({node, copy, std::move(generators)});
}

/// What was written with a generator G, in what `key` was as created, is written with (G + e) - e.
template <Ring R>
void BasisShifts<R>::substitute(GeneratorId key, GeneratorId generator, GeneratorId e) {
  auto [chain, is_new] = as_created_.try_emplace(key);
  if (is_new) {
    chain->second = {{key, ring_.one()}};
  }
  if (const sparse::Term<R, GeneratorId>* term = sparse::find_term<R>(chain->second, generator)) {
    const auto coefficient = ring_.negate(term->coefficient);
    sparse::add_multiple<R>(ring_, chain->second, coefficient, Terms<R, GeneratorId>{{e, ring_.one()}});
    in_as_created_[e].insert(key);
  }
}

template <Ring R>
void BasisShifts<R>::truncate(std::size_t mark, GeneratorId first) {
  while (shifts_.size() > mark) {
    take_back_last();
  }
  for (GeneratorId generator = first; generator < generators_.size(); ++generator) {
    if (const auto keys = in_as_created_.find(generator); keys != in_as_created_.end()) {
      for (const GeneratorId key : keys->second) {
        if (const auto chain = as_created_.find(key); chain != as_created_.end()) {
          std::erase_if(chain->second, [&](const sparse::Term<R, GeneratorId>& term) { return term.index >= first; });
        }
      }
      in_as_created_.erase(keys);
    }
    with_.erase(generator);
    as_created_.erase(generator);
  }
}

template <Ring R>
void BasisShifts<R>::take_back_last() {
  Shift& last = shifts_.back();
  for (const GeneratorId generator : last.generators) {
    if (const auto added = added_to_.find(generator); added->second.size() == 1) {
      added_to_.erase(added);
    } else {
      added->second.pop_back();
    }
  }
  if (last.generators == std::vector<GeneratorId>{generators_.of(last.node)}) {  // an entry must not outlive its node
    generators_of_.erase(last.node);
  } else {
    generators_of_[last.node] = std::move(last.generators);
  }
  generators_of_.erase(last.copy);
  shifts_.pop_back();
}

#define SESAME_INSTANTIATE(R) template class BasisShifts<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
