#include "ops/cells/dart_store.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <unordered_map>
#include <utility>

#include "ops/cells/dart_simplices.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {

/// Names and darts of many maps are mostly as far from one another: a search begins where it would end then.
const DartStore::Made* DartStore::named(std::uint32_t name) const {
  if (by_name_.empty() || name < by_name_.front().first || name > by_name_.back().first) {
    return nullptr;
  }
  const std::uint32_t least = by_name_.front().first;
  const std::uint64_t span = std::max(by_name_.back().first - least, 1U);
  const auto guess = static_cast<std::size_t>((name - least) * (by_name_.size() - 1) / span);
  if (by_name_[guess].first == name && (guess + 1 == by_name_.size() || by_name_[guess + 1].first != name)) {
    return &maps_[by_name_[guess].second];
  }
  const auto after = std::ranges::upper_bound(by_name_, std::pair{name, UINT32_MAX});
  return after != by_name_.begin() && std::prev(after)->first == name ? &maps_[std::prev(after)->second] : nullptr;
}

std::uint32_t DartStore::number_of_map(int dimension, Dart dart) const {
  const std::vector<std::uint32_t>& maps = by_dimension_[static_cast<std::size_t>(dimension)].maps;
  if (const std::size_t guess = dart / maps_[maps.front()].count; guess < maps.size()) {
    const Made& map = maps_[maps[guess]];
    if (map.first <= dart && dart - map.first < map.count) {
      return maps[guess];
    }
  }
  const auto after = std::ranges::upper_bound(maps, dart, {}, [this](std::uint32_t map) { return maps_[map].first; });
  return *std::prev(after);
}

Dart DartStore::darts(int dimension) const {
  const Dimension& of = by_dimension_[static_cast<std::size_t>(dimension)];
  return of.maps.empty() ? 0 : maps_[of.maps.back()].first + maps_[of.maps.back()].count;
}

void DartStore::add(std::uint32_t name, const GMap& map, CellId node, std::shared_ptr<const DartCells> cells,
                    bool is_by_simplices, Dart halves) {
  Dimension& of = by_dimension_[static_cast<std::size_t>(map.dimension())];
  const Dart first = darts(map.dimension());
  of.alpha.resize(static_cast<std::size_t>(map.dimension()) + 1);
  for (std::size_t i = 0; i < of.alpha.size(); ++i) {
    for (const Dart image : map.involutions()[i]) {
      of.alpha[i].push_back(first + image);
    }
  }
  note_map({name, map.dimension(), first, map.size(), node, std::move(cells), is_by_simplices, halves});
}

void DartStore::add_chain(std::uint32_t name, CellId node, std::shared_ptr<const DartCells> cells) {
  const int dimension = static_cast<int>(cells->of.size()) - 1;
  note_map({name, dimension, 0, 0, node, std::move(cells), false});
}

/// Among those of its dimension, in which the darts are numbered.
void DartStore::list_map(std::uint32_t number) {
  if (const Made& map = maps_[number]; !map.has_levels()) {
    by_dimension_[static_cast<std::size_t>(map.dimension)].maps.push_back(number);
  }
}

void DartStore::note_map(Made map) {
  by_name_.insert(std::ranges::upper_bound(by_name_, std::pair{map.name, maps()}), {map.name, maps()});
  maps_.push_back(std::move(map));
  list_map(maps() - 1);
  events_.push_back({What::made, 0, 0, 0, 0});
}

