// The darts of maps of which something is left.
#include <algorithm>
#include <utility>

#include "ops/cells/dart_store.hpp"

namespace sesame::ops {

/// Per map, whether it stays. A map that has been extended is another one of the same name by now.
std::vector<bool> DartStore::maps_left(const Renewed& renewed) const {
  std::vector<bool> are_left(maps_.size(), false);
  std::vector<std::uint32_t> pending;
  const auto keep = [&](std::uint32_t number) {
    if (!are_left[number]) {
      are_left[number] = true;
      pending.push_back(number);
    }
  };
  for (std::uint32_t number = 0; number < maps(); ++number) {
    const Made& map = maps_[number];
    const auto says_something = [&](int i, Dart d) {
      const bool is_there = map.has_levels() || !taken_out_with(map.dimension, map.first + d);
      return (is_there && renewed.seen(map, i, map.first + d).offset != UINT32_MAX) ||
             renewed.is_called_after(map, i, d);
    };
    bool is_left = false;
    for (std::size_t i = 0; i < map.cells->of.size() && !is_left && named(map.name) == &map; ++i) {
      for (Dart d = 0; d < map.cells->of[i].size() && !is_left; ++d) {
        is_left = says_something(static_cast<int>(i), d);
      }
    }
    if (is_left) {
      keep(number);
    }
  }
  while (!pending.empty()) {  // and what is sewn to them
    const Made& map = maps_[pending.back()];
    pending.pop_back();
    for (int i = 0; i <= map.dimension; ++i) {
      for (Dart d = map.first; d < map.first + map.count; ++d) {
        keep(number_of_map(map.dimension, alpha(map.dimension, i, d)));
      }
    }
  }
  return are_left;
}

void DartStore::begin_with(const DartStore& other, const Renewed& renewed) {
  const std::vector<bool> are_left = other.maps_left(renewed);
  std::array<std::vector<Dart>, largest_map_dimension + 1> new_number;  // of darts, by dimension
  for (std::size_t n = 0; n < new_number.size(); ++n) {
    new_number[n].assign(other.darts(static_cast<int>(n)), no_dart);
  }
  for (std::uint32_t number = 0; number < other.maps(); ++number) {
    const Made& old = other.maps_[number];
    if (!are_left[number]) {
      continue;
    }
    auto cells = std::make_shared<DartCells>();
    for (std::size_t i = 0; i < old.cells->of.size(); ++i) {
      cells->of.emplace_back();
      for (Dart d = 0; d < old.cells->of[i].size(); ++d) {
        cells->of.back().push_back(renewed.seen(old, static_cast<int>(i), old.first + d));
      }
    }
    const Dart first = old.has_levels() ? 0 : darts(old.dimension);
    for (Dart d = 0; d < old.count; ++d) {
      new_number[static_cast<std::size_t>(old.dimension)][old.first + d] = first + d;
    }
    by_name_.emplace_back(renewed.name(old.name), maps());
    maps_.push_back(
        {by_name_.back().first, old.dimension, first, old.count, 0, std::move(cells), old.is_by_simplices, old.halves});
    list_map(maps() - 1);
  }
  std::ranges::sort(by_name_);
  for (std::size_t n = 0; n < by_dimension_.size(); ++n) {
    by_dimension_[n].alpha.resize(by_dimension_[n].maps.empty() ? 0 : n + 1);
    for (std::size_t i = 0; i < by_dimension_[n].alpha.size(); ++i) {
      for (Dart d = 0; d < new_number[n].size(); ++d) {
        if (new_number[n][d] != no_dart) {
          by_dimension_[n].alpha[i].push_back(new_number[n][other.by_dimension_[n].alpha[i][d]]);
        }
      }
    }
  }
  for (const auto& [place, node] : other.sees_) {  // the simplices that are no sides, which maps have no lists of
    const auto& [n, i, dart] = place;
    if (const Dart now = new_number[n][dart]; i > n && now != no_dart) {
      const DartCells::Seen seen = renewed.seen(other.map_of(static_cast<int>(n), dart), static_cast<int>(i), dart);
      if (seen.offset != UINT32_MAX) {
        sees_.emplace(Place{n, i, now}, seen);
      }
    }
  }
  for (const auto& [place, with] : other.taken_out_) {
    if (const Dart dart = new_number[place[0]][place[1]]; dart != no_dart) {
      taken_out_.emplace(DartPlace{place[0], dart}, with);
    }
  }
}

}  // namespace sesame::ops
