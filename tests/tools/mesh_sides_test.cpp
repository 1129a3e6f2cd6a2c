// That loops bound where they are said to, asked of the homology of what is inside and of what is outside.
#include <algorithm>
#include <memory>
#include <random>
#include <string>

#include "engine/engine.hpp"
#include "tests/tools/mesh_checks.hpp"
#include "tests/tools/space_shapes.hpp"
#include "tools/mesh/graph.hpp"
#include "tools/mesh/incidence.hpp"

namespace sesame::tools {

namespace {

/// Tetrahedra of cubes, and all that is asked of them.
class Solid {
 public:
  explicit Solid(const std::vector<std::array<std::uint32_t, 4>>& tetrahedra) {
    ops::Insert insert;
    insert.exist_ok = true;
    for (const auto& corners : tetrahedra) {
      std::vector<std::string> labels;
      for (const std::uint32_t corner : corners) {
        labels.push_back(std::to_string(corner));
      }
      insert.simplices.push_back(labels);
    }
    REQUIRE(engine_.apply(std::move(insert)));
  }

  bool bounds(const MeshGenerator& loop) {
    engine::CellChain chain{1, {}};
    for (const CycleEdge& edge : loop.edges) {
      const auto [low, high] = std::minmax(edge.vertices[0], edge.vertices[1]);
      const auto cell = engine_.structure().lookup("{" + std::to_string(low) + "," + std::to_string(high) + "}");
      REQUIRE(cell);
      chain.terms.push_back({edge.vertices[0] == low ? edge.times : -edge.times, *cell});
    }
    std::sort(chain.terms.begin(), chain.terms.end(),
              [](const auto& a, const auto& b) { return a.generator < b.generator; });
    const auto answer = engine_.classify(chain);
    REQUIRE(answer.is_cycle);
    return answer.is_zero;
  }

 private:
  engine::Engine engine_;
};

/// What one part of a surface of cubes has inside, by how often a ray from far away crosses it.
Cubes inside_of(const Cubes& all, const Mesh& surface, const Parts& parts, std::uint32_t part) {
  Cubes inside(all.width() - 2);
  for (int x = 1; x + 1 < all.width(); ++x) {
    for (int y = 1; y + 1 < all.width(); ++y) {
      bool is_inside = false;
      for (int z = 0; z + 1 < all.width(); ++z) {
        const std::vector<std::uint32_t> square{all.point(x, y, z), all.point(x + 1, y, z), all.point(x, y + 1, z),
                                                all.point(x + 1, y + 1, z)};
        for (std::size_t f = 0; f < surface.faces.size(); ++f) {
          std::vector<std::uint32_t> corners(surface.faces[f].begin(), surface.faces[f].end());
          std::sort(corners.begin(), corners.end());
          std::vector<std::uint32_t> sorted = square;
          std::sort(sorted.begin(), sorted.end());
          if (corners == sorted && parts.of[corners[0]] == part) {
            is_inside = !is_inside;
          }
        }
        inside.set(x, y, z, is_inside);
      }
    }
  }
  return inside;
}

}  // namespace

TEST_CASE("handle loops bound in the solid inside, tunnel loops outside, and neither on the other side") {
  std::mt19937 random{5};  // NOLINT(cert-msc51-cpp): the same cases every time
  int handles = 0;
  int surfaces = 0;
  for (int round = 0; round < 25; ++round) {
    const Cubes cubes = random_cubes(5, 400, random);
    const Mesh mesh = cubes.surface();
    MeshHomology found = homology_of(mesh);
    check_basis(found, 1);
    const auto edges = incidence_of(mesh).edges;
    Parts parts = connected_parts(mesh.points.size(), edges);
    for (std::uint32_t k = 0; k < found.sorting.size(); ++k) {
      const auto genus = found.validity.components[k].genus();
      REQUIRE(genus);
      INFO(found.sorting[k].why_not);
      REQUIRE(found.sorting[k].is_sorted == (*genus > 0));
      if (*genus == 0) {
        continue;
      }
      std::vector<const MeshGenerator*> loops;
      for (const MeshGenerator* loop : of_degree(found, 1)) {
        if (loop->part == k) {
          loops.push_back(loop);
        }
      }
      REQUIRE(loops.size() == 2 * static_cast<std::size_t>(*genus));
      const Cubes inside = inside_of(cubes, mesh, parts, parts.of[loops[0]->vertices[0]]);
      Solid solid(inside.tetrahedra(true));
      Solid rest(inside.tetrahedra(false));
      for (const MeshGenerator* loop : loops) {
        REQUIRE(loop->side);
        CHECK(solid.bounds(*loop) == (*loop->side == LoopSide::handle));
        CHECK(rest.bounds(*loop) == (*loop->side == LoopSide::tunnel));
        handles += *loop->side == LoopSide::handle ? 1 : 0;
      }
      ++surfaces;
    }
  }
  CHECK(surfaces > 10);
  CHECK(handles > 20);
}

}  // namespace sesame::tools