void DartStore::extend(std::span<const Extension> extensions) {
  sparse::expects(!extensions.empty(), "some maps are extended");
  const int n = maps_[extensions[0].map].dimension;
  Dimension& of = by_dimension_[static_cast<std::size_t>(n) + 1];
  of.alpha.resize(static_cast<std::size_t>(n) + 2);
  std::unordered_map<std::uint32_t, Dart> new_first;
  Dart next = darts(n + 1);
  for (const Extension& each : extensions) {
    new_first.emplace(each.map, std::exchange(next, next + maps_[each.map].count));
  }
  const auto below = static_cast<std::uint32_t>(n);
  for (auto at = sees_.lower_bound({below, 0, 0}); at != sees_.end() && at->first[0] == below; ++at) {
    const auto [dimension, index, dart] = at->first;
    const std::uint32_t owner = number_of_map(n, dart);
    if (maps_[owner].is_by_simplices && new_first.contains(owner)) {  // its simplices are those of the new map, too
      const auto now = static_cast<std::uint32_t>(seen_index(n + 1, numbers_of_seen(n, static_cast<int>(index))));
      sees_.emplace(Place{below + 1, now, new_first.at(owner) + (dart - maps_[owner].first)}, at->second);
    }
  }
  for (const auto& [number, cells] : extensions) {
    const Made old = maps_[number];
    for (Dart d = old.first; d < old.first + old.count; ++d) {
      for (int i = 0; i <= n; ++i) {
        const Dart image = alpha(n, i, d);
        const std::uint32_t owner = number_of_map(n, image);
        of.alpha[static_cast<std::size_t>(i)].push_back(new_first.at(owner) + (image - maps_[owner].first));
      }
      of.alpha.back().push_back(new_first.at(number) + (d - old.first));
    }
    for (Dart d = 0; d < old.count; ++d) {
      if (const auto with = taken_out_with(n, old.first + d)) {
        taken_out_.emplace(DartPlace{static_cast<std::uint32_t>(n) + 1, new_first.at(number) + d},
                           static_cast<std::uint32_t>(*with));
      }
    }
    note_map({old.name, n + 1, new_first.at(number), old.count, 0, cells, old.is_by_simplices, old.halves});
  }
}

void DartStore::join(const Event& event, bool are_sewn) {
  auto& alpha = by_dimension_[static_cast<std::size_t>(event.dimension)].alpha[static_cast<std::size_t>(event.index)];
  alpha[event.a] = are_sewn ? event.b : event.a;
  alpha[event.b] = are_sewn ? event.a : event.b;
}

void DartStore::sew(int dimension, int i, Dart a, Dart b) {
  sparse::expects(alpha(dimension, i, a) == a && alpha(dimension, i, b) == b, "only free darts are sewn");
  events_.push_back({What::sewn, static_cast<std::int8_t>(dimension), static_cast<std::int8_t>(i), a, b});
  join(events_.back(), true);
}

void DartStore::unsew(int dimension, int i, Dart a, Dart b) {
  sparse::expects(alpha(dimension, i, a) == b, "only darts that are sewn are unsewn");
  events_.push_back({What::unsewn, static_cast<std::int8_t>(dimension), static_cast<std::int8_t>(i), a, b});
  join(events_.back(), false);
}

DartCells::Seen DartStore::seen(const Made& map, int i, Dart dart) const {
  if (!sees_.empty() && !map.has_levels()) {
    const auto at = sees_.find({static_cast<std::uint32_t>(map.dimension), static_cast<std::uint32_t>(i), dart});
    if (at != sees_.end()) {
      return at->second;
    }
  }
  if (map.is_by_simplices && i > map.dimension) {
    return {UINT32_MAX, 0};
  }
  const auto [offset, of_type] = map.cells->of[static_cast<std::size_t>(i)][dart - map.first];
  return {offset == UINT32_MAX ? offset : std::uint32_t{map.node + offset}, of_type};
}

void DartStore::see(int dimension, int i, Dart dart, const DartCells::Seen& node) {
  const Place place{static_cast<std::uint32_t>(dimension), static_cast<std::uint32_t>(i), dart};
  const auto [at, is_new] = sees_.try_emplace(place, node);
  saw_.push_back(is_new ? std::nullopt : std::optional{std::exchange(at->second, node)});
  events_.push_back({What::seen, static_cast<std::int8_t>(dimension), 0, dart, static_cast<Dart>(i)});
}

std::optional<int> DartStore::taken_out_with(int dimension, Dart dart) const {
  if (taken_out_.empty()) {
    return std::nullopt;
  }
  const auto at = taken_out_.find({static_cast<std::uint32_t>(dimension), dart});
  return at == taken_out_.end() ? std::nullopt : std::optional{static_cast<int>(at->second)};
}

void DartStore::take_out(int dimension, int i, Dart dart) {
  const DartPlace place{static_cast<std::uint32_t>(dimension), dart};
  const bool is_new = taken_out_.emplace(place, static_cast<std::uint32_t>(i)).second;
  sparse::expects(is_new, "a dart is taken out of a map once");
  events_.push_back({What::taken_out, static_cast<std::int8_t>(dimension), static_cast<std::int8_t>(i), dart, 0});
}

