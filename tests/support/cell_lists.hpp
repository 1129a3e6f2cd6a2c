/// \file
/// Lists of cells as tests want them.
#pragma once

#include <cstddef>

#include "ops/vocabulary/cell_list.hpp"

namespace sesame::tests {

/// The same cells, the last one first.
inline ops::CellList reversed(const ops::CellList& cells) {
  ops::CellList other;
  for (std::size_t k = cells.size(); k-- > 0;) {
    other.push_back(cells[k]);
  }
  return other;
}

}  // namespace sesame::tests
