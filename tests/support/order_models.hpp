/// \file
/// Orders of cells, random ones, and surfaces by their definition.
#pragma once

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "ops/maps/order_simplices.hpp"
#include "tests/support/cell_models.hpp"

namespace sesame::tests {

/// Some cells of an order, as the literal definitions of surfaces take them.
using CellSet = std::vector<ops::OrderCell>;

/// An order by the faces of its cells.
inline ops::Order order_of(std::vector<CellSet> faces) { return std::move(*ops::Order::make(std::move(faces))); }

inline bool are_comparable(const ops::Order& order, ops::OrderCell x, ops::OrderCell y) {
  return std::ranges::binary_search(order.strict_adherence(x), y);
}

/// Whether the order of some cells is a surface of dimension n: by the recursive definition, word by word.
inline bool is_literally_a_surface(const ops::Order& order, const CellSet& cells, int n) {
  if (n == 0) {
    return cells.size() == 2 && !are_comparable(order, cells[0], cells[1]);
  }
  if (cells.empty()) {
    return false;
  }
  CellSet met{cells.front()};
  for (std::size_t at = 0; at < met.size(); ++at) {
    for (const ops::OrderCell x : cells) {
      if (are_comparable(order, met[at], x) && std::ranges::find(met, x) == met.end()) {
        met.push_back(x);
      }
    }
  }
  return met.size() == cells.size() && std::ranges::all_of(cells, [&](ops::OrderCell x) {
           CellSet beside;
           std::ranges::copy_if(cells, std::back_inserter(beside),
                                [&](ops::OrderCell y) { return are_comparable(order, x, y); });
           return is_literally_a_surface(order, beside, n - 1);
         });
}

/// The order of the simplices of a random complex on at most six vertices: closed, and seldom pure.
inline ops::Order random_order(Random& random) {
  std::set<std::set<int>> simplices;
  const int vertices = random.in(1, 6);
  for (int k = random.in(1, 5); k > 0; --k) {
    std::set<int> simplex;
    for (int size = random.in(1, 4); size > 0; --size) {
      simplex.insert(random.in(1, vertices));
    }
    const std::vector<int> list(simplex.begin(), simplex.end());
    for (std::size_t bits = 1; bits < std::size_t{1} << list.size(); ++bits) {
      std::set<int> face;
      for (std::size_t at = 0; at < list.size(); ++at) {
        if ((bits >> at & 1U) != 0) {
          face.insert(list[at]);
        }
      }
      simplices.insert(face);
    }
  }
  const std::vector<std::set<int>> cells(simplices.begin(), simplices.end());
  std::vector<CellSet> faces(cells.size());
  for (ops::OrderCell x = 0; x < cells.size(); ++x) {
    for (ops::OrderCell y = 0; y < cells.size(); ++y) {
      if (cells[y].size() + 1 == cells[x].size() && std::ranges::includes(cells[x], cells[y])) {
        faces[x].push_back(y);
      }
    }
  }
  return order_of(std::move(faces));
}

/// A surface of any object: the order of the simplices of a random closed map.
inline ops::Order random_surface(Random& random) {
  const int dimension = random.in(0, 9);
  if (dimension == 0) {
    return order_of({{}, {}});
  }
  const ops::GMap map = dimension == 1   ? closed_polygon(static_cast<ops::Dart>(random.in(1, 5)))
                        : dimension == 2 ? random_cubes(random, 1)
                                         : random_surface_map(random, random.in(1, 5), true);
  return ops::order_of_simplices(ops::simplicial_analogue(map));
}

}  // namespace sesame::tests
