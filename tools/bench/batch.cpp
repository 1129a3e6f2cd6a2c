// Objects that are made in one step.
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "tools/bench/constructions.hpp"
#include "tools/bench/filtrations.hpp"

namespace sesame::tools {

Operations klein_bottle_at_once(std::uint32_t n) {
  ops::MakeComplex complex{"K", {}};
  // Left and right sides are glued straight, lower and upper ones with the opposite direction.
  const auto vertex = [n](std::uint32_t x, std::uint32_t y) { return y == n ? (n - x) % n * n : x % n * n + y; };
  for (std::uint32_t v = 0; v < n * n; ++v) {
    complex.cells.push_back({"v" + std::to_string(v), {}, {}, {}});
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> edges;
  const auto edge = [&](std::uint32_t a, std::uint32_t b) {  // from the vertex of the smaller number
    std::string& name = edges[{a, b}];
    if (name.empty()) {
      name = "e" + std::to_string(a) + "-" + std::to_string(b);
      complex.cells.push_back({name, {}, {"v" + std::to_string(b), "v" + std::to_string(a)}, {}});
    }
    return name;
  };
  std::size_t triangles = 0;
  for (std::uint32_t x = 0; x < n; ++x) {
    for (std::uint32_t y = 0; y < n; ++y) {
      const std::uint32_t low = vertex(x, y), high = vertex(x + 1, y + 1);
      for (const std::uint32_t middle : {vertex(x + 1, y), vertex(x, y + 1)}) {
        std::array<std::uint32_t, 3> v{low, middle, high};
        std::sort(v.begin(), v.end());
        std::vector<std::string> faces{edge(v[1], v[2]), edge(v[0], v[2]), edge(v[0], v[1])};
        complex.cells.push_back({"t" + std::to_string(triangles++), {}, std::move(faces), {}});
      }
    }
  }
  return {std::move(complex)};
}

Operations rips_at_once(std::uint32_t points, std::size_t cells, std::uint64_t seed) {
  const Filtration rips = rips_filtration(points, cells, seed);
  ops::Insert insert{{}, false};
  for (std::size_t k = 0; k < rips.size(); ++k) {
    insert.simplices.begin_list();
    for (const std::uint32_t v : rips.vertices[k]) {
      insert.simplices.add(std::to_string(v));
    }
  }
  return {std::move(insert)};
}

}  // namespace sesame::tools
