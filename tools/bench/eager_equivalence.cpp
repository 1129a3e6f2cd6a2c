#include "tools/bench/eager_equivalence.hpp"

#include <algorithm>
#include <map>

#include "reductions/homology.hpp"
#include "sparse/contract.hpp"
#include "sparse/smith.hpp"

namespace sesame::tools {

using sparse::Index;

namespace {

/// column(x) of a list of columns, or of a matrix.
template <sparse::Ring R>
auto column_of(const std::vector<sparse::Terms<R>>& columns) {
  return [&columns](Index x) -> const sparse::Terms<R>& { return columns[x]; };
}
template <sparse::Ring R>
auto column_of(const TwoWayMatrix<R>& matrix) {
  return [&matrix](Index x) -> const sparse::Terms<R>& { return matrix.column(x); };
}

template <class Columns>
void reach(Columns& columns, Index column) {
  if (column >= columns.size()) {
    columns.resize(column + 1);
  }
}

}  // namespace

// ---- the steps

template <sparse::Ring R>
void EagerEquivalence<R>::add_cell(Index cell, int degree, const Terms& boundary) {
  const Index b = size();
  append(degree, image(boundary, column_of<R>(g_)));
  eliminate_units({b});
  reach(g_, cell);
  g_[cell] = {{b, ring_.one()}};
  if (keeps_all()) {
    const Terms itself{{cell, ring_.one()}};
    f_.append_column(itself);
  }
}

template <sparse::Ring R>
void EagerEquivalence<R>::remove_cells(const std::vector<Removed>& removed, const Columns& chi) {
  const Element minus_one = ring_.negate(ring_.one());
  const Index first = size();
  // The new boundaries g i(x) - d0 x, with the maps as they were.
  std::vector<Terms> boundaries;
  for (const Removed& x : removed) {
    Terms& boundary = boundaries.emplace_back(image(x.becomes, column_of<R>(g_)));
    add(boundary, minus_one, g_[x.cell]);
    add(boundary, minus_one, shifted(x.boundary, first));
  }
  for (std::size_t k = 0; k < removed.size() && keeps_all(); ++k) {
    for (const Index y : f_.columns_with(removed[k].cell)) {  // r f, below h
      add(h_[y], ring_.negate(f_.entry(removed[k].cell, y)), {{first + static_cast<Index>(k), ring_.one()}});
    }
  }
  for (std::size_t k = 0; k < removed.size(); ++k) {
    append(removed[k].degree + 1, boundaries[k]);
    eliminate_units({first + static_cast<Index>(k)});
    if (keeps_all()) {
      f_.append_column({});
      f_.substitute(removed[k].cell, removed[k].becomes);
    }
    g_[removed[k].cell] = {};
  }
  for (const auto& [cell, chain] : chi) {
    add(g_[cell], minus_one, shifted(chain, first));
  }
}

template <sparse::Ring R>
void EagerEquivalence<R>::split_cells(const std::vector<Copy>& copies, const Columns& chi) {
  sparse::expects(keeps_all(), "cells are split with all maps at hand");
  const Element minus_one = ring_.negate(ring_.one());
  const Index first = size();
  const auto delta = perturbation(chi);
  std::set<Index> changed;
  for (std::size_t k = 0; k < copies.size(); ++k) {
    const Copy& y = copies[k];
    changed.insert(size());
    append(y.degree, shifted(y.boundary, first));
    sparse::RawTerms<R> difference{{y.source, minus_one}, {y.cell, ring_.one()}};
    f_.append_column(std::move(difference).normal(ring_));
    reach(g_, y.cell);
    g_[y.cell] = g_[y.source];
    add(g_[y.cell], ring_.one(), {{first + static_cast<Index>(k), ring_.one()}});
  }
  perturb_right(delta, changed);
  eliminate_units(std::move(changed));
}

template <sparse::Ring R>
auto EagerEquivalence<R>::perturbation(const Columns& chi) -> Columns {
  std::map<Index, Terms> columns;
  for (const auto& [cell, chain] : chi) {
    const Terms in_b = shifted(chain, size());
    for (const Index y : f_.columns_with(cell)) {
      add(columns[y], f_.entry(cell, y), in_b);
    }
  }
  return {columns.begin(), columns.end()};
}

/// What the new part `delta` of the boundary of B does to the right reduction, as long as none of the copies is
/// eliminated: -delta hS is added to fS, delta gS to the boundary of S.
template <sparse::Ring R>
void EagerEquivalence<R>::perturb_right(const Columns& delta, std::set<Index>& changed) {
  for (const auto& [y, chain] : delta) {
    add(d_[y], ring_.one(), chain);
    for (const Index x : h_small_.columns_with(y)) {
      f_small_.add_to_column(x, ring_.negate(h_small_.entry(y, x)), chain);
    }
    for (const Index x : g_small_.columns_with(y)) {
      d_small_.add_to_column(x, g_small_.entry(y, x), chain);
      settle(x);
      changed.insert(x);
    }
  }
}

// ---- generators and eliminations

template <sparse::Ring R>
void EagerEquivalence<R>::append(int degree, const Terms& boundary) {
  const Index b = size();
  degrees_.push_back(degree);
  ++level(degree).big_size;
  level(degree).small.insert(b);
  d_small_.append_column(image(boundary, column_of(f_small_)));
  if (keeps_all()) {
    d_.push_back(boundary);
    h_.emplace_back();
    Terms lift{{b, ring_.one()}};
    add(lift, ring_.negate(ring_.one()), image(boundary, column_of(h_small_)));
    g_small_.append_column(lift);
    h_small_.append_column({});
  }
  const Terms itself{{b, ring_.one()}};
  f_small_.append_column(itself);
  settle(b);
}

/// Eliminates until none of these columns of the boundary of S, nor any that changes on the way, has a unit entry.
template <sparse::Ring R>
void EagerEquivalence<R>::eliminate_units(std::set<Index> columns) {
  while (!columns.empty()) {
    const Index b = *columns.begin();
    columns.erase(columns.begin());
    if (const std::optional<Index> a = level_of(b).small.contains(b) ? best_unit(b) : std::nullopt) {
      for (const Index changed : d_small_.columns_with(*a)) {
        columns.insert(changed);
      }
      eliminate(*a, b);
    }
  }
}

/// The row of the unit entry of a boundary for which fewest columns of fS change; the youngest of those.
template <sparse::Ring R>
std::optional<Index> EagerEquivalence<R>::best_unit(Index b) {
  std::optional<Index> best;
  for (const auto& term : d_small_.column(b)) {
    if (ring_.is_unit(term.coefficient) && (!best || f_small_.listed(term.index) <= f_small_.listed(*best))) {
      best = term.index;
    }
  }
  return best;
}

template <sparse::Ring R>
void EagerEquivalence<R>::eliminate(Index a, Index b) {
  const Element inverse = ring_.inverse(d_small_.entry(a, b));
  if (keeps_all()) {
    const Terms of_b = g_small_.column(b);
    g_small_.clear_column(a);
    g_small_.clear_column(b);
    for (const Index y : f_small_.columns_with(a)) {
      h_small_.add_to_column(y, ring_.multiply(inverse, f_small_.entry(a, y)), of_b);
    }
    for (const Index c : d_small_.columns_with(a)) {
      if (c != b) {
        g_small_.add_to_column(c, ring_.negate(ring_.multiply(inverse, d_small_.entry(a, c))), of_b);
      }
    }
  }
  Terms becomes;  // of a
  for (const auto& term : d_small_.column(b)) {
    if (term.index != a) {
      becomes.push_back({term.index, ring_.negate(ring_.multiply(inverse, term.coefficient))});
    }
  }
  d_small_.clear_column(a);
  d_small_.clear_column(b);
  std::vector<Index> changed = d_small_.columns_with(a);
  changed.insert(changed.end(), d_small_.columns_with(b).begin(), d_small_.columns_with(b).end());
  f_small_.substitute(a, becomes);
  f_small_.substitute(b, {});
  d_small_.substitute(a, becomes);
  d_small_.substitute(b, {});
  for (const Index x : {a, b}) {
    level_of(x).small.erase(x);
    settle(x);
  }
  for (const Index c : changed) {
    settle(c);
  }
}

/// Takes note of a boundary in S that has changed.
template <sparse::Ring R>
void EagerEquivalence<R>::settle(Index b) {
  Level& its = level_of(b);
  if (!d_small_.column(b).empty()) {
    its.with_boundary.insert(b);
  } else if (its.with_boundary.erase(b) == 0) {
    return;
  }
  its.factors.reset();
}

template <sparse::Ring R>
auto EagerEquivalence<R>::level(int degree) -> Level& {
  reach(levels_, static_cast<Index>(degree));
  return levels_[static_cast<std::size_t>(degree)];
}

template <sparse::Ring R>
void EagerEquivalence<R>::add(Terms& into, const Element& factor, const Terms& terms) {
  touched_ += into.size() + terms.size();
  sparse::add_multiple<R>(ring_, into, factor, terms);
}

/// All terms first, then one sorting: adding column after column would read a long image again for each.
template <sparse::Ring R>
template <class Column>
auto EagerEquivalence<R>::image(const Terms& chain, const Column& column) -> Terms {
  sparse::RawTerms<R> image;
  for (const auto& term : chain) {
    for (const auto& [index, coefficient] : column(term.index)) {
      image.push_back({index, ring_.multiply(term.coefficient, coefficient)});
    }
  }
  touched_ += image.size();
  return std::move(image).normal(ring_);
}

template <sparse::Ring R>
auto EagerEquivalence<R>::shifted(const Terms& terms, Index by) const -> Terms {
  Terms result = terms;
  for (auto& term : result) {
    term.index += by;
  }
  return result;
}

// ---- answers

template <sparse::Ring R>
engine::Homology EagerEquivalence<R>::homology(std::size_t dimensions) {
  engine::Homology homology;
  std::int64_t rank_below = 0;  // of the boundary of this degree
  for (std::size_t p = 0; p < dimensions; ++p) {
    homology.small.push_back(p < levels_.size() ? static_cast<std::uint32_t>(levels_[p].small.size()) : 0);
    homology.big.push_back(p < levels_.size() ? levels_[p].big_size : 0);
    std::vector<sparse::Integer>& torsion = homology.torsion.emplace_back();
    std::int64_t rank = 0;
    if (p + 1 < levels_.size()) {
      for (const Element& factor : invariant_factors(levels_[p + 1])) {
        ++rank;
        if (!ring_.is_unit(factor)) {
          torsion.push_back(ring_.to_integer(factor));
        }
      }
    }
    homology.betti.push_back(homology.small[p] - rank_below - rank);
    rank_below = rank;
  }
  return homology;
}

/// Of the boundaries that are not zero, their rows numbered anew.
template <sparse::Ring R>
auto EagerEquivalence<R>::invariant_factors(Level& level) const -> const std::vector<Element>& {
  if (level.factors) {
    return *level.factors;
  }
  std::map<Index, Index> rows;
  for (const Index b : level.with_boundary) {
    for (const auto& term : d_small_.column(b)) {
      rows.emplace(term.index, 0);
    }
  }
  Index number = 0;
  for (auto& row : rows) {
    row.second = number++;
  }
  sparse::Matrix<R> matrix(ring_, number, 0);
  for (const Index b : level.with_boundary) {
    Terms column = d_small_.column(b);
    for (auto& term : column) {
      term.index = rows.at(term.index);
    }
    matrix.append_column(column);
  }
  return level.factors.emplace(sparse::invariant_factors(matrix));
}

template <sparse::Ring R>
std::uint64_t EagerEquivalence<R>::map_generators() {
  sparse::expects(keeps_all(), "generators are mapped back by gS and f");
  const auto generators = small_generators();
  std::uint64_t terms = 0;
  for (const auto& group :
       reductions::homology(reductions::complex_by_columns(ring_, generators, column_of<R>(d_small_)))) {
    for (const auto& generator : group.generators) {
      Terms cycle = generator.cycle.terms();
      for (auto& term : cycle) {
        term.index = generators.generators(static_cast<std::size_t>(generator.cycle.degree().value))[term.index];
      }
      terms += image(image(cycle, column_of(g_small_)), column_of(f_)).size();
    }
  }
  return terms;
}

template <sparse::Ring R>
std::uint64_t EagerEquivalence<R>::entries_held() const {
  std::uint64_t entries =
      f_.entries() + f_small_.entries() + g_small_.entries() + h_small_.entries() + d_small_.entries();
  for (const auto* columns : {&d_, &g_, &h_}) {
    for (const Terms& column : *columns) {
      entries += column.size();
    }
  }
  return entries;
}

template <sparse::Ring R>
std::uint64_t EagerEquivalence<R>::entries_touched() const {
  return touched_ + f_.touched() + f_small_.touched() + g_small_.touched() + h_small_.touched() + d_small_.touched();
}

// ---- written out

template <sparse::Ring R>
reductions::Basis<Index> EagerEquivalence<R>::small_generators() const {
  reductions::Basis<Index> generators;
  for (std::size_t p = 0; p < levels_.size(); ++p) {
    for (const Index b : levels_[p].small) {
      generators.add(static_cast<int>(p), b);
    }
  }
  return generators;
}

template <sparse::Ring R>
reductions::Equivalence<R> EagerEquivalence<R>::matrices(const reductions::ChainComplex<R>& object,
                                                         const reductions::Basis<Index>& cells) const {
  sparse::expects(keeps_all(), "an equivalence is written out when all of it is kept");
  reductions::Basis<Index> big;
  for (Index b = 0; b < size(); ++b) {
    big.add(degrees_[b], b);
  }
  const auto small = small_generators();
  const auto map = [&](int degree, const auto& source, const auto& target, const auto& matrix) {
    return reductions::map_by_columns(ring_, degree, source, target, column_of<R>(matrix));
  };
  const auto big_complex = reductions::complex_by_columns(ring_, big, column_of<R>(d_));
  return {{big_complex, object, map(0, big, cells, f_), map(0, cells, big, g_), map(1, big, big, h_)},
          {big_complex, reductions::complex_by_columns(ring_, small, column_of<R>(d_small_)),
           map(0, big, small, f_small_), map(0, small, big, g_small_), map(1, big, big, h_small_)}};
}

#define SESAME_INSTANTIATE(R) template class EagerEquivalence<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::tools