void DartStore::undo_last_event() {
  const Event last = events_.back();
  events_.pop_back();
  if (last.what == What::sewn || last.what == What::unsewn) {
    join(last, last.what == What::unsewn);
    return;
  }
  if (last.what == What::seen) {
    const Place place{static_cast<std::uint32_t>(last.dimension), last.b, last.a};
    if (saw_.back()) {
      sees_[place] = *saw_.back();
    } else {
      sees_.erase(place);
    }
    saw_.pop_back();
    return;
  }
  if (last.what == What::taken_out) {
    taken_out_.erase({static_cast<std::uint32_t>(last.dimension), last.a});
    return;
  }
  const Made& map = maps_.back();
  if (!map.has_levels()) {
    const auto dimension = static_cast<std::uint32_t>(map.dimension);
    taken_out_.erase(taken_out_.lower_bound({dimension, map.first}), taken_out_.lower_bound({dimension + 1, 0}));
    for (auto at = sees_.lower_bound({dimension, 0, 0}); at != sees_.end() && at->first[0] == dimension;) {
      at = at->first[2] >= map.first ? sees_.erase(at) : std::next(at);  // those of a map that was extended
    }
    Dimension& of = by_dimension_[static_cast<std::size_t>(map.dimension)];
    for (auto& alpha : of.alpha) {
      alpha.truncate(map.first);
    }
    of.maps.pop_back();
  }
  by_name_.erase(std::ranges::lower_bound(by_name_, std::pair{map.name, maps() - 1}));
  maps_.pop_back();
}

std::string dart_text(const DartStore::Made& map, Dart local) {
  const bool is_other = map.halves != 0 && local >= map.halves;
  return std::to_string(is_other ? local - map.halves : local) + (is_other ? "'" : "");
}

namespace {

/// A number below `most`, without leading zeros, or no_dart.
Dart number_of_text(std::string_view text, Dart most) {
  Dart dart = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), dart);
  const bool is_number =
      failure == std::errc{} && end == text.data() + text.size() && (text.size() == 1 || text[0] != '0');
  return is_number && dart < most ? dart : no_dart;
}

}  // namespace

Dart dart_of_text(const DartStore::Made& map, std::string_view text) {
  const bool is_other = map.halves != 0 && text.ends_with('\'');
  text.remove_suffix(is_other ? 1 : 0);
  const Dart dart = number_of_text(text, map.halves != 0 ? map.halves : map.count);
  return dart != no_dart && is_other ? dart + map.halves : dart;
}

Dart dart_of_text(const DartStore::Made& map, int i, std::string_view text) {
  if (i < 0 || i > map.dimension) {
    return no_dart;
  }
  return map.has_levels() ? number_of_text(text, static_cast<Dart>(map.cells->of[static_cast<std::size_t>(i)].size()))
                          : dart_of_text(map, text);
}

// --------------------------------------------------------------------------------------------------------- archives

void DartStore::save(sparse::ArchiveWriter& to) const {
  to.put(static_cast<std::uint64_t>(maps_.size()));
  for (const Made& map : maps_) {
    to.put(map.name);
    to.put(map.dimension);
    to.put(map.count);
    to.put(map.node);
    to.put(map.is_by_simplices);
    to.put(map.halves);
    for (const std::vector<DartCells::Seen>& seen : map.cells->of) {
      to.put_list(seen);
    }
  }
  for (const Dimension& of : by_dimension_) {
    for (std::size_t i = 0; i < of.alpha.size() && !of.maps.empty(); ++i) {  // all maps may have been undone
      to.put_list(of.alpha[i]);
    }
  }
  to.put_map(sees_);
  to.put_map(taken_out_);
}

/// Cells as they should be for the darts that there are.
bool DartStore::is_sound(const Made& map, const CellStore& nodes, const TypeTable& types) const {
  for (std::size_t i = 0; i < map.cells->of.size(); ++i) {
    const int dimension = map.is_by_simplices ? map.dimension - 1 : static_cast<int>(i);
    if (!map.has_levels() && map.cells->of[i].size() != (dimension < 0 ? 0 : map.count)) {
      return false;
    }
    for (const auto& [offset, dart] : map.cells->of[i]) {
      if (offset == UINT32_MAX) {
        continue;
      }
      const CellId node = map.node + offset;
      if (offset >= UINT32_MAX - std::uint32_t{map.node} || !nodes.contains(node) ||
          nodes.dimension(node) != dimension ||
          (!is_cone(nodes.type(node).type) && dart >= (map.is_by_simplices ? 1 : types.darts(nodes.type_id(node))))) {
        return false;
      }
    }
  }
  return true;
}

