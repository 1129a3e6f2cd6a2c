/// \file
/// What is said around the pictures of a barcode.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "replay/picture/barcode_drawing.hpp"

namespace sesame::replay {

/// The bars of one dimension that has some.
struct DimensionSummary {
  int dimension;
  std::uint64_t bars = 0;
  std::uint64_t essential = 0;
  engine::Time longest = 0;  ///< of those that end; 0 when none does
};

[[nodiscard]] std::vector<DimensionSummary> by_dimension(const engine::Barcode& barcode);

[[nodiscard]] std::string title_of(const Provenance& provenance, const DrawingOptions& options);

/// What pictures show of a barcode.
struct DrawnBarcode {
  engine::Barcode bars;                       ///< with a line and a point for each
  engine::Barcode counted;                    ///< in the Betti curves
  std::uint64_t shorter = 0, open = 0;        ///< how many are left out of `bars` for that
  std::optional<DimensionSummary> truncated;  ///< the dimension that is left out of everything
};
[[nodiscard]] DrawnBarcode drawn(const engine::Barcode& barcode, const DrawingOptions& options);

/// The provenance and the numbers of bars in pieces: "coefficients Z/2", "1,234 operations", ... What the title says
/// is not said again.
[[nodiscard]] std::vector<std::string> facts(const DrawnBarcode& drawn, const Provenance& provenance,
                                             const DrawingOptions& options);

/// "1 bar", "1,234 bars".
[[nodiscard]] std::string counted(std::uint64_t n, const std::string& thing);

}  // namespace sesame::replay
