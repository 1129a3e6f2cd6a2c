/// \file
/// The torsion of the small complex S, kept up to date as the core of its boundary grows.
#pragma once

#include <cstdint>
#include <map>

#include "engine/right/rewriter.hpp"
#include "sparse/presentation.hpp"

namespace sesame::engine {

/// For each degree p in which there is a core a Presentation: the small generators of degree p that its columns have
/// met, modulo these columns. The quotient of all of S_p by them has the same torsion as H_p, since S_p modulo its
/// cycles is free.
///
/// It is enough to add what is new, in the order in which it was made. A rule that eliminates a known symbol is a
/// relation, one whose b is known makes that 0 besides; a change of basis names a combination; the moves of Settling
/// change neither the span of the columns nor, but for these names, the rows they are written in; and a symbol that is
/// eliminated before any column that is kept has met it is in none. So a step costs its rules and its new columns, and
/// a new column what it is reduced to.
template <Ring R>
class LiveTorsion {
 public:
  struct Degree {
    sparse::Presentation group;
    std::size_t eliminated = 0;  ///< generators of it that rules have taken out of S since

    /// Of the columns that are in the core.
    [[nodiscard]] std::size_t rank() { return group.generators() - eliminated - group.group().free_rank; }
  };

  /// `rewriter` must outlive it.
  explicit LiveTorsion(const Rewriter<R>& rewriter) : rewriter_{rewriter} {}

  /// Takes in what has happened since. False when all has to be computed from the core, since too much is new for
  /// columns in the order in which they came. Then it begins afresh when there is little in the core.
  bool follow();
  /// By p. Requires: `follow` has said that they are current.
  [[nodiscard]] std::map<int, Degree>& degrees() { return degrees_; }

 private:
  void begin_afresh();
  void take_in_rule(RuleId rule);
  [[nodiscard]] Degree* degree_with(Symbol x);

  const Rewriter<R>& rewriter_;
  std::map<int, Degree> degrees_;
  RuleId next_rule_{0};
  Symbol next_symbol_{0};
  std::uint64_t breaks_ = 0;
  bool is_lost_ = false;
};

}  // namespace sesame::engine