void DartStore::load(sparse::ArchiveReader& from, const CellStore& nodes, const TypeTable& types) {
  const std::size_t count = from.get_count(sizeof(std::uint64_t));
  for (std::size_t k = 0; k < count && from.is_good(); ++k) {
    Made map{from.get<std::uint32_t>(), from.get<int>(), 0, from.get<Dart>(), from.get<CellId>(), {}, false};
    map.is_by_simplices = from.get_bool();
    map.halves = from.get<Dart>();
    if (!from.check(map.dimension >= 0 && map.dimension <= largest_map_dimension &&
                        (map.halves == 0 || map.count / 2 == map.halves) &&
                        (map.count > 0 || (map.halves == 0 && !map.is_by_simplices)),
                    "a map has a dimension and darts")) {
      return;
    }
    DartCells cells;
    for (int i = 0; i <= map.dimension; ++i) {
      cells.of.push_back(from.get_list<std::vector<DartCells::Seen>>());
    }
    map.cells = std::make_shared<const DartCells>(std::move(cells));
    map.first = map.has_levels() ? 0 : darts(map.dimension);
    if (!from.check(from.is_good() && map.count < no_dart - map.first && is_sound(map, nodes, types),
                    "the darts of a map belong to cells")) {
      return;
    }
    by_name_.emplace_back(map.name, maps());
    maps_.push_back(std::move(map));
    list_map(maps() - 1);
  }
  std::ranges::sort(by_name_);
  for (std::size_t n = 0; n < by_dimension_.size() && from.is_good(); ++n) {
    Dimension& of = by_dimension_[n];
    std::vector<std::vector<Dart>> alpha;
    for (std::size_t i = 0; i <= n && !of.maps.empty(); ++i) {
      alpha.push_back(from.get_list<std::vector<Dart>>());
    }
    if (alpha.empty()) {
      continue;
    }
    from.check(from.is_good() && alpha[0].size() == darts(static_cast<int>(n)) && GMap::make(alpha).has_value(),
               "darts have images under involutions");
    for (const std::vector<Dart>& images : alpha) {
      auto& list = of.alpha.emplace_back();
      std::ranges::for_each(images, [&](Dart image) { list.push_back(image); });
    }
  }
  from.get_map<Place, DartCells::Seen>([&](const Place& place, const DartCells::Seen& seen) {
    const auto& [dimension, i, dart] = place;
    const CellId node{seen.offset};
    bool is_sound =
        dimension <= largest_map_dimension && dart < darts(static_cast<int>(dimension)) && nodes.contains(node);
    if (is_sound && map_of(static_cast<int>(dimension), dart).is_by_simplices) {
      const int n = static_cast<int>(dimension), index = static_cast<int>(i);
      is_sound = std::int64_t{i} < n + (std::int64_t{2} << n) && seen.dart == 0 &&
                 nodes.dimension(node) + 1 == std::popcount(numbers_of_seen(n, index));
    } else if (is_sound) {
      is_sound = i <= dimension && nodes.dimension(node) == static_cast<int>(i) &&
                 (is_cone(nodes.type(node).type) || seen.dart < types.darts(nodes.type_id(node)));
    }
    if (from.check(is_sound, "a dart sees a cell")) {
      sees_.emplace(place, seen);
    }
  });
  from.get_map<DartPlace, std::uint32_t>([&](const DartPlace& place, std::uint32_t with) {
    const auto& [dimension, dart] = place;
    bool is_sound =
        dimension <= largest_map_dimension && with <= dimension && dart < darts(static_cast<int>(dimension));
    for (int i = 0; is_sound && i <= static_cast<int>(dimension); ++i) {
      is_sound = alpha(static_cast<int>(dimension), i, dart) == dart;
    }
    if (from.check(is_sound, "a dart that is taken out of its map is free")) {
      taken_out_.emplace(place, with);
    }
  });
}

}  // namespace sesame::ops
