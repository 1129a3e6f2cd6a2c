#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "replay/barcode/betti_curves.hpp"
#include "replay/picture/axis.hpp"
#include "replay/picture/barcode_panels.hpp"
#include "replay/picture/svg.hpp"

namespace sesame::replay {
namespace {

using engine::Barcode;

// All in pixels.
constexpr double most_raised = 10;  // the last curve above where it should be

/// A step function as an SVG path, where it is not 0, that has at most a few steps per column of pixels: within one,
/// only the extremes and the last value are drawn.
class StepPath {
 public:
  /// Begins at `x` with the value 0, which is at `zero`.
  StepPath(double x, double zero) : x_{x}, zero_{zero}, y_{zero}, low_{zero}, high_{zero} {}

  /// From `x` on the value is at `y`.
  void step(double x, double y) {
    if (y == y_) {
      return;
    }
    if (x - x_ >= column_width) {
      finish_column();
      go_across(x);
      low_ = high_ = y_;
    }
    y_ = y;
    low_ = std::min(low_, y);
    high_ = std::max(high_, y);
  }

  std::string ended(double x) && {
    finish_column();
    go_across(x);
    return std::move(path_);
  }

 private:
  static constexpr double column_width = 0.5;

  void go_across(double x) {
    if (y_ == zero_) {
      is_moving_ = true;
    } else {
      path_ += "H" + px(x);
    }
    x_ = x;
  }

  void finish_column() {
    if (low_ < std::min(drawn_, y_)) {
      go_to(low_);
    }
    if (high_ > std::max(drawn_, y_)) {
      go_to(high_);
    }
    if (y_ != drawn_) {
      go_to(y_);
    }
  }

  void go_to(double y) {
    if (is_moving_) {
      path_ += "M" + px(x_) + " " + px(drawn_);
      is_moving_ = false;
    }
    path_ += "V" + px(y);
    drawn_ = y;
  }

  std::string path_;
  double x_, zero_;
  double y_;               ///< the last value in the present column
  double low_, high_;      ///< the extremes in it
  double drawn_ = y_;      ///< where the path has come to
  bool is_moving_ = true;  ///< the path goes on elsewhere
};

/// Behind the last change the numbers go on.
Range with_room(const Range& range) { return {range.low, widened(range, 0.03).high, range.is_integral, range.origin}; }

class BettiPanel {
 public:
  BettiPanel(const Barcode& barcode, const TimeName& time, double width, double height)
      : barcode_{barcode},
        time_{time},
        width_{width},
        height_{height},
        range_{with_room(time_range(barcode))},
        largest_(dimensions(barcode)) {
    for_each_betti_change(barcode, [this](engine::Time, std::span<const std::uint64_t> betti) {
      for (std::size_t p = 0; p < betti.size(); ++p) {
        largest_[p] = std::max(largest_[p], betti[p]);
      }
    });
    std::uint64_t flattest = 0;
    for (const std::uint64_t b : largest_) {
      top_betti_ = std::max(top_betti_, b);
      flattest = b > 0 && (flattest == 0 || b < flattest) ? b : flattest;
    }
    is_logarithmic_ = top_betti_ >= 100 && flattest * 25 < top_betti_;
    choose_ticks();
  }

  Panel drawn() && {
    svg_.text(0, 16, Anchor::start, "panel", "Betti numbers");
    draw_axes();
    if (barcode_.bars.empty()) {
      svg_.text((left_ + right_) / 2, (title_height + bottom_) / 2, Anchor::middle, "faint", "no bars");
    }
    draw_curves();
    return {svg_.markup(), width_, height_};
  }

 private:
  void choose_ticks() {
    bottom_ = height_ - axis_height;
    if (is_logarithmic_) {
      up_ticks_ = {{0, "0"}};
      const bool is_sparse = top_betti_ > 20'000;
      for (std::uint64_t power = 1; power <= top_betti_; power *= 10) {
        for (const std::uint64_t digit : {1U, 2U, 5U}) {
          if (digit * power <= top_betti_ && (digit == 1 || !is_sparse)) {
            up_ticks_.push_back({static_cast<double>(digit * power), with_separators(digit * power)});
          }
        }
      }
    } else {
      up_ticks_ = round_ticks({0, static_cast<double>(top_betti_), true}, 8);
    }
    left_ = label_width(up_ticks_) + 34;
    ticks_ = ticks_across(range_, width_ - left_ - 2 * right_margin);
    left_ = std::max(left_, label_width(ticks_) / 2);
    right_ = width_ - std::max(right_margin, label_width(ticks_) / 2);
  }

