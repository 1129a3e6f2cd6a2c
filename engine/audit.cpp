#include "engine/audit.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "reductions/defect.hpp"
#include "reductions/homology.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {

using reductions::ChainComplex;
using reductions::map_by_columns;
using sparse::expects;
using sparse::Matrix;
using sparse::Term;

namespace {

template <Ring R, class Id>
Terms<R, Id> unit(const R& ring, Id id) {
  return {{id, ring.one()}};
}

}  // namespace

template <Ring R>
reductions::Equivalence<R> matrices_of(LiveEquivalence<R>& live) {
  const R& ring = live.big().ring();
  const Window& window = live.window();
  const Structure& structure = window.structure();
  const BigComplex<R>& big_complex = live.big();
  Rewriter<R>& rewriter = live.rewriter();

  expects(window.families() == 0, "the big complex of lazy cells is not written out");
  int raised = 0;  // by how much all degrees are, so that none is negative: see Generators
  for (GeneratorId b = 0; b < big_complex.size(); ++b) {
    raised = std::max(raised, -big_complex.degree(b));
  }
  const ops::CellBasis cells = ops::cells_at(structure, ops::now(structure));
  ops::CellBasis object;
  for (std::size_t p = 0; p < cells.generators().size(); ++p) {
    for (const CellId cell : cells.generators()[p]) {
      object.add(static_cast<int>(p) + raised, cell);
    }
  }
  reductions::Basis<GeneratorId> big;
  for (GeneratorId b = 0; b < big_complex.size(); ++b) {
    big.add(big_complex.degree(b) + raised, b);
  }
  reductions::Basis<Symbol> small;
  rewriter.for_each_small([&](Symbol x) { small.add(rewriter.degree(x) + raised, x); });
  const ChainComplex<R> c = ops::chain_complex(structure, object, ops::now(structure), ring);
  const ChainComplex<R> b =
      reductions::complex_by_columns(ring, big, [&](GeneratorId x) { return big_complex.boundary().column(x); });
  const ChainComplex<R> s =
      reductions::complex_by_columns(ring, small, [&](Symbol x) { return live.chains().boundary(unit(ring, x)); });
  const auto f = [&](GeneratorId x) { return big_complex.maps().f(unit(ring, x)); };
  const auto g = [&](CellId cell) {
    RawTerms<R, GeneratorId> out;
    big_complex.maps().add_g(cell, ring.one(), out);
    return out;
  };
  const auto h = [&](GeneratorId x) { return big_complex.maps().h(x); };
  const auto f_small = [&](GeneratorId x) { return rewriter.rewrite(unit(ring, x)); };
  const auto g_small = [&](Symbol x) { return rewriter.lift(unit(ring, x)); };
  const auto h_small = [&](GeneratorId x) { return rewriter.lift({}, rewriter.trace(unit(ring, x))); };
  return {{b, c, map_by_columns(ring, 0, big, object, f), map_by_columns(ring, 0, object, big, g),
           map_by_columns(ring, 1, big, big, h)},
          {b, s, map_by_columns(ring, 0, big, small, f_small), map_by_columns(ring, 0, small, big, g_small),
           map_by_columns(ring, 1, big, big, h_small)}};
}

namespace {

template <Ring R>
std::optional<std::string> defect_of_matrices(LiveEquivalence<R>& live) {
  if (const auto defect = reductions::first_defect(matrices_of(live))) {
    return "the equivalence: " + defect->to_string();
  }
  return std::nullopt;
}

/// The laws of F, G and K, cell by cell and generator by generator: of the equivalence as it is seen from outside.
template <Ring R>
std::optional<std::string> defect_of_maps(LiveEquivalence<R>& live, const ops::CellBasis& cells) {
  const R& ring = live.big().ring();
  const Structure& structure = live.window().structure();
  Rewriter<R>& rewriter = live.rewriter();

  const auto minus = [](CellChain a, const CellChain& b) {
    for (const CellChain::Term& term : b.terms) {
      a.terms.push_back({-term.coefficient, term.generator});
    }
    return a;
  };
  const auto is_zero = [&](const CellChain& chain) {
    RawTerms<R, CellId> sum;
    for (const auto& [coefficient, cell] : chain.terms) {
      sum.push_back({cell, from_rational(ring, coefficient)});
    }
    return std::move(sum).normal(ring).empty();
  };
  for (std::size_t p = 0; p < cells.generators().size(); ++p) {
    const int degree = static_cast<int>(p);
    for (const CellId cell : cells.generators()[p]) {
      const CellChain c{degree, {{1, cell}}};
      const CellChain dc = live.boundary(c);
      if (!live.boundary(dc).terms.empty()) {
        return "d d is not 0 on " + std::string{structure.name(cell)};
      }
      const SmallChain image = live.apply_F(c);
      if (!(p == 0 ? live.boundary(image).terms.empty() : live.apply_F(dc) == live.boundary(image))) {
        return "F does not obey d on " + std::string{structure.name(cell)};
      }
      // d K + K d + G F - 1
      CellChain sum = minus(live.boundary(live.apply_K(c)), c);
      for (const CellChain& more : {p == 0 ? CellChain{} : live.apply_K(dc), live.apply_G(image)}) {
        sum.terms.insert(sum.terms.end(), more.terms.begin(), more.terms.end());
      }
      if (!is_zero(sum)) {
        return "d K + K d is not 1 - G F on " + std::string{structure.name(cell)};
      }
    }
  }
  for (int p = 0; p < static_cast<int>(rewriter.small_counts().size()); ++p) {
    const std::size_t size = rewriter.small(p).size();
    for (SmallId k = 0; k < size; ++k) {
      const SmallChain x{p, {{1, k}}};
      if (!is_zero(minus(live.boundary(live.apply_G(x)), live.apply_G(live.boundary(x))))) {
        return "G does not obey d on generator " + std::to_string(k) + " of S_" + std::to_string(p);
      }
    }
  }
  return std::nullopt;
}

}  // namespace

