#include "replay/barcode_drawing.hpp"

#include "replay/barcode_sheet.hpp"
#include "replay/bars.hpp"

namespace sesame::replay {
namespace {

using engine::Barcode;

constexpr double full_width = 960, half_width = 465;

/// `shown` are the bars that are long enough to be drawn.
void write_sheet(std::ostream& out, const Barcode& barcode, const Barcode& shown, const Provenance& provenance,
                 const DrawingOptions& options, const std::vector<PlacedPanel>& panels) {
  double width = 0;
  for (const PlacedPanel& placed : panels) {
    width = std::max(width, placed.x + placed.panel.width);
  }
  const std::string title = title_of(provenance, options);
  SheetHead head(width);
  head.title(title)
      .facts(facts(shown, barcode.bars.size() - shown.bars.size(), provenance, options))
      .legend(by_dimension(shown));
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" << sheet(head.panel(), panels, title, svg_style(false));
}

}  // namespace

void write_svg(std::ostream& out, const Barcode& barcode, const Provenance& provenance, const DrawingOptions& options) {
  const Barcode shown = without_shorter(barcode, options.min_length);
  const Panel bars = barcode_panel(shown, options.time_name, full_width, options.walls);
  const Panel diagram = diagram_panel(shown, options.time_name, half_width);
  const Panel curves = betti_panel(barcode, options.time_name, half_width, diagram.height);
  const double below = bars.height + 16;
  write_sheet(out, barcode, shown, provenance, options,
              {{0, 0, bars}, {0, below, diagram}, {full_width - half_width, below, curves}});
}

void write_barcode_svg(std::ostream& out, const Barcode& barcode, const Provenance& provenance,
                       const DrawingOptions& options) {
  const Barcode shown = without_shorter(barcode, options.min_length);
  write_sheet(out, barcode, shown, provenance, options,
              {{0, 0, barcode_panel(shown, options.time_name, full_width, options.walls)}});
}

void write_diagram_svg(std::ostream& out, const Barcode& barcode, const Provenance& provenance,
                       const DrawingOptions& options) {
  const Barcode shown = without_shorter(barcode, options.min_length);
  write_sheet(out, barcode, shown, provenance, options, {{0, 0, diagram_panel(shown, options.time_name, 640)}});
}

void write_betti_svg(std::ostream& out, const Barcode& barcode, const Provenance& provenance,
                     const DrawingOptions& options) {
  write_sheet(out, barcode, barcode, provenance, options,
              {{0, 0, betti_panel(barcode, options.time_name, full_width, 420)}});
}

}  // namespace sesame::replay
