#include "ops/cells/cone_parts.hpp"

#include <algorithm>
#include <cstdint>

namespace sesame::ops {

std::vector<CellId> cone_parts(const Structure& structure, CellId cell) {
  std::vector<CellId> parts;
  if (is_cone(structure.cells().type(cell).type)) {
    for (std::uint32_t node = cell; node > 0 && is_cone_part(structure.cells().type(CellId{node - 1}).type); --node) {
      parts.push_back(structure.find(CellId{node - 1}));
    }
    std::ranges::reverse(parts);
  }
  return parts;
}

CellId whole_of_part(const Structure& structure, CellId part) {
  CellId whole = part;
  while (is_cone_part(structure.cells().type(whole).type)) {
    ++whole;
  }
  return structure.find(whole);
}

std::vector<CellId> with_parts(const Structure& structure, const std::vector<CellId>& cells) {
  std::vector<CellId> all;
  all.reserve(cells.size());
  for (const CellId cell : cells) {
    const CellType& type = structure.cells().type(cell).type;
    if (is_cone(type)) {
      const std::vector<CellId> parts = cone_parts(structure, cell);
      all.insert(all.end(), parts.begin(), parts.end());
    }
    if (!is_cone_part(type)) {
      all.push_back(cell);
    }
  }
  return all;
}

}  // namespace sesame::ops