template <Ring R>
std::optional<std::string> first_defect(LiveEquivalence<R>& live, ops::StepKind last_step,
                                        const ops::Moment& before_it) {
  const R& ring = live.big().ring();
  const Structure& structure = live.window().structure();
  constexpr std::uint64_t most = 1'000'000;
  const auto counts = structure.counts();
  if (const auto cells = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
      structure.lazy().families() > 0 && cells > most) {
    return "the object has " + std::to_string(cells) + " cells, most of them never written out: laws are checked on " +
           "objects of up to " + std::to_string(most) + " when there are products or large cones";
  }
  const ops::Moment present = ops::now(structure);
  for (const auto& step : ops::step_sequences(structure, last_step, before_it, present, ring)) {
    if (const auto defect = reductions::first_defect(step.sequence)) {
      return "the step's exact sequence: " + defect->to_string();
    }
  }
  const ops::CellBasis cells = ops::cells_at(structure, present);
  if (auto defect = ops::first_broken_face_law(structure, cells)) {
    return defect;
  }
  if (auto defect = live.window().families() == 0 ? defect_of_matrices(live) : defect_of_maps(live, cells)) {
    return defect;
  }
  const std::vector<reductions::AbelianGroup> groups =
      reductions::homology_groups(ops::chain_complex(structure, cells, present, ring));
  const Homology kept = live.homology(groups.size());
  for (std::size_t p = 0; p < kept.betti.size(); ++p) {
    const reductions::AbelianGroup scratch = p < groups.size() ? groups[p] : reductions::AbelianGroup{};
    const reductions::AbelianGroup found{static_cast<Index>(kept.betti[p]), kept.torsion[p]};
    if (!(scratch == found)) {
      return "H_" + std::to_string(p) + " is " + found.to_string() + " here, but " + scratch.to_string() +
             " by a Smith form from scratch";
    }
    const std::vector<Generator> basis = live.generators(static_cast<int>(p));
    if (basis.size() != scratch.rank + scratch.torsion.size()) {
      return "H_" + std::to_string(p) + " has " + std::to_string(basis.size()) + " generators for " +
             scratch.to_string();
    }
    for (std::size_t k = 0; k < basis.size(); ++k) {
      const ClassAnswer own = live.classify(basis[k].cycle);
      for (std::size_t m = 0; m < own.coefficients.size(); ++m) {
        if (!(own.coefficients[m] == Integer(m == k ? 1 : 0))) {
          return "generator " + std::to_string(k) + " of H_" + std::to_string(p) + " is not the class of itself";
        }
      }
      CellChain multiple = basis[k].cycle;
      for (CellChain::Term& term : multiple.terms) {
        term.coefficient *= basis[k].order;
      }
      if (!basis[k].order.is_zero() && !(live.boundary(basis[k].bounding) == multiple)) {
        return "generator " + std::to_string(k) + " of H_" + std::to_string(p) + ": its order times it is not bounded";
      }
    }
  }
  return std::nullopt;
}

#define SESAME_INSTANTIATE(R)                                           \
  template reductions::Equivalence<R> matrices_of(LiveEquivalence<R>&); \
  template std::optional<std::string> first_defect(LiveEquivalence<R>&, ops::StepKind, const ops::Moment&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
