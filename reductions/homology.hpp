/// \file
/// Homology groups of finite complexes, with generators, their orders, and the chains that prove the orders.
#pragma once

#include <vector>

#include "reductions/chain_complex.hpp"
#include "reductions/group.hpp"

namespace sesame::reductions {

/// A cycle whose class generates a cyclic summand of a homology group.
template <Ring R>
struct Generator {
  Chain<R> cycle;
  Integer order;      ///< 0 for a free class, otherwise the t > 1 of its Z/t
  Chain<R> bounding;  ///< d(bounding) = order * cycle; zero for a free class
};

/// H_p: the group is the direct sum of the cyclic groups of its generators, torsion first, in the order of
/// `group.torsion`, then the free ones.
template <Ring R>
struct HomologyGroup {
  AbelianGroup group;
  std::vector<Generator<R>> generators;
};

/// H_0, ..., H_top. Requires: d d = 0.
/// Cost: unit pairs are eliminated first; only what is left goes through the Smith-Agoston form.
template <Ring R>
[[nodiscard]] std::vector<HomologyGroup<R>> homology(const ChainComplex<R>& complex);

/// The groups alone: no cycle is computed, no transform kept. Requires: d d = 0.
template <Ring R>
[[nodiscard]] std::vector<AbelianGroup> homology_groups(const ChainComplex<R>& complex);

}  // namespace sesame::reductions
