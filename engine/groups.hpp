/// \file
/// The homology groups of the small complex S, read off the core of its boundary.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/live_torsion.hpp"
#include "engine/right/rewriter.hpp"
#include "sparse/cokernel.hpp"
#include "sparse/integer.hpp"
#include "sparse/kernel.hpp"
#include "sparse/rational.hpp"

namespace sesame::engine {

using sparse::Integer;
using sparse::Rational;

/// A generator of a group, in symbols.
template <Ring R>
struct GroupGenerator {
  Integer order;  ///< 0: free
  Terms<R, Symbol> cycle;
  Terms<R, Symbol> bounding;  ///< its boundary is order * cycle; empty for a free generator
};

/// The group of one degree p, as read off the core: its columns of degree p say what is a cycle, those of degree p +
/// 1 what is a boundary.
template <Ring R>
struct Group {
  std::vector<Symbol> free;      ///< generators of S without boundary that are in no column above
  std::vector<Symbol> bound;     ///< generators of S without boundary that are
  std::vector<Symbol> lower;     ///< generators of S with a boundary
  sparse::Kernel<R> kernel;      ///< of d on `lower`
  std::vector<Symbol> columns;   ///< the core's columns of the degree above
  sparse::Cokernel<R> quotient;  ///< of those, as written in the basis of cycles: `bound`, then that of the kernel

  [[nodiscard]] Index cycles() const { return quotient.size(); }
  /// A combination of the basis of cycles, in symbols.
  [[nodiscard]] Terms<R, Symbol> in_symbols(const R& ring, const Terms<R>& coordinates) const;
  /// The coordinates of a cycle of S that has no part on `free`. Requires: it is a cycle.
  [[nodiscard]] Terms<R> coordinates(const R& ring, const Terms<R, Symbol>& cycle) const;

  /// Calls visit(GroupGenerator) for each generator, as long as it answers true: those of finite order by increasing
  /// order, then the free ones. Each is worked out when it is its turn.
  template <class Visit>
  void for_each_generator(const R& ring, Visit visit) const {
    for (Index k = 0; k < quotient.summands(); ++k) {
      if (!visit(on_cycles(ring, k))) {
        return;
      }
    }
    for (const Symbol x : free) {
      if (!visit(GroupGenerator<R>{0, {{x, ring.one()}}, {}})) {
        return;
      }
    }
  }
  /// The class of a cycle z of S.
  struct Class {
    std::vector<Rational> coefficients;  ///< of the generators, in the order in which they are visited
    Terms<R, Symbol> bounding;           ///< z is the sum of the generators plus its boundary
  };
  [[nodiscard]] Class class_of(const R& ring, const Terms<R, Symbol>& cycle) const;

 private:
  [[nodiscard]] GroupGenerator<R> on_cycles(const R& ring, Index k) const;
  [[nodiscard]] Terms<R, Symbol> in_columns(Terms<R> terms) const;
};

/// The groups of all degrees. Those of the present state: nothing is to be kept over a step.
template <Ring R>
class Groups {
 public:
  /// `rewriter` must outlive it.
  Groups(R ring, const Rewriter<R>& rewriter) : ring_{ring}, rewriter_{rewriter}, live_{rewriter} {}

  /// What the core says of all degrees.
  struct Torsion {
    std::vector<std::vector<Integer>> coefficients;  ///< by degree: invariant factors > 1, each dividing the next
    std::vector<std::uint32_t> ranks;                ///< of dS, by degree
  };
  /// Cost: O(1) as long as the core has not changed; else what is new, see LiveTorsion; where too much is, a Smith form
  /// of the core for each degree, without transforms.
  [[nodiscard]] const Torsion& torsion();
  /// Cost: the small generators of a degree, and eliminations of the core's columns of two, see Kernel and Cokernel.
  [[nodiscard]] Group<R> of(int degree) const;

 private:
  void read_off_live();
  void compute_from_core();
  [[nodiscard]] sparse::Matrix<R> core_matrix(const std::vector<Symbol>& columns) const;

  R ring_;
  const Rewriter<R>& rewriter_;
  LiveTorsion<R> live_;
  Torsion torsion_;
  std::uint64_t version_ = 0;  ///< of the core, that torsion_ is of
  bool is_filled_ = false;
};

}  // namespace sesame::engine
