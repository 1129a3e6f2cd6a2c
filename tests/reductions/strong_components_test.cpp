#include "reductions/strong_components.hpp"

#include <algorithm>
#include <vector>

#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame;
using sparse::Index;

namespace {

using Graph = std::vector<std::vector<Index>>;

/// reaches[v][w]: there is a path from v to w, the empty one included. By transitive closure: the plain twin.
std::vector<std::vector<bool>> closure(const Graph& successors) {
  const std::size_t n = successors.size();
  std::vector<std::vector<bool>> reaches(n, std::vector<bool>(n));
  for (std::size_t v = 0; v < n; ++v) {
    reaches[v][v] = true;
    for (const Index w : successors[v]) {
      reaches[v][w] = true;
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t v = 0; v < n; ++v) {
      for (std::size_t w = 0; w < n; ++w) {
        reaches[v][w] = reaches[v][w] || (reaches[v][k] && reaches[k][w]);
      }
    }
  }
  return reaches;
}

Graph random_graph(sparse::Random& random, Index n, Index edges) {
  Graph successors(n);
  for (Index k = 0; n > 0 && k < edges; ++k) {
    successors[sparse::below(random, n)].push_back(sparse::below(random, n));
  }
  return successors;
}

}  // namespace

TEST_CASE("strong_components: the vertices that reach one another, and what they lead to first", "[reductions][twin]") {
  sparse::Random random{GENERATE(range(0U, 100U))};
  const Index n = sparse::below(random, 12);
  const Graph graph = random_graph(random, n, sparse::below(random, 2 * n + 1));
  const auto reaches = closure(graph);
  const auto components = reductions::strong_components(graph);
  std::vector<std::size_t> component_of(n, components.size());
  std::size_t vertices = 0;
  for (std::size_t k = 0; k < components.size(); ++k) {
    CHECK_FALSE(components[k].empty());
    CHECK(std::is_sorted(components[k].begin(), components[k].end()));
    for (const Index v : components[k]) {
      component_of[v] = k;
      ++vertices;
    }
  }
  REQUIRE(vertices == n);
  for (Index v = 0; v < n; ++v) {
    REQUIRE(component_of[v] < components.size());
    for (Index w = 0; w < n; ++w) {
      CHECK((component_of[v] == component_of[w]) == (reaches[v][w] && reaches[w][v]));
      CHECK((!reaches[v][w] || component_of[w] <= component_of[v]));
    }
  }
}

TEST_CASE("strong_components: a long cycle is one, a long path is many", "[reductions]") {
  constexpr Index n = 10'000;
  Graph path(n);
  for (Index v = 0; v + 1 < n; ++v) {
    path[v] = {v + 1};
  }
  const auto apart = reductions::strong_components(path);
  REQUIRE(apart.size() == n);
  CHECK(apart.front() == std::vector<Index>{n - 1});
  path[n - 1] = {0};
  CHECK(reductions::strong_components(path).size() == 1);
  CHECK(reductions::strong_components({}).empty());
}
