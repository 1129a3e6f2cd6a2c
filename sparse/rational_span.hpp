/// \file
/// The span over Q of integer vectors: whether others are in it.
#pragma once

#include <optional>
#include <vector>

#include "sparse/chain.hpp"

namespace sesame::sparse {

/// The span of the columns of an integer matrix of some rank r, by a basis of the functionals that vanish on them: one
/// for each row that is not among r in which some r columns are nonsingular, modulo a prime and hence over Q. They are
/// solutions of systems of equations, J. Dixon 1982, and are checked on all columns. So answers are proved.
class RationalSpan {
 public:
  using Vector = Terms<Integers>;

  /// Nothing when there would be many functionals, or when the rank is not that modulo the prime. Cost: two
  /// eliminations of the matrix in machine words; for each functional some products of a matrix and a vector.
  static std::optional<RationalSpan> of(Index rows, const std::vector<Vector>& columns);

  /// Requires: v is on rows of the matrix. Cost: the functionals on v.
  [[nodiscard]] bool contains(const Vector& v) const;

 private:
  std::vector<std::vector<Integer>> functionals_;  ///< by rows
};

}  // namespace sesame::sparse
