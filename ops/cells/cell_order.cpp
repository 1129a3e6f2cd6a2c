#include "ops/cells/cell_order.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace sesame::ops {

namespace {

/// The same where ages are ids: cells are put into a list of all nodes, by their oldest members, and read off it.
void distribute(const Structure& structure, std::vector<CellId>& cells) {
  std::vector<CellId> by_age(structure.cells().size(), none);
  std::array<std::size_t, largest_dimension + 2> next{};  // per dimension: where its cells begin
  for (const CellId c : cells) {
    by_age[structure.forest().oldest(c)] = c;
    ++next[static_cast<std::size_t>(structure.dimension(c)) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (const CellId c : by_age) {
    if (c != none) {
      cells[next[static_cast<std::size_t>(structure.dimension(c))]++] = c;
    }
  }
}

}  // namespace

void sort_by_dimension_and_age(const Structure& structure, std::vector<CellId>& cells) {
  constexpr std::size_t most_nodes = 8;  // for each cell
  if (structure.lazy().families() == 0 && structure.cells().size() / most_nodes <= cells.size()) {
    return distribute(structure, cells);
  }
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
