// The types of cells of maps.
#include <algorithm>
#include <numeric>
#include <utility>

#include "ops/cells/cell_type.hpp"
#include "ops/cells/map_cells.hpp"
#include "ops/maps/incidence_numbers.hpp"
#include "ops/maps/rooted_map.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// The type of the cell over a boundary, as a list of numbers, and back.
CellType encoded(const GMap& boundary) {
  CellType type{0, boundary.dimension() + 1};
  for (const std::vector<Dart>& alpha : boundary.involutions()) {
    type.insert(type.end(), alpha.begin(), alpha.end());
  }
  return type;
}

Result<GMap> decoded(const CellType& type) {
  const auto broken = [] { return Error{Errc::bad_input, "the type of a cell of a map is its canonical boundary"}; };
  if (type.size() < 4 || type[1] < 2 || type[1] > largest_map_dimension ||
      (type.size() - 2) % static_cast<std::size_t>(type[1]) != 0) {
    return broken();
  }
  const std::size_t darts = (type.size() - 2) / static_cast<std::size_t>(type[1]);
  std::vector<std::vector<Dart>> alpha;
  for (std::size_t begin = 2; begin < type.size(); begin += darts) {
    const std::span<const int> images = std::span{type}.subspan(begin, darts);
    if (std::ranges::any_of(images, [](int d) { return d < 0; })) {
      return broken();
    }
    alpha.emplace_back(images.begin(), images.end());
  }
  return GMap::make(std::move(alpha));
}

}  // namespace

TypeId TypeTable::cell_over(const GMap& boundary) {
  if (boundary.dimension() < 1) {
    const bool is_point = boundary.dimension() < 0 && boundary.size() == 1;
    const bool is_pair = boundary.dimension() == 0 && boundary.size() == 2 && !boundary.is_free(0, 0);
    return is_point ? vertex() : is_pair ? simplex(1) : TypeId{none};
  }
  const auto known = ids_.find(encoded(boundary));
  return known != ids_.end() ? known->second : is_homology_sphere(boundary) ? intern_shape(boundary) : TypeId{none};
}

const ConeShape* TypeTable::cone_over(const GMap& boundary) {
  const auto [at, is_new] = cones_.try_emplace(encoded(boundary));
  if (is_new && cells_of_map(boundary, *this).has_value()) {
    at->second = cone_shape_of(boundary);
  }
  return at->second ? &*at->second : nullptr;
}

TypeId TypeTable::intern_shape(const GMap& boundary) {
  auto shape = std::make_unique<CellShape>(shape_of(boundary));
  const int n = boundary.dimension();
  TypeInfo info;
  info.type = encoded(boundary);
  info.dimension = n + 1;
  const IndexSet within_face = boundary.indices() >> 1U;
  std::vector<std::vector<Dart>> orders;  // of the darts of faces
  for (std::uint32_t k = 0; k < shape->face_roots.size(); ++k) {
    const Dart root = shape->face_roots[k];
    orders.push_back(darts_from(boundary, root, within_face));
    const TypeId face = cell_over(restricted_to(boundary, orders.back(), n - 1));
    sparse::expects(face != none, "the faces of a ball are balls");
    info.faces.push_back({0, static_cast<int>(k), shape->signs[root], face});
  }
  for (std::uint32_t first = 0; first < info.faces.size(); ++first) {
    const TypeId type = info.faces[first].type;
    for (std::uint32_t second = 0; second < infos_[type].faces.size(); ++second) {
      const Dart here = orders[first][face_root(type, second)];
      const CellShape::Place there = shape->places[boundary.alpha(n, here)];
      const CellShape::Place seen = place_in_face(info.faces[there.face].type, there.dart);
      if (std::pair{first, second} < std::pair{there.face, seen.face}) {
        info.laws.push_back({first, second, there.face, seen.face, seen.dart});
      }
    }
  }
  info.shape = std::move(shape);
  CellType type = info.type;
  return add(std::move(type), std::move(info));
}

Dart TypeTable::darts(TypeId id) const {
  const TypeInfo& info = infos_[id];
  return info.shape != nullptr ? info.shape->boundary.size() : info.dimension == 0 ? 1 : 2;
}

CellShape::Place TypeTable::place_in_face(TypeId id, Dart d) const {
  const TypeInfo& info = infos_[id];
  return info.shape != nullptr ? info.shape->places[d] : CellShape::Place{d, 0};
}

