/// \file
/// The left reduction (f, g, h): B => C of the big complex onto the object.
#pragma once

#include <cstdint>
#include <span>

#include "engine/left/basis_shifts.hpp"
#include "engine/left/deletions.hpp"
#include "engine/left/families.hpp"
#include "engine/left/generators.hpp"

namespace sesame::engine {

/// The maps between the big complex B and the object's cells C, which are never stored:
///
///   f [c] = the cell that c is now or 0, f <x> = 0, f e = y - x       (the union-find forest of the structure)
///   g c   = [c] + sum over faces k of sign_k P(c_k)                   (the identity, plus corrections)
///   g y   = e + g x as it was when y was made, plus corrections since
///   h [c] = -P(c), h <x> = 0, h e = P(x) - P(y)
///   f u   = -d z, h u = g z as if z were there still
///
/// for [c], <x>, e and u the generators of a cell, of a removal, of a copy y of x and of the deletion of a cell z. P(x)
/// is the sum of the generators <y> on the path of the forest from x to the cell that x is now, each with the sign with
/// which x had become y; f has the sign of the whole path. For a face that has moved, P runs along the path of what the
/// face was until then, and along that of what it is since. So f g = 1 and d h + h d = 1 - g f, f h = 0, h g = 0, h h =
/// 0.
///
/// A lazy cell has no generator of its own: g of it is its F, and f of a generator s of its family is G s, of one
/// attached to lazy cells z has -K z more. For these f and g are one half of a homological equivalence; see Families.
///
/// Cost: of P at most log2(cells) terms, of g that times the number of faces, of f O(1) terms per generator that is of
/// no family and attached to none.
///
/// Threads: one at a time, as queries keep what they find.
template <Ring R>
class LeftMaps {
 public:
  using Element = typename R::Element;

  /// All of them must outlive it.
  LeftMaps(R ring, const Window& window, const Generators& generators, const Deletions& deletions,
           const BasisShifts<R>& shifts, const Families<R>& families)
      : ring_{ring},
        window_{window},
        structure_{window.structure()},
        generators_{generators},
        deletions_{deletions},
        shifts_{shifts},
        families_{families} {}

  /// g of a current cell, in normal form; times a factor, added to `out`.
  [[nodiscard]] Terms<R, GeneratorId> g(CellId cell) const;
  void add_g(CellId cell, const Element& factor, RawTerms<R, GeneratorId>& out) const;
  /// f of a chain of B, as a chain of current cells, in normal form.
  [[nodiscard]] Terms<R, CellId> f(std::span<const sparse::Term<R, GeneratorId>> chain) const;
  /// How many terms `f` adds up, without writing out more than the factors of lazy families.
  [[nodiscard]] std::uint64_t terms_of_f(std::span<const sparse::Term<R, GeneratorId>> chain) const;
  /// h of a generator, in normal form. Requires: there are no lazy families.
  [[nodiscard]] Terms<R, GeneratorId> h(GeneratorId generator) const;
  /// P(x) times a factor, added to `out`; of the path up to a number of removals.
  void add_path(CellId x, LinkId links, const Element& factor, RawTerms<R, GeneratorId>& out) const;

  /// The lazy cells in g of a cell, as chains of the lazy families: for a lazy cell itself, with the factor.
  void add_lazy_part(CellId cell, const Element& factor, RawTerms<R, CellId>& out) const;
  /// K of them, in current cells: the part of K of a current cell that no lift has.
  void add_K_of_lazy_part(CellId cell, const Element& factor, RawTerms<R, CellId>& out) const;

  /// The links ever followed on the paths P(x).
  [[nodiscard]] std::uint64_t links_followed() const { return links_followed_; }

 private:
  [[nodiscard]] Element times(int coefficient, const Element& factor) const;
  /// What a generator of a cell stands for now: calls visit(node, sign) for y and, with -1, for x when it was made for
  /// a copy y of x, and likewise for each e that was added to it.
  template <class Visit>
  void for_each_node_of(GeneratorId generator, Visit visit) const;
  [[nodiscard]] std::uint64_t terms_of_f(GeneratorId generator) const;
  void add_f(GeneratorId generator, const Element& factor, RawTerms<R, CellId>& out) const;
  void add_as_now(const RawTerms<R, CellId>& nodes, RawTerms<R, CellId>& out) const;
  void add_cell(CellId node, const Element& factor, RawTerms<R, CellId>& out) const;
  void add_g_at(CellId cell, const ops::Moment& moment, const Element& factor, RawTerms<R, GeneratorId>& out) const;

  R ring_;
  const Window& window_;
  const Structure& structure_;
  const Generators& generators_;
  const Deletions& deletions_;
  const BasisShifts<R>& shifts_;
  const Families<R>& families_;
  mutable std::uint64_t links_followed_ = 0;
};

}  // namespace sesame::engine
