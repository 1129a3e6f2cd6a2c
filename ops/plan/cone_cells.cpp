#include "ops/plan/cone_cells.hpp"

#include <fmt/format.h>

#include "ops/cells/cofaces.hpp"

namespace sesame::ops {

Status check_part_names(const ConeShape& shape, const std::string& name, const Structure& structure) {
  for (std::size_t k = 1; k < shape.generators.size(); ++k) {
    if (const std::string part = fmt::format("{}~{}", name, k); structure.is_name_taken(part)) {
      return Error{
          Errc::bad_input,
          fmt::format("the name \"{}\" is in use, and would be one of a part of the new cell \"{}\"", part, name)};
    }
  }
  return Done{};
}

Status check_cofaces(CellId cell, const std::unordered_set<CellId>& known, std::string_view what,
                     const Structure& structure) {
  for (const CellId coface : cofaces(structure, cell)) {
    const CellType& type = structure.cells().type(coface).type;
    if (!known.contains(coface) && !is_cone(type) && !is_cone_part(type)) {
      return Error{Errc::refused, fmt::format("\"{}\" is a face of \"{}\", which is no cell of its map: {} would tear "
                                              "that; remove it first",
                                              structure.name(cell), structure.name(coface), what)};
    }
  }
  return Done{};
}

std::string name_of_whole(const std::string& part) { return part.substr(0, part.rfind('~')); }

std::vector<CellId> cone_parts(const Structure& structure, CellId cell) {
  std::vector<CellId> parts;
  if (!is_cone(structure.cells().type(cell).type)) {
    return parts;
  }
  const std::string name = structure.name(cell);
  for (std::size_t k = 1; true; ++k) {
    const auto part = structure.directory().find(fmt::format("{}~{}", name, k));
    if (!part || part->cell == none || !structure.is_current(structure.find(part->cell))) {
      return parts;
    }
    parts.push_back(structure.find(part->cell));
  }
}

Status check_no_cone(CellId cell, std::string_view what, const Structure& structure) {
  const CellType& type = structure.cells().type(cell).type;
  return is_cone(type) || is_cone_part(type)
             ? Error{Errc::refused, fmt::format("\"{}\" is a {}: {} is possible of other cells only; make the map "
                                                "\"as\":\"simplices\"",
                                                structure.name(cell), describe(type), what)}
             : Status{Done{}};
}

}  // namespace sesame::ops
