// Cells of maps that are no balls: a generator for each of a small model of what they are cones over.
#include <algorithm>
#include <string>
#include <vector>

#include "ops/cells/cofaces.hpp"
#include "ops/maps/map_conversions.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/groups.hpp"
#include "tests/support/plain_maps.hpp"
#include "tests/support/solids.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

std::vector<std::uint64_t> cells_of(const Engine& engine) { return {engine.cells().begin(), engine.cells().end()}; }

std::vector<std::uint64_t> parts_of(const Engine& engine) {
  const auto parts = engine.structure().bodies().parts();
  return {parts.begin(), parts.end()};
}

std::string why_not(Engine& engine, const ops::Operation& op) {
  const std::string before = dump(engine);
  const auto report = engine.apply(op);
  CHECK(dump(engine) == before);
  return report ? "" : report.error().what;
}

bool tells(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

GMap torus_of_nine() { return ops::to_gmap(torus_grid(3, 3)); }

/// Surfaces with and without boundary, orientable or not, and cells over them.
std::vector<GMap> cones() {
  std::vector<GMap> all{torus_of_nine().extended(), solid_of(cube_faces())};
  for (const KnownSurface& surface : known_surfaces()) {
    const bool has_folded_edges = surface.classes == 0;
    if (!has_folded_edges) {
      all.push_back(surface.map.extended());
    }
  }
  return all;
}

}  // namespace

TEST_CASE("a cell over a torus has one generator of its dimension, and two of the one below") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("m", torus_of_nine().extended()));
  CHECK(cells_of(engine) == std::vector<std::uint64_t>{9, 18, 9, 1});
  CHECK(parts_of(engine) == std::vector<std::uint64_t>{0, 0, 2});
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}});
  CHECK(engine.euler_characteristic() == 1);
  CHECK(engine.first_defect().value_or("") == "");
  CHECK(engine.structure().lookup("m.3:0") == engine.structure().lookup("m.3:71"));
  CHECK(engine.structure().lookup("m.3:0~1").has_value());
}

TEST_CASE("two cells over one torus make its suspension") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("m", torus_of_nine().extended()));
  carry_out(engine, make_map("k", torus_of_nine().extended()));
  for (ops::Dart d = 0; d < 72; ++d) {
    (void)engine.apply(sew_darts(3, dart_name("m", d), dart_name("k", d)));
  }
  CHECK(cells_of(engine) == std::vector<std::uint64_t>{9, 18, 9, 2});
  CHECK(engine.euler_characteristic() == 2);
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}, {0, {}}, {2, {}}, {1, {}}});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("a cell over a projective plane carries its torsion") {
  Engine engine(ring_named("Z"));
  const GMap plane = projective_plane_of_a_square();
  carry_out(engine, make_map("m", plane.extended()));
  carry_out(engine, make_map("k", plane.extended()));
  CHECK(parts_of(engine) == std::vector<std::uint64_t>{0, 0, 2});
  for (ops::Dart d = 0; d < plane.size(); ++d) {
    (void)engine.apply(sew_darts(3, dart_name("m", d), dart_name("k", d)));
  }
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}, {0, {}}, {0, {2}}});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("a surface that is extended bounds the cone over it") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("t", torus_of_nine()));
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 2, 1});
  carry_out(engine, ops::Extend{{"t"}});
  CHECK(cells_of(engine) == std::vector<std::uint64_t>{9, 18, 9, 1});
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}});
  CHECK(engine.first_defect().value_or("") == "");
  CHECK(tells(why_not(engine, ops::Extend{{"t"}}), "open"));
  carry_out(engine, ops::Undo{1});
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 2, 1});
  CHECK(parts_of(engine) == std::vector<std::uint64_t>{0, 0, 0});
}

TEST_CASE("a cell that is no ball goes with its parts, is glued with them, and is not split") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("m", torus_of_nine().extended()));
  carry_out(engine, make_map("k", torus_of_nine().extended()));
  CHECK(tells(why_not(engine, operation(R"({"op":"remove","cells":["m.3:0~1"]})")), R"(a part of "m.3:0")"));
  CHECK(tells(why_not(engine, operation(R"({"op":"deidentify","split":[{"cell":"m.3:0","as":"x","moves":[]}]})")),
              "no ball"));
  carry_out(engine, R"({"op":"remove","cells":["m.3:5"]})");
  CHECK(parts_of(engine) == std::vector<std::uint64_t>{0, 0, 2});
  CHECK(engine.homology().betti == std::vector<std::int64_t>{2, 2, 1, 0});
  carry_out(engine, ops::Undo{1});
  carry_out(engine, R"({"op":"identify","pairs":[["m.3:0","k.3:0"]]})");
  CHECK(cells_of(engine) == std::vector<std::uint64_t>{9, 18, 9, 1});
  CHECK(parts_of(engine) == std::vector<std::uint64_t>{0, 0, 2});
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}});
  carry_out(engine, R"({"op":"remove","cells":["m.0:0"],"cofaces":true})");
  CHECK(parts_of(engine) == std::vector<std::uint64_t>{0, 0, 0});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("cells of any kind, sewn and unsewn at random, are the map that their darts are") {
  const auto seed = GENERATE(range(0U, 12U));
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(seed, ring);
  Random random(seed);
  PlainMaps maps(ring_named(ring), 3);
  const std::vector<GMap> kinds = cones();
  for (int k = 0; k < 4; ++k) {
    const GMap& kind = kinds[static_cast<std::size_t>(random.in(0, static_cast<int>(kinds.size()) - 1))];
    maps.make("c" + std::to_string(k), kind);
    if (k % 2 == 0) {
      maps.make("d" + std::to_string(k), kind);
    }
  }
  maps.check();
  sew_and_unsew(maps, random, 80);
}

