/// \file
/// The maps printed in S. Peltier, habilitation (2023), section 3.3.3: data that several folders test against.
///
/// The text writes maps on the right and gives f, g, h, i, j, r, s; the boundaries are in its pictures. They are what
/// the laws make of the printed maps; where these leave an orientation open, a comment says so.
#pragma once

#include "reductions/exact_sequence.hpp"
#include "tests/support/complexes.hpp"

namespace sesame::tests {

/// Figure 3.8: a ladder of two squares' outlines, v0 v1 v2 on one side and v3 v4 v5 on the other, the face f0 in the
/// first square; reduced to two edges between two vertices. H_0 = Z, H_1 = Z.
///
/// Small generators: v0, v3 as 0, 1 of degree 0, e4, e6 as 0, 1 of degree 1. The maps determine every boundary but the
/// direction of e4, here from v0 to v3 (e5 and f0 follow it).
template <Ring R>
reductions::Reduction<R> figure_3_8(const R& ring) {
  using reductions::GradedMap;
  const ChainComplex<R> big = complex_of(ring, {6, 7, 1},
                                         {{{{0, 1}, {1, -1}},   // e0
                                           {{1, 1}, {2, -1}},   // e1
                                           {{3, 1}, {4, -1}},   // e2
                                           {{4, 1}, {5, -1}},   // e3
                                           {{3, 1}, {0, -1}},   // e4
                                           {{1, 1}, {4, -1}},   // e5
                                           {{5, 1}, {2, -1}}},  // e6
                                          {{{0, -1}, {2, 1}, {4, -1}, {5, -1}}}});
  const ChainComplex<R> small = complex_of(ring, {2, 2}, {{{{1, 1}, {0, -1}}, {{1, 1}, {0, -1}}}});
  GradedMap<R> f(ring, 0, big.sizes(), small.sizes(),
                 {matrix_of(ring, 2, {{{0, 1}}, {{0, 1}}, {{0, 1}}, {{1, 1}}, {{1, 1}}, {{1, 1}}}),
                  matrix_of(ring, 2, {{}, {}, {}, {}, {{0, 1}}, {{0, -1}}, {{1, 1}}}), matrix_of(ring, 0, {{}})});
  GradedMap<R> g(ring, 0, small.sizes(), big.sizes(),
                 {matrix_of(ring, 6, {{{0, 1}}, {{3, 1}}}),
                  matrix_of(ring, 7, {{{4, 1}}, {{6, 1}, {3, 1}, {2, 1}, {1, -1}, {0, -1}}})});
  GradedMap<R> h(ring, 1, big.sizes(), big.sizes(),
                 {matrix_of(ring, 7, {{}, {{0, -1}}, {{1, -1}, {0, -1}}, {}, {{2, -1}}, {{3, -1}, {2, -1}}}),
                  matrix_of(ring, 1, {{}, {}, {}, {}, {}, {{0, -1}}, {}}), matrix_of(ring, 0, {{}})});
  return {big, small, std::move(f), std::move(g), std::move(h)};
}

/// Figure 3.10: two triangles f0 = v0 v1 v2 and f1 = v3 v4 v5, whose edges e1 = v1 v2 and e4 = v3 v4 are identified.
///
/// Generators keep the order of their names: C0 has v3, v4 and e4, C2 has v0, v1, v2, v5, then e0, e1, e2, e3, e5.
/// The other edges, which the maps leave open: e0 = v0 v1, e2 = v0 v2, e3 = v3 v5, e5 = v4 v5.
template <Ring R>
reductions::ExactSequence<R> figure_3_10(const R& ring) {
  using reductions::GradedMap;
  const ChainComplex<R> c0 = complex_of(ring, {2, 1}, {{{{0, -1}, {1, 1}}}});
  const ChainComplex<R> c1 = complex_of(ring, {6, 6, 2},
                                        {{{{0, -1}, {1, 1}},
                                          {{1, -1}, {2, 1}},
                                          {{0, -1}, {2, 1}},
                                          {{3, -1}, {5, 1}},
                                          {{3, -1}, {4, 1}},
                                          {{4, -1}, {5, 1}}},
                                         {{{0, 1}, {1, 1}, {2, -1}}, {{4, 1}, {5, 1}, {3, -1}}}});
  const ChainComplex<R> c2 =
      complex_of(ring, {4, 5, 2},
                 {{{{0, -1}, {1, 1}}, {{1, -1}, {2, 1}}, {{0, -1}, {2, 1}}, {{1, -1}, {3, 1}}, {{2, -1}, {3, 1}}},
                  {{{0, 1}, {1, 1}, {2, -1}}, {{1, 1}, {4, 1}, {3, -1}}}});
  GradedMap<R> i(ring, 0, c0.sizes(), c1.sizes(),
                 {matrix_of(ring, 6, {{{1, 1}, {3, -1}}, {{2, 1}, {4, -1}}}), matrix_of(ring, 6, {{{1, 1}, {4, -1}}})});
  GradedMap<R> j(ring, 0, c1.sizes(), c2.sizes(),
                 {matrix_of(ring, 4, {{{0, 1}}, {{1, 1}}, {{2, 1}}, {{1, 1}}, {{2, 1}}, {{3, 1}}}),
                  matrix_of(ring, 5, {{{0, 1}}, {{1, 1}}, {{2, 1}}, {{3, 1}}, {{1, 1}}, {{4, 1}}}),
                  matrix_of(ring, 2, {{{0, 1}}, {{1, 1}}})});
  GradedMap<R> r(ring, 0, c1.sizes(), c0.sizes(),
                 {matrix_of(ring, 2, {{}, {}, {}, {{0, -1}}, {{1, -1}}, {}}),
                  matrix_of(ring, 1, {{}, {}, {}, {}, {{0, -1}}, {}}), matrix_of(ring, 0, {{}, {}})});
  GradedMap<R> s(ring, 0, c2.sizes(), c1.sizes(),
                 {matrix_of(ring, 6, {{{0, 1}}, {{1, 1}}, {{2, 1}}, {{5, 1}}}),
                  matrix_of(ring, 6, {{{0, 1}}, {{1, 1}}, {{2, 1}}, {{3, 1}}, {{5, 1}}}),
                  matrix_of(ring, 2, {{{0, 1}}, {{1, 1}}})});
  return {c0, c1, c2, std::move(i), std::move(j), std::move(r), std::move(s)};
}

}  // namespace sesame::tests