  [[nodiscard]] double height_of(double betti) const {
    const auto shown = [this](double b) { return is_logarithmic_ ? std::log1p(b) : b; };
    const double top = title_height + 4 + most_raised;
    return bottom_ - (bottom_ - top) * shown(betti) / shown(static_cast<double>(top_betti_));
  }

  void draw_axes() {
    const Scale across(range_, left_, right_);
    for (const Tick& tick : ticks_) {
      const double x = across(tick.value);
      svg_.line(x, title_height, x, bottom_, "grid").line(x, bottom_, x, bottom_ + 4, "axis");
      svg_.text(x, bottom_ + 17, Anchor::middle, "ink", tick.label);
    }
    for (const Tick& tick : up_ticks_) {
      const double y = height_of(tick.value);
      svg_.line(left_, y, right_, y, "grid").line(left_ - 4, y, left_, y, "axis");
      svg_.text(left_ - 7, y + 4, Anchor::end, "ink", tick.label);
    }
    svg_.line(left_, bottom_, right_, bottom_, "axis").line(left_, title_height, left_, bottom_, "axis");
    svg_.text((left_ + right_) / 2, bottom_ + 36, Anchor::middle, "ink", axis_name(time_, range_));
    svg_.raw(fmt::format("<g transform=\"translate(12 {}) rotate(-90)\">\n", px((title_height + bottom_) / 2)));
    svg_.text(0, 0, Anchor::middle, "ink", is_logarithmic_ ? "Betti number (logarithmic)" : "Betti number");
    svg_.raw("</g>\n");
  }

  void draw_curves() {
    const Scale across(range_, left_, right_);
    std::vector<StepPath> paths(largest_.size(), StepPath(left_, bottom_));
    for_each_betti_change(barcode_, [&](engine::Time time, std::span<const std::uint64_t> betti) {
      for (std::size_t p = 0; p < betti.size(); ++p) {
        paths[p].step(across.at(time), height_of(static_cast<double>(betti[p])));
      }
    });
    const auto curves = std::count_if(largest_.begin(), largest_.end(), [](std::uint64_t b) { return b > 0; });
    // Equal numbers would hide each other: each curve lies a little above the one before it.
    const double shift = std::min(2.0, std::min(most_raised, 0.6 * (bottom_ - height_of(1))) /
                                           static_cast<double>(std::max<std::ptrdiff_t>(curves, 1)));
    double raised = 0;
    for (std::size_t p = 0; p < paths.size(); ++p) {
      if (largest_[p] == 0) {
        continue;
      }
      const int dimension = static_cast<int>(p);
      svg_.raw(
          fmt::format("<path class=\"{}{}\" fill=\"none\" stroke-width=\"2\" transform=\"translate(0 {})\" "
                      "d=\"{}\"><title>H{}: at most {}</title></path>\n",
                      stroke_class(dimension), dimension >= 8 ? " dashed" : "", px(-raised),
                      std::move(paths[p]).ended(right_), dimension, with_separators(largest_[p])));
      raised += shift;
    }
  }

  const Barcode& barcode_;
  const TimeName& time_;
  double width_, height_;
  Range range_;
  std::vector<std::uint64_t> largest_;  ///< by dimension
  std::uint64_t top_betti_ = 1;
  bool is_logarithmic_ = false;
  std::vector<Tick> ticks_, up_ticks_;
  double left_ = 0, right_ = 0, bottom_ = 0;
  Svg svg_;
};

}  // namespace

Panel betti_panel(const Barcode& barcode, const TimeName& time, double width, double height) {
  return BettiPanel(barcode, time, width, height).drawn();
}

}  // namespace sesame::replay
