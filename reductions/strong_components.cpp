// The only file of this folder that includes Boost.Graph.
#include "reductions/strong_components.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/strong_components.hpp>

namespace sesame::reductions {

std::vector<std::vector<sparse::Index>> strong_components(const std::vector<std::vector<sparse::Index>>& successors) {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;
  Graph graph(successors.size());
  for (std::size_t v = 0; v < successors.size(); ++v) {
    for (const sparse::Index w : successors[v]) {
      boost::add_edge(v, w, graph);
    }
  }
  // Tarjan's algorithm finishes a component when everything that it leads to is finished: its numbers are the order.
  std::vector<std::size_t> number(successors.size());
  const std::size_t count = boost::strong_components(
      graph, boost::make_iterator_property_map(number.begin(), get(boost::vertex_index, graph)));
  std::vector<std::vector<sparse::Index>> components(count);
  for (std::size_t v = 0; v < successors.size(); ++v) {
    components[number[v]].push_back(static_cast<sparse::Index>(v));
  }
  return components;
}

}  // namespace sesame::reductions
