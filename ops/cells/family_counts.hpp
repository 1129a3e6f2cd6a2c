/// \file
/// How many cells lazy families have.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ops/cells/lazy_family.hpp"

namespace sesame::ops {

/// More cells than this are not counted; far below what 64 bits can say, so that sums of two are safe.
inline constexpr std::uint64_t largest_count = std::uint64_t{1} << 60;

/// The cells of a body, by dimension.
using CellCounts = std::span<const std::uint64_t>;

/// Those of a product; more than `largest_count` where that is beyond 64 bits. No dimension is above 62.
[[nodiscard]] std::vector<std::uint64_t> cells_of_product(CellCounts lefts, CellCounts rights, bool simplicial);
/// Those of a cone, without the apex, over bodies that have so many.
void add_cells_of_cone(CellCounts base, std::vector<std::uint64_t>& cone);

}  // namespace sesame::ops
