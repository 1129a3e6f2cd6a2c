#include "ops/maps/surface_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "ops/maps/cell_errors.hpp"
#include "ops/maps/order_simplices.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// The cells between two cells, either of which may be fictive.
class Section {
 public:
  Section(const Order& order, const OrderCellName& name)
      : order_{order}, name_{name}, below_(order.size(), false), between_(order.size(), false) {}

  /// Takes the cells below one, or all, into account from now on.
  void set_high(OrderCell high) {
    high_ = high;
    members_ = high == no_order_cell ? all() : order_.boundary(high);
    below_.assign(order_.size(), false);
    for (const OrderCell x : members_) {
      below_[x] = true;
    }
  }
  [[nodiscard]] const std::vector<OrderCell>& members() const { return members_; }

  /// What is wrong with the section from a cell, or from the fictive one, up to the cell set.
  [[nodiscard]] Status check(OrderCell low) {
    const int gap = rank(high_, order_.dimension() + 1) - rank(low, -1);
    if (gap < 2) {
      return Done{};
    }
    const std::vector<OrderCell> cells = low == no_order_cell ? members_ : above(low);
    if (gap == 2 && cells.size() != 2) {
      return refused_cells(fmt::format("{} the number of cells of dimension {} is {}: in a surface it is 2", place(low),
                                       rank(low, -1) + 1, cells.size()));
    }
    if (gap > 2) {
      for (const OrderCell x : cells) {
        between_[x] = true;
      }
      const OrderCell apart = not_connected(cells);
      if (apart != no_order_cell) {
        return refused_cells(
            fmt::format("{} the cells are not connected, such as cells {} and {}: in a surface they are", place(low),
                        name_(cells.front()), name_(apart)));
      }
    }
    return Done{};
  }

 private:
  [[nodiscard]] int rank(OrderCell x, int of_fictive) const { return x == no_order_cell ? of_fictive : order_.rank(x); }

  [[nodiscard]] std::vector<OrderCell> all() const {
    std::vector<OrderCell> cells(order_.size());
    for (OrderCell x = 0; x < order_.size(); ++x) {
      cells[x] = x;
    }
    return cells;
  }

  [[nodiscard]] std::string place(OrderCell low) const {
    if (low == no_order_cell) {
      return high_ == no_order_cell ? "in the whole" : fmt::format("below cell {}", name_(high_));
    }
    return high_ == no_order_cell ? fmt::format("above cell {}", name_(low))
                                  : fmt::format("between cell {} and cell {}", name_(low), name_(high_));
  }

  /// The members above a cell.
  [[nodiscard]] std::vector<OrderCell> above(OrderCell low) const {
    std::vector<OrderCell> cells = order_.strict_star(low);
    std::erase_if(cells, [&](OrderCell x) { return !below_[x]; });
    return cells;
  }

  /// A cell marked as between that steps to neighbours do not reach from the first one; marks are taken away.
  OrderCell not_connected(const std::vector<OrderCell>& cells) {
    std::vector<OrderCell> found;
    const auto meet = [&](OrderCell x) {
      if (between_[x]) {
        between_[x] = false;
        found.push_back(x);
      }
    };
    meet(cells.front());
    for (std::size_t at = 0; at < found.size(); ++at) {
      std::ranges::for_each(order_.faces(found[at]), meet);
      std::ranges::for_each(order_.cofaces(found[at]), meet);
    }
    OrderCell apart = no_order_cell;
    for (const OrderCell x : cells) {
      apart = between_[x] && apart == no_order_cell ? x : apart;
      between_[x] = false;
    }
    return apart;
  }

  const Order& order_;
  const OrderCellName& name_;
  OrderCell high_ = no_order_cell;
  std::vector<OrderCell> members_;
  std::vector<bool> below_;
  std::vector<bool> between_;
};

/// All sections up to a cell.
Status check_up_to(Section& section, OrderCell high) {
  section.set_high(high);
  if (Status s = section.check(no_order_cell); !s) {
    return s;
  }
  for (const OrderCell low : section.members()) {
    if (Status s = section.check(low); !s) {
      return s;
    }
  }
  return Done{};
}

Status check_closed(const GMap& map) {
  for (int i = 0; i <= map.dimension(); ++i) {
    for (Dart d = 0; d < map.size(); ++d) {
      if (map.is_free(i, d)) {
        return refused_cells(
            fmt::format("dart {} is {}-free: a surface has no boundary, so each dart has another one by "
                        "alpha_{}",
                        d, i, i));
      }
    }
  }
  return Done{};
}

}  // namespace

