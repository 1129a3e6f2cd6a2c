/// \file
/// Effective short exact sequences, and the theorem that gives the third equivalence from two, in its three directions.
#pragma once

#include "reductions/equivalence.hpp"
#include "sparse/result.hpp"

namespace sesame::reductions {

/// 0 -> C0 -i-> C1 -j-> C2 -> 0, effective: i and j are chain maps; r: C1 -> C0 and s: C2 -> C1 are graded maps (not
/// chain maps in general) with r i = 1, j s = 1 and i r + s j = 1.
template <Ring R>
struct ExactSequence {
  ChainComplex<R> c0;
  ChainComplex<R> c1;
  ChainComplex<R> c2;
  GradedMap<R> i;
  GradedMap<R> j;
  GradedMap<R> r;
  GradedMap<R> s;

  /// r d1 s : C2 -> C0 of degree -1. It measures how far s is from a chain map: d1 s = s d2 + i chi.
  [[nodiscard]] GradedMap<R> chi() const;
};

/// An equivalence of C2 from those of C0 and C1 (identification, degeneracy).
///
/// Requires  the laws of the sequence; eq0 and eq1 are equivalences of its C0 and C1.
/// Ensures   big and small complex are the cones of g1 i f0 and of fS1 g1 i f0 gS0.
/// Source    J. Rubio, F. Sergeraert, Constructive homological algebra (2006); S. Peltier, habilitation (2023),
/// theorem 4.
template <Ring R>
[[nodiscard]] Equivalence<R> forward(const ExactSequence<R>& sequence, const Equivalence<R>& eq0,
                                     const Equivalence<R>& eq1);

/// An equivalence of C1 from those of C0 and C2 (de-identification, adding cells).
///
/// C1 is C0 + C2 with differential [[d0, chi], [0, d2]], up to the isomorphism (c0, c2) -> i c0 + s c2. The left
/// reduction comes from the easy perturbation lemma, the right one from the basic one, whose series stops at its second
/// term because chi only goes from the second summand to the first.
/// Requires  eq0 and eq2 are equivalences of the sequence's C0 and C2.
/// Errors    law_broken when d0 chi + chi d2 != 0: then the sequence breaks a law and there is no such equivalence.
/// Source    as above.
template <Ring R>
[[nodiscard]] Result<Equivalence<R>> backward(const ExactSequence<R>& sequence, const Equivalence<R>& eq0,
                                              const Equivalence<R>& eq2);

/// An equivalence of C0 from those of C1 and C2 (removing cells), with all degrees raised by one: that is, of the
/// complex whose degree p + 1 is that of C0's degree p, with the opposite boundary. (The big complex can have
/// generators in what would be degree -1: those of B2's vertices.)
///
/// Requires  the laws of the sequence; eq1 and eq2 are equivalences of its C1 and C2.
/// Ensures   big and small complex are the cones of g2 j f1 and of fS2 g2 j f1 gS1. With J = g2 j f1, the boundary of
///           (b1, b2) is (-d b1, J b1 + d b2), and f = (r f1, chi f2), g = (g1 i, 0), h = [[-h1, g1 s f2], [0, h2]].
/// Source    as above; checked by multiplying out.
template <Ring R>
[[nodiscard]] Equivalence<R> kernel(const ExactSequence<R>& sequence, const Equivalence<R>& eq1,
                                    const Equivalence<R>& eq2);

}  // namespace sesame::reductions
