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
  using Clock = std::chrono::steady_clock;
  const bool is_told = step_log().should_log(spdlog::level::debug) && !core.columns().empty();
  const auto start = is_told ? Clock::now() : Clock::time_point{};
  torsion_ = {};
  version_ = core.version();
  is_filled_ = true;
  const bool is_live = live_.follow();
  is_live ? read_off_live() : compute_from_core();
  if (is_told) {
    const std::chrono::duration<double, std::micro> took = Clock::now() - start;
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
  const auto smith_of_nothing = [&] { return sparse::smith_form(Matrix<R>(ring_, 0, 0)); };
  Group<R> group{{}, {}, columns_of(degree), smith_of_nothing(), columns_of(degree + 1), smith_of_nothing()};
  group.kernel = sparse::smith_form(core_matrix(group.lower));
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
  const std::size_t cycles = group.bound.size() + group.lower.size() - group.kernel.factors.size();
  Matrix<R> boundaries(ring_, static_cast<Index>(cycles), 0);
  for (const Symbol x : group.columns) {
    boundaries.append_column(group.coordinates(ring_, *core.find(x)));
  }
  group.smith = sparse::smith_form(boundaries);
  step_log().debug("H_{} was computed with its basis: {} free classes, Smith forms of {} and {} columns", degree,
                   group.free.size(), group.lower.size(), group.columns.size());
  return group;
}

template <Ring R>
Terms<R, Symbol> Group<R>::in_symbols(const R& ring, const Terms<R>& coordinates) const {
  RawTerms<R, Symbol> out;
  const auto rank = static_cast<Index>(kernel.factors.size());
  for (const Term<R>& term : coordinates) {
    if (term.index < bound.size()) {
      out.push_back({bound[term.index], term.coefficient});
      continue;
    }
    const Index column = rank + term.index - static_cast<Index>(bound.size());
    kernel.right.for_each_in_column(column, [&](const Term<R>& part) {
      out.push_back({lower[part.index], ring.multiply(term.coefficient, part.coefficient)});
    });
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
  const auto rank = static_cast<Index>(kernel.factors.size());
  for (const Term<R>& term : kernel.right_inverse.apply(on_lower)) {
    expects(term.index >= rank, "the image of a cycle is a cycle of the small complex");
    out.push_back({static_cast<Index>(bound.size()) + term.index - rank, term.coefficient});
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

/// The k-th generator that the Smith form has.
template <Ring R>
GroupGenerator<R> Group<R>::on_cycles(const R& ring, Index k) const {
  GroupGenerator<R> generator{0, in_symbols(ring, smith.left_inverse.column(k)), {}};
  if (k < smith.factors.size()) {
    generator.order = ring.to_integer(smith.factors[k]);
    generator.bounding = in_columns(smith.right.column(k));
  }
  return generator;
}

template <Ring R>
typename Group<R>::Class Group<R>::class_of(const R& ring, const Terms<R, Symbol>& cycle) const {
  // 1. The coordinates: on the basis of the Smith form for what meets the core, on the free generators else.
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
  std::vector<typename R::Element> dense(cycles(), ring.zero());
  for (const Term<R>& term : smith.left.apply(coordinates(ring, in_core))) {
    dense[term.index] = term.coefficient;
  }
  // 2. What is left of them modulo the orders, and what bounds the rest.
  Class result;
  Terms<R> bounding;
  for (std::size_t k = 0; k < dense.size(); ++k) {
    if (k >= smith.factors.size()) {
      result.coefficients.push_back(to_rational(ring, dense[k]));
      continue;
    }
    const auto& order = smith.factors[k];
    const auto quotient = ring.quotient(dense[k], order);
    sparse::add_multiple<R>(ring, bounding, quotient, smith.right.column(static_cast<Index>(k)));
    if (!ring.is_unit(order)) {
      result.coefficients.push_back(ring.to_integer(ring.subtract(dense[k], ring.multiply(quotient, order))));
    }
  }
  result.coefficients.insert(result.coefficients.end(), on_free.begin(), on_free.end());
  result.bounding = in_columns(std::move(bounding));
  return result;
}

#define SESAME_INSTANTIATE(R) \
  template struct Group<R>;   \
  template class Groups<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
