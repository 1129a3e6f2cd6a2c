#include "tools/mesh/graph.hpp"

#include <boost/pending/disjoint_sets.hpp>
#include <numeric>

namespace sesame::tools {

// Boost.Graph's incremental components: union-find over plain arrays. Its connected_components() needs an adjacency
// list, which took ten times as long here to fill as everything else in `validate` together.
Parts connected_parts(std::size_t nodes, const std::vector<Edge>& links) {
  std::vector<std::uint32_t> rank(nodes, 0);
  std::vector<std::uint32_t> parent(nodes);
  std::iota(parent.begin(), parent.end(), 0U);
  boost::disjoint_sets<std::uint32_t*, std::uint32_t*> sets{rank.data(), parent.data()};
  for (const auto& [a, b] : links) {
    sets.union_set(a, b);
  }

  constexpr auto unnumbered = static_cast<std::uint32_t>(-1);
  Parts parts;
  std::vector<std::uint32_t> number_of(nodes, unnumbered);
  parts.of.reserve(nodes);
  for (std::uint32_t node = 0; node < nodes; ++node) {
    auto& number = number_of[sets.find_set(node)];
    if (number == unnumbered) {
      number = static_cast<std::uint32_t>(parts.count++);
    }
    parts.of.push_back(number);
  }
  return parts;
}

}  // namespace sesame::tools
