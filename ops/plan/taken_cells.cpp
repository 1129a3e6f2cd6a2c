#include "ops/plan/taken_cells.hpp"

#include <unordered_set>

#include "ops/cells/cell_order.hpp"
#include "ops/cells/cofaces.hpp"

namespace sesame::ops {

std::optional<std::vector<CellId>> open_star(const Structure& structure, std::vector<CellId> cells, std::size_t most) {
  std::unordered_set<CellId> known(cells.begin(), cells.end());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    for (const CellId coface : cofaces(structure, cells[k])) {
      if (known.insert(coface).second) {
        cells.push_back(coface);
      }
    }
    if (cells.size() > most) {
      return std::nullopt;
    }
  }
  return cells;
}

void add_deletions(std::vector<CellId> cells, const Structure& structure, Plan& plan) {
  sort_by_dimension_and_age(structure, cells);
  plan.deletions.assign(cells.rbegin(), cells.rend());
  for (const CellId cell : plan.deletions) {
    if (structure.abstract().contains(cell) && structure.bodies().kind(structure.body_of(cell)).is_abstract) {
      if (!plan.abstract) {
        plan.abstract.emplace();
      }
      plan.abstract->excluded.push_back(cell);
    }
  }
}

}  // namespace sesame::ops
