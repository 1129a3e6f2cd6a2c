#include "replay/picture/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "replay/picture/svg.hpp"
#include "replay/text/text_buffer.hpp"
#include "sparse/contract.hpp"

namespace sesame::replay {
namespace {

using engine::Time;

/// A step of `digit` times 10^exponent.
struct Step {
  int digit, exponent;
  [[nodiscard]] double size() const { return digit * std::pow(10.0, exponent); }
};

/// The least round step that is at least `size`.
Step round_step(double size, bool is_integral) {
  const int exponent = static_cast<int>(std::floor(std::log10(size)));
  if (is_integral && exponent < 0) {
    return {1, 0};
  }
  for (const Step step : {Step{1, exponent}, Step{2, exponent}, Step{5, exponent}}) {
    if (step.size() >= size * (1 - 1e-9)) {
      return step;
    }
  }
  return {1, exponent + 1};
}

/// Of a multiple of the step, with no more decimals than the step has.
std::string tick_label(double value, const Step& step, double largest) {
  if (largest >= 1e12 || step.exponent < -7) {
    const double digits = std::clamp(std::ceil(std::log10(largest / step.size())) + 1, 3.0, 17.0);
    return value == std::trunc(value) ? number_text(value) : fmt::format("{:.{}g}", value, static_cast<int>(digits));
  }
  std::string text = fmt::format("{:.{}f}", std::abs(value), std::max(0, -step.exponent));
  const std::size_t whole = std::min(text.find('.'), text.size());
  if (largest >= 10'000) {
    text = with_separators(std::stoull(text.substr(0, whole))) + text.substr(whole);
  }
  return value < 0 ? "-" + text : text;
}

/// A multiple of a power of ten, at least the distance of the two, nearest to the lower one on the side of 0, so that
/// all that is round when counted from there is round; 0 when their distance is no double.
Time round_origin(Time low, Time high) {
  constexpr double most = 1e15;
  const double distance = (high - low).nearest();
  if (distance > most) {
    return {};
  }
  std::uint64_t power = 10;
  while (static_cast<double>(power) < distance) {
    power *= 10;
  }
  const std::uint64_t whole = low.modulo_2_64();
  if (low < Time{}) {
    const auto negative = static_cast<std::int64_t>(whole);
    return negative - negative % static_cast<std::int64_t>(power);
  }
  return whole - whole % power;
}

}  // namespace

Range time_range(const engine::Barcode& barcode) {
  if (barcode.bars.empty()) {
    return {};
  }
  Time low = barcode.bars.front().birth, high = low;
  bool is_integral = true;
  const auto include = [&](Time x) {
    low = std::min(low, x);
    high = std::max(high, x);
    is_integral = is_integral && x.nearest() == std::trunc(x.nearest());
  };
  for (const engine::Bar& bar : barcode.bars) {
    include(bar.birth);
    if (bar.death != engine::never) {
      include(bar.death);
    }
  }
  const Time origin = low.is_large() || high.is_large() ? round_origin(low, high) : Time{};
  Range range{(low - origin).nearest(), (high - origin).nearest(), is_integral, origin};
  if (range.low == range.high) {
    const double at = range.low;
    const double around = at == std::trunc(at) && std::abs(at) < 1e6 ? 1 : std::abs(at) / 2;
    range.high = std::min(at + around, std::numeric_limits<double>::max());
    range.low = range.high == at ? at / 2 : at;
  }
  return range;
}

Range widened(const Range& range, double part) {
  constexpr double largest = std::numeric_limits<double>::max();
  const double more = 2 * part * (range.high / 2 - range.low / 2);
  return {std::max(range.low - more, -largest), std::min(range.high + more, largest), range.is_integral, range.origin};
}

std::string axis_name(const std::string& time_name, const Range& range) {
  return range.origin == Time{} ? time_name : fmt::format("{}, counted from {}", time_name, number_text(range.origin));
}

std::vector<Tick> round_ticks(const Range& range, std::size_t most) {
  sparse::expects(most >= 2, "an axis has two ticks at least");
  const double size = (range.high / 2 - range.low / 2) / (static_cast<double>(most) / 2);
  const Step step = round_step(std::clamp(size, 1e-300, 1e308), range.is_integral);
  // 10^exponent times the digit is not exact for negative exponents: dividing by a power is.
  const auto multiple = [&step](double k) {
    return step.exponent < 0 ? k * step.digit / std::pow(10.0, -step.exponent) : k * step.size();
  };
  constexpr double slack = 1e-9;  // of a step: the ends of the range may be multiples but for rounding
  const double first = std::ceil(range.low / step.size() - slack), last = range.high / step.size() + slack;
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  std::vector<Tick> ticks;
  for (std::size_t i = 0; i <= most && first + static_cast<double>(i) <= last; ++i) {
    const double value = multiple(first + static_cast<double>(i)) + 0.0;  // not -0
    if (ticks.empty() || value > ticks.back().value) {
      ticks.push_back({value, tick_label(value, step, largest)});
    }
  }
  return ticks;
}

std::vector<Tick> ticks_across(const Range& range, double pixels) {
  const Scale scale(range, 0, pixels);
  for (std::size_t most = 10; most > 2; --most) {
    std::vector<Tick> ticks = round_ticks(range, most);
    const double gap = ticks.size() < 2 ? pixels : scale(ticks[1].value) - scale(ticks[0].value);
    if (label_width(ticks) + 12 <= gap) {
      return ticks;
    }
  }
  return round_ticks(range, 2);
}

double label_width(const std::vector<Tick>& ticks) {
  double width = 0;
  for (const Tick& tick : ticks) {
    width = std::max(width, text_width(tick.label, small_text));
  }
  return width;
}

}  // namespace sesame::replay
