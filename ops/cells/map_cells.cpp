#include "ops/cells/map_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "ops/maps/cell_boundary.hpp"
#include "ops/maps/incidence_numbers.hpp"
#include "ops/maps/rooted_map.hpp"

namespace sesame::ops {
namespace {

Error no_ball(const std::string& title, const GMap& boundary) {
  return {Errc::refused, fmt::format("{} is no ball: its canonical boundary {}", title, why_no_sphere(boundary))};
}

/// Adds the cells of one dimension, one after the other.
class Layout {
 public:
  Layout(Orbits orbits, TypeTable& types, bool any = false) : types_{types}, any_{any} {
    found_.places.assign(orbits.of.size(), no_dart);
    found_.orbits = std::move(orbits);
  }

  /// The next cell as a dart of its boundary sees it. Errors    refused, when it is no ball and should be one.
  Status add(const CellBoundary& cell, Dart from, const std::function<std::string()>& title) {
    const std::vector<Dart> order = darts_from(cell.map, from);
    const TypeId seen = types_.cell_over(restricted_to(cell.map, order, cell.map.dimension()));
    if (seen == none) {
      if (!any_) {
        return no_ball(title(), cell.map);
      }
      add_cone(cell);
      return Done{};
    }
    const TypeTable::Canonical canonical = types_.canonical(seen);
    place_.resize(order.size());  // which dart of the type a dart of the boundary is
    for (Dart k = 0; k < order.size(); ++k) {
      place_[order[k]] = types_.dart_from(canonical.type, canonical.root, k);
    }
    place_darts(cell, canonical.type);
    return Done{};
  }
  [[nodiscard]] const Orbits& orbits() const { return found_.orbits; }
  [[nodiscard]] CellsOfMap take() { return std::move(found_); }

 private:
  /// Its darts are numbered from the root from which isomorphic ones look alike.
  void add_cone(const CellBoundary& cell) {
    const std::vector<Dart> order = darts_from(cell.map, canonical_root(cell.map));
    place_.resize(order.size());
    for (Dart k = 0; k < order.size(); ++k) {
      place_[order[k]] = k;
    }
    found_.cones.emplace(static_cast<std::uint32_t>(found_.types.size()),
                         types_.cone_over(restricted_to(cell.map, order, cell.map.dimension())));
    place_darts(cell, none);
  }

  void place_darts(const CellBoundary& cell, TypeId type) {
    Dart root = no_dart;
    for (std::size_t k = 0; k < cell.darts.size(); ++k) {
      const Dart place = place_[cell.boundary_darts[k]];
      found_.places[cell.darts[k]] = place;
      root = place == 0 ? std::min(root, cell.darts[k]) : root;
    }
    found_.types.push_back(type);
    found_.roots.push_back(root);
  }

  TypeTable& types_;
  bool any_;
  CellsOfMap found_;
  std::vector<Dart> place_;
};

/// The cells of one level of a chain of maps: their boundaries are the components.
class Components {
 public:
  explicit Components(const GMap& level) : level_{level}, walk_{level}, place_(level.size(), no_dart) {}

  CellBoundary of(Dart first) {
    CellBoundary cell;
    cell.darts = walk_.from(first, level_.indices());
    std::ranges::sort(cell.darts);
    for (Dart k = 0; k < cell.darts.size(); ++k) {
      place_[cell.darts[k]] = k;
      cell.boundary_darts.push_back(k);
    }
    std::vector<std::vector<Dart>> alpha(level_.involutions().size());
    for (std::size_t j = 0; j < alpha.size(); ++j) {
      for (const Dart d : cell.darts) {
        alpha[j].push_back(place_[level_.involutions()[j][d]]);
      }
    }
    cell.map = alpha.empty() ? GMap::points(1) : std::move(*GMap::make(std::move(alpha)));
    cell.representatives = cell.darts;
    return cell;
  }
  /// Which dart of its boundary a dart is, of the cell that was asked for last.
  [[nodiscard]] Dart place(Dart d) const { return place_[d]; }

