#include "engine/groups.hpp"

#include <spdlog/logger.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "engine/log.hpp"
#include "sparse/contract.hpp"
#include "sparse/smith.hpp"

namespace sesame::engine {

using sparse::expects;
using sparse::Matrix;
using sparse::Term;

/// The core's columns as a matrix on the rows that occur, in the order in which they do.
template <Ring R>
Matrix<R> Groups<R>::core_matrix(const std::vector<Symbol>& columns) const {
  std::unordered_map<Symbol, Index> rows;
  Matrix<R> matrix(ring_, 0, 0);
  for (const Symbol x : columns) {
    RawTerms<R> terms;
    for (const Term<R, Symbol>& term : *rewriter_.core().find(x)) {
      const auto [row, is_new] = rows.try_emplace(term.index, static_cast<Index>(rows.size()));
      if (is_new) {
        matrix.append_rows(1);
      }
      terms.push_back({row->second, term.coefficient});
    }
    matrix.append_column(std::move(terms).normal(ring_));
  }
  return matrix;
}

template <Ring R>
const typename Groups<R>::Torsion& Groups<R>::torsion() {
  const TorsionCore<R>& core = rewriter_.core();
  if (is_filled_ && version_ == core.version()) {
    return torsion_;
  }
  using std::chrono::steady_clock;
  const bool is_told = step_log().should_log(spdlog::level::debug) && !core.columns().empty();
  const auto start = is_told ? steady_clock::now() : steady_clock::time_point{};
  torsion_ = {};
  version_ = core.version();
  is_filled_ = true;
  const bool is_live = live_.follow();
  is_live ? read_off_live() : compute_from_core();
  if (is_told) {
    const std::chrono::duration<double, std::micro> took = steady_clock::now() - start;
    step_log().debug("torsion was {} {} columns in {} degrees; took {:.1f} us",
                     is_live ? "brought up to date with" : "computed anew, by Smith forms of", core.columns().size(),
                     std::count_if(torsion_.ranks.begin(), torsion_.ranks.end(), [](auto rank) { return rank > 0; }),
                     took.count());
  }
  return torsion_;
}

template <Ring R>
void Groups<R>::read_off_live() {
  for (auto& [degree, live] : live_.degrees()) {
    const auto p = static_cast<std::size_t>(degree);
    torsion_.ranks.resize(p + 2, 0);
    torsion_.ranks[p + 1] = static_cast<std::uint32_t>(live.rank());
    torsion_.coefficients.resize(p + 1);
    torsion_.coefficients[p] = live.group.group().torsion;
  }
}

template <Ring R>
void Groups<R>::compute_from_core() {
  std::map<int, std::vector<Symbol>> by_degree;
  for (const auto& [x, column] : rewriter_.core().columns()) {
    by_degree[rewriter_.degree(x)].push_back(x);
  }
  for (const auto& [degree, columns] : by_degree) {
    const auto p = static_cast<std::size_t>(degree);
    const auto factors = sparse::invariant_factors(core_matrix(columns));
    torsion_.ranks.resize(p + 1, 0);
    torsion_.ranks[p] = static_cast<std::uint32_t>(factors.size());
    torsion_.coefficients.resize(p);
    for (const auto& factor : factors) {
      if (!ring_.is_unit(factor)) {
        torsion_.coefficients[p - 1].push_back(ring_.to_integer(factor));
      }
    }
  }
}

template <Ring R>
Group<R> Groups<R>::of(int degree) const {
  const TorsionCore<R>& core = rewriter_.core();
  const auto columns_of = [&](int p) {
    std::vector<Symbol> columns;
    for (const auto& [x, column] : core.columns()) {
      if (rewriter_.degree(x) == p) {
        columns.push_back(x);
      }
    }
    return columns;
  };
  const std::vector<Symbol> lower = columns_of(degree);
  Group<R> group{{},
                 {},
                 lower,
                 sparse::Kernel<R>(core_matrix(lower)),
                 columns_of(degree + 1),
                 sparse::Cokernel<R>(Matrix<R>(ring_, 0, 0))};
  std::set<Symbol> met;
  for (const Symbol x : group.columns) {
    for (const Term<R, Symbol>& term : *core.find(x)) {
      met.insert(term.index);
    }
  }
  for (const Symbol x : rewriter_.small(degree)) {
    if (core.find(x) == nullptr) {
      (met.contains(x) ? group.bound : group.free).push_back(x);
    }
  }
  Matrix<R> boundaries(ring_, static_cast<Index>(group.bound.size()) + group.kernel.size(), 0);
  for (const Symbol x : group.columns) {
    boundaries.append_column(group.coordinates(ring_, *core.find(x)));
  }
  group.quotient = sparse::Cokernel<R>(boundaries);
  step_log().debug("H_{} was computed with its basis: {} free classes, eliminations of {} and {} columns", degree,
                   group.free.size(), group.lower.size(), group.columns.size());
  return group;
}

template <Ring R>
Terms<R, Symbol> Group<R>::in_symbols(const R& ring, const Terms<R>& coordinates) const {
  RawTerms<R, Symbol> out;
  Terms<R> on_kernel;
  for (const Term<R>& term : coordinates) {
    if (term.index < bound.size()) {
      out.push_back({bound[term.index], term.coefficient});
    } else {
      on_kernel.push_back({term.index - static_cast<Index>(bound.size()), term.coefficient});
    }
  }
  if (!on_kernel.empty()) {
    for (Term<R>& term : kernel.combination(on_kernel)) {
      out.push_back({lower[term.index], std::move(term.coefficient)});
    }
  }
  return std::move(out).normal(ring);
}

template <Ring R>
Terms<R> Group<R>::coordinates(const R& ring, const Terms<R, Symbol>& cycle) const {
  const auto position = [](const std::vector<Symbol>& symbols, Symbol x) -> std::optional<Index> {
    const auto at = std::lower_bound(symbols.begin(), symbols.end(), x);
    return at != symbols.end() && *at == x ? std::optional{static_cast<Index>(at - symbols.begin())} : std::nullopt;
  };
  RawTerms<R> out;
  Terms<R> on_lower;
  for (const Term<R, Symbol>& term : cycle) {
    if (const auto at = position(bound, term.index)) {
      out.push_back({*at, term.coefficient});
    } else {
      const auto row = position(lower, term.index);
      expects(row.has_value(), "a cycle is made of the small generators of its degree");
      on_lower.push_back({*row, term.coefficient});
    }
  }
  for (Term<R>& term : kernel.coordinates(on_lower)) {
    out.push_back({static_cast<Index>(bound.size()) + term.index, std::move(term.coefficient)});
  }
  return std::move(out).normal(ring);
}

/// A chain of the core's columns of the degree above, in symbols.
template <Ring R>
Terms<R, Symbol> Group<R>::in_columns(Terms<R> terms) const {
  Terms<R, Symbol> out;
  out.reserve(terms.size());
  for (Term<R>& term : terms) {
    out.push_back({columns[term.index], std::move(term.coefficient)});
  }
  return out;
}

/// The generator of the k-th summand of the quotient.
template <Ring R>
GroupGenerator<R> Group<R>::on_cycles(const R& ring, Index k) const {
  auto found = quotient.generator(k);
  return {ring.to_integer(found.order), in_symbols(ring, found.vector), in_columns(std::move(found.bounding))};
}

template <Ring R>
typename Group<R>::Class Group<R>::class_of(const R& ring, const Terms<R, Symbol>& cycle) const {
  // In the quotient for what meets the core, on the free generators else.
  Terms<R, Symbol> in_core;
  std::vector<Rational> on_free(free.size());
  for (const Term<R, Symbol>& term : cycle) {
    const auto at = std::lower_bound(free.begin(), free.end(), term.index);
    if (at != free.end() && *at == term.index) {
      on_free[static_cast<std::size_t>(at - free.begin())] = to_rational(ring, term.coefficient);
    } else {
      in_core.push_back(term);
    }
  }
  auto found = quotient.class_of(coordinates(ring, in_core));
  Class result;
  for (const auto& coefficient : found.coefficients) {
    result.coefficients.push_back(to_rational(ring, coefficient));
  }
  result.coefficients.insert(result.coefficients.end(), on_free.begin(), on_free.end());
  result.bounding = in_columns(std::move(found.bounding));
  return result;
}

#define SESAME_INSTANTIATE(R) \
  template struct Group<R>;   \
  template class Groups<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
