#include "ops/maps/order_operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "ops/maps/cell_errors.hpp"

namespace sesame::ops {
namespace {

Status check_cells(const Order& order, const std::vector<OrderCell>& cells) {
  const auto wrong = std::ranges::find_if(cells, [&](OrderCell x) { return x >= order.size(); });
  if (wrong != cells.end()) {
    return bad_cells(fmt::format("there is no cell {}, only {} cells", *wrong, order.size()));
  }
  return Done{};
}

void sort_each_once(std::vector<OrderCell>& cells) {
  std::ranges::sort(cells);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

bool contains(const std::vector<OrderCell>& sorted, OrderCell x) { return std::ranges::binary_search(sorted, x); }

/// Those of some cells that lie next below another one, when only these count.
std::vector<OrderCell> faces_within(const Order& order, const std::vector<OrderCell>& cells, OrderCell x) {
  std::vector<OrderCell> below;
  std::ranges::set_intersection(order.boundary(x), cells, std::back_inserter(below));
  std::vector<OrderCell> faces = below;
  for (const OrderCell y : below) {
    const std::vector<OrderCell> lower = order.boundary(y);
    std::erase_if(faces, [&](OrderCell z) { return contains(lower, z); });
  }
  return faces;
}

/// The cell that each is merged with; itself when it is not paired.
Result<std::vector<OrderCell>> partners(const Order& order, std::span<const std::pair<OrderCell, OrderCell>> pairs) {
  std::vector<OrderCell> partner(order.size());
  std::iota(partner.begin(), partner.end(), OrderCell{0});
  std::vector<bool> is_first(order.size(), false);
  std::vector<bool> is_second(order.size(), false);
  for (const auto& [one, other] : pairs) {
    if (Status s = check_cells(order, {one, other}); !s) {
      return s.error();
    }
    if (is_first[one] || is_second[other]) {
      return bad_cells(fmt::format("cell {} is paired twice: each cell has one that corresponds to it",
                                   is_first[one] ? one : other));
    }
    is_first[one] = is_second[other] = true;
    partner[one] = other;
  }
  return partner;
}

Status check_isomorphism(const Order& order, std::span<const std::pair<OrderCell, OrderCell>> pairs,
                         const std::vector<OrderCell>& partner) {
  for (const auto& [one, other] : pairs) {
    std::vector<OrderCell> found;
    std::ranges::transform(order.faces(one), std::back_inserter(found), [&](OrderCell y) { return partner[y]; });
    std::ranges::sort(found);
    if (found == order.faces(other)) {
      continue;
    }
    std::vector<OrderCell> without_match;
    std::ranges::set_symmetric_difference(found, order.faces(other), std::back_inserter(without_match));
    return refused_cells(
        fmt::format("cells {} and {} cannot be identified: their faces do not correspond at cell {}, since the "
                    "pairs are no isomorphism of closures",
                    one, other, without_match.front()));
  }
  return Done{};
}

/// Per cell the least one that it is merged with.
std::vector<OrderCell> merged(const Order& order, std::span<const std::pair<OrderCell, OrderCell>> pairs) {
  std::vector<OrderCell> parent(order.size());
  std::iota(parent.begin(), parent.end(), OrderCell{0});
  const auto root = [&](OrderCell x) {
    while (parent[x] != x) {
      x = parent[x] = parent[parent[x]];
    }
    return x;
  };
  for (const auto& [one, other] : pairs) {
    const auto [least, greatest] = std::minmax({root(one), root(other)});
    parent[greatest] = least;
  }
  for (OrderCell x = 0; x < order.size(); ++x) {
    parent[x] = root(x);
  }
  return parent;
}

}  // namespace

Result<Suborder> suborder(const Order& order, std::vector<OrderCell> cells) {
  if (Status s = check_cells(order, cells); !s) {
    return s.error();
  }
  sort_each_once(cells);
  std::vector<OrderCell> upwards = cells;
  std::ranges::stable_sort(upwards, {}, [&](OrderCell x) { return order.rank(x); });
  std::vector<int> ranks(order.size(), 0);
  std::vector<std::vector<OrderCell>> faces(cells.size());
  for (const OrderCell x : upwards) {
    const std::vector<OrderCell> next = faces_within(order, cells, x);
    for (const OrderCell y : next) {
      ranks[x] = std::max(ranks[x], ranks[y] + 1);
    }
    for (const OrderCell y : next) {
      if (ranks[y] + 1 != ranks[x]) {
        return refused_cells(
            fmt::format("these cells have a jump in dimension among them: cell {} has the rank {} there, and "
                        "cell {} next below it the rank {}",
                        x, ranks[x], y, ranks[y]));
      }
      faces[static_cast<std::size_t>(std::ranges::lower_bound(cells, x) - cells.begin())].push_back(
          static_cast<OrderCell>(std::ranges::lower_bound(cells, y) - cells.begin()));
    }
  }
  return Suborder{std::move(*Order::make(std::move(faces))), std::move(cells)};
}

Result<Order> cellular_cone(const Order& order, std::vector<OrderCell> base) {
  if (Status s = check_cells(order, base); !s) {
    return s.error();
  }
  sort_each_once(base);
  std::vector<OrderCell> principal;
  for (const OrderCell x : base) {
    for (const OrderCell y : order.faces(x)) {
      if (!contains(base, y)) {
        return bad_cells(
            fmt::format("a cone over cell {} is one over its face {}, too, which is not in the base", x, y));
      }
    }
    if (std::ranges::none_of(order.cofaces(x), [&](OrderCell z) { return contains(base, z); })) {
      principal.push_back(x);
    }
  }
  const auto by_rank = [&](OrderCell x) { return order.rank(x); };
  if (!principal.empty()) {
    const auto [low, high] = std::ranges::minmax_element(principal, {}, by_rank);
    if (order.rank(*low) != order.rank(*high)) {
      return refused_cells(
          fmt::format("the base is not pure: cell {} of dimension {} and cell {} of dimension {} are no faces "
                      "within it, so from the cone, of dimension {}, there would be a jump to cell {}",
                      *high, order.rank(*high), *low, order.rank(*low), order.rank(*high) + 1, *low));
    }
  }
  std::vector<std::vector<OrderCell>> faces;
  for (OrderCell x = 0; x < order.size(); ++x) {
    faces.push_back(order.faces(x));
  }
  faces.push_back(std::move(principal));
  return Order::make(std::move(faces));
}

Result<IdentifiedOrder> identify_cells(const Order& order, std::span<const std::pair<OrderCell, OrderCell>> pairs) {
  const Result<std::vector<OrderCell>> partner = partners(order, pairs);
  if (!partner) {
    return partner.error();
  }
  if (Status s = check_isomorphism(order, pairs, *partner); !s) {
    return s.error();
  }
  const std::vector<OrderCell> least = merged(order, pairs);
  IdentifiedOrder identified;
  OrderCell count = 0;
  for (OrderCell x = 0; x < order.size(); ++x) {
    identified.image.push_back(least[x] == x ? count++ : identified.image[least[x]]);
  }
  std::vector<std::vector<OrderCell>> faces(count);
  for (OrderCell x = 0; x < order.size(); ++x) {
    if (least[x] == x) {  // cells merged with it have the same faces now
      std::vector<OrderCell>& images = faces[identified.image[x]];
      std::ranges::transform(order.faces(x), std::back_inserter(images),
                             [&](OrderCell y) { return identified.image[y]; });
      sort_each_once(images);
    }
  }
  identified.order = std::move(*Order::make(std::move(faces)));
  return identified;
}

}  // namespace sesame::ops
