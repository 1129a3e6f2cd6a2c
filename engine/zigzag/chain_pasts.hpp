/// \file
/// What chains have been: of vectors of a SpaceZigzag that are classes of chains of cells.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "ops/ids.hpp"
#include "sparse/chain.hpp"
#include "sparse/contract.hpp"
#include "sparse/ring.hpp"

namespace sesame::engine {

/// What the chain of a bar is after a map and the next ones, until the next piece or the end of the bar.
template <sparse::Ring R>
struct ChainPiece {
  std::uint64_t from;  ///< the number of the map
  sparse::Terms<R, ops::CellId> chain;
};

/// The past of a chain of cells, as CycleHistory has it of simplices: a sum of *wires* with factors. A wire is what
/// somebody's chain has gained by a map: before it the chain was what it is now, less its wires since. So a sum of
/// chains has the sum of their pasts, whatever they were; each chain begins with a wire that is all of it. Wires are
/// shared. Cost of a sum: the number of wires.
template <sparse::Ring R>
class ChainPast {
 public:
  using Element = typename R::Element;
  using Chain = sparse::Terms<R, ops::CellId>;

  /// The chain has gained `difference` by map `now`. `number`: how many wires there were before, of all chains.
  void gain(const R& ring, Chain difference, std::uint64_t now, std::uint64_t number) {
    terms_.push_back({std::make_shared<const Wire>(Wire{now, number, std::move(difference)}), ring.one()});
  }

  /// This += factor * other, as far as it is not older than the birth of this one.
  void add(const R& ring, const Element& factor, const ChainPast& other, std::uint64_t birth) {
    std::vector<Term> sum;
    auto mine = terms_.begin();
    for (const Term& term : other.terms_) {
      if (term.wire->from <= birth) {
        continue;
      }
      for (; mine != terms_.end() && mine->wire->number < term.wire->number; ++mine) {
        sum.push_back(std::move(*mine));
      }
      Term added{term.wire, ring.multiply(factor, term.factor)};
      if (mine != terms_.end() && mine->wire == term.wire) {
        added.factor = ring.add(added.factor, mine->factor);
        ++mine;
      }
      if (!ring.is_zero(added.factor)) {
        sum.push_back(std::move(added));
      }
    }
    sum.insert(sum.end(), std::move_iterator(mine), std::move_iterator(terms_.end()));
    terms_ = std::move(sum);
  }

  /// The chains from the birth on, in order: neighbours differ. `chain`: what it is now. Cost: their terms and those of
  /// the wires.
  [[nodiscard]] std::vector<ChainPiece<R>> pieces(const R& ring, Chain chain, std::uint64_t birth) const {
    std::vector<ChainPiece<R>> found;
    for (auto term = terms_.rbegin(); term != terms_.rend() && term->wire->from > birth;) {
      const std::uint64_t from = term->wire->from;
      Chain before = chain;
      for (; term != terms_.rend() && term->wire->from == from; ++term) {
        sparse::add_multiple(ring, before, ring.negate(term->factor), term->wire->chain);
      }
      if (before != chain) {
        found.push_back({from, std::exchange(chain, std::move(before))});
      }
    }
    found.push_back({birth, std::move(chain)});
    std::reverse(found.begin(), found.end());
    return found;
  }

 private:
  struct Wire {
    std::uint64_t from, number;
    Chain chain;
  };
  struct Term {
    std::shared_ptr<const Wire> wire;
    Element factor;
  };
  std::vector<Term> terms_;  ///< by the numbers of wires, so by the maps, too
};

}  // namespace sesame::engine