Status check_boundaries(const Order& order, const std::vector<OrderCell>& cells, const OrderCellName& name) {
  std::vector<bool> met(order.size(), false);
  Section section(order, name);
  for (const OrderCell x : cells) {
    for (const OrderCell y : order.closure(x)) {
      if (!met[y]) {
        met[y] = true;
        if (Status s = check_up_to(section, y); !s) {
          return s;
        }
      }
    }
  }
  return Done{};
}

Status check_surface(const Order& order) {
  if (order.size() == 0) {
    return refused_cells("an order without a cell is no surface: one of dimension 0 has two cells");
  }
  const std::vector<OrderCell> principal = order.principal_cells();
  for (const OrderCell x : principal) {
    if (order.rank(x) != order.dimension()) {
      return refused_cells(
          fmt::format("cell {} of dimension {} is no face: in a surface of dimension {} all cells of smaller "
                      "dimensions are",
                      x, order.rank(x), order.dimension()));
    }
  }
  if (Status s = check_boundaries(order, principal); !s) {
    return s;
  }
  const OrderCellName name = number_of_cell;
  Section section(order, name);
  return check_up_to(section, no_order_cell);
}

OrderCell switched(const Order& order, OrderCell low, OrderCell x, OrderCell high) {
  std::vector<OrderCell> cells;
  if (low != no_order_cell && high != no_order_cell) {
    std::ranges::set_intersection(order.cofaces(low), order.faces(high), std::back_inserter(cells));
  } else if (high != no_order_cell) {
    cells = order.faces(high);
  } else if (low != no_order_cell) {
    cells = order.cofaces(low);
  } else {
    cells = order.principal_cells();
  }
  sparse::expects(cells.size() == 2 && (cells[0] == x || cells[1] == x), "a switch is between two cells");
  return cells[0] == x ? cells[1] : cells[0];
}

std::vector<std::vector<OrderCell>> cell_tuples(const Order& order, int i) {
  std::vector<std::vector<OrderCell>> tuples;
  for (OrderCell x = 0; x < order.size(); ++x) {
    if (order.rank(x) == 0) {
      tuples.push_back({x});
    }
  }
  for (int length = 0; length < i; ++length) {
    std::vector<std::vector<OrderCell>> longer;
    for (const std::vector<OrderCell>& tuple : tuples) {
      for (const OrderCell x : order.cofaces(tuple.back())) {
        longer.push_back(tuple);
        longer.back().push_back(x);
      }
    }
    tuples = std::move(longer);
  }
  return tuples;
}

std::vector<Dart> switches(const Order& order, const std::vector<std::vector<OrderCell>>& tuples, std::size_t j) {
  std::vector<Dart> places;
  for (std::vector<OrderCell> tuple : tuples) {
    const OrderCell low = j == 0 ? no_order_cell : tuple[j - 1];
    const OrderCell high = j + 1 == tuple.size() ? no_order_cell : tuple[j + 1];
    tuple[j] = switched(order, low, tuple[j], high);
    places.push_back(static_cast<Dart>(std::ranges::lower_bound(tuples, tuple) - tuples.begin()));
  }
  return places;
}

Result<GMap> gmap_of_surface(const Order& surface) {
  if (Status s = check_surface(surface); !s) {
    return s.error();
  }
  const std::vector<std::vector<OrderCell>> tuples = cell_tuples(surface, surface.dimension());
  std::vector<std::vector<Dart>> alpha;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(surface.dimension()); ++i) {
    alpha.push_back(switches(surface, tuples, i));
  }
  return GMap::make(std::move(alpha));
}

Result<Order> surface_of_gmap(const GMap& map) {
  if (map.dimension() < 0 || map.size() == 0) {
    return refused_cells("a map without involutions or without darts is no surface");
  }
  if (Status s = check_closed(map); !s) {
    return s.error();
  }
  const Orbits parts = components(map);
  if (parts.count() != 1) {
    return refused_cells(
        fmt::format("the map is not connected: nothing leads from dart {} to dart {}, and a surface is", parts.first[0],
                    parts.first[1]));
  }
  return order_of_cells(simplicial_analogue(map));
}

}  // namespace sesame::ops
