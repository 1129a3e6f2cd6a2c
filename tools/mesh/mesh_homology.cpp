#include "tools/mesh/mesh_homology.hpp"

#include <iterator>
#include <utility>

#include "tools/mesh/mesh_generators.hpp"
#include "tools/mesh/script.hpp"

namespace sesame::tools {

namespace {

bool is_rational(const sparse::AnyRing& ring) { return std::holds_alternative<sparse::Rationals>(ring); }

/// Builds the complex by the step that `sesame import` writes, so that cells have the same names here and there.
Result<std::unique_ptr<engine::Engine>> build(const Mesh& triangulated, const MeshHomologyOptions& options) {
  auto complex = make_complex(triangulated, {options.source, "Z", Polygons::fan, BuildOrder::breadth_first, false});
  if (!complex) {
    return complex.error();
  }
  auto engine =
      std::make_unique<engine::Engine>(is_rational(options.ring) ? sparse::AnyRing{sparse::Integers{}} : options.ring);
  if (const auto report = engine->apply(std::move(*complex)); !report) {
    return report.error();
  }
  return engine;
}

void add(FoundGenerators found, MeshHomology& result) {
  std::move(found.generators.begin(), found.generators.end(), std::back_inserter(result.generators));
  result.loops_tried += found.loops_tried;
}

}  // namespace

Result<MeshHomology> mesh_homology(const Mesh& mesh, const MeshHomologyOptions& options) {
  MeshHomology result;
  result.validity = validate(mesh);
  const PreparedMesh parts = prepared(mesh);
  result.remarks = parts.triangles.remarks;
  SelfIntersections meetings = self_intersections(parts.polygons);
  auto engine = build(parts.triangles, options);
  if (!engine) {
    return engine.error();
  }
  result.engine = std::move(*engine);
  result.ring = options.ring;
  result.homology = result.engine->homology();
  if (is_rational(options.ring)) {
    for (auto& factors : result.homology.torsion) {
      factors.clear();
    }
  }
  if (options.generators) {
    const MeshCells cells(parts, result.engine->structure(), options.source);
    add(components_of(cells), result);
    FoundGenerators loops = loops_of(cells, *result.engine, options.ring, {result.validity, meetings});
    result.sorting = std::move(loops.sorting);
    std::move(loops.remarks.begin(), loops.remarks.end(), std::back_inserter(result.remarks));
    add(std::move(loops), result);
    add(surfaces_of(cells, *result.engine, options.ring, options.faces), result);
  }
  for (FaceMeeting& meeting : meetings.meetings) {
    for (std::uint32_t& face : meeting.faces) {
      face = parts.face_in_file[face];
    }
  }
  result.meetings = std::move(meetings);
  return result;
}

}  // namespace sesame::tools
