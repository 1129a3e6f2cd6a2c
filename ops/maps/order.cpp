#include "ops/maps/order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "ops/maps/cell_errors.hpp"
#include "ops/maps/gmap.hpp"

namespace sesame::ops {
namespace {

using Lists = std::vector<std::vector<OrderCell>>;

/// What steps along lists reach from a cell, which is met first; increasing.
std::vector<OrderCell> reached(const Lists& steps, OrderCell start) {
  std::vector<bool> met(steps.size(), false);
  std::vector<OrderCell> found{start};
  met[start] = true;
  for (std::size_t at = 0; at < found.size(); ++at) {
    for (const OrderCell next : steps[found[at]]) {
      if (!met[next]) {
        met[next] = true;
        found.push_back(next);
      }
    }
  }
  std::ranges::sort(found);
  return found;
}

std::vector<OrderCell> without(std::vector<OrderCell> cells, OrderCell x) {
  cells.erase(std::ranges::lower_bound(cells, x));
  return cells;
}

std::vector<OrderCell> united(const std::vector<OrderCell>& a, const std::vector<OrderCell>& b) {
  std::vector<OrderCell> cells;
  std::ranges::set_union(a, b, std::back_inserter(cells));
  return cells;
}

/// A cell below itself, among cells each of which has a face without a rank.
OrderCell on_a_cycle(const Lists& faces, const std::vector<int>& ranks, OrderCell start) {
  std::vector<bool> met(faces.size(), false);
  for (OrderCell x = start;; x = *std::ranges::find_if(faces[x], [&](OrderCell y) { return ranks[y] < 0; })) {
    if (met[x]) {
      return x;
    }
    met[x] = true;
  }
}

}  // namespace

std::string number_of_cell(OrderCell x) { return std::to_string(x); }

Result<Order> Order::make(std::vector<std::vector<OrderCell>> faces, const OrderCellName& name) {
  Order order;
  order.faces_ = std::move(faces);
  if (Status s = order.check_lists(name); !s) {
    return s.error();
  }
  if (Status s = order.find_ranks(name); !s) {
    return s.error();
  }
  if (Status s = order.check_jumps(name); !s) {
    return s.error();
  }
  return order;
}

Status Order::check_lists(const OrderCellName& name) {
  cofaces_.resize(faces_.size());
  for (OrderCell x = 0; x < size(); ++x) {
    std::ranges::sort(faces_[x]);
    if (!faces_[x].empty() && faces_[x].back() >= size()) {
      return bad_cells(
          fmt::format("cell {} has the face {}, but there are only {} cells", name(x), faces_[x].back(), size()));
    }
    if (const auto twice = std::ranges::adjacent_find(faces_[x]); twice != faces_[x].end()) {
      return bad_cells(
          fmt::format("cell {} has the face {} twice: in an order a cell is a face once", name(x), name(*twice)));
    }
    for (const OrderCell y : faces_[x]) {
      cofaces_[y].push_back(x);
    }
  }
  return Done{};
}

/// A cell has its rank once all its faces have theirs.
Status Order::find_ranks(const OrderCellName& name) {
  ranks_.assign(faces_.size(), -1);
  std::vector<std::size_t> missing;
  std::vector<OrderCell> ready;
  for (OrderCell x = 0; x < size(); ++x) {
    missing.push_back(faces_[x].size());
    if (faces_[x].empty()) {
      ready.push_back(x);
    }
  }
  for (std::size_t at = 0; at < ready.size(); ++at) {
    const OrderCell x = ready[at];
    for (const OrderCell y : faces_[x]) {
      ranks_[x] = std::max(ranks_[x], ranks_[y]);
    }
    dimension_ = std::max(dimension_, ++ranks_[x]);
    for (const OrderCell z : cofaces_[x]) {
      if (--missing[z] == 0) {
        ready.push_back(z);
      }
    }
  }
  if (const auto lost = std::ranges::find(ranks_, -1); lost != ranks_.end()) {
    const auto start = static_cast<OrderCell>(lost - ranks_.begin());
    return bad_cells(fmt::format("cell {} lies below itself, by its faces and theirs: no cell may",
                                 name(on_a_cycle(faces_, ranks_, start))));
  }
  if (dimension_ > largest_map_dimension) {
    return bad_cells(fmt::format("cell {} has the dimension {}: at most {} is possible", name(ready.back()),
                                 rank(ready.back()), largest_map_dimension));
  }
  return Done{};
}

Status Order::check_jumps(const OrderCellName& name) const {
  for (OrderCell x = 0; x < size(); ++x) {
    for (const OrderCell y : faces_[x]) {
      if (rank(y) + 1 == rank(x)) {
        continue;
      }
      for (const OrderCell z : faces_[x]) {
        if (z != y && std::ranges::binary_search(closure(z), y)) {
          return bad_cells(
              fmt::format("cell {} has the face {}, which lies below its face {}: only cells next below it are faces",
                          name(x), name(y), name(z)));
        }
      }
      return bad_cells(
          fmt::format("there is a jump in dimension from cell {} of dimension {} to its face {} of dimension {}",
                      name(x), rank(x), name(y), rank(y)));
    }
  }
  return Done{};
}

std::vector<std::uint32_t> Order::f_vector() const {
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(dimension_ + 1));
  for (const int rank : ranks_) {
    ++counts[static_cast<std::size_t>(rank)];
  }
  return counts;
}

std::vector<OrderCell> Order::neighbours(OrderCell x) const { return united(faces_[x], cofaces_[x]); }

std::vector<OrderCell> Order::closure(OrderCell x) const { return reached(faces_, x); }
std::vector<OrderCell> Order::boundary(OrderCell x) const { return without(closure(x), x); }
std::vector<OrderCell> Order::star(OrderCell x) const { return reached(cofaces_, x); }
std::vector<OrderCell> Order::strict_star(OrderCell x) const { return without(star(x), x); }
std::vector<OrderCell> Order::adherence(OrderCell x) const { return united(closure(x), star(x)); }
std::vector<OrderCell> Order::strict_adherence(OrderCell x) const { return without(adherence(x), x); }

std::vector<OrderCell> Order::principal_cells() const {
  std::vector<OrderCell> cells;
  for (OrderCell x = 0; x < size(); ++x) {
    if (cofaces_[x].empty()) {
      cells.push_back(x);
    }
  }
  return cells;
}

bool Order::is_pure() const {
  return std::ranges::all_of(principal_cells(), [&](OrderCell x) { return rank(x) == dimension_; });
}

bool Order::is_connected() const {
  if (size() == 0) {
    return true;
  }
  Lists steps(size());
  for (OrderCell x = 0; x < size(); ++x) {
    steps[x] = neighbours(x);
  }
  return reached(steps, 0).size() == size();
}

}  // namespace sesame::ops
