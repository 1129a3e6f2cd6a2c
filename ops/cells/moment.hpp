/// \file
/// Moments of the history of a cell structure.
#pragma once

#include <cstdint>

#include "ops/ids.hpp"

namespace sesame::ops {

/// A moment of the history: how many cells had been created and removed (taken away ones
/// among these), incidences moved, copies and lazy families
/// made, and how many nodes been asked for.
struct Moment {
  CellId created = 0;
  LinkId links = 0;
  std::uint32_t moves = 0;
  FamilyId families = 0;
  std::uint32_t copies = 0;
  CellId asked = asked_node(0);
  /// Whether there was such a node.
  [[nodiscard]] bool knew(CellId node) const { return node < (is_asked_for(node) ? asked : created); }
  friend bool operator==(const Moment&, const Moment&) = default;
};

/// Removals and families in one order: how many of each there had been.
using Instant = std::uint64_t;
[[nodiscard]] constexpr Instant instant_of(LinkId links, FamilyId families) {
  return Instant{links} << 32U | Instant{families};
}
/// Just after a removal, before any family that followed it.
[[nodiscard]] constexpr Instant instant_after(LinkId link) { return instant_of(link + 1, 0); }

}  // namespace sesame::ops
