/// \file
/// Pictures of measurements as SVG: curves over logarithmic axes.
#pragma once

#include <string>
#include <vector>

#include "replay/picture/barcode_panels.hpp"
#include "tools/bench/statistics.hpp"

namespace sesame::tools {

struct Curve {
  std::string label;
  std::vector<Sighting> points;  ///< those that are not positive are left out where an axis is logarithmic
  bool has_symbols = false;      ///< a symbol at each point, else a line only
  bool is_dashed = false;
  int colour = 0;  ///< also the shape of the symbols
};

struct PlotFrame {
  std::string title, x_label, y_label;
  bool is_log_x = true;  ///< y always is
  double width = 470, height = 300;
};

/// With the classes of replay::svg_style. No curve, or none with points: only the frame.
[[nodiscard]] replay::Panel plot_panel(const PlotFrame& frame, const std::vector<Curve>& curves);
/// The same as an element <svg>.
[[nodiscard]] std::string plot(const PlotFrame& frame, const std::vector<Curve>& curves);

}  // namespace sesame::tools
