#include "replay/picture/barcode_drawing.hpp"

#include "replay/picture/barcode_sheet.hpp"

namespace sesame::replay {
namespace {

using engine::Barcode;

constexpr double full_width = 960, half_width = 465;

void write_sheet(std::ostream& out, const DrawnBarcode& shown, const Provenance& provenance,
                 const DrawingOptions& options, const std::vector<PlacedPanel>& panels) {
  double width = 0;
  for (const PlacedPanel& placed : panels) {
    width = std::max(width, placed.x + placed.panel.width);
  }
  const std::string title = title_of(provenance, options);
  SheetHead head(width);
  head.title(title).facts(facts(shown, provenance, options)).legend(by_dimension(shown.bars));
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" << sheet(head.panel(), panels, title, svg_style(false));
}

}  // namespace

void write_svg(std::ostream& out, const Barcode& barcode, const Provenance& provenance, const DrawingOptions& options) {
  const DrawnBarcode shown = drawn(barcode, options);
  const Panel bars = barcode_panel(shown.bars, options.time_name, full_width, options.walls);
  const Panel diagram = diagram_panel(shown.bars, options.time_name, half_width);
  const Panel curves = betti_panel(shown.counted, options.time_name, half_width, diagram.height);
  const double below = bars.height + 16;
  write_sheet(out, shown, provenance, options,
              {{0, 0, bars}, {0, below, diagram}, {full_width - half_width, below, curves}});
}

void write_barcode_svg(std::ostream& out, const Barcode& barcode, const Provenance& provenance,
                       const DrawingOptions& options) {
  const DrawnBarcode shown = drawn(barcode, options);
  write_sheet(out, shown, provenance, options,
              {{0, 0, barcode_panel(shown.bars, options.time_name, full_width, options.walls)}});
}

void write_diagram_svg(std::ostream& out, const Barcode& barcode, const Provenance& provenance,
                       const DrawingOptions& options) {
  const DrawnBarcode shown = drawn(barcode, options);
  write_sheet(out, shown, provenance, options, {{0, 0, diagram_panel(shown.bars, options.time_name, 640)}});
}

void write_betti_svg(std::ostream& out, const Barcode& barcode, const Provenance& provenance,
                     const DrawingOptions& options) {
  DrawnBarcode shown = drawn(barcode, options);
  shown.bars = shown.counted;  // curves leave out none
  shown.shorter = shown.open = 0;
  write_sheet(out, shown, provenance, options,
              {{0, 0, betti_panel(shown.counted, options.time_name, full_width, 420)}});
}

}  // namespace sesame::replay
