/// \file
/// Panels put together, with a legend, as one SVG element.
#pragma once

#include <string>
#include <vector>

#include "replay/picture/barcode_panels.hpp"
#include "replay/picture/barcode_summary.hpp"
#include "replay/picture/svg.hpp"

namespace sesame::replay {

/// A panel and where it is on its sheet.
struct PlacedPanel {
  double x, y;
  Panel panel;
};

/// Lines of text and symbols at the head of a sheet; the height that they take is known once they are made.
class SheetHead {
 public:
  explicit SheetHead(double width) : width_{width} {}
  SheetHead& title(const std::string& text);
  /// Pieces in as many lines as they need, with dots between them.
  SheetHead& facts(const std::vector<std::string>& pieces);
  /// Symbol, name and number of bars of each dimension.
  SheetHead& legend(const std::vector<DimensionSummary>& dimensions);

  [[nodiscard]] Panel panel() const { return {svg_.markup(), width_, height_}; }

 private:
  double width_;
  double height_ = 0;
  Svg svg_;
};

/// An <svg> element with the head, below it the panels, and a margin around. `style`: rules of its own, for a file that
/// stands alone; empty in a page that has them.
[[nodiscard]] std::string sheet(const Panel& head, const std::vector<PlacedPanel>& panels, const std::string& label,
                                const std::string& style);

}  // namespace sesame::replay
