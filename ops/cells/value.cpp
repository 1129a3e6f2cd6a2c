#include "ops/cells/value.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// That a type can have: those of so many edges.
constexpr std::size_t most_vertices = 2 * std::size_t{largest_dimension};

/// The components of a type as stretches of its vertices, or of the entries of a map.
template <class Visit>
void for_each_component(const CellType& type, Visit visit) {
  std::size_t begin = 0;
  for (const int a : type) {
    visit(begin, begin + static_cast<std::size_t>(a) + 1);
    begin += static_cast<std::size_t>(a) + 1;
  }
}

/// The vertex up to which a stretch of a map goes: the dimension of the component of the cell, 0 when it has none.
std::uint8_t last_vertex(const VertexMap& map, std::size_t begin, std::size_t end) {
  return *std::max_element(map.begin() + static_cast<std::ptrdiff_t>(begin),
                           map.begin() + static_cast<std::ptrdiff_t>(end));
}

/// The inner map after the outer one, whose vertices are those of `type`.
VertexMap composed(const CellType& type, VertexMap outer, const VertexMap& inner) {
  std::size_t of_inner = 0;
  for_each_component(type, [&](std::size_t begin, std::size_t end) {
    const std::uint8_t last = last_vertex(outer, begin, end);
    if (last == 0) {
      return;  // sent to a single vertex: the cell has no such component
    }
    for (std::size_t k = begin; k < end; ++k) {
      outer[k] = inner[of_inner + outer[k]];
    }
    of_inner += std::size_t{last} + 1;
  });
  return outer;
}

}  // namespace

VertexMap VertexMaps::map_of(const Value& v) const {
  const CellType& type = types_.info(v.type).type;
  VertexMap monotone;
  int direction = 0;
  for (const int a : type) {
    monotone.push_back(0);
    for (int j = 0; j < a; ++j, ++direction) {
      const bool moves = (v.collapsed >> direction & 1) == 0;
      monotone.push_back(static_cast<std::uint8_t>(monotone.back() + (moves ? 1 : 0)));
    }
  }
  if (v.order == same_order) {
    return monotone;
  }
  VertexMap map;
  for (const std::uint8_t place : permutation(v.order)) {
    map.push_back(monotone[place]);
  }
  return map;
}

Value VertexMaps::value_of(CellId cell, TypeId type, const VertexMap& map) {
  Value v{cell, type, 0, same_order};
  std::vector<std::uint8_t> places(map.size());
  std::vector<std::size_t> sorted(map.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  int direction = 0;
  for_each_component(types_.info(type).type, [&](std::size_t begin, std::size_t end) {
    std::stable_sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin),
                     sorted.begin() + static_cast<std::ptrdiff_t>(end),
                     [&map](std::size_t a, std::size_t b) { return map[a] < map[b]; });
    for (std::size_t place = begin; place < end; ++place) {
      places[sorted[place]] = static_cast<std::uint8_t>(place);
      if (place > begin) {
        v.collapsed |= Degeneracy{map[sorted[place]] == map[sorted[place - 1]]} << direction++;
      }
    }
  });
  v.order = order(places);
  return v;
}

Value VertexMaps::compose(const Value& outer, const Value& inner) {
  if (outer.order == same_order && inner.order == same_order) {
    return {inner.cell, outer.type, ops::compose(outer.collapsed, inner.collapsed), same_order};
  }
  if (is_of_map(outer.order) || is_of_map(inner.order)) {
    return {inner.cell, outer.type, 0, compose(outer.order, inner.order)};
  }
  if (!outer.is_degenerate() && !inner.is_degenerate()) {  // both maps are permutations
    return {inner.cell, outer.type, 0, compose(outer.order, inner.order)};
  }
  const VertexMap map = composed(types_.info(outer.type).type, map_of(outer), map_of(inner));
  return value_of(inner.cell, outer.type, map);
}

OrderId VertexMaps::compose(OrderId outer, OrderId inner) {
  if (outer == same_order || inner == same_order) {
    return outer == same_order ? inner : outer;
  }
  if (is_of_map(inner)) {
    const auto& [permutation, sign, type, dart] = orders_[inner];
    return order_at(type, types_.dart_from(type, dart, orders_[outer].dart));
  }
  std::array<std::uint8_t, most_vertices> composite;
  const std::span<const std::uint8_t> first = permutation(outer), second = permutation(inner);
  std::transform(first.begin(), first.end(), composite.begin(), [&](std::uint8_t k) { return second[k]; });
  return order(std::span{composite}.first(first.size()));
}