TEST_CASE("cones and suspensions over cells of maps are known by their boundaries") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("t", torus_of_nine()));
  carry_out(engine, R"({"op":"cone","apex":"v","over":"t"})");
  CHECK(cells_of(engine) == std::vector<std::uint64_t>{10, 27, 27, 9});
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}});
  CHECK(engine.first_defect().value_or("") == "");
  CHECK(engine.structure().lookup("v*t.2:0").has_value());
  CHECK(engine.structure().lookup("v*t.2:1") == engine.structure().lookup("v*t.2:0"));
  CHECK(tells(why_not(engine, ops::Unsew{2, {"t:0"}}), R"(is a face of "v*t.)"));
  carry_out(engine, R"({"op":"suspend","apexes":["n","s"],"over":["t.2:0","t.2:8"]})");
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}});
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, make_map("m", projective_plane_of_a_square().extended()));
  carry_out(engine, R"({"op":"cone","apex":"w","over":"m"})");
  CHECK(parts_of(engine) == std::vector<std::uint64_t>{0, 0, 1, 1});
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{2, {}}});
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, R"({"op":"remove","cells":["w*m.3:0"]})");
  CHECK(parts_of(engine) == std::vector<std::uint64_t>{0, 0, 1, 0});
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{2, {}}, {0, {}}, {0, {2}}});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("maps of two and three dimensions, changed by local operations at random, are what their darts are") {
  const auto seed = GENERATE(range(0U, 16U));
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(seed, ring);
  Random random(seed);
  PlainMaps flat(ring_named(ring), 2);
  for (int k = 0; k < 3; ++k) {
    flat.make("p" + std::to_string(k), ops::polygon(static_cast<ops::Dart>(random.in(2, 5))));
  }
  flat.make("s", map_of_faces(prism_faces(3)));
  sew_and_unsew(flat, random, 60, true);
  PlainMaps solid(ring_named(ring), 3);
  const std::vector<GMap> kinds = cones();
  for (int k = 0; k < 2; ++k) {
    solid.make("c" + std::to_string(k),
               kinds[static_cast<std::size_t>(random.in(0, static_cast<int>(kinds.size()) - 1))]);
    solid.make("d" + std::to_string(k), solid_of(random.one_in(2) ? cube_faces() : tetrahedron_faces()));
  }
  sew_and_unsew(solid, random, 60, true);
}

