#include "ops/cells/analogue_chain.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "ops/cells/cone_parts.hpp"
#include "ops/cells/dart_simplices.hpp"
#include "ops/cells/lineage.hpp"
#include "ops/cells/name_text.hpp"
#include "ops/maps/gmap.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// The darts of maps of one dimension.
class Darts {
 public:
  Darts(const Structure& structure, int dimension)
      : structure_{structure}, store_{structure.darts()}, dimension_{dimension} {}

  [[nodiscard]] int dimension() const { return dimension_; }

  /// What involutions reach from a dart, with +1, or -1 where an odd number of those below `turning` was taken.
  /// Requires: the signs don't depend on the way.
  [[nodiscard]] std::unordered_map<Dart, int> signed_orbit(Dart start, IndexSet generators, int turning) const {
    std::unordered_map<Dart, int> signs{{start, 1}};
    std::vector<Dart> found{start};
    for (std::size_t at = 0; at < found.size(); ++at) {
      for (int j = 0; j <= dimension_; ++j) {
        const Dart next = store_.alpha(dimension_, j, found[at]);
        if ((generators >> j & 1U) != 0 && signs.emplace(next, signs.at(found[at]) * (j < turning ? -1 : 1)).second) {
          found.push_back(next);
        }
      }
    }
    return signs;
  }

  /// Adds the simplices of a cell of dimension i: those numbered 0 to i, or with a last number `apex`, that its darts
  /// see. Orbits under all involutions but that of i, and that of the apex, are a cell, and of it in a boundary.
  void add_cell(Dart start, int i, std::optional<int> apex, int coefficient, std::map<std::string, int>& sum) const {
    const IndexSet all = (IndexSet{2} << dimension_) - 1;
    IndexSet numbers = (IndexSet{2} << i) - 1;
    IndexSet around = all & ~(IndexSet{1} << i);
    if (apex) {
      numbers |= IndexSet{1} << *apex;
      around &= ~(IndexSet{1} << *apex);
    }
    // A face counts in the boundary of a cell as the dart does that sees both, and as (-1)^i in that of a simplex.
    const bool is_reversed = (i * (i + 1) / 2 + (apex ? i + 1 : 0)) % 2 != 0;
    std::unordered_set<Dart> met;
    for (const auto& [d, sign] : signed_orbit(start, around, i)) {
      if (met.contains(d)) {
        continue;
      }
      Dart least = d;
      for (const auto& [same, turn] : signed_orbit(d, all & ~numbers, 0)) {
        met.insert(same);
        least = std::min(least, same);
      }
      sum[name(least, numbers)] += (is_reversed ? -sign : sign) * coefficient;
    }
  }

  /// The simplex at the apex alone.
  void add_apex(Dart d, int coefficient, std::map<std::string, int>& sum) const {
    const IndexSet all = (IndexSet{2} << dimension_) - 1;
    const IndexSet apex = IndexSet{1} << dimension_;
    Dart least = d;
    for (const auto& [same, sign] : signed_orbit(d, all & ~apex, 0)) {
      least = std::min(least, same);
    }
    sum[name(least, apex)] += coefficient;
  }

  /// The darts of the canonical boundary of the largest cell of a dart, in the order of their places, and that
  /// boundary.
  [[nodiscard]] std::pair<std::vector<Dart>, GMap> boundary_around(Dart start) const {
    const auto signs = signed_orbit(start, ((IndexSet{1} << dimension_) - 1), 0);
    const auto place = [&](Dart d) { return store_.seen(store_.map_of(dimension_, d), dimension_, d).dart; };
    std::vector<Dart> darts(signs.size());
    for (const auto& [d, sign] : signs) {
      darts[place(d)] = d;
    }
    std::vector<std::vector<Dart>> images(static_cast<std::size_t>(dimension_));
    for (int j = 0; j < dimension_; ++j) {
      for (const Dart d : darts) {
        images[static_cast<std::size_t>(j)].push_back(place(store_.alpha(dimension_, j, d)));
      }
    }
    Result<GMap> boundary = GMap::make(std::move(images));
    sparse::expects(boundary.has_value(), "the boundary of a cell is a map");
    return {std::move(darts), std::move(*boundary)};
  }

 private:
  [[nodiscard]] std::string name(Dart d, IndexSet numbers) const {
    return name_of_simplex(structure_, dimension_, numbers, d);
  }