OrderId VertexMaps::inverse(OrderId id) {
  if (is_of_map(id)) {
    const auto& [permutation, sign, type, dart] = orders_[id];
    return order_at(types_.seen_from(type, dart), types_.dart_seen_from(type, dart, 0));
  }
  const std::span<const std::uint8_t> there = permutation(id);
  std::array<std::uint8_t, most_vertices> back;
  for (std::size_t k = 0; k < there.size(); ++k) {
    back[there[k]] = static_cast<std::uint8_t>(k);
  }
  return order(std::span{back}.first(there.size()));
}

Value VertexMaps::product(CellId cell, const Value& left, const Value& right) {
  const TypeId type = types_.product(left.type, right.type);
  if (left.order == same_order && right.order == same_order) {
    return {cell, type, left.collapsed | right.collapsed << types_.info(left.type).dimension, same_order};
  }
  VertexMap map = map_of(left);
  const VertexMap more = map_of(right);
  map.insert(map.end(), more.begin(), more.end());
  return value_of(cell, type, map);
}

Value VertexMaps::coned(CellId cell, const Value& v, bool by_edge) {
  const TypeId type = types_.coned(v.type, by_edge);
  if (v.order == same_order) {
    return {cell, type, v.collapsed, same_order};
  }
  VertexMap map = map_of(v);
  if (by_edge) {
    map.insert(map.end(), {0, 1});
  } else {
    map.push_back(static_cast<std::uint8_t>(*std::max_element(map.begin(), map.end()) + 1));
  }
  return value_of(cell, type, map);
}

OrderId VertexMaps::order_at(TypeId type, Dart dart) {
  if (dart == 0) {
    return same_order;
  }
  if (types_.info(type).shape == nullptr) {  // an edge
    return order(std::array<std::uint8_t, 2>{1, 0});
  }
  const auto [at, is_new] = index_of_darts_.try_emplace({type, dart}, static_cast<OrderId>(orders_.size()));
  if (is_new) {
    orders_.push_back({{}, types_.sign_of_dart(type, dart), type, dart});
  }
  return at->second;
}

/// The root of the face is some dart of the cell, and so one of a face of that.
VertexMaps::FaceStep VertexMaps::face_of_map(const Value& v, std::uint32_t k) {
  const TypeId face = types_.info(v.type).faces[k].type;
  const auto [permutation, sign, type, dart] = orders_[v.order];
  const CellShape::Place place = types_.place_in_face(type, types_.dart_from(type, dart, types_.face_root(v.type, k)));
  return {{v.cell, face, 0, order_at(types_.info(type).faces[place.face].type, place.dart)}, place.face};
}

std::uint32_t VertexMaps::face_of_cell(const Value& v, std::uint32_t k) {
  return v.order == same_order ? k : is_of_map(v.order) ? face_of_map(v, k).of_cell : permutation(v.order)[k];
}

VertexMaps::FaceStep VertexMaps::without_vertex(const Value& v, std::uint32_t k) {
  if (is_of_map(v.order)) {
    return face_of_map(v, k);
  }
  const TypeInfo& info = types_.info(v.type);
  if (v.order == same_order) {
    const DegenerateFace step = face_of_degenerate(info, v.collapsed, k);
    return {{v.cell, step.type, step.collapsed, same_order}, step.of_cell};
  }
  if (info.dimension == 1 && !v.is_degenerate()) {  // an edge, the other way round
    return {{v.cell, info.faces[k].type, 0, same_order}, permutation(v.order)[k]};
  }
  VertexMap map = map_of(v);
  std::size_t begin = 0;  // of the component of the face
  std::size_t end = 0;
  std::uint32_t number = 0;  // of faces of the cell, in the components before that
  for_each_component(info.type, [&](std::size_t first, std::size_t last) {
    if (first <= k) {
      if (end != 0) {
        const std::uint8_t before = last_vertex(map, begin, end);
        number += before == 0 ? 0U : std::uint32_t{before} + 1;
      }
      begin = first;
      end = last;
    }
  });
  const std::uint8_t vertex = map[k];
  map.erase(map.begin() + static_cast<std::ptrdiff_t>(k));
  --end;
  const auto stretch = std::span{map}.subspan(begin, end - begin);
  const bool keeps_cell = std::find(stretch.begin(), stretch.end(), vertex) != stretch.end();
  if (!keeps_cell) {
    for (std::uint8_t& image : stretch) {
      image = static_cast<std::uint8_t>(image - (image > vertex ? 1 : 0));
    }
  }
  if (stretch.size() == 1) {  // the component has vanished
    map.erase(map.begin() + static_cast<std::ptrdiff_t>(begin));
  }
  return {value_of(v.cell, info.faces[k].type, map), keeps_cell ? DegenerateFace::itself : number + vertex};
}