TEST_CASE("what is left of cubes around a hole is one cell that is no ball") {
  Engine engine(ring_named("Z"));  // four cubes in a ring, sewn to each other and then made one
  for (int k = 0; k < 4; ++k) {
    carry_out(engine, make_map("c" + std::to_string(k), solid_of(cube_faces())));
  }
  const Polygons faces = cube_faces();
  const auto facing = [&](std::size_t one, std::size_t other) {  // two sides of a cube without a common vertex
    return std::none_of(faces[one].begin(), faces[one].end(), [&](const auto v) {
      return std::find(faces[other].begin(), faces[other].end(), v) != faces[other].end();
    });
  };
  std::size_t opposite = 1;
  while (!facing(0, opposite)) {
    ++opposite;
  }
  for (int k = 0; k < 4; ++k) {
    const std::string one = "c" + std::to_string(k);
    const std::string next = "c" + std::to_string((k + 1) % 4);
    carry_out(engine, sew_darts(3, dart_name(one, 0), dart_name(next, static_cast<ops::Dart>(8 * opposite))));
  }
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 1, 0, 0});
  for (int k = 0; k < 3; ++k) {
    carry_out(engine, ops::RemoveCell{"c" + std::to_string(k) + ".2:0"});
    CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 1, 0, 0});
    CHECK(engine.first_defect().value_or("") == "");
  }
  CHECK(cells_of(engine).back() == 1);
  carry_out(engine, R"({"op":"remove_cell","cell":"c3.2:0"})");  // which it has on both sides: the cone over a torus
  CHECK(parts_of(engine) == std::vector<std::uint64_t>{0, 0, 2});
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0, 0});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("a cone over a cell that is no ball is one over its parts too") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("m", torus_of_nine().extended()));
  carry_out(engine, R"({"op":"cone","apex":"v","over":["m.3:0"]})");
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("a cell over an open disk has that as a face") {
  Engine engine(ring_named("Z"));
  const GMap open = *GMap::make({{1, 0, 3, 2, 5, 4, 7, 6}, {7, 2, 1, 4, 3, 6, 5, 0}, {0, 1, 2, 3, 4, 5, 6, 7}});
  carry_out(engine, make_map("m", open.extended()));
  carry_out(engine, make_map("k", open.extended()));
  CHECK(tells(why_not(engine, operation(R"({"op":"remove","cells":["m.2:0"]})")), R"(is a face of "m.3:0")"));
  carry_out(engine, R"({"op":"identify","pairs":[["m.3:0","k.3:0"]]})");
  CHECK(cells_of(engine) == std::vector<std::uint64_t>{4, 4, 1, 1});
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}});
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, R"({"op":"remove","cells":["m.1:0"],"cofaces":true})");
  CHECK(cells_of(engine) == std::vector<std::uint64_t>{4, 3});
  CHECK(parts_of(engine) == std::vector<std::uint64_t>{0, 0, 0});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("there is no cell over a sphere whose edges were folded when they were degenerate") {
  Engine engine(ring_named("Z"));
  build(engine, {R"({"op":"polygon","name":"p","sides":2})", R"({"op":"degenerate","cell":"p.1:0","along":0})",
                 R"({"op":"degenerate","cell":"p.1:2","along":0})",
                 R"({"op":"sew","dim":2,"pairs":[["p:0","p:1"],["p:2","p:3"]]})"});
  CHECK(tells(why_not(engine, ops::Extend{{"p"}}), "has a cell that is no ball"));
}

namespace {

/// The split of a vertex that takes all edges which end there to its copy.
ops::Deidentify split_off(const Engine& engine, const std::string& vertex) {
  const ops::Structure& structure = engine.structure();
  const ops::CellId cell = *structure.lookup(vertex);
  ops::Deidentify::Split split{vertex, "x", {}};
  for (const ops::CellId edge : ops::cofaces(structure, cell)) {
    for (std::uint32_t k = 0; structure.dimension(edge) == 1 && k < 2; ++k) {
      if (structure.values().face_of_cell(edge, k).cell == cell) {
        split.moves.emplace_back(structure.name(edge), k);
      }
    }
  }
  return {{split}};
}

}  // namespace

TEST_CASE("what lies in the boundary of a cell that is no ball is split only where that loses nothing") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("m", torus_of_nine().extended()));
  const std::string why = why_not(engine, split_off(engine, "m.0:0"));
  CHECK((tells(why, R"("m.1:)") && tells(why, R"(it belongs to "m.3:0", which is no ball)")));
  CHECK(tells(
      why_not(engine, operation(R"({"op":"deidentify","split":[{"cell":"m.2:0","as":"x","moves":[["m.3:0",0]]}]})")),
      R"(belongs to "m.3:0")"));
  build(engine, {R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e.0","m.0:0"]]})",
                 R"({"op":"deidentify","split":[{"cell":"m.0:0","as":"y","moves":[["e",1]]}]})"});
  CHECK(engine.homology().betti == std::vector<std::int64_t>{2, 0, 0, 0});
  carry_out(engine, R"({"op":"remove","cells":["m.3:0"]})");
  carry_out(engine, split_off(engine, "m.0:8"));  // now nothing depends on it
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("no cell is made over darts that see other cells than these have as faces") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("t", torus_of_nine()));
  carry_out(engine, split_off(engine, "t.0:0"));
  CHECK(tells(why_not(engine, ops::Extend{{"t"}}), R"(it sees "t.0:0", which is no face there of "t.1:)"));
  Engine cube(ring_named("Z"));
  carry_out(cube, make_map("c", map_of_faces(cube_faces())));
  carry_out(cube, split_off(cube, "c.0:0"));
  carry_out(cube, ops::Extend{{"c"}});  // a ball is what its faces say
  std::string far;                      // a face without that vertex
  for (ops::Dart d = 0; far.empty(); d += 8) {
    bool has_it = false;
    for (ops::Dart k = d; k < d + 8; ++k) {
      has_it = has_it || cube.structure().lookup("c.0:" + std::to_string(k)) == cube.structure().lookup("c.0:0");
    }
    far = has_it ? "" : "c.2:" + std::to_string(d);
  }
  CHECK(tells(why_not(cube, ops::RemoveCell{far}), R"(it sees "c.0:0", which is no face there of "c.1:)"));
  carry_out(cube, R"({"op":"remove","cells":["c.0:0"]})");  // which is nobody's face by now
  CHECK(tells(why_not(cube, ops::RemoveCell{far}), "was removed"));
  CHECK(cube.first_defect().value_or("") == "");
}
