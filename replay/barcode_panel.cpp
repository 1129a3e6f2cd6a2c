#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "replay/axis.hpp"
#include "replay/barcode_panels.hpp"
#include "replay/bars.hpp"
#include "replay/svg.hpp"

namespace sesame::replay {
namespace {

using engine::Bar;
using engine::Barcode;

// All in pixels.
constexpr double title_height = 28, axis_height = 44, least_margin = 34;
constexpr double most_height = 1000;  // of the bars together
constexpr double most_pitch = 14;     // from one bar to the next
constexpr double least_pitch = 0.5;   // thinner lines cannot be seen even when the picture is enlarged
constexpr double least_group = 14;    // of the bars of a dimension, for its name
constexpr double group_gap = 8;
constexpr double least_pitch_with_arrow = 5;  // below, the line just runs on to the end of the axis
constexpr auto most_bars = static_cast<std::size_t>(most_height / least_pitch);

bool is_essential(const Bar& bar) { return bar.death == engine::never; }

class BarcodePanel {
 public:
  BarcodePanel(const Barcode& barcode, const TimeName& time, double width)
      : all_{barcode.bars.size()},
        bars_{longest_bars(barcode, most_bars)},
        time_{time},
        range_{time_range(barcode)},
        width_{width},
        pitch_{std::clamp(most_height / static_cast<double>(std::max<std::size_t>(bars_.size(), 1)), least_pitch,
                          most_pitch)} {
    const double plain = width_ - 2 * least_margin;
    ticks_ = ticks_across(range_, plain - 60);
    const double half_label = label_width(ticks_) / 2;
    left_ = std::max(least_margin, half_label);
    right_ = width_ - 16;
    last_ = right_ - half_label - 20;  // behind it is the time that never ends
  }

  Panel drawn() && {
    svg_.text(0, 16, Anchor::start, "panel", "Barcode");
    if (bars_.size() < all_) {
      svg_.text(
          width_, 16, Anchor::end, "faint",
          fmt::format("the longest of each dimension: {} of {} bars; {} are left out", with_separators(bars_.size()),
                      with_separators(all_), with_separators(all_ - bars_.size())));
    }
    Svg bars;
    const double bottom = draw_bars(bars);
    draw_axis(bottom);
    svg_.raw(bars.markup());
    return {svg_.markup(), width_, bottom + axis_height};
  }

 private:
  /// Returns where the bars end.
  double draw_bars(Svg& svg) {
    double y = title_height;
    if (bars_.empty()) {
      svg.text((left_ + right_) / 2, y + 34, Anchor::middle, "faint", "no bars");
      return y + 60;
    }
    for (auto group = bars_.begin(); group != bars_.end();) {
      const int dimension = group->dimension;
      const auto end = std::find_if(group, bars_.end(), [&](const Bar& bar) { return bar.dimension != dimension; });
      const auto bars = static_cast<double>(end - group);
      const double height = std::max(least_group, pitch_ * bars);
      const double pitch = std::min(height / bars, most_pitch);
      svg.text(4, y + height / 2 + 4, Anchor::start, "ink", fmt::format("H{}", dimension));
      svg.raw(fmt::format("<g class=\"{}\" fill=\"none\" stroke-width=\"{}\">\n", stroke_class(dimension),
                          px(thickness(pitch))));
      for (double at = y + pitch / 2; group != end; ++group, at += pitch) {
        draw_bar(svg, *group, at, pitch);
      }
      svg.raw("</g>\n");
      y += height + group_gap;
    }
    return y;
  }

  static double thickness(double pitch) { return pitch > 4 ? pitch * 0.5 : pitch > 1.5 ? pitch * 0.75 : pitch; }

  void draw_bar(Svg& svg, const Bar& bar, double y, double pitch) const {
    const Scale scale(range_, left_, last_);
    const double from = scale(bar.birth);
    const std::string title = fmt::format("<title>H{} {}</title>", bar.dimension, interval_text(bar));
    if (!is_essential(bar)) {
      const double to = std::max(scale(bar.death), from + 1);
      svg.raw(fmt::format("<path d=\"M{} {}H{}\">{}</path>\n", px(from), px(y), px(to), title));
    } else if (pitch < least_pitch_with_arrow) {
      svg.raw(fmt::format("<path d=\"M{} {}H{}\">{}</path>\n", px(from), px(y), px(right_), title));
    } else {
      const double size = std::min(pitch * 0.45, 5.0);
      svg.raw(
          fmt::format("<g><path d=\"M{0} {1}H{2}\"/><path class=\"{3}\" stroke=\"none\" "
                      "d=\"M{4} {1}l-{5} -{6}v{7}Z\"/>{8}</g>\n",
                      px(from), px(y), px(right_ - 2 * size), fill_class(bar.dimension), px(right_), px(2 * size),
                      px(size), px(2 * size), title));
    }
  }

  void draw_axis(double y) {
    const Scale scale(range_, left_, last_);
    for (const Tick& tick : ticks_) {
      const double x = scale(tick.value);
      svg_.line(x, title_height - 4, x, y, "grid").line(x, y, x, y + 4, "axis");
      svg_.text(x, y + 17, Anchor::middle, "ink", tick.label);
    }
    svg_.line(left_, y, right_, y, "axis");
    if (std::any_of(bars_.begin(), bars_.end(), is_essential)) {
      svg_.text(right_, y + 17, Anchor::middle, "ink", "\u221E");
    }
    svg_.text((left_ + right_) / 2, y + 36, Anchor::middle, "ink", time_);
  }

  std::size_t all_;
  std::vector<Bar> bars_;
  const TimeName& time_;
  Range range_;
  double width_, pitch_;
  std::vector<Tick> ticks_;
  double left_ = 0, right_ = 0;  ///< the ends of the axis
  double last_ = 0;              ///< where the last finite time is
  Svg svg_;
};

}  // namespace

Panel barcode_panel(const Barcode& barcode, const TimeName& time, double width) {
  return BarcodePanel(barcode, time, width).drawn();
}

}  // namespace sesame::replay
