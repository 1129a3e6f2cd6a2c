#include "ops/cells/cell_order.hpp"

#include <algorithm>

namespace sesame::ops {

void sort_by_dimension_and_age(const Structure& structure, std::vector<CellId>& cells) {
  struct Aged {
    int dimension;
    CellId oldest, cell;
  };
  std::vector<Aged> aged;
  aged.reserve(cells.size());
  for (const CellId c : cells) {
    aged.push_back({structure.dimension(c), structure.forest().oldest(c), c});
  }
  std::sort(aged.begin(), aged.end(), [&structure](const Aged& a, const Aged& b) {
    return a.dimension != b.dimension ? a.dimension < b.dimension : structure.lazy().is_older(a.oldest, b.oldest);
  });
  std::transform(aged.begin(), aged.end(), cells.begin(), [](const Aged& a) { return a.cell; });
}

}  // namespace sesame::ops
