#include "ops/cells/cell_order.hpp"

#include <algorithm>

namespace sesame::ops {

void sort_by_dimension_and_age(const Structure& structure, std::vector<CellId>& cells) {
  std::sort(cells.begin(), cells.end(), [&structure](CellId a, CellId b) {
    const int p = structure.dimension(a), q = structure.dimension(b);
    return p != q ? p < q : structure.lazy().is_older(structure.forest().oldest(a), structure.forest().oldest(b));
  });
}

}  // namespace sesame::ops
