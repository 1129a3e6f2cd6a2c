#include "replay/export/object_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <unordered_map>
#include <utility>

#include "ops/maps/orbits.hpp"
#include "ops/plan/sewing.hpp"
#include "ops/plan/step_names.hpp"

namespace sesame::replay {
namespace {

using ops::CellId;
using ops::Dart;
using ops::DartStore;
using ops::Value;

Error no_map(const std::string& why) {
  return {Errc::refused, "the object does not consist of maps, as a map file should: " + why};
}

class MapFinder {
 public:
  explicit MapFinder(const ObjectCells& cells)
      : cells_{cells}, structure_{cells.structure()}, store_{structure_.darts()} {}

  Result<ObjectMap> run() {
    if (Status s = find_darts(); !s) {
      return s.error();
    }
    if (Status s = make_map(); !s) {
      return s.error();
    }
    found_.vertices.resize(found_.darts.size());
    if (Status s = check_cells(); !s) {
      return s.error();
    }
    for (ops::IndexSet set = 1; has_simplices_ && set <= found_.map.indices(); ++set) {
      if (Status s = check_simplices(set); !s) {
        return s.error();
      }
    }
    if (Status s = check_all_are_met(); !s) {
      return s.error();
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] int dimension() const { return *dimension_; }
  [[nodiscard]] const DartStore::Made& made(Dart d) const { return store_.map_of(dimension(), found_.darts[d]); }
  [[nodiscard]] std::string name(Dart d) const { return found_.name(d, structure_); }

  Status find_darts() {
    for (std::uint32_t number = 0; number < store_.maps(); ++number) {
      const DartStore::Made& map = store_.map(number);
      if (store_.named(map.name) != &map || map.has_levels()) {
        continue;  // it was extended, or is a chain of maps
      }
      bool has_darts = false;
      for (Dart d = map.first; d < map.first + map.count; ++d) {
        if (is_gone(map, d)) {
          continue;
        }
        has_darts = true;
        found_.darts.push_back(d);
      }
      if (!has_darts) {
        continue;
      }
      if (dimension_.value_or(map.dimension) != map.dimension) {
        return no_map(fmt::format("\"{}\" is a map of dimension {}, and there is one of dimension {}",
                                  structure_.directory().names()[map.name].text, map.dimension, dimension()));
      }
      dimension_ = map.dimension;
      has_simplices_ = has_simplices_ || map.is_by_simplices;
    }
    return dimension_ ? Status{Done{}} : no_map("there is none");
  }

  /// Whether nothing of what a dart was made for is there.
  [[nodiscard]] bool is_gone(const DartStore::Made& map, Dart d) const {
    if (store_.taken_out_with(map.dimension, d)) {
      return true;
    }
    if (map.is_by_simplices) {
      return !simplex(map, (ops::IndexSet{1} << (map.dimension + 1)) - 1, d).has_value();
    }
    for (int i = 0; i <= map.dimension; ++i) {
      if (ops::seen_now(map.dimension, i, d, structure_)) {
        return false;
      }
    }
    return true;
  }

  Status make_map() {
    std::unordered_map<Dart, Dart> number;
    for (Dart d = 0; d < found_.darts.size(); ++d) {
      number.emplace(found_.darts[d], d);
    }
    std::vector<std::vector<Dart>> alpha(static_cast<std::size_t>(dimension()) + 1);
    for (int i = 0; i <= dimension(); ++i) {
      for (Dart d = 0; d < found_.darts.size(); ++d) {
        const auto image = number.find(store_.alpha(dimension(), i, found_.darts[d]));
        if (image == number.end()) {
          return no_map(fmt::format("what \"{}\" is sewn to was taken away", name(d)));
        }
        alpha[static_cast<std::size_t>(i)].push_back(image->second);
      }
    }
    Result<ops::GMap> map = ops::GMap::make(std::move(alpha));
    if (!map) {
      return no_map(map.error().what);
    }
    found_.map = std::move(*map);
    return Done{};
  }

  /// A cell of the object is met, from a dart, as one that stands for some orbit.
  Status meet(CellId cell, std::uint64_t orbit, Dart d) {
    const auto [at, is_new] = met_.try_emplace(cell, orbit);
    return at->second == orbit ? Status{Done{}}
                               : no_map(fmt::format("\"{}\" was glued, but not by sewing, to what \"{}\" belongs to",
                                                    structure_.name(cell), name(d)));
  }

  Status check_cells() {
    std::vector<Value> below, here(found_.darts.size());
    std::uint64_t orbits_before = 0;
    for (int i = 0; i <= dimension(); ++i) {
      const ops::Orbits orbits = ops::cells(found_.map, i);
      for (Dart d = 0; d < found_.darts.size(); ++d) {
        if (made(d).is_by_simplices) {
          continue;
        }
        if (Status s = check_cell(i, d, orbits_before + orbits.of[d], below, here[d]); !s) {
          return s;
        }
      }
      orbits_before += orbits.count();
      below = here;
    }
    return Done{};
  }

  Status check_cell(int i, Dart d, std::uint64_t orbit, const std::vector<Value>& below, Value& seen) {
    const Result<Value> value = ops::seen_now(dimension(), i, found_.darts[d], structure_);
    if (!value) {
      return no_map(value.error().what);
    }
    if (value->is_degenerate()) {
      return no_map(fmt::format("the {}-cell of \"{}\" was squashed", i, name(d)));
    }
    const bool is_cone = ops::is_cone(structure_.cells().type(value->cell).type);
    if (i > 0 && !is_cone && !(structure_.values().face(*value, 0) == below[d])) {
      return no_map(
          fmt::format("\"{}\" has not the face that \"{}\" sees: it was split", structure_.name(value->cell), name(d)));
    }
    if (i == 0) {
      found_.vertices[d] = value->cell;
    }
    seen = *value;
    return meet(value->cell, orbit, d);
  }

  /// The simplex that was made for a set of involutions, from the least dart of its orbit.
  [[nodiscard]] std::optional<Value> simplex(const DartStore::Made& map, ops::IndexSet set, Dart d) const {
    std::vector<int> numbers;
    for (int i = 0; i <= map.dimension; ++i) {
      if ((set >> i & 1U) != 0) {
        numbers.push_back(i);
      }
    }
    const std::string name = fmt::format("{}.<{}>:{}", structure_.directory().names()[map.name].text,
                                         fmt::join(numbers, "-"), dart_text(map, d - map.first));
    const Result<Value> value = ops::resolve_cell(name, structure_);
    return value && !value->is_degenerate() ? std::optional{*value} : std::nullopt;
  }

  Status check_simplices(ops::IndexSet set) {
    const ops::Orbits& orbits = orbits_.emplace_back(ops::orbits(found_.map, found_.map.indices() & ~set));
    for (std::uint32_t orbit = 0; orbit < orbits.count(); ++orbit) {
      const Dart first = orbits.first[orbit];
      if (!made(first).is_by_simplices) {
        continue;
      }
      const auto value = simplex(made(first), set, found_.darts[first]);
      if (!value) {
        return no_map(fmt::format("a simplex of \"{}\" was squashed or taken away", name(first)));
      }
      if (Status s = meet(value->cell, key(set, first), first); !s) {
        return s;
      }
      if (Status s = check_faces(set, *value, first); !s) {
        return s;
      }
    }
    for (Dart d = 0; set == 1 && d < found_.darts.size(); ++d) {
      if (made(d).is_by_simplices) {
        const Dart first = orbits.first[orbits.of[d]];
        found_.vertices[d] = simplex(made(first), set, found_.darts[first])->cell;
      }
    }
    return Done{};
  }

  /// What the simplex of a dart and a set of numbers is met as.
  [[nodiscard]] std::uint64_t key(ops::IndexSet set, Dart d) const { return set << 32U | orbits_[set - 1].of[d]; }

  /// Sets with fewer numbers are less as integers, so their simplices have been met.
  Status check_faces(ops::IndexSet set, const Value& value, Dart first) const {
    std::uint32_t k = 0;
    for (int i = 0; i <= dimension(); ++i) {
      const ops::IndexSet rest = set & ~(ops::IndexSet{1} << i);
      if (rest == set || rest == 0) {
        continue;
      }
      const auto face = met_.find(structure_.values().face(value, k++).cell);
      if (face == met_.end() || face->second != key(rest, first)) {
        return no_map(fmt::format("\"{}\" has not the face that \"{}\" sees: it was split", structure_.name(value.cell),
                                  name(first)));
      }
    }
    return Done{};
  }

  Status check_all_are_met() const {
    for (std::size_t dimension = 0; dimension < cells_.dimensions(); ++dimension) {
      for (const CellId cell : cells_.of(dimension)) {
        if (!met_.contains(cell) && !ops::is_cone_part(structure_.cells().type(cell).type)) {
          return no_map(fmt::format("\"{}\" is none of the cells of its maps", structure_.name(cell)));
        }
      }
    }
    return Done{};
  }

  const ObjectCells& cells_;
  const ops::Structure& structure_;
  const DartStore& store_;
  ObjectMap found_;
  std::optional<int> dimension_;
  bool has_simplices_ = false;
  std::unordered_map<CellId, std::uint64_t> met_;  // which orbit each cell stands for
  std::vector<ops::Orbits> orbits_;                // of maps by simplices, per set of numbers but the first
};

}  // namespace

std::string ObjectMap::name(Dart dart, const ops::Structure& structure) const {
  return ops::name_of_dart(map.dimension(), darts[dart], structure);
}

Result<ObjectMap> map_of_object(const ObjectCells& cells) { return MapFinder(cells).run(); }

}  // namespace sesame::replay
