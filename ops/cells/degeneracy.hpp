/// \file
/// Degeneracy operators as sets of collapsed directions: the arithmetic of degenerate cells and of their faces.
#pragma once

#include <cstdint>

#include "ops/cells/cell_type.hpp"
#include "ops/ids.hpp"

namespace sesame::ops {

/// A simploid of type (a_1, ..., a_n) has a_1 + ... + a_n *directions*: number j of component i lies between the
/// vertices j and j + 1 of that component; they are numbered from 0, component after component. A degenerate cell is a
/// smaller cell with some directions collapsed: bit d is set when direction d is. (A composite of the operators s^i_j
/// is a monotone surjection in each component, and that is the set of steps that do not move.) 0: not degenerate.
///
/// Source: S. Peltier's habilitation (2023), definitions 23 to 25; written this way the commutation rules of face and
/// degeneracy operators need no list of cases.
using Degeneracy = std::uint64_t;

/// `inner` collapses some of the directions that `outer` leaves: all that are collapsed in the end. Cost O(bits).
[[nodiscard]] Degeneracy compose(Degeneracy outer, Degeneracy inner);

/// The directions of `collapsed` that are left when those of `dropped` go. Cost O(bits).
[[nodiscard]] Degeneracy without(Degeneracy collapsed, Degeneracy dropped);

/// Calls visit(l, r) for every pair of sets of collapsed directions, without a common one, with which a p-simplex and a
/// q-simplex become n-simplices: n! / ((n - p)! (n - q)! (p + q - n)!) of them.
template <class Visit>
void for_each_pair_of_degeneracies(int n, int p, int q, Visit&& visit) {
  if (n < p || n < q || n > p + q) {
    return;
  }
  const auto for_each_subset = [](int of, int size, auto&& use) {
    Degeneracy set = (Degeneracy{1} << size) - 1;
    while (set < Degeneracy{1} << of) {
      use(set);
      if (set == 0) {
        return;
      }
      const Degeneracy lowest = set & (~set + 1);  // the next set of the same size
      const Degeneracy next = set + lowest;
      set = next | ((set ^ next) / lowest >> 2);
    }
  };
  for_each_subset(n, n - p, [&](Degeneracy l) {
    for_each_subset(p, n - q, [&](Degeneracy among_the_rest) { visit(l, compose(l, among_the_rest) ^ l); });
  });
}

/// Face k of a cell of some type with some directions collapsed.
struct DegenerateFace {
  static constexpr std::uint32_t itself = UINT32_MAX;
  TypeId type;           ///< of the face
  Degeneracy collapsed;  ///< the directions of that type that are collapsed for certain
  std::uint32_t
      of_cell;  ///< the face of the cell underneath that it is a degeneracy of, or `itself`: of the whole cell
};
/// Requires: k is a face of the type. Cost O(dimension).
[[nodiscard]] DegenerateFace face_of_degenerate(const TypeInfo& type, Degeneracy collapsed, std::uint32_t k);

/// The number of the face d^i_j, both as in FaceOperator; of the direction j of component i.
[[nodiscard]] std::uint32_t face_number(const CellType& type, int component, int vertex);
[[nodiscard]] int direction_number(const CellType& type, int component, int j);

}  // namespace sesame::ops
