#include "ops/maps/incidence.hpp"

#include <algorithm>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// One step, by the name that both kinds of maps share here.
Dart step(const GMap& map, int i, Dart d) { return map.alpha(i, d); }
Dart step(const NMap& map, int i, Dart d) { return map.beta(i, d); }

template <class Map>
std::vector<Dart> free_darts_of(const Map& map, int i) {
  std::vector<Dart> free;
  for (Dart d = 0; d < map.size(); ++d) {
    if (map.is_free(i, d)) {
      free.push_back(d);
    }
  }
  return free;
}

template <class Map>
bool is_closed_at(const Map& map, int i) {
  for (Dart d = 0; d < map.size(); ++d) {
    if (map.is_free(i, d)) {
      return false;
    }
  }
  return true;
}

template <class Map>
bool is_closed_from(const Map& map, int i) {
  for (; i <= map.dimension(); ++i) {
    if (!is_closed(map, i)) {
      return false;
    }
  }
  return true;
}

template <class Map>
std::optional<std::vector<int>> steps(const Map& map, const std::vector<Dart>& darts) {
  std::vector<int> indices;
  for (std::size_t at = 1; at < darts.size(); ++at) {
    int i = 0;
    while (i <= map.dimension() && step(map, i, darts[at - 1]) != darts[at]) {
      ++i;
    }
    if (i > map.dimension()) {
      return std::nullopt;
    }
    indices.push_back(i);
  }
  return indices;
}

template <class Map>
std::vector<Dart> shortest_path(const Map& map, Dart from, Dart to) {
  std::vector<Dart> before(map.size(), no_dart);
  std::vector<Dart> met{to};
  before[to] = to;
  // Backwards, for then the path is read forwards; every step has one that undoes it.
  for (std::size_t at = 0; at < met.size() && before[from] == no_dart; ++at) {
    for (int i = 0; i <= map.dimension(); ++i) {
      if (const Dart next = step(map, i, met[at]); next != no_dart && before[next] == no_dart) {
        before[next] = met[at];
        met.push_back(next);
      }
    }
  }
  std::vector<Dart> path;
  if (before[from] != no_dart) {
    for (path.push_back(from); path.back() != to;) {
      path.push_back(before[path.back()]);
    }
  }
  return path;
}

}  // namespace

MapIncidence::MapIncidence(const GMap& map) {
  for (int i = 0; i <= map.dimension(); ++i) {
    cells_.push_back(ops::cells(map, i));
  }
  list_darts();
}

MapIncidence::MapIncidence(const NMap& map) {
  for (int i = 0; i <= map.dimension(); ++i) {
    cells_.push_back(ops::cells(map, i));
  }
  list_darts();
}

void MapIncidence::list_darts() {
  for (const Orbits& cells : cells_) {
    std::vector<std::uint32_t> begin(std::size_t{cells.count()} + 1, 0);
    for (const std::uint32_t cell : cells.of) {
      ++begin[std::size_t{cell} + 1];
    }
    for (std::size_t cell = 1; cell < begin.size(); ++cell) {
      begin[cell] += begin[cell - 1];
    }
    std::vector<Dart> darts(cells.of.size());
    std::vector<std::uint32_t> next = begin;
    for (Dart d = 0; d < darts.size(); ++d) {
      darts[next[cells.of[d]]++] = d;
    }
    darts_.push_back(std::move(darts));
    begin_.push_back(std::move(begin));
  }
}

std::vector<Dart> MapIncidence::darts(MapCell cell) const {
  sparse::expects(cell.dimension >= 0 && cell.dimension <= dimension(), "a map has cells of dimension 0 to its own");
  const auto i = static_cast<std::size_t>(cell.dimension);
  const auto all = darts_[i].begin();
  const std::size_t at = number(cell);
  return {all + begin_[i][at], all + begin_[i][at + 1]};
}

bool MapIncidence::are_incident(MapCell a, MapCell b) const {
  if (a.dimension == b.dimension) {
    return false;
  }
  const std::vector<Dart> of_a = darts(a);
  return std::ranges::any_of(of_a, [&](Dart d) { return cells(b.dimension).join(d, b.dart); });
}

std::vector<Dart> MapIncidence::incident(MapCell cell, int j) const {
  std::vector<Dart> found;
  if (j != cell.dimension) {
    for (const Dart d : darts(cell)) {
      found.push_back(cells(j).first[cells(j).of[d]]);
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool MapIncidence::are_adjacent(MapCell a, MapCell b) const {
  if (a.dimension != b.dimension || a.dimension == 0) {
    return false;
  }
  const std::vector<Dart> shared = incident(a, a.dimension - 1);
  return std::ranges::any_of(shared, [&](Dart d) { return are_incident({a.dimension - 1, d}, b); });
}

std::vector<Dart> MapIncidence::adjacent(MapCell cell) const {
  std::vector<Dart> found;
  if (cell.dimension == 0) {
    return found;
  }
  for (const Dart shared : incident(cell, cell.dimension - 1)) {
    for (const Dart other : incident({cell.dimension - 1, shared}, cell.dimension)) {
      if (!cells(cell.dimension).join(other, cell.dart)) {
        found.push_back(other);
      }
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<Dart> free_darts(const GMap& map, int i) { return free_darts_of(map, i); }
std::vector<Dart> free_darts(const NMap& map, int i) { return free_darts_of(map, i); }

bool is_closed(const GMap& map, int i) { return is_closed_at(map, i); }
bool is_closed(const NMap& map, int i) { return is_closed_at(map, i); }
bool is_closed(const GMap& map) { return is_closed_from(map, 0); }
bool is_closed(const NMap& map) { return is_closed_from(map, 1); }

std::optional<std::vector<int>> steps_of_path(const GMap& map, const std::vector<Dart>& darts) {
  return steps(map, darts);
}
std::optional<std::vector<int>> steps_of_path(const NMap& map, const std::vector<Dart>& darts) {
  return steps(map, darts);
}

std::vector<Dart> path(const GMap& map, Dart from, Dart to) { return shortest_path(map, from, to); }
std::vector<Dart> path(const NMap& map, Dart from, Dart to) { return shortest_path(map, from, to); }

}  // namespace sesame::ops
