#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "replay/barcode/bars.hpp"
#include "replay/picture/axis.hpp"
#include "replay/picture/barcode_panels.hpp"
#include "replay/picture/svg.hpp"

namespace sesame::replay {
namespace {

using engine::Bar;
using engine::Barcode;

// All in pixels.
constexpr double infinity_height = 34;  // from the line of essential bars to the square of the others

/// The bars that are drawn as one symbol.
struct Mark {
  int dimension;
  std::int64_t x, y;  ///< in the grid
  std::uint64_t bars;
  Bar first;
};

class DiagramPanel {
 public:
  DiagramPanel(const Barcode& barcode, const TimeName& time, double width)
      : barcode_{barcode}, time_{time}, width_{width}, range_{widened(time_range(barcode), 0.04)} {
    ticks_ = ticks_across(range_, width_ - 120);
    left_ = label_width(ticks_) + 34;
    right_ = width_ - std::max(right_margin, label_width(ticks_) / 2);
    top_ = title_height + infinity_height;
    bottom_ = top_ + (right_ - left_);
  }

  Panel drawn() && {
    svg_.text(0, 16, Anchor::start, "panel", "Persistence diagram");
    draw_axes();
    draw_points();
    if (barcode_.bars.empty()) {
      svg_.text(left_ + (right_ - left_) / 3, top_ + (bottom_ - top_) / 3, Anchor::middle, "faint", "no bars");
    }
    return {svg_.markup(), width_, bottom_ + axis_height};
  }

 private:
  [[nodiscard]] double infinity_line() const { return top_ - 18; }

  void draw_axes() {
    const Scale across(range_, left_, right_), up(range_, bottom_, top_);
    svg_.raw(
        fmt::format("<path class=\"below\" d=\"M{} {}H{}V{}Z\"/>\n", px(left_), px(bottom_), px(right_), px(top_)));
    for (const Tick& tick : ticks_) {
      const double x = across(tick.value), y = up(tick.value);
      svg_.line(x, top_, x, bottom_, "grid").line(x, bottom_, x, bottom_ + 4, "axis");
      svg_.line(left_, y, right_, y, "grid").line(left_ - 4, y, left_, y, "axis");
      svg_.text(x, bottom_ + 17, Anchor::middle, "ink", tick.label);
      svg_.text(left_ - 7, y + 4, Anchor::end, "ink", tick.label);
    }
    svg_.line(left_, bottom_, right_, bottom_, "axis").line(left_, infinity_line() - 10, left_, bottom_, "axis");
    svg_.line(left_, bottom_, right_, top_, "axis");
    svg_.line(left_, infinity_line(), right_, infinity_line(), "axis dashed");
    svg_.text(left_ - 7, infinity_line() + 4, Anchor::end, "ink", "\u221E");
    svg_.text((left_ + right_) / 2, bottom_ + 36, Anchor::middle, "ink",
              fmt::format("birth ({})", axis_name(time_, range_)));
    svg_.raw(fmt::format("<g transform=\"translate(12 {}) rotate(-90)\">\n", px((top_ + bottom_) / 2)));
    svg_.text(0, 0, Anchor::middle, "ink", fmt::format("death ({})", axis_name(time_, range_))).raw("</g>\n");
  }

  /// Bars whose points fall into one cell of a grid of `cell` pixels are one mark, in a deterministic order.
  [[nodiscard]] std::vector<Mark> marks(double cell) const {
    const Scale across(range_, left_, right_), up(range_, bottom_, top_);
    std::vector<Mark> marks;
    marks.reserve(barcode_.bars.size());
    for (const Bar& bar : barcode_.bars) {
      const double y = bar.death == engine::never ? infinity_line() : up.at(bar.death);
      marks.push_back({bar.dimension, std::llround(across.at(bar.birth) / cell), std::llround(y / cell), 1, bar});
    }
    const auto place = [](const Mark& mark) { return std::tie(mark.dimension, mark.x, mark.y); };
    std::stable_sort(marks.begin(), marks.end(), [&](const Mark& m, const Mark& n) { return place(m) < place(n); });
    std::vector<Mark> merged;
    for (const Mark& mark : marks) {
      if (!merged.empty() && place(merged.back()) == place(mark)) {
        ++merged.back().bars;
      } else {
        merged.push_back(mark);
      }
    }
    return merged;
  }

  void draw_points() {
    const double cell = barcode_.bars.size() <= 2000 ? 0.5 : barcode_.bars.size() <= 20'000 ? 2 : 3;
    std::vector<Mark> marks = this->marks(cell);
    // Large symbols first: what lies on them is seen.
    std::stable_sort(marks.begin(), marks.end(), [](const Mark& m, const Mark& n) { return m.bars > n.bars; });
    const double least = marks.size() <= 300 ? 4 : marks.size() <= 3000 ? 2.5 : 1.5;
    const bool has_titles = marks.size() <= 5000;
    const Scale across(range_, left_, right_), up(range_, bottom_, top_);
    svg_.raw("<g fill-opacity=\"0.8\">\n");
    for (const Mark& mark : marks) {
      const double radius = std::min(least * (1 + 0.25 * std::log2(static_cast<double>(mark.bars))), 3.5 * least);
      const double y = mark.first.death == engine::never ? infinity_line() : up.at(mark.first.death);
      svg_.symbol(across.at(mark.first.birth), y, radius, mark.dimension, has_titles ? title_of(mark) : "");
    }
    svg_.raw("</g>\n");
  }

  static std::string title_of(const Mark& mark) {
    const std::string interval = short_interval_text(mark.first);
    return mark.bars == 1 ? fmt::format("H{} {}", mark.dimension, interval)
                          : fmt::format("H{}, {} bars: {} and such", mark.dimension, mark.bars, interval);
  }

  const Barcode& barcode_;
  const TimeName& time_;
  double width_;
  Range range_;
  std::vector<Tick> ticks_;
  double left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;  ///< the square of the bars that end
  Svg svg_;
};

}  // namespace

Panel diagram_panel(const Barcode& barcode, const TimeName& time, double width) {
  return DiagramPanel(barcode, time, width).drawn();
}

}  // namespace sesame::replay
