/// \file
/// Barcodes: the intervals over which homology classes live.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/towers/time.hpp"

namespace sesame::engine {

inline constexpr Time never{std::numeric_limits<double>::infinity()};

/// A class of dimension `dimension` that lives in the half-open interval [birth, death); death = never: to the end.
struct Bar {
  int dimension;
  Time birth, death;

  friend auto operator<=>(const Bar&, const Bar&) = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 errs
};

/// The bars of positive length, sorted, and the number of those that were born and died at the same time.
struct Barcode {
  std::vector<Bar> bars;
  std::uint64_t hidden = 0;
};

}  // namespace sesame::engine
