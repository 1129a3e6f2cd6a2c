#include "engine/zigzag/cycle_history.hpp"

#include <algorithm>
#include <utility>

namespace sesame::engine {
namespace {

constexpr auto nobody_asks = [](CellKey) {};

/// The sum of chains, each times a factor. Cost: their terms, sorted.
template <sparse::Ring R>
class SumOfChains {
 public:
  explicit SumOfChains(const R& ring) : ring_{ring} {}

  void add(const CellChain<R>& chain, const typename R::Element& factor) {
    for (const CellTerm<R>& term : chain) {
      terms_.emplace_back(term.cell, ring_.multiply(factor, coefficient(ring_, term)));
    }
  }
  /// The sum, and nothing is left.
  CellChain<R> take() {
    std::ranges::sort(terms_, std::ranges::greater{}, &Term::first);
    CellChain<R> sum;
    for (std::size_t at = 0; at < terms_.size();) {
      typename R::Element value = ring_.zero();
      const CellKey cell = terms_[at].first;
      for (; at < terms_.size() && terms_[at].first == cell; ++at) {
        value = ring_.add(value, terms_[at].second);
      }
      if (!ring_.is_zero(value)) {
        sum.push_back(cell_term<R>(cell, value));
      }
    }
    terms_.clear();
    return sum;
  }

 private:
  using Term = std::pair<CellKey, typename R::Element>;
  const R& ring_;
  std::vector<Term> terms_;
};

}  // namespace

template <sparse::Ring R>
bool CycleHistory<R>::keeps(std::size_t d) {
  while (keeps_.size() <= d) {
    keeps_.push_back(wants_(static_cast<int>(keeps_.size())));
    pasts_.emplace_back();
  }
  return keeps_[d];
}

template <sparse::Ring R>
void CycleHistory<R>::begin(std::size_t d, Number number) {
  if (wires_.size() >= most_wires_) {
    collect();
  }
  if (pasts_[d].size() <= number) {
    pasts_[d].resize(number + std::size_t{1});
  }
  pasts_[d][number].clear();
}

template <sparse::Ring R>
void CycleHistory<R>::begin(std::size_t d, Number number, const Chain& cycle, Moment now) {
  begin(d, number);
  change(pasts_[d][number], cycle, now);
}

template <sparse::Ring R>
void CycleHistory<R>::add(Past& x, const Past& y, const Element& factor, Moment birth) {
  const auto end = std::ranges::partition_point(
      y, [&](const CellTerm<R>& term) { return wire(term).from.operation >= birth.operation; });
  add_chain(ring_, x, std::span{y.begin(), end}, factor, scratch_, nobody_asks);
}

template <sparse::Ring R>
void CycleHistory<R>::exchange(Past& x, Past& y, const Element& factor, Moment birth) {
  Past old = x;
  add(x, y, factor, birth);
  x = scaled(ring_, std::move(x), ring_.inverse(factor));
  y = std::move(old);
}

template <sparse::Ring R>
void CycleHistory<R>::change(Past& of, Chain difference, Moment now) {
  of.insert(of.begin(), cell_term<R>(CellKey{wires_.size(), 0}, ring_.one()));
  wires_.push_back({now, std::move(difference)});
}

template <sparse::Ring R>
typename CycleHistory<R>::Chain CycleHistory<R>::pass_on(std::size_t d, const Level& level, std::span<const Used> used,
                                                         const Chain& rest, CellSum<R>& sum, Moment now) {
  Number carrier = used.front().number;
  Past in_boundary;
  sum.add(rest, ring_.one());
  for (const auto& [number, times] : used) {
    if (!level[number].is_open) {
      sum.add(level[number].terms, ring_.negate(times));
      continue;
    }
    if (level[carrier].rank < level[number].rank) {
      const Element to_one = ring_.inverse(times);
      Past passed;
      add(passed, in_boundary, ring_.negate(to_one), level[carrier].birth);
      change(passed, sum.terms(to_one), now);
      past(d, carrier) = std::move(passed);
      carrier = number;
    }
    add(in_boundary, past(d, number), times, {});
  }
  past(d, carrier) = std::move(in_boundary);
  Chain dying = sum.terms(ring_.one());
  sum.clear();
  return dying;
}

template <sparse::Ring R>
std::vector<CyclePiece> CycleHistory<R>::pieces(const Past& past, Chain cycle, const MomentBar& bar) const {
  std::vector<CyclePiece> found;
  SumOfChains<R> sum{ring_};
  for (auto term = past.begin(); term != past.end() && wire(*term).from.operation > bar.birth.operation;) {
    const Moment from = wire(*term).from;
    for (; term != past.end() && wire(*term).from.operation == from.operation; ++term) {
      sum.add(wire(*term).chain, coefficient(ring_, *term));
    }
    if (const Chain change = sum.take(); !change.empty()) {
      if (from.operation < bar.death.operation) {
        found.push_back({from, told(bar.dimension, cycle)});
      }
      add_chain(ring_, cycle, change, ring_.negate(ring_.one()), scratch_, nobody_asks);
    }
  }
  found.push_back({bar.birth, told(bar.dimension, cycle)});
  std::ranges::reverse(found);
  return found;
}

template <sparse::Ring R>
ZigzagChain CycleHistory<R>::told(int dimension, const Chain& chain) const {
  ZigzagChain told{dimension, {}};
  for (auto term = chain.rbegin(); term != chain.rend(); ++term) {
    told.terms.push_back({sparse::to_rational(ring_, coefficient(ring_, *term)), term->cell.age()});
  }
  return told;
}

/// Wires keep their order, so pasts stay sorted.
template <sparse::Ring R>
void CycleHistory<R>::collect() {
  std::vector<std::uint64_t> number_of(wires_.size(), 0);
  const auto for_each_term = [&](auto&& visit) {
    for (std::vector<Past>& level : pasts_) {
      for (Past& past : level) {
        std::ranges::for_each(past, visit);
      }
    }
  };
  for_each_term([&](const CellTerm<R>& term) { number_of[term.cell.age()] = 1; });
  std::uint64_t kept = 0;
  for (std::size_t k = 0; k < wires_.size(); ++k) {
    if (number_of[k] != 0) {
      number_of[k] = kept;
      if (kept != k) {
        wires_[kept] = std::move(wires_[k]);
      }
      ++kept;
    }
  }
  wires_.erase(wires_.begin() + static_cast<std::ptrdiff_t>(kept), wires_.end());
  for_each_term([&](CellTerm<R>& term) { term.cell = CellKey{number_of[term.cell.age()], 0}; });
  most_wires_ = std::max(fewest_collected, 2 * wires_.size());
}

template class CycleHistory<sparse::Z2>;
template class CycleHistory<sparse::Zp>;
template class CycleHistory<sparse::Rationals>;

}  // namespace sesame::engine
