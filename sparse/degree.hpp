/// \file
/// Degrees (dimensions) as a type of their own, so that a (q-1)-chain is never taken for a q-chain.
#pragma once

#include <compare>

namespace sesame::sparse {

/// The degree of a chain or of a generator; a cell's dimension.
struct Degree {
  int value = 0;
  friend auto operator<=>(const Degree&, const Degree&) = default;
};

constexpr Degree below(Degree q) { return {q.value - 1}; }
constexpr Degree above(Degree q) { return {q.value + 1}; }

}  // namespace sesame::sparse
