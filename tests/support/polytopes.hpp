/// \file
/// Orders of the faces of polytopes, and the operations that make orders and chains of maps.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ops/maps/chain_of_maps.hpp"
#include "ops/maps/order_operations.hpp"
#include "ops/vocabulary/operation.hpp"
#include "tests/support/random_complexes.hpp"

namespace sesame::tests {

/// The faces of each cell.
using FacesOfCells = std::vector<std::vector<ops::OrderCell>>;

inline ops::Order made_order(FacesOfCells faces) { return std::move(*ops::Order::make(std::move(faces))); }
inline FacesOfCells faces_of(const ops::Order& order) {
  FacesOfCells faces;
  for (ops::OrderCell x = 0; x < order.size(); ++x) {
    faces.push_back(order.faces(x));
  }
  return faces;
}

/// The cells (x, y), those of the first x first.
inline ops::Order product_of(const ops::Order& a, const ops::Order& b) {
  FacesOfCells faces;
  for (ops::OrderCell x = 0; x < a.size(); ++x) {
    for (ops::OrderCell y = 0; y < b.size(); ++y) {
      std::vector<ops::OrderCell>& own = faces.emplace_back();
      for (const ops::OrderCell face : a.faces(x)) {
        own.push_back(face * b.size() + y);
      }
      for (const ops::OrderCell face : b.faces(y)) {
        own.push_back(x * b.size() + face);
      }
    }
  }
  return made_order(std::move(faces));
}

/// Those of the second after those of the first.
inline ops::Order beside(const ops::Order& a, const ops::Order& b) {
  FacesOfCells faces = faces_of(a);
  for (std::vector<ops::OrderCell> own : faces_of(b)) {
    for (ops::OrderCell& x : own) {
      x += a.size();
    }
    faces.push_back(std::move(own));
  }
  return made_order(std::move(faces));
}

/// With one cell over all.
inline ops::Order filled(const ops::Order& order) {
  std::vector<ops::OrderCell> all;
  for (ops::OrderCell x = 0; x < order.size(); ++x) {
    all.push_back(x);
  }
  return std::move(*ops::cellular_cone(order, std::move(all)));
}
/// Without its last cell.
inline ops::Order boundary_of(const ops::Order& order) {
  FacesOfCells faces = faces_of(order);
  faces.pop_back();
  return made_order(std::move(faces));
}
/// Of the boundary of a polytope: its dual.
inline ops::Order dual_of(const ops::Order& order) {
  FacesOfCells faces;
  for (ops::OrderCell x = 0; x < order.size(); ++x) {
    faces.push_back(order.cofaces(x));
  }
  return made_order(std::move(faces));
}

inline ops::Order edge_order() { return made_order({{}, {}, {0, 1}}); }
/// With sides >= 2; the face is the last cell.
inline ops::Order polygon_order(ops::OrderCell sides) {
  FacesOfCells faces(sides);
  for (ops::OrderCell k = 0; k < sides; ++k) {
    faces.push_back({k, (k + 1) % sides});
  }
  return filled(made_order(std::move(faces)));
}
/// Each proper face of a cell, and the cell, again as the cone over it from a new vertex; the pyramid is the last cell.
inline ops::Order pyramid_over(const ops::Order& order) {
  FacesOfCells faces = faces_of(order);
  const auto apex = static_cast<ops::OrderCell>(faces.size());
  faces.emplace_back();
  for (ops::OrderCell x = 0; x < order.size(); ++x) {
    std::vector<ops::OrderCell>& own = faces.emplace_back();
    own.push_back(x);
    if (order.rank(x) == 0) {
      own.push_back(apex);
    }
    for (const ops::OrderCell face : order.faces(x)) {
      own.push_back(apex + 1 + face);
    }
  }
  return made_order(std::move(faces));
}
inline ops::Order cube_order(int dimension) {
  ops::Order cube = edge_order();
  for (int k = 1; k < dimension; ++k) {
    cube = product_of(cube, edge_order());
  }
  return cube;
}

/// A polytope of dimension 2 to 4, whose last cell is the whole: simplices, cubes, their duals, prisms, pyramids.
inline ops::Order random_polytope(Random& random) {
  ops::Order polytope = polygon_order(static_cast<ops::OrderCell>(random.in(2, 5)));
  for (int more = random.in(0, 1); more > 0; --more) {
    polytope = random.one_in(2) ? pyramid_over(polytope) : product_of(polytope, edge_order());
  }
  if (random.one_in(8)) {
    polytope = random.one_in(2) ? cube_order(4) : pyramid_over(polytope);
  }
  return random.one_in(3) ? filled(dual_of(boundary_of(polytope))) : polytope;
}

/// Cell x is called "cx". Faces are listed in a random order.
inline ops::MakeIncidence make_order(const std::string& name, const ops::Order& order, bool as_simplices,
                                     Random* random = nullptr) {
  ops::MakeIncidence op{name, {}, as_simplices};
  for (ops::OrderCell x = 0; x < order.size(); ++x) {
    std::vector<std::string> faces;
    for (const ops::OrderCell face : order.faces(x)) {
      faces.push_back("c" + std::to_string(face));
    }
    for (std::size_t k = 1; random != nullptr && k < faces.size(); ++k) {
      std::swap(faces[k], faces[static_cast<std::size_t>(random->in(0, static_cast<int>(k)))]);
    }
    op.cells.push_back({"c" + std::to_string(x), {}, std::move(faces), {}});
  }
  return op;
}

inline ops::MakeChainOfMaps make_chain(const std::string& name, const ops::ChainOfMaps& chain,
                                       bool as_simplices = false) {
  ops::MakeChainOfMaps op{name, chain.level(0).size(), {}, as_simplices};
  for (int i = 1; i <= chain.dimension(); ++i) {
    op.levels.push_back({chain.level(i).involutions(), chain.faces()[static_cast<std::size_t>(i) - 1]});
  }
  return op;
}

/// The i-cell of a dart of level i.
inline std::string seen_cell(const std::string& name, int i, ops::Dart d) {
  return name + "." + std::to_string(i) + ":" + std::to_string(d);
}

}  // namespace sesame::tests
