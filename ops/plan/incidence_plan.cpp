// Incidence graphs, which are orders of cells: by their cells, or by their chains.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ops/cells/map_cells.hpp"
#include "ops/cells/name_text.hpp"
#include "ops/maps/chain_of_surfaces.hpp"
#include "ops/maps/order_simplices.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

using sparse::quoted;
using Lists = std::vector<std::vector<OrderCell>>;
using Tuples = std::vector<std::vector<OrderCell>>;

/// The order of the cells that are listed, and their faces as they are listed.
struct Listed {
  Order order;
  Lists faces;
};

/// Reads the list.
class ListReader {
 public:
  explicit ListReader(const MakeIncidence& operation) : operation_{operation} {}

  Result<Listed> run() {
    if (Status s = index_cells(); !s) {
      return s.error();
    }
    Listed listed;
    for (std::size_t k = 0; k < operation_.cells.size(); ++k) {
      std::vector<OrderCell>& faces = listed.faces.emplace_back();
      for (const std::string_view id : operation_.cells.faces(k)) {
        const auto face = index_.find(id);
        if (face == index_.end()) {
          return Error{Errc::unknown_name,
                       fmt::format("cell {} of incidence graph {} names a face {} that is not listed there",
                                   quoted(operation_.cells.id(k)), quoted(operation_.name), quoted(id))};
        }
        faces.push_back(face->second);
      }
    }
    Result<Order> order = Order::make(listed.faces, [&](OrderCell x) { return quoted(operation_.cells.id(x)); });
    if (!order) {
      return Error{order.error().code,
                   fmt::format("{} is no incidence graph: {}", quoted(operation_.name), order.error().what)};
    }
    listed.order = std::move(*order);
    return listed;
  }

 private:
  Status index_cells() {
    for (std::size_t k = 0; k < operation_.cells.size(); ++k) {
      const std::string_view id = operation_.cells.id(k);
      if (!is_name(id)) {
        return Error{Errc::bad_input,
                     fmt::format("cell {} of incidence graph {} needs an id without white space or control characters",
                                 k + 1, quoted(operation_.name))};
      }
      if (!index_.emplace(id, static_cast<OrderCell>(k)).second) {
        return Error{Errc::bad_input, fmt::format("incidence graph {} lists cell {} twice: ids must differ",
                                                  quoted(operation_.name), quoted(id))};
      }
    }
    return Done{};
  }

  const MakeIncidence& operation_;
  std::unordered_map<std::string_view, OrderCell> index_;
};

Status check_names(const MakeIncidence& operation, const Structure& structure) {
  if (Status s = check_new_name(operation.name, structure); !s) {
    return s;
  }
  if (operation.cells.size() == 0) {
    return Error{Errc::bad_input,
                 fmt::format("{} has no cells: an incidence graph needs one at least", quoted(operation.name))};
  }
  return Done{};
}

Status check_free(const std::string& name, const Structure& structure) {
  return structure.is_name_taken(name)
             ? Status{Error{Errc::bad_input,
                            fmt::format("the name {} is in use: choose another name for the incidence graph or the "
                                        "cell",
                                        quoted(name))}}
             : Status{Done{}};
}

// ------------------------------------------------------------------------------------------------------------ by cells

/// Each cell as that of a map, its darts the cell-tuples up to it.
class CellsWriter {
 public:
  CellsWriter(const MakeIncidence& operation, const Listed& listed, const Structure& structure, Plan& plan)
      : operation_{operation}, listed_{listed}, order_{listed.order}, structure_{structure}, plan_{plan} {}

  Status run() {
    if (Status s = check_boundaries(order_, order_.principal_cells(), [&](OrderCell x) { return title(x); }); !s) {
      return as_advised(fmt::format("a cell has no surface as boundary: {}", s.error().what));
    }
    for (int i = 0; i <= order_.dimension(); ++i) {
      tuples_.push_back(cell_tuples(order_, i));
    }
    auto layers = cells_of_chain(chain_of_tuples(order_, tuples_),
                                 {[&](int i, Dart least) { return dart(first_tuple(cell(i, least))); },
                                  [&](int i, Dart least) { return fmt::format("cell {}", title(cell(i, least))); }},
                                 structure_.types());
    if (!layers) {
      return as_advised(layers.error().what);
    }
    layers_ = std::move(*layers);
    place_cells();
    write_darts();
    if (Status s = check_cell_names(); !s) {
      return s;
    }
    plan_.first = structure_.cells().size();
    std::ranges::for_each(by_place_, [&](OrderCell x) { write_cell(x); });
    return Done{};
  }

