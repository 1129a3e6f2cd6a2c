/// \file
/// The three pictures of a barcode as panels that a sheet or a page puts together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/towers/barcode.hpp"
#include "replay/picture/barcode_drawing.hpp"

namespace sesame::replay {

/// SVG content with its upper left corner at (0, 0).
struct Panel {
  std::string markup;
  double width, height;
};

/// What the axes of births and deaths count: "operation", "time".
using TimeName = std::string;

/// A line per bar, by dimension, then by birth; essential bars end in an arrow. With many bars the lines get thinner,
/// and when there are more than fit, as many as do are shown: see longest_bars. The panel says so.
[[nodiscard]] Panel barcode_panel(const engine::Barcode& barcode, const TimeName& time, double width, Walls walls);

/// A symbol per bar at (birth, death) over the diagonal, those of essential bars on a line of their own. Points of one
/// dimension that are too near to be told apart make one larger symbol, so the size of the picture is bounded.
[[nodiscard]] Panel diagram_panel(const engine::Barcode& barcode, const TimeName& time, double width);

/// A step function per dimension: the Betti number against time. The vertical axis is logarithmic, and says so, when
/// some curve would else be too flat to be seen. The size of the picture is bounded by its width.
[[nodiscard]] Panel betti_panel(const engine::Barcode& barcode, const TimeName& time, double width, double height);

}  // namespace sesame::replay
