#include "engine/towers/chain_images.hpp"

#include <algorithm>
#include <optional>

#include "sparse/contract.hpp"

namespace sesame::engine {

using ops::TowerComplex;
using sparse::Terms;

// ---- images

template <Ring R>
std::vector<typename ChainImages<R>::Image>& ChainImages<R>::images_of(std::size_t dimension) {
  const std::size_t at = has_shared_slots_ ? 0 : dimension;
  if (images_.size() <= at) {
    images_.resize(at + 1);
  }
  return images_[at];
}

/// gathered_ += factor g(cell).
template <Ring R>
void ChainImages<R>::add_cell(std::size_t dimension, Slot slot, const Element& factor) {
  const Image& image = images_of(dimension)[slot];
  gathered_.push_back({image.generator, image.is_negative ? ring_.negate(factor) : factor});
  if (image.corrections != no_terms) {
    for (const TermType& each : corrections_[image.corrections]) {
      gathered_.push_back({each.index, ring_.multiply(factor, each.coefficient)});
    }
  }
}

template <Ring R>
void ChainImages<R>::include(std::size_t dimension, Slot slot, std::span<const Slot> facets) {
  Element sign = ring_.one();
  gathered_.clear();
  for (const Slot facet : facets) {
    add_cell(dimension - 1, facet, sign);
    sign = ring_.negate(sign);
  }
  inclusion_ = inclusions_ - 1;
  std::vector<Image>& images = images_of(dimension);
  if (slot >= images.size()) {
    images.resize(std::max<std::size_t>(slot + std::size_t{1}, images.size() + images.size() / 2));
  }
  images[slot] = Image{next_generator(), false, no_terms};
}

template <Ring R>
void ChainImages<R>::contract(std::size_t dimension, const TowerComplex::Change& change) {
  gathered_.clear();
  add_cell(dimension, change.slot, ring_.one());
  if (change.fate == TowerComplex::Fate::merged) {
    add_cell(dimension, change.survivor, change.is_reversed ? ring_.one() : ring_.negate(ring_.one()));
  }
  inclusion_ = no_inclusion;
}

template <Ring R>
void ChainImages<R>::correct(std::size_t dimension, Slot slot, std::uint32_t generator, bool is_negative) {
  Image& image = images_of(dimension)[slot];
  if (image.corrections == no_terms) {
    image.corrections = static_cast<std::uint32_t>(corrections_.size());
    corrections_.emplace_back();
  }
  corrections_[image.corrections].push_back({generator, ring_.from(is_negative ? -1 : 1)});
}

template <Ring R>
void ChainImages<R>::reverse(std::size_t dimension, Slot slot) {
  Image& image = images_of(dimension)[slot];
  image.is_negative = !image.is_negative;
  if (image.corrections != no_terms) {
    for (TermType& each : corrections_[image.corrections]) {
      each.coefficient = ring_.negate(each.coefficient);
    }
  }
}

// ---- generators

/// The generator whose boundary is gathered_.
template <Ring R>
typename ChainImages<R>::Generator ChainImages<R>::append(std::size_t dimension) {
  sparse::expects(std::max(generators_.size(), times_.size()) < negative_mark, "fewer than 2^32 - 2 generators");
  gathered_.finish(ring_, boundary_);
  const Generator b = next_generator();
  generators_.push_back({terms_.size(), static_cast<std::uint32_t>(boundary_.size()), alive_mark,
                         static_cast<std::uint32_t>(times_.size() - 1), inclusion_,
                         static_cast<std::uint8_t>(dimension)});
  added_.emplace_back(additions_.size(), 0);
  scale_.push_back(ring_.one());
  return b;
}

template <Ring R>
void ChainImages<R>::bear(std::size_t dimension, Node node) {
  const Generator b = append(dimension);
  // That V(b) is a cycle will do; which one is worked out when somebody asks.
  terms_.insert(terms_.end(), boundary_.begin(), boundary_.end());
  bearers_.resize(std::max(bearers_.size(), dimension + 1));
  std::vector<Generator>& bearers = bearers_[dimension];
  bearers.resize(std::max<std::size_t>(bearers.size(), node + std::size_t{1}));
  bearers[node] = b;
}

/// Keeps the reduced boundary of b, made to end with 1 times the generator of the class that dies.
template <Ring R>
void ChainImages<R>::kill(std::size_t dimension, Node node) {
  const Generator b = append(dimension + 1);
  const Generator pivot = bearers_[dimension][node];
  reduce(boundary_, [&](Generator killer, const Element& factor) { additions_.push_back({killer, factor}); });
  added_[b].second = static_cast<std::uint32_t>(additions_.size() - added_[b].first);
  sparse::expects(!column_.empty() && column_.back().index == pivot, "classes and chains find the same pair");
  const std::uint64_t first_term = terms_.size();
  scale_[b] = ring_.inverse(column_.back().coefficient);
  for (const TermType& each : column_) {
    terms_.push_back({each.index, ring_.multiply(scale_[b], each.coefficient)});
  }
  Cell& dead = generators_[pivot];
  dead.first_term = first_term;
  dead.terms = static_cast<std::uint32_t>(column_.size());
  dead.partner = b;
  generators_[b].partner = negative_mark;
}

template <Ring R>
void ChainImages<R>::renumber(std::size_t dimension, std::span<const Node> number) {
  if (dimension >= bearers_.size()) {
    return;
  }
  std::vector<Generator>& bearers = bearers_[dimension];
  const std::size_t nodes = std::min(bearers.size(), number.size());
  for (std::size_t node = 0; node < nodes; ++node) {
    if (number[node] != ClassSpace<R>::no_node) {
      bearers[number[node]] = bearers[node];  // numbers keep their order, so none is read too late
    }
  }
}

// ---- reduction

/// Leaves in column_ a boundary with multiples of R(killer) added until its youngest generator is alive, or nothing
/// is left; tells note(killer, factor) of each. For a cycle that is worked out late that is what it would have been
/// when it was born: all classes in its boundary were dead by then.
template <Ring R>
template <class Note>
void ChainImages<R>::reduce(std::span<const TermType> boundary, Note&& note) {
  for (const TermType& each : boundary) {
    add_term(each.index, ring_.one(), each.coefficient);
  }
  column_.clear();
  std::optional<TermType> top = sum_.take();
  for (; top; top = sum_.take()) {
    const Cell& cell = generators_[top->index];
    const Generator killer = cell.partner;
    sparse::expects(killer != negative_mark, "the youngest generator of a cycle is a class");
    if (killer == alive_mark) {
      break;
    }
    // R(killer) ends with 1 times this generator.
    const Element factor = ring_.negate(top->coefficient);
    for (const TermType& each : kept_terms(cell).first(cell.terms - 1)) {
      add_term(each.index, factor, each.coefficient);
    }
    note(killer, factor);
  }
  for (; top; top = sum_.take()) {
    column_.push_back(*top);
  }
  std::ranges::reverse(column_);
}

template <Ring R>
void ChainImages<R>::add_term(Generator generator, const Element& factor, const Element& coefficient) {
  ++terms_touched_;
  __builtin_prefetch(generators_.data() + generator);  // it may be the youngest some time soon
  sum_.add_product(generator, factor, coefficient);
}

// ---- bars and their chains

template <Ring R>
std::vector<BarCycles::TracedBar> ChainImages<R>::bars() const {
  std::vector<TracedBar> found;
  for (Generator a = 0; a < generators_.size(); ++a) {
    const Cell& cell = generators_[a];
    const auto dimension = static_cast<int>(cell.dimension);
    if (cell.partner == alive_mark) {
      found.push_back({{dimension, times_[cell.operation], never}, cell.operation, cell.operation, a, a});
    } else if (cell.partner != negative_mark && generators_[cell.partner].operation != cell.operation) {
      const std::uint32_t killer = generators_[cell.partner].operation;
      found.push_back({{dimension, times_[cell.operation], times_[killer]}, cell.operation, killer, a, cell.partner});
    }
  }
  std::ranges::stable_sort(found, {}, &TracedBar::bar);
  return found;
}

template <Ring R>
InclusionChain ChainImages<R>::cycle(const TracedBar& bar) {
  if (bar.bar.death == never) {
    const std::span<const TermType> kept = kept_terms(generators_[bar.birth]);
    const Terms<R> boundary(kept.begin(), kept.end());
    std::vector<Addition> additions{{bar.birth, ring_.one()}};
    reduce(boundary, [&](Generator killer, const Element& factor) { additions.push_back({killer, factor}); });
    return expand(bar.bar.dimension, additions);
  }
  return inclusions(bar.bar.dimension, kept_terms(generators_[bar.birth]));
}

template <Ring R>
InclusionChain ChainImages<R>::bounded_chain(const TracedBar& bar) {
  sparse::expects(bar.bar.death != never, "a bar that has ended has a chain that its cycle bounds");
  const Addition whole{bar.death, ring_.one()};
  return expand(bar.bar.dimension + 1, {&whole, 1});
}

template <Ring R>
InclusionChain ChainImages<R>::inclusions(int degree, std::span<const TermType> terms) const {
  InclusionChain chain{degree, {}};
  for (const TermType& each : terms) {
    if (generators_[each.index].inclusion != no_inclusion) {
      chain.terms.push_back({to_rational(ring_, each.coefficient), InclusionId{generators_[each.index].inclusion}});
    }
  }
  return chain;
}

/// The sum of multiples of V(b): younger generators first, so that each is expanded once.
template <Ring R>
InclusionChain ChainImages<R>::expand(int degree, std::span<const Addition> sum) {
  for (const Addition& each : sum) {
    sum_.add_product(each.killer, ring_.one(), each.factor);
  }
  Terms<R> found;
  while (const std::optional<TermType> top = sum_.take()) {
    const Element scaled = ring_.multiply(top->coefficient, scale_[top->index]);
    found.push_back({top->index, scaled});
    const TermRange range = added_[top->index];
    for (const Addition& each : std::span{additions_}.subspan(range.first, range.second)) {
      sum_.add_product(each.killer, scaled, each.factor);
    }
  }
  std::ranges::reverse(found);
  return inclusions(degree, found);
}

template class ChainImages<sparse::Z2>;
template class ChainImages<sparse::Zp>;
template class ChainImages<sparse::Rationals>;

}  // namespace sesame::engine