Dart TypeTable::face_root(TypeId id, std::uint32_t face) const {
  const TypeInfo& info = infos_[id];
  return info.shape != nullptr ? info.shape->face_roots[face] : face;
}

int TypeTable::sign_of_dart(TypeId id, Dart d) const {
  const TypeInfo& info = infos_[id];
  return info.shape != nullptr ? info.shape->signs[d] : d == 0 ? 1 : -1;
}

const std::vector<Dart>& TypeTable::order_from(TypeId id, Dart root) {
  const auto [at, is_new] = orders_.try_emplace({id, root});
  if (is_new) {
    const TypeInfo& info = infos_[id];
    at->second = info.shape != nullptr ? darts_from(info.shape->boundary, root)
                 : info.dimension == 0 ? std::vector<Dart>{0}
                                       : std::vector<Dart>{root, 1 - root};
  }
  return at->second;
}

Dart TypeTable::dart_from(TypeId id, Dart root, Dart d) { return root == 0 ? d : order_from(id, root)[d]; }

Dart TypeTable::dart_seen_from(TypeId id, Dart root, Dart d) {
  if (root == 0) {
    return d;
  }
  const std::vector<Dart>& order = order_from(id, root);
  return static_cast<Dart>(std::ranges::find(order, d) - order.begin());
}

TypeId TypeTable::seen_from(TypeId id, Dart root) {
  if (root == 0 || infos_[id].shape == nullptr) {
    return id;
  }
  const GMap& boundary = infos_[id].shape->boundary;
  return cell_over(restricted_to(boundary, order_from(id, root), boundary.dimension()));
}

TypeTable::Canonical TypeTable::canonical(TypeId id) {
  if (infos_[id].shape == nullptr) {
    return {id, 0};
  }
  const auto [at, is_new] = canonical_.try_emplace(id, Canonical{id, 0});
  if (is_new) {
    const Dart root = canonical_root(infos_[id].shape->boundary);
    const Canonical found{seen_from(id, root), dart_seen_from(id, root, 0)};
    canonical_.insert_or_assign(id, found);
    return found;
  }
  return at->second;
}

/// The cells of the boundary, by dimension, then the whole.
StandardCell TypeTable::standard_of_map(TypeId whole) {
  const GMap boundary = infos_[whole].shape->boundary;  // a copy: types may be new
  Result<std::vector<CellsOfMap>> layers = cells_of_map(boundary, *this);
  sparse::expects(layers.has_value(), "the cells of a ball's boundary are balls");
  StandardCell standard;
  std::uint32_t first_below = 0;
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < layers->size(); ++i) {
    const CellsOfMap& layer = (*layers)[i];
    for (std::uint32_t c = 0; c < layer.orbits.count(); ++c) {
      StandardFace cell{layer.types[c], {}, {}, std::to_string(i) + ":" + std::to_string(layer.roots[c])};
      for (const CellsOfMap::Face& face : layer.faces_of(c)) {
        cell.faces.push_back(first_below + face.cell);
        cell.face_darts.push_back(face.dart);
      }
      standard.cells.push_back(std::move(cell));
    }
    first_below = std::exchange(first, first + layer.orbits.count());
  }
  StandardFace top{whole, {}, {}, std::to_string(layers->size()) + ":0"};
  for (const Dart root : infos_[whole].shape->face_roots) {
    top.faces.push_back(first_below + layers->back().orbits.of[root]);
    top.face_darts.push_back(layers->back().places[root]);
  }
  standard.cells.push_back(std::move(top));
  DartCells darts = dart_cells(*layers);
  darts.of.emplace_back();
  for (Dart d = 0; d < boundary.size(); ++d) {
    darts.of.back().push_back({first, d});
  }
  standard.darts = std::make_shared<const DartCells>(std::move(darts));
  return standard;
}

bool TypeTable::load_shape(const CellType& type, sparse::ArchiveReader& from) {
  const Result<GMap> boundary = decoded(type);
  const bool is_sound = boundary.has_value() && darts_from(*boundary, 0).size() == boundary->size() &&
                        rooted_at(*boundary, 0) == *boundary && is_homology_sphere(*boundary);
  const std::size_t known = infos_.size();
  return from.check(is_sound && !ids_.contains(type), "the type of a cell of a map is that over a homology sphere") &&
         from.check(intern_shape(*boundary) == known, "each type follows those of its faces");
}

}  // namespace sesame::ops