 private:
  const GMap& level_;
  OrbitWalk walk_;
  std::vector<Dart> place_;
};

/// Faces are found from the darts that see them: of each root of a face some dart of the map is one. `lower`: which
/// dart a dart is among those of the cells below.
template <class Lower>
void add_faces(const CellsOfMap& below, TypeTable& types, CellsOfMap& cells, Lower lower) {
  for (std::uint32_t c = 0; c < cells.orbits.count(); ++c) {
    const TypeId type = cells.types[c];
    const auto arity = type == none ? 0U : static_cast<std::uint32_t>(types.info(type).faces.size());
    cells.face_ends.push_back((c == 0 ? 0 : cells.face_ends.back()) + arity);
  }
  cells.faces.assign(cells.face_ends.empty() ? 0 : cells.face_ends.back(), {UINT32_MAX, no_dart});
  for (Dart d = 0; d < cells.places.size(); ++d) {
    const std::uint32_t cell = cells.orbits.of[d];
    const TypeId type = cells.types[cell];
    if (type == none) {
      continue;
    }
    const CellShape::Place place = types.place_in_face(type, cells.places[d]);
    if (place.dart == 0) {
      const std::uint32_t begin = cell == 0 ? 0 : cells.face_ends[cell - 1];
      cells.faces[begin + place.face] = {below.orbits.of[lower(d)], below.places[lower(d)]};
    }
  }
}

}  // namespace

const char* why_no_sphere(const GMap& boundary) {
  const DartSigns signs = dart_signs(boundary);
  return signs.fault == DartSigns::Fault::fold        ? "is open or folded"
         : signs.fault == DartSigns::Fault::one_sided ? "is not orientable"
                                                      : "has not the homology of a sphere";
}

Result<std::vector<CellsOfMap>> cells_of_map(const GMap& map, TypeTable& types, bool any_on_top) {
  std::vector<CellsOfMap> all;
  CellBoundaries boundaries(map);
  for (int i = 0; i <= map.dimension(); ++i) {
    const bool any = any_on_top && i == map.dimension() && i >= least_cone_dimension;
    Layout layout(cells(map, i), types, any);
    for (const Dart first : layout.orbits().first) {
      const CellBoundary cell = boundaries.of(i, first);
      const auto title = [&] { return fmt::format("the {}-cell of dart {}", i, first); };
      if (Status s = layout.add(cell, 0, title); !s) {
        return s.error();
      }
    }
    CellsOfMap cells = layout.take();
    if (i == 0) {
      cells.face_ends.assign(cells.orbits.count(), 0);
    } else {
      add_faces(all.back(), types, cells, [](Dart d) { return d; });
    }
    all.push_back(std::move(cells));
  }
  return all;
}

CellsSeen cells_seen_from_least_darts() {
  return {[](int, Dart least) { return least; },
          [](int i, Dart least) { return fmt::format("the {}-cell of dart {}", i, least); }};
}

Result<std::vector<CellsOfMap>> cells_of_chain(const ChainOfMaps& chain, const CellsSeen& seen, TypeTable& types) {
  std::vector<CellsOfMap> all;
  for (int i = 0; i <= chain.dimension(); ++i) {
    Layout layout(chain.cells(i), types);
    Components components(chain.level(i));
    for (const Dart least : layout.orbits().first) {
      const CellBoundary cell = components.of(least);
      const auto title = [&] { return seen.title(i, least); };
      if (Status s = layout.add(cell, components.place(seen.from(i, least)), title); !s) {
        return s.error();
      }
    }
    CellsOfMap cells = layout.take();
    if (i == 0) {
      cells.face_ends.assign(cells.orbits.count(), 0);
    } else {
      add_faces(all.back(), types, cells, [&](Dart d) { return chain.sigma(i, d); });
    }
    all.push_back(std::move(cells));
  }
  return all;
}

DartCells dart_cells(const std::vector<CellsOfMap>& cells) {
  DartCells darts;
  std::uint32_t first = 0;
  for (const CellsOfMap& layer : cells) {
    darts.of.emplace_back();
    for (std::size_t d = 0; d < layer.places.size(); ++d) {
      darts.of.back().push_back({first + layer.orbits.of[d], layer.places[d]});
    }
    first += layer.orbits.count();
  }
  return darts;
}

}  // namespace sesame::ops
