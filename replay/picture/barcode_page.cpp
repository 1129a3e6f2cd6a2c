#include <fmt/format.h>

#include "replay/barcode/bars.hpp"
#include "replay/picture/barcode_drawing.hpp"
#include "replay/picture/barcode_sheet.hpp"
#include "replay/text/text_buffer.hpp"

namespace sesame::replay {
namespace {

using engine::Bar;
using engine::Barcode;

constexpr std::size_t bars_listed = 40;

constexpr std::string_view page_style = R"(:root{color-scheme:light dark}
body{margin:2rem auto;max-width:1000px;padding:0 1rem;font:15px/1.5 system-ui,"Segoe UI",Roboto,sans-serif;
background:#fff;color:#222}
h1{font-size:1.5rem;margin:0 0 .3rem;overflow-wrap:anywhere}h2{font-size:1.1rem;margin:2rem 0 .5rem}
.facts{color:#5f6368;overflow-wrap:anywhere}
figure{margin:1.5rem 0;overflow-x:auto}svg{display:block;max-width:100%;height:auto}
.tables{display:flex;flex-wrap:wrap;gap:0 4rem}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:.2rem .9rem .2rem 0;text-align:right;border-bottom:1px solid #e3e5e8}
th:first-child,td:first-child{text-align:left}td svg{display:inline-block;vertical-align:-1px;margin-right:.4rem}
@media (prefers-color-scheme:dark){body{background:#16181b;color:#e8e8e8}.facts{color:#a8adb3}
th,td{border-color:#33373c}
)";

/// The name of a dimension after its symbol.
std::string named(int dimension) {
  Svg symbol;
  symbol.symbol(6, 6, 4.5, dimension, "");
  return fmt::format("<svg width=\"12\" height=\"12\" aria-hidden=\"true\">{}</svg>H{}", symbol.markup(), dimension);
}

std::string row(const std::vector<std::string>& cells, std::string_view tag) {
  std::string text = "<tr>";
  for (const std::string& cell : cells) {
    text += fmt::format("<{0}>{1}</{0}>", tag, cell);
  }
  return text + "</tr>\n";
}

std::string dimension_table(const Barcode& barcode) {
  std::string text = "<table>\n" + row({"", "bars", "never end", "longest that ends"}, "th");
  for (const DimensionSummary& summary : by_dimension(barcode)) {
    const bool some_end = summary.bars > summary.essential;
    text += row({named(summary.dimension), with_separators(summary.bars), with_separators(summary.essential),
                 some_end ? short_number_text(summary.longest) : "\u2013"},
                "td");
  }
  return text + "</table>\n";
}

std::string bar_table(const std::vector<Bar>& bars) {
  std::string text = "<table>\n" + row({"", "birth", "death", "length"}, "th");
  for (const Bar& bar : bars) {
    const bool ends = bar.death != engine::never;
    text += row({named(bar.dimension), short_number_text(bar.birth), ends ? short_number_text(bar.death) : "\u221E",
                 ends ? short_number_text(bar.death - bar.birth) : "\u221E"},
                "td");
  }
  return text + "</table>\n";
}

std::string figure(const Panel& panel, const std::string& label) {
  return "<figure>\n" + sheet(SheetHead(panel.width).panel(), {{0, 0, panel}}, label, "") + "</figure>\n";
}

/// For all figures.
std::string legend(const Barcode& barcode, double width) {
  SheetHead head(width);
  head.legend(by_dimension(barcode));
  return barcode.bars.empty() ? "" : "<div>\n" + sheet(head.panel(), {}, "Legend", "") + "</div>\n";
}

}  // namespace

void write_html(std::ostream& out, const Barcode& barcode, const Provenance& provenance,
                const DrawingOptions& options) {
  const DrawnBarcode drawn_barcode = drawn(barcode, options);
  const Barcode& shown = drawn_barcode.bars;
  const std::string title = xml_escaped(title_of(provenance, options));
  std::string facts_line;
  for (const std::string& fact : facts(drawn_barcode, provenance, options)) {
    facts_line += (facts_line.empty() ? "" : " \u00B7 ") + xml_escaped(fact);
  }
  const std::vector<Bar> listed = longest_bars(shown, bars_listed);
  const bool lists_all = listed.size() == shown.bars.size();
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      << "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" << title
      << "</title>\n<style>\n"
      << svg_style(false) << page_style << svg_style(true) << "}\n</style>\n</head>\n<body>\n<h1>" << title
      << "</h1>\n<p class=\"facts\">" << facts_line << "</p>\n"
      << legend(shown, 920) << figure(barcode_panel(shown, options.time_name, 920, options.walls), "Barcode")
      << figure(diagram_panel(shown, options.time_name, 640), "Persistence diagram")
      << figure(betti_panel(drawn_barcode.counted, options.time_name, 920, 380), "Betti numbers")
      << "<div class=\"tables\">\n<div>\n<h2>Dimensions</h2>\n"
      << dimension_table(shown) << "</div>\n<div>\n<h2>"
      << (lists_all ? "All bars"
                    : fmt::format("The {} longest bars of {}, each dimension with its share", listed.size(),
                                  with_separators(shown.bars.size())))
      << "</h2>\n"
      << bar_table(listed) << "</div>\n</div>\n</body>\n</html>\n";
}

}  // namespace sesame::replay
