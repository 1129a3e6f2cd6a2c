/// \file
/// A chain of cells for each open bar of a SpaceZigzag, and what it has been.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/zigzag/chain_pasts.hpp"
#include "engine/zigzag/space_zigzag.hpp"

namespace sesame::engine {

/// Chains whose classes are the vectors of the open bars, in their order, through all maps: so together those of all
/// bars are an interval decomposition. Cost of a map: the chains that change, and the pasts of those that others are
/// added to. Threads: one at a time, for queries too.
template <sparse::Ring R>
class OpenChains {
 public:
  using Chain = sparse::Terms<R, ops::CellId>;
  using Place = typename SpaceZigzag<R>::Place;

  explicit OpenChains(R ring) : ring_{ring} {}

  /// Follows a map, which is the one with the number `now`. begin(place) is the chain of a bar that begins, and
  /// become(place, chain) what is that of one that goes on: of its class, or sent to it, where the map is backward.
  /// on_end(birth, pieces) is told of those that end, and their chains.
  template <class Begin, class Become, class OnEnd>
  void follow(const typename SpaceZigzag<R>::Passage& passage, std::uint64_t now, const Begin& begin,
              const Become& become, const OnEnd& on_end) {
    std::vector<Open> next(passage.open.size()), ending(passage.ended.size());
    // What others are added to first, as what is not moves.
    for (const bool is_sum : {true, false}) {
      take(passage.open, is_sum, next);
      take(passage.ended, is_sum, ending);
    }
    for (std::size_t k = 0; k < ending.size(); ++k) {
      on_end(passage.ended[k].birth, pieces(ending[k], passage.ended[k].birth));
    }
    for (std::size_t k = 0; k < next.size(); ++k) {
      Open& open = next[k];
      Chain chain = passage.open[k].was == SpaceZigzag<R>::nowhere ? begin(k) : become(k, std::as_const(open.chain));
      if (chain != open.chain) {
        Chain difference = chain;
        sparse::add_multiple(ring_, difference, ring_.negate(ring_.one()), open.chain);
        open.past.gain(ring_, std::move(difference), now, wires_++);
        open.chain = std::move(chain);
      }
    }
    open_ = std::move(next);
  }

  /// Those of an open bar until now.
  [[nodiscard]] std::vector<ChainPiece<R>> pieces(std::size_t place, std::uint64_t birth) const {
    return pieces(open_[place], birth);
  }

 private:
  struct Open {
    Chain chain;
    ChainPast<R> past;
  };

  [[nodiscard]] std::vector<ChainPiece<R>> pieces(const Open& open, std::uint64_t birth) const {
    return open.past.pieces(ring_, open.chain, birth);
  }
  /// What was at those of the places to which something is added, or nothing is, with that.
  void take(const std::vector<Place>& places, bool is_sum, std::vector<Open>& taken) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Place& place = places[k];
      if (place.was == SpaceZigzag<R>::nowhere || place.added.empty() == is_sum) {
        continue;
      }
      if (!is_sum) {
        taken[k] = std::move(open_[place.was]);
        continue;
      }
      taken[k] = open_[place.was];
      for (const auto& [lower, factor] : place.added) {
        sparse::add_multiple(ring_, taken[k].chain, factor, open_[lower].chain);
        taken[k].past.add(ring_, factor, open_[lower].past, place.birth);
      }
    }
  }

  R ring_;
  std::vector<Open> open_;  ///< as the SpaceZigzag has them
  std::uint64_t wires_ = 0;
};

}  // namespace sesame::engine
