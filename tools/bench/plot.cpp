#include "tools/bench/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "replay/picture/axis.hpp"
#include "replay/picture/svg.hpp"

namespace sesame::tools {
namespace {

using replay::Anchor;
using replay::Range;
using replay::Scale;
using replay::Svg;
using replay::Tick;

constexpr double margin_left = 70, margin_right = 16, margin_bottom = 44, title_height = 24, legend_row = 16;

/// An axis: coordinates are powers of ten when it is logarithmic.
class Axis {
 public:
  Axis(const std::vector<Curve>& curves, double Sighting::*coordinate, bool is_log)
      : coordinate_{coordinate}, is_log_{is_log} {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double low = infinity, high = -infinity;
    for (const Curve& curve : curves) {
      for (const Sighting& point : curve.points) {
        if (is_visible(point)) {
          low = std::min(low, at(point));
          high = std::max(high, at(point));
        }
      }
    }
    if (low > high) {
      low = high = 0;
    }
    range_ = is_log ? Range{std::floor(low), std::max(std::ceil(high), std::floor(low) + 1), true}
                    : Range{0, std::max(high, 1.0), true};
  }

  [[nodiscard]] bool is_visible(const Sighting& point) const { return !is_log_ || point.*coordinate_ > 0; }
  [[nodiscard]] double at(const Sighting& point) const {
    return is_log_ ? std::log10(point.*coordinate_) : point.*coordinate_;
  }
  [[nodiscard]] const Range& range() const { return range_; }
  [[nodiscard]] std::vector<Tick> ticks(double pixels) const {
    return is_log_ ? replay::round_ticks(range_, 8) : replay::ticks_across(range_, pixels);
  }
  [[nodiscard]] std::string label(const Tick& tick) const {
    if (!is_log_) {
      return tick.label;
    }
    const double value = std::pow(10, tick.value);
    return value >= 1e-3 && value < 1e4 ? fmt::format("{:g}", value) : fmt::format("1e{:.0f}", tick.value);
  }

 private:
  double Sighting::*coordinate_;
  bool is_log_;
  Range range_;
};

struct Area {
  double left, top, right, bottom;
};

void draw_frame(Svg& svg, const PlotFrame& frame, const Area& area, const Axis& x, const Axis& y) {
  const Scale across(x.range(), area.left, area.right), up(y.range(), area.bottom, area.top);
  for (const Tick& tick : x.ticks(area.right - area.left)) {
    svg.line(across(tick.value), area.top, across(tick.value), area.bottom, "grid");
    svg.text(across(tick.value), area.bottom + 15, Anchor::middle, "faint", x.label(tick));
  }
  for (const Tick& tick : y.ticks(area.bottom - area.top)) {
    svg.line(area.left, up(tick.value), area.right, up(tick.value), "grid");
    svg.text(area.left - 7, up(tick.value) + 4, Anchor::end, "faint", y.label(tick));
  }
  svg.line(area.left, area.bottom, area.right, area.bottom, "axis");
  svg.line(area.left, area.top, area.left, area.bottom, "axis");
  svg.text(0, 14, Anchor::start, "panel", replay::fitted(frame.title, frame.width, replay::panel_title));
  svg.text((area.left + area.right) / 2, area.bottom + 34, Anchor::middle, "ink", frame.x_label);
  svg.raw(fmt::format("<g transform=\"translate(12 {}) rotate(-90)\">", replay::px((area.top + area.bottom) / 2)));
  svg.text(0, 0, Anchor::middle, "ink", frame.y_label).raw("</g>\n");
}

void draw_curve(Svg& svg, const Curve& curve, const Area& area, const Axis& x, const Axis& y) {
  const Scale across(x.range(), area.left, area.right), up(y.range(), area.bottom, area.top);
  std::string path, symbols;
  for (const Sighting& point : curve.points) {
    if (!x.is_visible(point) || !y.is_visible(point)) {
      continue;
    }
    const double px = across(x.at(point)), py = up(y.at(point));
    path += fmt::format("{}{} {}", path.empty() ? 'M' : 'L', replay::px(px), replay::px(py));
    if (curve.has_symbols) {
      Svg symbol;
      symbol.symbol(px, py, 3.5, curve.colour, fmt::format("{}: {:g}, {:g}", curve.label, point.x, point.y));
      symbols += symbol.markup();
    }
  }
  if (!path.empty()) {
    svg.raw(fmt::format("<path class=\"{}{}\" fill=\"none\" stroke-width=\"{}\" stroke-linejoin=\"round\" d=\"{}\"/>\n",
                        replay::stroke_class(curve.colour), curve.is_dashed ? " dashed" : "",
                        curve.has_symbols || curve.is_dashed ? 0.8 : 1.4, path));
    svg.raw(symbols);
  }
}

void draw_legend(Svg& svg, const std::vector<Curve>& curves) {
  double y = title_height + 8;
  for (const Curve& curve : curves) {
    if (curve.label.empty()) {
      continue;
    }
    if (curve.has_symbols) {
      svg.symbol(margin_left + 9, y - 4, 3.5, curve.colour, "");
    } else {
      svg.line(margin_left, y - 4, margin_left + 18, y - 4,
               replay::stroke_class(curve.colour) + (curve.is_dashed ? " dashed" : ""));
    }
    svg.text(margin_left + 26, y, Anchor::start, "ink", curve.label);
    y += legend_row;
  }
}

}  // namespace

replay::Panel plot_panel(const PlotFrame& frame, const std::vector<Curve>& curves) {
  const auto labels = std::ranges::count_if(curves, [](const Curve& curve) { return !curve.label.empty(); });
  const double legend = static_cast<double>(labels) * legend_row;
  const Axis x(curves, &Sighting::x, frame.is_log_x), y(curves, &Sighting::y, true);
  const double height = frame.height + legend;
  const Area area{margin_left, title_height + legend + 6, frame.width - margin_right, height - margin_bottom};
  Svg svg;
  draw_frame(svg, frame, area, x, y);
  draw_legend(svg, curves);
  for (const Curve& curve : curves) {
    draw_curve(svg, curve, area, x, y);
  }
  return {svg.markup(), frame.width, height};
}

std::string plot(const PlotFrame& frame, const std::vector<Curve>& curves) {
  constexpr double rim = 4;  // glyphs reach a little over the place where their text begins, and <svg> cuts
  const replay::Panel panel = plot_panel(frame, curves);
  return fmt::format(
      "<svg class=\"sesame\" xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"-{2} 0 "
      "{0} {1}\" role=\"img\" aria-label=\"{3}\">\n{4}</svg>\n",
      replay::px(panel.width + 2 * rim), replay::px(panel.height), rim, replay::xml_escaped(frame.title), panel.markup);
}

}  // namespace sesame::tools
