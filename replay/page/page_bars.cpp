#include "replay/page/page_bars.hpp"

#include <algorithm>
#include <cmath>

#include "replay/picture/axis.hpp"

namespace sesame::replay {
namespace {

using engine::Bar;
using ops::JsonText;

bool is_open(const Bar& bar) { return bar.death == engine::never; }

/// Calls visit(bars of one dimension) for each dimension.
template <class Visit>
void for_each_dimension(std::span<const Bar> bars, Visit&& visit) {
  for (std::size_t begin = 0; begin < bars.size();) {
    std::size_t end = begin;
    while (end < bars.size() && bars[end].dimension == bars[begin].dimension) {
      ++end;
    }
    visit(bars.subspan(begin, end - begin));
    begin = end;
  }
}

/// Adds a list of times, one for each bar that is wanted.
template <class Wants, class TimeOf>
void write_times(const char* name, std::span<const Bar> bars, const PageTimes& times, JsonText& out, Wants&& wants,
                 TimeOf&& time_of) {
  out.key(name);
  out.begin_list();
  double before = 0;
  for (const Bar& bar : bars) {
    if (wants(bar)) {
      const double now = time_of(bar);
      times.write_number(times.are_whole() ? now - before : now, out);
      before = now;
    }
  }
  out.end_list();
}

}  // namespace

PageTimes::PageTimes(std::span<const Bar> bars) {
  const bool has_large = std::ranges::any_of(
      bars, [](const Bar& bar) { return bar.birth.is_large() || (!is_open(bar) && bar.death.is_large()); });
  if (has_large) {
    origin_ = time_range({{bars.begin(), bars.end()}, 0}).origin;
    are_rounded_ = origin_ == 0;
  }
  constexpr double largest_exact = 9007199254740992.0;  // 2^53
  const auto is_whole = [&](engine::Time time) {
    return time.is_whole() && std::abs(number(time)) < largest_exact / 2;
  };
  are_whole_ = std::ranges::all_of(
      bars, [&](const Bar& bar) { return is_whole(bar.birth) && (is_open(bar) || is_whole(bar.death)); });
}

void PageTimes::write_number(double number, JsonText& out) const {
  if (are_whole_) {
    out.value(static_cast<std::int64_t>(number));
  } else {
    out.value(number);
  }
}

void write_page_bars(std::span<const Bar> bars, const PageTimes& times, JsonText& out) {
  out.begin_list();
  for_each_dimension(bars, [&](std::span<const Bar> same) {
    const auto ends = [](const Bar& bar) { return !is_open(bar); };
    const auto birth = [&](const Bar& bar) { return times.number(bar.birth); };
    out.begin_object();
    out.field("dim", same[0].dimension);
    write_times("births", same, times, out, ends, birth);
    out.key(times.are_whole() ? "lengths" : "deaths");
    out.begin_list();
    for (const Bar& bar : same) {
      if (ends(bar)) {
        times.write_number(times.number(bar.death) - (times.are_whole() ? times.number(bar.birth) : 0), out);
      }
    }
    out.end_list();
    write_times("open", same, times, out, is_open, birth);
    out.end_object();
  });
  out.end_list();
}

PageBarNumbers::PageBarNumbers(std::span<const Bar> bars) : bars_{bars}, asked_(bars.size()) {
  numbers_.reserve(bars.size());
  std::uint64_t first = 0;
  for_each_dimension(bars, [&](std::span<const Bar> same) {
    std::uint64_t ended = first;
    auto open =
        first + static_cast<std::uint64_t>(std::ranges::count_if(same, [](const Bar& b) { return !is_open(b); }));
    for (const Bar& bar : same) {
      numbers_.push_back(is_open(bar) ? open++ : ended++);
    }
    first += same.size();
  });
}

std::optional<std::uint64_t> PageBarNumbers::next(const Bar& bar) {
  const auto [begin, end] = std::equal_range(bars_.begin(), bars_.end(), bar);
  const auto first = static_cast<std::size_t>(begin - bars_.begin());
  if (begin == end || asked_[first] == static_cast<std::size_t>(end - begin)) {
    return std::nullopt;
  }
  return numbers_[first + asked_[first]++];
}

}  // namespace sesame::replay
