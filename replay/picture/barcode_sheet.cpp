#include "replay/picture/barcode_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sesame::replay {
namespace {

// All in pixels.
constexpr double margin = 20;
constexpr double title_size = 17;
constexpr double line_height = 17;

}  // namespace

SheetHead& SheetHead::title(const std::string& text) {
  svg_.text(0, height_ + title_size, Anchor::start, "title", fitted(text, width_, title_size));
  height_ += title_size + 11;
  return *this;
}

SheetHead& SheetHead::facts(const std::vector<std::string>& pieces) {
  std::string line;
  const auto end_line = [&] {
    svg_.text(0, height_ + small_text, Anchor::start, "faint", fitted(line, width_, small_text));
    height_ += line_height;
    line.clear();
  };
  for (const std::string& piece : pieces) {
    constexpr std::string_view dot = " \u00B7 ";
    if (!line.empty() &&
        text_width(line, small_text) + text_width(dot, small_text) + text_width(piece, small_text) > width_) {
      end_line();
    }
    line.append(line.empty() ? "" : dot).append(piece);
  }
  end_line();
  height_ += 6;
  return *this;
}

SheetHead& SheetHead::legend(const std::vector<DimensionSummary>& dimensions) {
  constexpr double symbol_width = 16, gap = 18;
  double x = 0;
  for (const DimensionSummary& summary : dimensions) {
    std::string text = fmt::format("H{}: {}", summary.dimension, counted(summary.bars, "bar"));
    if (summary.essential > 0) {
      text += fmt::format(" ({} \u221E)", with_separators(summary.essential));
    }
    const double width = symbol_width + text_width(text, small_text) + gap;
    if (x > 0 && x + width - gap > width_) {
      x = 0;
      height_ += line_height;
    }
    svg_.symbol(x + 6, height_ + small_text - 4, 4.5, summary.dimension, "");
    svg_.text(x + symbol_width, height_ + small_text, Anchor::start, "ink", text);
    x += width;
  }
  height_ += dimensions.empty() ? 0 : line_height + 6;
  return *this;
}

std::string sheet(const Panel& head, const std::vector<PlacedPanel>& panels, const std::string& label,
                  const std::string& style) {
  double width = head.width, height = 0;
  const double top = margin + head.height + (head.height > 0 ? 8 : 0);
  for (const PlacedPanel& placed : panels) {
    width = std::max(width, placed.x + placed.panel.width);
    height = std::max(height, placed.y + placed.panel.height);
  }
  const std::string w = px(width + 2 * margin), h = px(top + height + margin / 2);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"sesame\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "role=\"img\" aria-label=\"{2}\">\n",
      w, h, xml_escaped(label));
  if (!style.empty()) {
    svg += "<style>\n" + style + "</style>\n";
  }
  svg += fmt::format("<rect class=\"paper\" width=\"{}\" height=\"{}\"/>\n", w, h);
  const auto add = [&svg](double x, double y, const Panel& panel) {
    svg += fmt::format("<g transform=\"translate({} {})\">\n{}</g>\n", px(x), px(y), panel.markup);
  };
  add(margin, margin, head);
  for (const PlacedPanel& placed : panels) {
    add(margin + placed.x, top + placed.y, placed.panel);
  }
  return svg + "</svg>\n";
}

}  // namespace sesame::replay
