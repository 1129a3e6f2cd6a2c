/// \file
/// What the open cycles of a zigzag have been: a cycle for each bar at each moment of it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/zigzag/cycle_level.hpp"
#include "engine/zigzag/zigzag_chain.hpp"
#include "engine/zigzag/zigzag_tracker.hpp"

namespace sesame::engine {

/// The pasts of open cycles, by their levels and numbers.
///
/// A *wire* is a chain that is there from a moment on. A past is a sum of wires with factors: before an operation the
/// cycle was what it is now, less those that have come with it or since. A cycle to which another one of lower rank is
/// added gains its past: the other one was there before it, or it bounded until it was open, which is what its first
/// wire says. What becomes another one of its class gains a wire, which is the difference. What was before the birth of
/// a cycle is left out. Pasts share their wires; those that none has any more go when they are as many as the others.
///
/// Cost: of a sum of pasts, their wires. Source: T. K. Dey, T. Hou, D. Morozov, "A fast algorithm for computing zigzag
/// representatives" (2024), whose bundles are these pasts; they have the first cycle instead of the last one, too.
///
/// Threads: one at a time, for queries too.
template <sparse::Ring R>
class CycleHistory {
 public:
  using Element = typename R::Element;
  using Chain = CellChain<R>;
  using Level = CycleLevel<R>;
  using Number = typename Level::Number;
  using Used = typename Level::Used;
  /// A chain of wires: their keys say only how many there were before them.
  using Past = CellChain<R>;

  CycleHistory(R ring, std::function<bool(int)> wants) : ring_{ring}, wants_{std::move(wants)} {}

  /// Whether there are pasts of this level. Those of others must not be asked for.
  [[nodiscard]] bool keeps(std::size_t d);

  /// A cycle is open from now on, as none was before it.
  void begin(std::size_t d, Number number);
  /// The same; until now it bounded.
  void begin(std::size_t d, Number number, const Chain& cycle, Moment now);
  [[nodiscard]] Past& past(std::size_t d, Number number) { return pasts_[d][number]; }
  /// x += factor y, as far as it is not older than x.
  void add(Past& x, const Past& y, const Element& factor, Moment birth);
  /// x becomes what is added to it, with a factor, and y the old x.
  void exchange(Past& x, Past& y, const Element& factor, Moment birth);

  /// What OnlineZigzag::pass_on does to cycles, before it does so; and what dies has the past of the sum of all open
  /// cycles that the boundary has, which is returned. The boundary less all boundaries in it that come before a cycle
  /// is what its carrier is changed by. `used`: all that the boundary has from the first open one on, `rest`: their
  /// sum; `sum` is memory.
  [[nodiscard]] Chain pass_on(std::size_t d, const Level& level, std::span<const Used> used, const Chain& rest,
                              CellSum<R>& sum, Moment now);
  /// A cycle is not open any more.
  void end(std::size_t d, Number number) { pasts_[d][number] = {}; }

  /// The cycles of a bar with this past, in order: neighbours differ. `cycle`: what it is now, at its death or at the
  /// end. Cost: their terms and those of the wires.
  [[nodiscard]] std::vector<CyclePiece> pieces(const Past& past, Chain cycle, const MomentBar& bar) const;

 private:
  struct Wire {
    Moment from;
    Chain chain;
  };
  static constexpr std::size_t fewest_collected = 64;

  /// A cycle with the past `of` has become another one of its class, by this difference.
  void change(Past& of, Chain difference, Moment now);
  [[nodiscard]] const Wire& wire(const CellTerm<R>& term) const { return wires_[term.cell.age()]; }
  [[nodiscard]] ZigzagChain told(int dimension, const Chain& chain) const;
  void collect();

  R ring_;
  std::function<bool(int)> wants_;
  std::vector<bool> keeps_;  ///< of the levels that have been asked about
  std::vector<Wire> wires_;
  std::vector<std::vector<Past>> pasts_;  ///< by level and number; empty when the cycle is not open
  std::size_t most_wires_ = fewest_collected;
  mutable Chain scratch_;
};

}  // namespace sesame::engine