 private:
  [[nodiscard]] std::string title(OrderCell x) const { return quoted(operation_.cells.id(x)); }
  [[nodiscard]] Error as_advised(const std::string& what) const {
    return {Errc::refused, fmt::format("{}; make {} \"as\":\"simplices\"", what, quoted(operation_.name))};
  }

  [[nodiscard]] const Tuples& tuples(int i) const { return tuples_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] OrderCell cell(int i, Dart dart) const { return tuples(i)[dart].back(); }
  /// A cell with its first face, the first face of that, and so on: the dart that its name stands for.
  [[nodiscard]] std::vector<OrderCell> first_tuple(OrderCell x) const {
    std::vector<OrderCell> tuple{x};
    while (!listed_.faces[tuple.back()].empty()) {
      tuple.push_back(listed_.faces[tuple.back()].front());
    }
    std::ranges::reverse(tuple);
    return tuple;
  }
  [[nodiscard]] Dart dart(const std::vector<OrderCell>& tuple) const {
    const Tuples& all = tuples(static_cast<int>(tuple.size()) - 1);
    return static_cast<Dart>(std::ranges::lower_bound(all, tuple) - all.begin());
  }

  /// Those that are given, and those by darts.
  Status check_cell_names() const {
    std::string full = operation_.name + ".";
    const std::size_t base = full.size();
    const bool are_free = is_free_beginning(full, structure_, operation_.cells.size());
    const DartStore::Made darts{0, order_.dimension(), 0, 0, 0, plan_.map->cells, false};
    for (std::size_t k = 0; k < operation_.cells.size(); ++k) {
      const std::string_view id = operation_.cells.id(k);
      const std::string as_part = fmt::format("m.{}", id);
      const auto split = split_dart(as_part);
      if (split && split->length == 1 && dart_of_text(darts, split->dimension, split->dart) != no_dart) {
        return Error{Errc::bad_input,
                     fmt::format("a cell of {} cannot have the id {}, which with its name stands for the cell that a "
                                 "dart sees: choose another",
                                 quoted(operation_.name), quoted(id))};
      }
      full.replace(base, std::string::npos, id);
      if (Status s = are_free ? Done{} : check_free(full, structure_); !s) {
        return s;
      }
    }
    for (int i = 0; i <= order_.dimension() && !are_free; ++i) {
      for (std::size_t d = 0; d < tuples(i).size(); ++d) {
        full.replace(base, std::string::npos, fmt::format("{}:{}", i, d));
        if (Status s = check_free(full, structure_); !s) {
          return s;
        }
      }
    }
    return Done{};
  }

  /// By dimension, then as they are listed.
  void place_cells() {
    by_place_.resize(order_.size());
    std::iota(by_place_.begin(), by_place_.end(), OrderCell{0});
    std::ranges::stable_sort(by_place_, {}, [&](OrderCell x) { return order_.rank(x); });
    places_.resize(order_.size());
    for (std::uint32_t k = 0; k < by_place_.size(); ++k) {
      places_[by_place_[k]] = k;
    }
  }

  void write_cell(OrderCell x) {
    const int i = order_.rank(x);
    const CellsOfMap& layer = layers_[static_cast<std::size_t>(i)];
    const Dart named = dart(first_tuple(x));
    const std::uint32_t number = layer.orbits.of[named];
    const std::size_t first_face = plan_.faces.size();
    for (const auto& [face, seen_from] : layer.faces_of(number)) {
      const CellsOfMap& below = layers_[static_cast<std::size_t>(i) - 1];
      add_face({plan_.first + places_[cell(i - 1, below.orbits.first[face])],
                structure_.maps().order_at(below.types[face], seen_from)},
               plan_);
    }
    if (const Dart place = layer.places[named]; place != 0) {
      plan_.name_orders.emplace_back(places_[x], structure_.maps().order_at(layer.types[number], place));
    }
    plan_.names.append(operation_.name).append(1, '.').append(operation_.cells.id(x));
    add_cell(layer.types[number], first_face, plan_);
  }