OrderId VertexMaps::order(std::span<const std::uint8_t> permutation) {
  const std::size_t size = permutation.size();
  std::size_t kept = 0;
  while (kept < size && permutation[kept] == kept) {
    ++kept;
  }
  if (kept == size) {
    return same_order;
  }
  std::vector<std::uint8_t> entries(permutation.begin(), permutation.end());
  if (const auto known = index_.find(entries); known != index_.end()) {
    return known->second;
  }
  int sign = 1;
  for (std::size_t a = 0; a < size; ++a) {
    for (std::size_t b = a + 1; b < size; ++b) {
      sign = permutation[a] > permutation[b] ? -sign : sign;
    }
  }
  const auto at = index_.emplace(entries, static_cast<OrderId>(orders_.size())).first;
  orders_.push_back({std::move(entries), sign});
  return at->second;
}

// --------------------------------------------------------------------------------------------------------- archives

void VertexMaps::save(sparse::ArchiveWriter& to) const {
  to.put(static_cast<std::uint64_t>(orders_.size()));
  for (const Order& each : orders_) {
    to.put_list(each.permutation);
    if (each.type != none) {
      to.put(each.type);
      to.put(each.dart);
    }
  }
}

void VertexMaps::load(sparse::ArchiveReader& from) {
  const std::size_t count = from.get_count(sizeof(std::uint64_t));
  for (std::size_t k = 0; k < count && from.is_good(); ++k) {
    const auto permutation = from.get_list<std::vector<std::uint8_t>>();
    if (k > 0 && permutation.empty()) {
      const auto type = from.get<TypeId>();
      const auto dart = from.get<Dart>();
      from.check(type < types_.size() && types_.info(type).shape != nullptr && dart < types_.darts(type) &&
                     order_at(type, dart) == k,
                 "each dart from which a cell is seen is listed once");
      continue;
    }
    std::vector<std::uint8_t> sorted = permutation;
    std::sort(sorted.begin(), sorted.end());
    bool is_permutation = sorted.size() <= most_vertices;
    for (std::size_t at = 0; is_permutation && at < sorted.size(); ++at) {
      is_permutation = sorted[at] == at;
    }
    if (from.check(is_permutation, "an order is a permutation")) {
      from.check(order(permutation) == k, "each order is listed once");
    }
  }
}

bool VertexMaps::is_order_of(OrderId order, TypeId type) const {
  if (order == same_order) {
    return true;
  }
  if (order >= orders_.size()) {
    return false;
  }
  if (is_of_map(order) || ops::is_of_map(types_.info(type).type)) {
    return orders_[order].type == type;
  }
  if (is_by_boundary(types_.info(type).type)) {
    return false;
  }
  const auto places = permutation(order);
  std::size_t vertices = 0;
  bool keeps_to_components = true;
  for_each_component(types_.info(type).type, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end && k < places.size(); ++k) {
      keeps_to_components = keeps_to_components && places[k] >= begin && places[k] < end;
    }
    vertices = end;
  });
  return keeps_to_components && vertices == places.size();
}

bool VertexMaps::is_value_of(const Value& v, TypeId of_cell) const {
  if (v.type < types_.size() && ops::is_of_map(types_.info(v.type).type)) {
    return v.collapsed == 0 && (v.order == same_order ? v.type == of_cell
                                                      : is_order_of(v.order, of_cell) &&
                                                            types_.seen_from(of_cell, orders_[v.order].dart) == v.type);
  }
  if (v.type < types_.size() && is_by_boundary(types_.info(v.type).type)) {
    return v.is_plain() && v.type == of_cell;
  }
  if (v.type >= types_.size() || !is_order_of(v.order, v.type) || (v.collapsed >> types_.info(v.type).dimension) != 0) {
    return false;
  }
  CellType left;
  int direction = 0;
  for (const int a : types_.info(v.type).type) {
    int of_component = 0;
    for (int j = 0; j < a; ++j, ++direction) {
      of_component += (v.collapsed >> direction & 1) == 0 ? 1 : 0;
    }
    if (of_component > 0) {
      left.push_back(of_component);
    }
  }
  return left == types_.info(of_cell).type;
}

}  // namespace sesame::ops
