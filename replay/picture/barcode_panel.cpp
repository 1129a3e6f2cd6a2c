#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "replay/barcode/bars.hpp"
#include "replay/picture/axis.hpp"
#include "replay/picture/bar_wall.hpp"
#include "replay/picture/barcode_panels.hpp"
#include "replay/picture/svg.hpp"
#include "replay/text/text_buffer.hpp"

namespace sesame::replay {
namespace {

using engine::Bar;
using engine::Barcode;

// All in pixels.
constexpr double least_margin = 34;
constexpr double most_height = 1000;  // of the bars together
constexpr double most_pitch = 14;     // from one bar to the next
constexpr double least_pitch = 0.5;   // thinner lines cannot be seen even when the picture is enlarged
constexpr double least_group = 14;    // of the bars of a dimension, for its name
constexpr double group_gap = 8;
constexpr double least_pitch_with_arrow = 5;      // below, the line just runs on to the end of the axis
constexpr double lane_pitch = 3, wall_text = 16;  // of a wall: from one line to the next, and for what it says
constexpr std::size_t most_lanes = 8;
constexpr double short_part = 0.05;  // of the axis; longer bars are no wall
constexpr auto most_bars = static_cast<std::size_t>(most_height / least_pitch);

bool is_essential(const Bar& bar) { return bar.death == engine::never; }

class BarcodePanel {
 public:
  BarcodePanel(const Barcode& barcode, const TimeName& time, double width, Walls walls)
      : time_{time}, range_{time_range(barcode)}, width_{width} {
    Barcode others = barcode;
    if (walls == Walls::thin) {
      take_walls(others);
    }
    all_ = others.bars.size();
    bars_ = longest_bars(others, most_bars);
    pitch_ =
        std::clamp(most_height / static_cast<double>(std::max<std::size_t>(bars_.size(), 1)), least_pitch, most_pitch);
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
  void take_walls(Barcode& barcode) {
    std::vector<Bar> others;
    for (auto begin = barcode.bars.begin(); begin != barcode.bars.end();) {
      const int dimension = begin->dimension;
      const auto end = std::find_if(begin, barcode.bars.end(), [&](const Bar& b) { return b.dimension != dimension; });
      std::vector<Bar> own(begin, end);
      if (BarWall wall = take_wall(own, short_part * (range_.high - range_.low), most_lanes); wall.bars > 0) {
        walls_.emplace(dimension, std::move(wall));
      }
      others.insert(others.end(), own.begin(), own.end());
      begin = end;
    }
    barcode.bars = std::move(others);
  }

  /// Returns where the bars end.
  double draw_bars(Svg& svg) {
    double y = title_height;
    if (bars_.empty() && walls_.empty()) {
      svg.text((left_ + right_) / 2, y + 34, Anchor::middle, "faint", "no bars");
      return y + 60;
    }
    std::set<int> dimensions;
    std::for_each(bars_.begin(), bars_.end(), [&](const Bar& bar) { dimensions.insert(bar.dimension); });
    std::for_each(walls_.begin(), walls_.end(), [&](const auto& wall) { dimensions.insert(wall.first); });
    for (const int dimension : dimensions) {
      const double end = draw_wall(svg, dimension, draw_group(svg, dimension, y));
      svg.text(4, (y + end) / 2 + 4, Anchor::start, "ink", fmt::format("H{}", dimension));
      y = end + group_gap;
    }
    return y;
  }

  /// The bars of a dimension, from `y` down. Returns where they end.
  double draw_group(Svg& svg, int dimension, double y) const {
    const auto [begin, end] = std::equal_range(bars_.begin(), bars_.end(), Bar{dimension, 0, 0},
                                               [](const Bar& a, const Bar& b) { return a.dimension < b.dimension; });
    if (begin == end) {
      return y;
    }
    const auto bars = static_cast<double>(end - begin);
    const double height = std::max(least_group, pitch_ * bars);
    const double pitch = std::min(height / bars, most_pitch);
    svg.raw(fmt::format("<g class=\"{}\" fill=\"none\" stroke-width=\"{}\">\n", stroke_class(dimension),
                        px(thickness(pitch))));
    double at = y + pitch / 2;
    for (auto bar = begin; bar != end; ++bar, at += pitch) {
      draw_bar(svg, *bar, at, pitch);
    }
    svg.raw("</g>\n");
    return y + height;
  }

  /// The wall of a dimension, if there is one: bars that touch are one line,
  /// and their number is said.
  double draw_wall(Svg& svg, int dimension, double y) const {
    const auto found = walls_.find(dimension);
    if (found == walls_.end()) {
      return y;
    }
    const BarWall& wall = found->second;
    const Scale scale(range_, left_, last_);
    std::string path;
    for (const std::vector<Bar>& lane : wall.lanes) {
      y += lane_pitch;
      double begin = 0, end = -1;  // of the present line; none yet
      const auto finish = [&] { path += end < begin ? "" : fmt::format("M{} {}H{}", px(begin), px(y), px(end)); };
      for (const Bar& bar : lane) {
        const double from = scale.at(bar.birth), to = std::max(scale.at(bar.death), from + 1);
        if (end < begin || from > end + 0.5) {
          finish();
          begin = from;
        }
        end = to;
      }
      finish();
    }
    svg.raw(fmt::format("<path class=\"{}\" fill=\"none\" stroke-width=\"1.5\" d=\"{}\"/>\n", stroke_class(dimension),
                        path));
    svg.text(left_, y + wall_text - 4, Anchor::start, "faint",
             fmt::format("{} bars of length {}{}, drawn thin", with_separators(wall.bars), wall.is_even ? "" : "up to ",
                         short_number_text(wall.length)));
    return y + wall_text;
  }

  static double thickness(double pitch) { return pitch > 4 ? pitch * 0.5 : pitch > 1.5 ? pitch * 0.75 : pitch; }

  void draw_bar(Svg& svg, const Bar& bar, double y, double pitch) const {
    const Scale scale(range_, left_, last_);
    const double from = scale.at(bar.birth);
    const std::string title = fmt::format("<title>H{} {}</title>", bar.dimension, short_interval_text(bar));
    if (!is_essential(bar)) {
      const double to = std::max(scale.at(bar.death), from + 1);
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
    svg_.text((left_ + right_) / 2, y + 36, Anchor::middle, "ink", axis_name(time_, range_));
  }

  std::size_t all_ = 0;           ///< bars that belong to no wall
  std::vector<Bar> bars_;         ///< those of them that are drawn
  std::map<int, BarWall> walls_;  ///< by dimension
  const TimeName& time_;
  Range range_;
  double width_, pitch_ = 0;
  std::vector<Tick> ticks_;
  double left_ = 0, right_ = 0;  ///< the ends of the axis
  double last_ = 0;              ///< where the last finite time is
  Svg svg_;
};

}  // namespace

Panel barcode_panel(const Barcode& barcode, const TimeName& time, double width, Walls walls) {
  return BarcodePanel(barcode, time, width, walls).drawn();
}

}  // namespace sesame::replay