  void write_darts() {
    auto cells = std::make_shared<DartCells>();
    for (int i = 0; i <= order_.dimension(); ++i) {
      cells->of.emplace_back();
      for (Dart d = 0; d < tuples(i).size(); ++d) {
        cells->of.back().push_back({places_[cell(i, d)], layers_[static_cast<std::size_t>(i)].places[d]});
      }
    }
    plan_.map = {{}, std::move(cells)};
  }

  const MakeIncidence& operation_;
  const Listed& listed_;
  const Order& order_;
  const Structure& structure_;
  Plan& plan_;
  std::vector<Tuples> tuples_;         // by dimension of their last cells
  std::vector<CellsOfMap> layers_;     // their darts are the tuples
  std::vector<OrderCell> by_place_;    // the new cells one after the other
  std::vector<std::uint32_t> places_;  // where in these a cell is
};

// -------------------------------------------------------------------------------------------------------- by simplices

/// How many chains there are; at most `most` + 1.
std::int64_t count_of_chains(const Order& order, std::int64_t most) {
  std::vector<OrderCell> upwards(order.size());
  std::iota(upwards.begin(), upwards.end(), OrderCell{0});
  std::ranges::stable_sort(upwards, {}, [&](OrderCell x) { return order.rank(x); });
  std::vector<std::int64_t> below(order.size(), 1);  // chains whose largest cell it is
  std::int64_t all = 0;
  for (const OrderCell x : upwards) {
    for (const OrderCell y : order.boundary(x)) {
      below[x] = std::min(most + 1, below[x] + below[y]);
    }
    all = std::min(most + 1, all + below[x]);
  }
  return all;
}

Status plan_by_simplices(const MakeIncidence& operation, const Order& order, const Structure& structure,
                         const Limits& limits, Plan& plan) {
  if (Status s = check_room(count_of_chains(order, limits.cells), structure, limits); !s) {
    return s;
  }
  for (std::size_t k = 0; k < operation.cells.size(); ++k) {
    if (operation.cells.id(k).find('<') != std::string_view::npos) {
      return Error{Errc::bad_input,
                   fmt::format("the id {} of a cell of {} has a \"<\", which parts the cells in names of chains, such "
                               "as {}.<v<e>: choose another",
                               quoted(operation.cells.id(k)), quoted(operation.name), operation.name)};
    }
  }
  const NumberedSet set = simplicial_analogue(order);
  const std::string beginning = operation.name + ".<";
  const auto name = [&](int p, SimplexNumber simplex) {
    std::vector<std::string_view> ids;
    for (const SimplexNumber x : set.vertices(p, simplex)) {
      ids.push_back(operation.cells.id(x));
    }
    return fmt::format("{}{}>", beginning, fmt::join(ids, "<"));
  };
  const bool are_free = is_free_beginning(beginning, structure, operation.cells.size());
  for (int p = 0; p <= set.dimension() && !are_free; ++p) {
    for (SimplexNumber simplex = 0; simplex < set.count(p); ++simplex) {
      if (Status s = check_free(name(p, simplex), structure); !s) {
        return s;
      }
    }
  }
  plan.first = structure.cells().size();
  CellId first_below = none;
  for (int p = 0; p <= set.dimension(); ++p) {
    const CellId first_here = plan.first + plan.cells.size();
    for (SimplexNumber simplex = 0; simplex < set.count(p); ++simplex) {
      const std::size_t first_face = plan.faces.size();
      for (std::size_t k = 0; p > 0 && k <= static_cast<std::size_t>(p); ++k) {
        add_face({first_below + set.faces(p, simplex)[k], same_order}, plan);
      }
      plan.names.append(name(p, simplex));
      add_cell(structure.types().simplex(p), first_face, plan);
    }
    first_below = first_here;
  }
  return Done{};
}

}  // namespace

Status plan_incidence(const MakeIncidence& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  if (Status s = check_names(operation, structure); !s) {
    return s;
  }
  const Result<Listed> listed = ListReader(operation).run();
  if (!listed) {
    return listed.error();
  }
  if (Status s = check_room(static_cast<std::int64_t>(operation.cells.size()), structure, limits); !s) {
    return s;
  }
  plan.new_body = operation.name;
  return operation.as_simplices ? plan_by_simplices(operation, listed->order, structure, limits, plan)
                                : CellsWriter(operation, *listed, structure, plan).run();
}

}  // namespace sesame::ops
