#include "tools/mesh/mesh_generators.hpp"

#include <map>
#include <numeric>

#include "tools/mesh/chain_measures.hpp"
#include "tools/mesh/geometry.hpp"
#include "tools/mesh/graph.hpp"

namespace sesame::tools {

namespace {

using engine::CellChain;
using sparse::Integer;

/// Whether a triangle's corners in increasing order run around as the file has them.
bool is_even(const MeshCells& cells, std::uint32_t triangle) {
  const auto face = cells.mesh().triangles.faces[triangle];
  return (face[0] < face[1]) == ((face[1] < face[2]) == (face[0] < face[2]));
}

/// The polygons of a cycle. Between two triangles of one lies an edge that is on no other, so all have one coefficient.
std::vector<SurfaceFace> faces_of(const MeshCells& cells, const CellChain& chain, const sparse::AnyRing& ring) {
  std::map<std::uint32_t, Integer> times;
  for (const auto& [coefficient, cell] : chain.terms) {
    const std::uint32_t triangle = cells.triangle(cell);
    const Integer along = coefficient.numerator();
    const Integer against = has_signs(ring) ? -along : minus_one(ring) + Integer{1} - along;
    times.emplace(cells.mesh().face_in_file[cells.mesh().face_of_triangle[triangle]],
                  is_even(cells, triangle) ? along : against);
  }
  std::vector<SurfaceFace> faces;
  for (const auto& [face, count] : times) {
    faces.push_back({face, count});
  }
  return faces;
}

/// 1 when the chain runs through its lowest triangle as the file does, else -1; 1 over Z/p.
Integer orientation(const MeshCells& cells, const CellChain& chain, const sparse::AnyRing& ring) {
  if (!has_signs(ring)) {
    return 1;
  }
  const CellChain::Term* lowest = nullptr;
  std::uint32_t triangle = 0;
  for (const auto& term : chain.terms) {
    const std::uint32_t t = cells.triangle(term.generator);
    if (lowest == nullptr || t < triangle) {
      lowest = &term;
      triangle = t;
    }
  }
  return is_even(cells, triangle) == (lowest->coefficient.sign() > 0) ? 1 : -1;
}

}  // namespace

FoundGenerators components_of(const MeshCells& cells) {
  const auto& points = cells.mesh().polygons.points;
  const Parts parts = connected_parts(points.size(), cells.edges());
  FoundGenerators found;
  found.generators.resize(parts.count);
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    MeshGenerator& component = found.generators[parts.of[v]];
    if (component.vertices.empty()) {
      component.vertices.push_back(cells.in_file(v));
      component.chain = {0, {{1, cells.vertex(v)}}};
      component.box = {points[v], points[v]};
    }
    extend(component.box, points[v]);
  }
  for (MeshGenerator& component : found.generators) {
    for (std::size_t i = 0; i < 3; ++i) {
      component.centre[i] = std::midpoint(component.box[0][i], component.box[1][i]);
    }
  }
  return found;
}

FoundGenerators surfaces_of(const MeshCells& cells, engine::Engine& engine, const sparse::AnyRing& ring,
                            bool with_faces) {
  const ChainMeasures measures(cells, ring);
  FoundGenerators found;
  for (const engine::Generator& generator : engine.generators(2)) {
    MeshGenerator surface;
    surface.degree = 2;
    surface.order = generator.order;
    surface.chain = generator.cycle;
    surface.triangles = generator.cycle.terms.size();
    if (const Integer sign = orientation(cells, generator.cycle, ring); sign != 1) {
      for (auto& term : surface.chain.terms) {
        term.coefficient = term.coefficient * sign;
      }
    }
    measures.measure_surface(surface);
    if (with_faces) {
      surface.faces = faces_of(cells, surface.chain, ring);
    }
    found.generators.push_back(std::move(surface));
  }
  return found;
}

}  // namespace sesame::tools
