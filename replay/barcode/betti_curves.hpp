/// \file
/// Betti numbers against time, from a barcode.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "engine/towers/barcode.hpp"

namespace sesame::replay {

/// The number of dimensions that a barcode has bars of, counted from 0: 1 + the largest; 0 without bars.
[[nodiscard]] std::size_t dimensions(const engine::Barcode& barcode);

/// Calls `visit(time, betti)` for each time at which a Betti number changes, in increasing order, with one number per
/// dimension, those that hold from this time to the next. Before the first time all are 0. A bar that ends when another
/// one of its dimension begins changes nothing.
/// Requires: bars sorted. Cost: O(bars * log bars), plus the dimensions for each time.
void for_each_betti_change(const engine::Barcode& barcode,
                           const std::function<void(engine::Time, std::span<const std::uint64_t>)>& visit);

}  // namespace sesame::replay
