/// \file
/// Degenerate cells the plain way, as lists of vertices: what the bit arithmetic of ops/ is tested against.
#pragma once

#include <algorithm>
#include <compare>
#include <map>
#include <set>
#include <vector>

#include "ops/cells/structure.hpp"

namespace sesame::tests {

/// A cell underneath, and per component of the value's own type the vertex of that component of the cell to which each
/// vertex goes: from 0 on, without a gap, never down. A component of the value that goes to one vertex is none of the
/// cell's.
struct PlainValue {
  ops::CellId cell = ops::none;
  std::vector<std::vector<int>> maps;
  friend auto operator<=>(const PlainValue&, const PlainValue&) = default;

  [[nodiscard]] ops::CellType type() const {
    ops::CellType type;
    for (const auto& map : maps) {
      type.push_back(static_cast<int>(map.size()) - 1);
    }
    return type;
  }
  [[nodiscard]] int dimension() const {
    int dimension = 0;
    for (const auto& map : maps) {
      dimension += static_cast<int>(map.size()) - 1;
    }
    return dimension;
  }
  [[nodiscard]] ops::CellType type_underneath() const {
    ops::CellType type;
    for (const auto& map : maps) {
      if (map.back() > 0) {
        type.push_back(map.back());
      }
    }
    return type;
  }
  [[nodiscard]] bool is_degenerate() const { return type() != type_underneath(); }
  [[nodiscard]] ops::Degeneracy collapsed() const {
    ops::Degeneracy set = 0;
    int direction = 0;
    for (const auto& map : maps) {
      for (std::size_t v = 1; v < map.size(); ++v, ++direction) {
        set |= ops::Degeneracy{map[v] == map[v - 1]} << direction;
      }
    }
    return set;
  }
};

inline PlainValue plain_value(ops::CellId cell, const ops::CellType& type, ops::Degeneracy collapsed = 0) {
  PlainValue value{cell, {}};
  int direction = 0;
  for (const int a : type) {
    std::vector<int> map{0};
    for (int j = 0; j < a; ++j, ++direction) {
      map.push_back(map.back() + ((collapsed >> direction & 1) == 0 ? 1 : 0));
    }
    value.maps.push_back(std::move(map));
  }
  return value;
}
inline PlainValue plain_value(const ops::Structure& structure, const ops::Value& v) {
  return plain_value(v.cell, structure.types().info(v.type).type, v.collapsed);
}

/// The value whose vertices are those of `outer`, sent on by `inner`: `inner` is what the cell of `outer` is.
inline PlainValue composed(PlainValue outer, const PlainValue& inner) {
  std::size_t component = 0;
  for (auto& map : outer.maps) {
    if (map.back() > 0) {
      for (int& vertex : map) {
        vertex = inner.maps[component][static_cast<std::size_t>(vertex)];
      }
      ++component;
    }
  }
  outer.cell = inner.cell;
  return outer;
}

/// Vertex j of component i (from 0) twice.
inline PlainValue doubled(PlainValue value, std::size_t i, std::size_t j) {
  auto& map = value.maps[i];
  const int vertex = map[j];
  map.insert(map.begin() + static_cast<std::ptrdiff_t>(j), vertex);
  return value;
}
/// The product with a point, taken for an edge, as component i.
inline PlainValue thickened(PlainValue value, std::size_t i) {
  value.maps.insert(value.maps.begin() + static_cast<std::ptrdiff_t>(i), std::vector<int>{0, 0});
  return value;
}

/// Without vertex j of component i. `face_of(cell, k)` is face k of the cell underneath, a value.
template <class FaceOf>
PlainValue plain_face(PlainValue value, std::size_t i, std::size_t j, FaceOf face_of) {
  auto& map = value.maps[i];
  const int vertex = map[j];
  map.erase(map.begin() + static_cast<std::ptrdiff_t>(j));
  const bool is_missed = std::find(map.begin(), map.end(), vertex) == map.end();
  std::uint32_t number = 0;
  if (is_missed) {
    for (std::size_t before = 0; before < i; ++before) {
      const int b = value.maps[before].back();
      number += b == 0 ? 0U : static_cast<std::uint32_t>(b) + 1;
    }
    number += static_cast<std::uint32_t>(vertex);
    for (int& v : map) {
      v -= v > vertex ? 1 : 0;
    }
  }
  if (map.size() == 1) {
    value.maps.erase(value.maps.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return is_missed ? composed(value, face_of(value.cell, number)) : value;
}

/// Component and vertex of face k of a type, in the flattened order.
inline std::pair<std::size_t, std::size_t> face_at(const ops::CellType& type, std::uint32_t k) {
  std::size_t component = 0;
  while (k > static_cast<std::uint32_t>(type[component])) {
    k -= static_cast<std::uint32_t>(type[component++]) + 1;
  }
  return {component, k};
}
inline std::uint32_t number_of_faces(const ops::CellType& type) {
  std::uint32_t number = 0;
  for (const int a : type) {
    number += static_cast<std::uint32_t>(a) + 1;
  }
  return number;
}
template <class FaceOf>
PlainValue plain_face(const PlainValue& value, std::uint32_t k, FaceOf face_of) {
  const auto [component, vertex] = face_at(value.type(), k);
  return plain_face(value, component, vertex, face_of);
}

/// Every value of one more dimension that is degenerate over this one.
inline std::vector<PlainValue> degeneracies(const PlainValue& value) {
  std::vector<PlainValue> all;
  for (std::size_t i = 0; i <= value.maps.size(); ++i) {
    all.push_back(thickened(value, i));
    for (std::size_t j = 0; i < value.maps.size() && j < value.maps[i].size(); ++j) {
      all.push_back(doubled(value, i, j));
    }
  }
  return all;
}

/// A value and all that is degenerate over it, up to a dimension.
inline std::set<PlainValue> with_degeneracies(const PlainValue& value, int most) {
  std::set<PlainValue> all{value};
  std::vector<PlainValue> pending{value};
  while (!pending.empty()) {
    const PlainValue next = pending.back();
    pending.pop_back();
    if (next.dimension() < most) {
      for (PlainValue& degenerate : degeneracies(next)) {
        if (all.insert(degenerate).second) {
          pending.push_back(std::move(degenerate));
        }
      }
    }
  }
  return all;
}

/// Every list of integers >= 1 with this sum: the types of this dimension.
inline std::vector<ops::CellType> types_of_dimension(int dimension) {
  if (dimension == 0) {
    return {{}};
  }
  std::vector<ops::CellType> types;
  for (int first = 1; first <= dimension; ++first) {
    for (const ops::CellType& rest : types_of_dimension(dimension - first)) {
      ops::CellType type{first};
      type.insert(type.end(), rest.begin(), rest.end());
      types.push_back(std::move(type));
    }
  }
  return types;
}

inline std::vector<ops::CellType> types_up_to_dimension(int dimension) {
  std::vector<ops::CellType> types;
  for (int p = 0; p <= dimension; ++p) {
    for (ops::CellType& type : types_of_dimension(p)) {
      types.push_back(std::move(type));
    }
  }
  return types;
}

}  // namespace sesame::tests
