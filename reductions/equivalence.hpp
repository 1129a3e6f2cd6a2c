/// \file
/// Homological equivalences: an object and a small complex, tied together by a big one that reduces to both.
#pragma once

#include "reductions/reduction.hpp"

namespace sesame::reductions {

/// C <= B => S: `left` reduces the big complex B to the object C, `right` reduces it to the small complex S.
///
/// F, G and K are what one asks of it. With them d K + K d = 1 - G F, so a cycle z of C with F z = d y bounds
/// G y + K z.
template <Ring R>
struct Equivalence {
  Reduction<R> left;
  Reduction<R> right;

  [[nodiscard]] const ChainComplex<R>& object() const { return left.small; }
  [[nodiscard]] const ChainComplex<R>& big() const { return left.big; }
  [[nodiscard]] const ChainComplex<R>& small() const { return right.small; }

  /// fS g : C -> S, the class of a chain.
  [[nodiscard]] GradedMap<R> F() const { return right.f * left.g; }
  /// f gS : S -> C, the chain that represents a small generator.
  [[nodiscard]] GradedMap<R> G() const { return left.f * right.g; }
  /// f hS g : C -> C of degree +1, the homotopy from G F to 1.
  [[nodiscard]] GradedMap<R> K() const { return left.f * right.h * left.g; }

  friend bool operator==(const Equivalence&, const Equivalence&) = default;
};

/// C <= C => C by identities.
template <Ring R>
[[nodiscard]] Equivalence<R> trivial_equivalence(const ChainComplex<R>& complex);

/// C <= C => S for a reduction C => S.
template <Ring R>
[[nodiscard]] Equivalence<R> equivalence_of(const Reduction<R>& right);

/// The same object and big complex, with the small complex reduced once more by S => S'.
template <Ring R>
[[nodiscard]] Equivalence<R> shrink(const Equivalence<R>& equivalence, const Reduction<R>& further);

}  // namespace sesame::reductions
