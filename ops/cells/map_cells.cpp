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

Error no_ball(int i, const CellBoundary& cell) {
  const DartSigns signs = dart_signs(cell.map);
  const char* why = signs.fault == DartSigns::Fault::fold        ? "is open or folded"
                    : signs.fault == DartSigns::Fault::one_sided ? "is not orientable"
                                                                 : "has not the homology of a sphere";
  return {Errc::refused,
          fmt::format("the {}-cell of dart {} is no ball: its canonical boundary {}", i, cell.darts.front(), why)};
}

/// Adds the cells of a map to those of its dimension, one after the other.
class Layout {
 public:
  Layout(const GMap& map, int i, TypeTable& types, bool any)
      : map_{map}, i_{i}, types_{types}, any_{any}, boundaries_{map} {}

  Result<CellsOfMap> run() {
    found_.orbits = cells(map_, i_);
    found_.places.assign(map_.size(), no_dart);
    for (const Dart first : found_.orbits.first) {
      const CellBoundary cell = boundaries_.of(i_, first);
      const std::vector<Dart> order = darts_from(cell.map, 0);
      const TypeId seen = types_.cell_over(restricted_to(cell.map, order, i_ - 1));
      if (seen != none) {
        add(cell, order, types_.canonical(seen));
      } else if (any_) {
        add_cone(cell);
      } else {
        return no_ball(i_, cell);
      }
    }
    return std::move(found_);
  }

 private:
  /// Its darts are numbered from the root from which isomorphic ones look alike.
  void add_cone(const CellBoundary& cell) {
    const std::vector<Dart> order = darts_from(cell.map, canonical_root(cell.map));
    place_.resize(order.size());
    for (Dart k = 0; k < order.size(); ++k) {
      place_[order[k]] = k;
    }
    found_.cones.emplace(static_cast<std::uint32_t>(found_.types.size()),
                         &types_.cone_over(restricted_to(cell.map, order, i_ - 1)));
    place_darts(cell, none);
  }

  void add(const CellBoundary& cell, const std::vector<Dart>& order, const TypeTable::Canonical& canonical) {
    place_.resize(order.size());  // which dart of the type a dart of the boundary is
    for (Dart k = 0; k < order.size(); ++k) {
      place_[order[k]] = types_.dart_from(canonical.type, canonical.root, k);
    }
    place_darts(cell, canonical.type);
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

  const GMap& map_;
  int i_;
  TypeTable& types_;
  bool any_;
  CellBoundaries boundaries_;
  CellsOfMap found_;
  std::vector<Dart> place_;
};

/// Faces are found from the darts that see them: of each root of a face some dart of the map is one.
void add_faces(const CellsOfMap& below, TypeTable& types, CellsOfMap& cells) {
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
      cells.faces[begin + place.face] = {below.orbits.of[d], below.places[d]};
    }
  }
}

}  // namespace

Result<std::vector<CellsOfMap>> cells_of_map(const GMap& map, TypeTable& types, bool any_on_top) {
  std::vector<CellsOfMap> all;
  for (int i = 0; i <= map.dimension(); ++i) {
    const bool any = any_on_top && i == map.dimension() && i >= least_cone_dimension;
    Result<CellsOfMap> cells = Layout(map, i, types, any).run();
    if (!cells) {
      return cells.error();
    }
    if (i == 0) {
      cells->face_ends.assign(cells->orbits.count(), 0);
    } else {
      add_faces(all.back(), types, *cells);
    }
    all.push_back(std::move(*cells));
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
