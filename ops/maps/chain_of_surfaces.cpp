#include "ops/maps/chain_of_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "ops/maps/cell_errors.hpp"
#include "ops/maps/order_simplices.hpp"

namespace sesame::ops {
namespace {

using Tuples = std::vector<std::vector<OrderCell>>;

/// Per tuple the place of the one without its last cell.
std::vector<Dart> places_without_last(const Tuples& tuples, const Tuples& shorter) {
  std::vector<Dart> places;
  for (std::vector<OrderCell> tuple : tuples) {
    tuple.pop_back();
    places.push_back(static_cast<Dart>(std::ranges::lower_bound(shorter, tuple) - shorter.begin()));
  }
  return places;
}

Status check_closed(const ChainOfMaps& chain) {
  for (int i = 1; i <= chain.dimension(); ++i) {
    for (int j = 0; j < i; ++j) {
      for (Dart d = 0; d < chain.level(i).size(); ++d) {
        if (chain.level(i).is_free(j, d)) {
          return refused_cells(
              fmt::format("dart {} of level {} is {}-free: a chain of surfaces has cells whose boundaries have "
                          "no boundary, so each dart has another one by alpha_{}",
                          d, i, j, j));
        }
      }
    }
  }
  return Done{};
}

/// That an order has a cell and is connected.
Status check_connected(const Order& order) {
  if (order.size() == 0) {
    return refused_cells("a chain of surfaces has a cell");
  }
  if (!order.is_connected()) {
    return refused_cells("the cells are not connected: those of a chain of surfaces are");
  }
  return Done{};
}

}  // namespace

Status check_chain_of_surfaces(const Order& order) {
  if (Status s = check_connected(order); !s) {
    return s;
  }
  return check_boundaries(order, order.principal_cells());
}

ChainOfMaps chain_of_tuples(const Order& order, const std::vector<Tuples>& tuples) {
  std::vector<GMap> levels;
  std::vector<std::vector<Dart>> sigma;
  for (std::size_t i = 0; i < tuples.size(); ++i) {
    if (i == 0) {
      levels.push_back(GMap::points(static_cast<Dart>(tuples[0].size())));
      continue;
    }
    std::vector<std::vector<Dart>> alpha;
    for (std::size_t j = 0; j < i; ++j) {
      alpha.push_back(switches(order, tuples[i], j));
    }
    levels.push_back(std::move(*GMap::make(std::move(alpha))));
    sigma.push_back(places_without_last(tuples[i], tuples[i - 1]));
  }
  return std::move(*ChainOfMaps::make(std::move(levels), std::move(sigma)));
}

Result<ChainOfMaps> chain_of_maps_of_surfaces(const Order& order) {
  if (Status s = check_chain_of_surfaces(order); !s) {
    return s.error();
  }
  std::vector<Tuples> tuples;
  for (int i = 0; i <= order.dimension(); ++i) {
    tuples.push_back(cell_tuples(order, i));
  }
  return chain_of_tuples(order, tuples);
}

Result<Order> chain_of_surfaces_of_maps(const ChainOfMaps& chain) {
  if (Status s = check_closed(chain); !s) {
    return s.error();
  }
  Result<Order> order = order_of_cells(simplicial_analogue(chain));
  if (!order) {
    return order;
  }
  if (Status s = check_connected(*order); !s) {
    return s.error();
  }
  return order;
}

}  // namespace sesame::ops
