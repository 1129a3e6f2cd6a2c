// What an eager equivalence is asked: homology, generators, figures, and all of it as matrices.
#include <map>

#include "reductions/homology.hpp"
#include "sparse/contract.hpp"
#include "sparse/smith.hpp"
#include "tools/bench/eager_equivalence.hpp"

namespace sesame::tools {

using sparse::Index;

namespace {

/// column(x) of a matrix.
template <class Matrix>
auto column_of(const Matrix& matrix) {
  return [&matrix](Index x) { return matrix.column(x); };
}

}  // namespace

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
       reductions::homology(reductions::complex_by_columns(ring_, generators, column_of(d_small_)))) {
    for (const auto& generator : group.generators) {
      Terms cycle = generator.cycle.terms();
      for (auto& term : cycle) {
        term.index = generators.generators(static_cast<std::size_t>(generator.cycle.degree().value))[term.index];
      }
      terms += image(image(cycle, g_small_), f_).size();
    }
  }
  return terms;
}

template <sparse::Ring R>
std::uint64_t EagerEquivalence<R>::entries_held() const {
  return f_.entries() + f_small_.entries() + g_small_.entries() + h_small_.entries() + d_small_.entries() +
         d_.stored_entries() + g_.stored_entries() + h_.stored_entries();
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
                                                         const ops::CellBasis& cells) const {
  sparse::expects(keeps_all(), "an equivalence is written out when all of it is kept");
  reductions::Basis<Index> big;
  for (Index b = 0; b < size(); ++b) {
    big.add(degrees_[b], b);
  }
  reductions::Basis<Index> numbers;  // of the cells
  for (std::size_t p = 0; p < cells.generators().size(); ++p) {
    for (const ops::CellId cell : cells.generators(p)) {
      numbers.add(static_cast<int>(p), cell);
    }
  }
  const auto small = small_generators();
  const auto map = [&](int degree, const auto& source, const auto& target, const auto& matrix) {
    return reductions::map_by_columns(ring_, degree, source, target, column_of(matrix));
  };
  const auto big_complex = reductions::complex_by_columns(ring_, big, column_of(d_));
  return {{big_complex, object, map(0, big, numbers, f_), map(0, numbers, big, g_), map(1, big, big, h_)},
          {big_complex, reductions::complex_by_columns(ring_, small, column_of(d_small_)), map(0, big, small, f_small_),
           map(0, small, big, g_small_), map(1, big, big, h_small_)}};
}

#define SESAME_INSTANTIATE(R) template class EagerEquivalence<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::tools