  const Structure& structure_;
  const DartStore& store_;
  int dimension_;
};

/// A dart that sees a cell, and whether it counts + in the orientation that the name of the cell has.
struct Seeing {
  int dimension;  ///< of the map
  Dart dart;
  int sign;
};

/// The node that a dart sees as a cell that there is now, and which dart of it that is.
std::optional<DartCells::Seen> seen_now_of(const Structure& structure, const DartStore::Made& map, int i, Dart d) {
  const DartCells::Seen seen = structure.darts().seen(map, i, d);
  auto value = seen_from_dart(structure, map, i, d);
  if (!value) {
    return std::nullopt;
  }
  Lineage(structure).advance_to_now(*value);
  const bool is_cone_cell = is_cone(structure.cells().type(value->cell).type);
  return DartCells::Seen{std::uint32_t{value->cell}, is_cone_cell ? seen.dart : structure.maps().dart_of(value->order)};
}

std::optional<Seeing> dart_of_cell(const Structure& structure, CellId cell) {
  const DartStore& store = structure.darts();
  const std::string name = structure.name(cell);
  const auto split = split_dart(name);
  const DartStore::Made* map =
      map_named(structure, split ? std::string_view{name}.substr(0, split->length) : std::string_view{name});
  if (map == nullptr || map->has_levels() || map->is_by_simplices) {
    return std::nullopt;
  }
  const int i = split ? split->dimension : map->dimension;
  const Dart local = split ? dart_of_text(*map, split->dart) : 0;
  if (local == no_dart) {
    return std::nullopt;
  }
  const TypeId type = structure.cells().type_id(cell);
  const bool has_sign = !is_cone(structure.cells().type(cell).type);
  const auto sign_of = [&](const DartCells::Seen& seen) {
    return has_sign ? structure.types().sign_of_dart(type, seen.dart) : 1;
  };
  const Dart called = map->first + local;
  const auto by_name = seen_now_of(structure, *map, i, called);
  if (!by_name || by_name->offset != std::uint32_t{cell}) {
    return std::nullopt;
  }
  if (!store.taken_out_with(map->dimension, called)) {
    return Seeing{map->dimension, called, 1};
  }
  for (Dart d = 0; d < store.darts(map->dimension); ++d) {
    if (!store.taken_out_with(map->dimension, d)) {
      const auto seen = seen_now_of(structure, store.map_of(map->dimension, d), i, d);
      if (seen && seen->offset == std::uint32_t{cell}) {
        return Seeing{map->dimension, d, sign_of(*by_name) * sign_of(*seen)};
      }
    }
  }
  return std::nullopt;
}

AnalogueChain listed(const std::map<std::string, int>& sum) {
  AnalogueChain chain;
  for (const auto& [name, coefficient] : sum) {
    if (coefficient != 0) {
      chain.emplace_back(coefficient, name);
    }
  }
  return chain;
}

}  // namespace

std::optional<AnalogueChain> in_analogue(const Structure& structure, CellId cell) {
  const CellType& type = structure.cells().type(cell).type;
  const bool is_part = is_cone_part(type);
  const CellId whole = is_part ? whole_of_part(structure, cell) : cell;
  const auto seeing = dart_of_cell(structure, whole);
  if (!seeing) {
    return std::nullopt;
  }
  const Darts darts(structure, seeing->dimension);
  std::map<std::string, int> sum;
  if (!is_part && !is_cone(type)) {
    darts.add_cell(seeing->dart, structure.dimension(cell), std::nullopt, seeing->sign, sum);
    return listed(sum);
  }
  const auto [dart_at, boundary] = darts.boundary_around(seeing->dart);
  const ConeShape* shape = structure.types().cone_over(boundary);
  sparse::expects(shape != nullptr, "a cell is there, so it has a shape");
  const std::vector<CellId> parts = cone_parts(structure, whole);
  const auto at = static_cast<std::size_t>(std::ranges::find(parts, cell) - parts.begin());  // the cell itself is last
  const ConeShape::Generator& generator = shape->generators[at];
  if (generator.degree == 0) {
    darts.add_apex(dart_at[0], 1, sum);
  }
  for (const ConeShape::Term& term : generator.terms) {
    darts.add_cell(dart_at[term.dart], term.dimension, darts.dimension(), term.coefficient, sum);
  }
  return listed(sum);
}

}  // namespace sesame::ops
