#include "tools/bench/eager_equivalence.hpp"

#include <map>

#include "sparse/contract.hpp"

namespace sesame::tools {

using sparse::Index;

// ---- the steps

template <sparse::Ring R>
void EagerEquivalence<R>::add_cell(Index cell, int degree, const Terms& boundary) {
  const Index b = size();
  const Terms in_b = image(boundary, g_);
  if (keeps_all()) {
    append_to(d_, in_b);
    append_to(h_, {});
    f_.append_column(Terms{{cell, ring_.one()}});
  }
  g_.append_rows(1);
  append(degree, in_b);
  eliminate_units({b});
  set_g(cell, Terms{{b, ring_.one()}});
}

template <sparse::Ring R>
void EagerEquivalence<R>::remove_cells(const std::vector<Removed>& removed, const Columns& chi) {
  const Element minus_one = ring_.negate(ring_.one());
  const Index first = size();
  const auto count = static_cast<Index>(removed.size());
  // The new boundaries g i(x) - d0 x, with the maps as they were.
  std::vector<Terms> boundaries;
  for (const Removed& x : removed) {
    Terms& boundary = boundaries.emplace_back(image(x.becomes, g_));
    add(boundary, minus_one, g_.column(x.cell));
    add(boundary, minus_one, shifted(x.boundary, first));
  }
  if (keeps_all()) {
    merge(h_, block(count, first, pulled_back_removal(removed)), block(count, count, {}));
    for (const Terms& boundary : boundaries) {
      append_to(d_, boundary);
    }
  }
  Columns minus_chi = chi;
  for (auto& [cell, chain] : minus_chi) {
    for (auto& term : chain) {
      term.coefficient = ring_.negate(term.coefficient);
    }
  }
  merge(g_, block(count, g_.columns(), minus_chi), block(count, 0, {}));
  for (Index k = 0; k < count; ++k) {
    append(removed[k].degree + 1, boundaries[k]);
    eliminate_units({first + k});
    if (keeps_all()) {
      f_.append_column({});
      f_.substitute(removed[k].cell, removed[k].becomes);
    }
    g_.set_column(removed[k].cell, {});
  }
}

/// -r f, by columns; chains of removed cells.
template <sparse::Ring R>
auto EagerEquivalence<R>::pulled_back_removal(const std::vector<Removed>& removed) -> Columns {
  std::map<Index, Terms> columns;
  for (Index k = 0; k < removed.size(); ++k) {
    for (const Index y : f_.columns_with(removed[k].cell)) {
      columns[y].push_back({k, ring_.negate(f_.entry(removed[k].cell, y))});
    }
  }
  return {columns.begin(), columns.end()};
}

template <sparse::Ring R>
void EagerEquivalence<R>::split_cells(const std::vector<Copy>& copies, const Columns& chi) {
  sparse::expects(keeps_all(), "cells are split with all maps at hand");
  const Element minus_one = ring_.negate(ring_.one());
  const Index first = size();
  const auto count = static_cast<Index>(copies.size());
  const auto delta = perturbation(chi);
  Columns d0;
  for (Index k = 0; k < count; ++k) {
    d0.emplace_back(k, copies[k].boundary);
  }
  merge(d_, block(count, first, delta), block(count, count, d0));
  merge(h_, block(count, first, {}), block(count, count, {}));
  g_.append_rows(count);
  std::set<Index> changed;
  for (Index k = 0; k < count; ++k) {
    const Copy& y = copies[k];
    changed.insert(size());
    append(y.degree, shifted(y.boundary, first));
    sparse::RawTerms<R> difference{{y.source, minus_one}, {y.cell, ring_.one()}};
    f_.append_column(std::move(difference).normal(ring_));
    Terms lift = g_.column(y.source);
    add(lift, ring_.one(), {{first + k, ring_.one()}});
    set_g(y.cell, lift);
  }
  perturb_right(delta, first, changed);
  eliminate_units(std::move(changed));
}

template <sparse::Ring R>
auto EagerEquivalence<R>::perturbation(const Columns& chi) -> Columns {
  std::map<Index, Terms> columns;
  for (const auto& [cell, chain] : chi) {
    for (const Index y : f_.columns_with(cell)) {
      add(columns[y], f_.entry(cell, y), chain);
    }
  }
  return {columns.begin(), columns.end()};
}

/// What the new part `delta` of the boundary of B does to the right reduction, as long as none of the copies is
/// eliminated: -delta hS is added to fS, delta gS to the boundary of S.
template <sparse::Ring R>
void EagerEquivalence<R>::perturb_right(const Columns& delta, Index first, std::set<Index>& changed) {
  for (const auto& [y, copies] : delta) {
    const Terms chain = shifted(copies, first);
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
  d_small_.append_column(image(boundary, f_small_));
  if (keeps_all()) {
    Terms lift{{b, ring_.one()}};
    add(lift, ring_.negate(ring_.one()), image(boundary, h_small_));
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
  const auto p = static_cast<std::size_t>(degree);
  if (p >= levels_.size()) {
    levels_.resize(p + 1);
  }
  return levels_[p];
}

// ---- blocks

/// A matrix of which these columns are not zero.
template <sparse::Ring R>
sparse::Matrix<R> EagerEquivalence<R>::block(Index rows, Index columns, const Columns& stored) const {
  sparse::Matrix<R> matrix(ring_, rows, columns);
  for (const auto& [column, terms] : stored) {
    matrix.set_column(column, terms);
  }
  return matrix;
}

/// [[into, 0], [below, corner]].
template <sparse::Ring R>
void EagerEquivalence<R>::merge(sparse::Matrix<R>& into, const sparse::Matrix<R>& below,
                                const sparse::Matrix<R>& corner) {
  const sparse::MergeWork work = into.merge(block(into.rows(), corner.columns(), {}), below, corner);
  touched_ += work.entries_written;
}

/// Appends a generator to a map B -> B.
template <sparse::Ring R>
void EagerEquivalence<R>::append_to(sparse::Matrix<R>& matrix, const Terms& column) const {
  matrix.append_rows(1);
  matrix.append_column(column);
}

template <sparse::Ring R>
void EagerEquivalence<R>::set_g(Index cell, const Terms& column) {
  while (g_.columns() <= cell) {
    g_.append_column({});
  }
  g_.set_column(cell, column);
}

template <sparse::Ring R>
void EagerEquivalence<R>::add(Terms& into, const Element& factor, const Terms& terms) {
  touched_ += into.size() + terms.size();
  sparse::add_multiple<R>(ring_, into, factor, terms);
}

template <sparse::Ring R>
auto EagerEquivalence<R>::shifted(const Terms& terms, Index by) const -> Terms {
  Terms result = terms;
  for (auto& term : result) {
    term.index += by;
  }
  return result;
}

#define SESAME_INSTANTIATE(R) template class EagerEquivalence<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::tools
