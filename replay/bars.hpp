/// \file
/// Bars, chosen by their length and as text.
#pragma once

#include <string>
#include <vector>

#include "engine/barcode.hpp"

namespace sesame::replay {

/// The longer comes first; of equal length the one that comes first in a barcode.
[[nodiscard]] bool is_longer(const engine::Bar& x, const engine::Bar& y);

/// The barcode without the bars that are shorter.
[[nodiscard]] engine::Barcode without_shorter(const engine::Barcode& barcode, engine::Time min_length);

/// Up to `most` bars, in their order: each dimension gets an equal share at least, as far as it has bars, and half of
/// it at least goes to bars that end, as far as there are any. Within its share, and of what the others leave, the
/// longest are taken; of equal length the earlier.
[[nodiscard]] std::vector<engine::Bar> longest_bars(const engine::Barcode& barcode, std::size_t most);

/// "[2, 7)", "[2, \u221e)".
[[nodiscard]] std::string interval_text(const engine::Bar& bar);
/// The same with short numbers, for pictures.
[[nodiscard]] std::string short_interval_text(const engine::Bar& bar);

}  // namespace sesame::replay
