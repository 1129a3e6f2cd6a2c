/// \file
/// Bars, chosen among many and as text.
#pragma once

#include <string>
#include <vector>

#include "engine/towers/barcode.hpp"

namespace sesame::replay {

/// The longer comes first; of equal length the one that comes first in a barcode.
[[nodiscard]] bool is_longer(const engine::Bar& x, const engine::Bar& y);

/// Which bars are listed and drawn. Betti numbers and curves are those of all of them.
struct BarSelection {
  engine::Time min_length = 0;   ///< shorter bars are left out
  bool leaves_out_open = false;  ///< bars that never end are left out

  [[nodiscard]] bool is_too_short(const engine::Bar& bar) const {
    return min_length > 0 && bar.death - bar.birth < min_length;
  }
  [[nodiscard]] bool is_left_out_as_open(const engine::Bar& bar) const {
    return leaves_out_open && bar.death == engine::never;
  }
  [[nodiscard]] bool has(const engine::Bar& bar) const { return !is_too_short(bar) && !is_left_out_as_open(bar); }
};

/// The bars of a barcode that a selection has.
[[nodiscard]] engine::Barcode selected(const engine::Barcode& barcode, const BarSelection& selection);

/// Up to `most` bars, in their order: each dimension gets an equal share at least, as far as it has bars, and half of
/// it at least goes to bars that end, as far as there are any. Within its share, and of what the others leave, the
/// longest are taken; of equal length the earlier.
[[nodiscard]] std::vector<engine::Bar> longest_bars(const engine::Barcode& barcode, std::size_t most);

/// "[2, 7)", "[2, \u221e)".
[[nodiscard]] std::string interval_text(const engine::Bar& bar);
/// The same with short numbers, for pictures.
[[nodiscard]] std::string short_interval_text(const engine::Bar& bar);

}  // namespace sesame::replay
