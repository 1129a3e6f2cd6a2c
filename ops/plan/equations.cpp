#include "ops/plan/equations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "ops/cells/cone_parts.hpp"
#include "ops/plan/step_names.hpp"

namespace sesame::ops {
namespace {

/// Is a list the numbers from 0 to `last` in some order?
bool is_permutation(std::vector<int> list, int last) {
  std::sort(list.begin(), list.end());
  std::vector<int> numbers(static_cast<std::size_t>(last) + 1);
  std::iota(numbers.begin(), numbers.end(), 0);
  return list == numbers;
}

/// A vertex has no component, but a list with its one vertex is allowed for it.
bool is_vertex_map(const Identify::Map& map, const CellType& type) {
  return (type.empty() && map == Identify::Map{{0}}) ||
         std::equal(map.begin(), map.end(), type.begin(), type.end(), is_permutation);
}

/// A vertex map as an order of the vertices of a type.
Result<OrderId> order_of(const Identify::Map& map, TypeId id, const Structure& structure) {
  const CellType& type = structure.types().info(id).type;
  if (is_of_map(type)) {
    return Error{Errc::bad_input, fmt::format("a {} has no vertex map: name it by the dart that is to meet that of the "
                                              "other name",
                                              describe(type))};
  }
  if (is_by_boundary(type)) {
    return Error{Errc::bad_input, fmt::format("a {} has no vertex map: it is glued face by face", describe(type))};
  }
  if (!is_vertex_map(map, type)) {
    return Error{Errc::bad_input,
                 fmt::format("a vertex map of a {} {}", describe(type),
                             type.size() > 1 ? "has a list for each component, each a permutation of its "
                                               "vertices, which are counted from 0"
                                             : "is a permutation of its vertices, which are counted from 0")};
  }
  std::vector<std::uint8_t> permutation;
  for (std::size_t i = 0; i < type.size(); ++i) {
    const std::size_t before = permutation.size();
    for (const int k : map[i]) {
      permutation.push_back(static_cast<std::uint8_t>(before + static_cast<std::size_t>(k)));
    }
  }
  return structure.maps().order(permutation);
}

/// Does a cell of this type have the direction that it is to be squashed along?
Status check_direction(const Degenerate& operation, const CellType& type) {
  const auto wrong = [](std::string what) { return Error{Errc::bad_input, std::move(what)}; };
  const std::string& name = operation.cell;
  if (!is_simploid(type)) {
    return wrong(fmt::format("\"{}\" is a {}: only simploids have directions along which they can be squashed", name,
                             describe(type)));
  }
  if (type.empty()) {
    return wrong(fmt::format("\"{}\" is a vertex, which has no face to be squashed onto", name));
  }
  if (!operation.component && type.size() > 1) {
    return wrong(
        fmt::format("\"{}\" is a {}: \"along\" should be [i,j], the component i counted from 1", name, describe(type)));
  }
  const int component = operation.component.value_or(1);
  if (component < 1 || component > static_cast<int>(type.size())) {
    return wrong(fmt::format("\"{}\" is a {}: its components are 1 to {}", name, describe(type), type.size()));
  }
  const int size = type[static_cast<std::size_t>(component) - 1];
  if (operation.index < 0 || operation.index >= size) {
    return wrong(fmt::format("\"{}\" is a {}: the index \"along\" which it is squashed should be from 0 to {}", name,
                             describe(type), size - 1));
  }
  return Done{};
}

}  // namespace

Result<std::vector<Equation>> equations_of(const Identify& operation, const Structure& structure) {
  std::vector<Equation> equations;
  equations.reserve(operation.pairs.size());
  for (std::size_t k = 0; k < operation.pairs.size(); ++k) {
    const auto& [one, other] = operation.pairs[k];
    const Result<Value> a = resolve_cell(one, structure);
    Result<Value> b = resolve_cell(other, structure);
    if (!a || !b) {
      return a ? b.error() : a.error();
    }
    if (a->type != b->type) {
      TypeTable& types = structure.types();
      if (types.canonical(a->type).type == types.canonical(b->type).type) {
        return Error{Errc::refused, fmt::format("\"{}\" and \"{}\" are cells alike, but not as seen from these darts: "
                                                "no isomorphism takes the one dart to the other",
                                                one, other)};
      }
      return Error{Errc::refused,
                   fmt::format("\"{}\" is a {} and \"{}\" a {}: only cells of the same type can be identified", one,
                               describe(types.info(a->type).type), other, describe(types.info(b->type).type))};
    }
    if (const auto map = operation.maps.find(k); map != operation.maps.end()) {
      const Result<OrderId> order = order_of(map->second, a->type, structure);
      if (!order) {
        return order.error();
      }
      b = structure.maps().reordered(*order, *b);
    }
    equations.emplace_back(*a, *b);
    const std::vector<CellId> parts = cone_parts(structure, a->cell);
    const std::vector<CellId> others = cone_parts(structure, b->cell);
    if (is_cone_part(structure.cells().type(a->cell).type) || parts.size() != others.size()) {
      return Error{Errc::refused,
                   fmt::format("\"{}\" and \"{}\" are cells that are no balls, or parts of such, and not "
                               "alike: they cannot be identified",
                               one, other)};
    }
    for (std::size_t part = 0; part < parts.size(); ++part) {
      if (structure.cells().type_id(parts[part]) != structure.cells().type_id(others[part])) {
        return Error{
            Errc::refused,
            fmt::format("\"{}\" and \"{}\" are no balls, and not alike: they cannot be identified", one, other)};
      }
      equations.emplace_back(structure.values().plain(parts[part]), structure.values().plain(others[part]));
    }
  }
  return equations;
}

Result<std::vector<Equation>> equations_of(const Degenerate& operation, const Structure& structure) {
  const Result<Value> cell = resolve_cell(operation.cell, structure);
  if (!cell) {
    return cell.error();
  }
  const CellType& type = structure.types().info(cell->type).type;
  if (Status s = check_direction(operation, type); !s) {
    return s.error();
  }
  const int component = operation.component.value_or(1) - 1;
  const Value face = structure.values().face(*cell, face_number(type, component, operation.index));
  const Value squashed{none, cell->type, Degeneracy{1} << direction_number(type, component, operation.index)};
  return std::vector<Equation>{{*cell, structure.maps().compose(squashed, face)}};
}

}  // namespace sesame::ops
