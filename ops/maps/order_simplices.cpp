#include "ops/maps/order_simplices.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "ops/maps/cell_errors.hpp"

namespace sesame::ops {
namespace {

using Chains = std::vector<std::vector<OrderCell>>;

/// The chains of one cell more, in lexicographic order as those given are.
Chains extended(const Chains& chains, const Chains& above) {
  Chains longer;
  for (const std::vector<OrderCell>& chain : chains) {
    for (const OrderCell x : above[chain.back()]) {
      longer.push_back(chain);
      longer.back().push_back(x);
    }
  }
  return longer;
}

/// Per chain the places of those with one cell less.
std::vector<std::vector<SimplexNumber>> faces_of(const Chains& chains, const Chains& shorter) {
  std::vector<std::vector<SimplexNumber>> faces;
  for (const std::vector<OrderCell>& chain : chains) {
    std::vector<SimplexNumber>& places = faces.emplace_back();
    for (std::size_t k = 0; k < chain.size(); ++k) {
      std::vector<OrderCell> rest = chain;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
      places.push_back(static_cast<SimplexNumber>(std::ranges::lower_bound(shorter, rest) - shorter.begin()));
    }
  }
  return faces;
}

/// That each simplex of `all`, which has at least those of `set`, is one of that.
Status check_simplices(const NumberedSet& set, const NumberedSet& all) {
  for (int p = 1; p <= all.dimension(); ++p) {
    if (set.count(p) == all.count(p)) {
      continue;
    }
    std::set<std::vector<SimplexNumber>> known;
    for (SimplexNumber s = 0; s < set.count(p); ++s) {
      known.insert(set.vertices(p, s));
    }
    for (SimplexNumber s = 0; s < all.count(p); ++s) {
      if (!known.contains(all.vertices(p, s))) {
        return refused_cells(
            fmt::format("no order has these cells: of the cells {} each lies below the next one, but no simplex "
                        "has them all",
                        fmt::join(all.vertices(p, s), ", ")));
      }
    }
  }
  return Done{};
}

}  // namespace

NumberedSet simplicial_analogue(const Order& order) {
  std::vector<int> numbers;
  Chains above;
  Chains chains;
  for (OrderCell x = 0; x < order.size(); ++x) {
    numbers.push_back(order.rank(x));
    above.push_back(order.strict_star(x));
    chains.push_back({x});
  }
  NumberedSet::Faces faces;
  while (!chains.empty()) {
    Chains longer = extended(chains, above);
    faces.push_back(faces_of(longer, chains));
    chains = std::move(longer);
  }
  return std::move(*NumberedSet::make(std::move(numbers), std::move(faces)));
}

Result<Order> order_of_cells(const NumberedSet& set) {
  if (const auto twice = set.multi_incidence()) {
    return refused_cells(fmt::format(
        "no order has these cells: the cells {} are incident more than once, by the {}-simplices {} "
        "and {}",
        fmt::join(set.vertices(twice->dimension, twice->one), ", "), twice->dimension, twice->one, twice->other));
  }
  std::vector<std::vector<OrderCell>> faces(set.count(0));
  for (SimplexNumber edge = 0; edge < set.count(1); ++edge) {
    const std::vector<SimplexNumber>& cells = set.vertices(1, edge);
    if (set.number_of_vertex(cells[0]) + 1 == set.number_of_vertex(cells[1])) {
      faces[cells[1]].push_back(cells[0]);
    }
  }
  Order order = std::move(*Order::make(std::move(faces)));
  if (Status s = check_simplices(set, simplicial_analogue(order)); !s) {
    return s.error();
  }
  return order;
}

Order order_of_simplices(const NumberedSet& set) {
  std::vector<std::vector<OrderCell>> faces(set.count(0));
  OrderCell below = 0;  // how many come before those of the dimension below
  for (int p = 1; p <= set.dimension(); ++p) {
    for (SimplexNumber s = 0; s < set.count(p); ++s) {
      std::vector<OrderCell>& cells = faces.emplace_back();
      std::ranges::transform(set.faces(p, s), std::back_inserter(cells),
                             [&](SimplexNumber face) { return below + face; });
    }
    below += set.count(p - 1);
  }
  return std::move(*Order::make(std::move(faces)));
}

}  // namespace sesame::ops
