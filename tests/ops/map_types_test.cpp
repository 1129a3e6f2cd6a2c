// The types of cells of maps, and such cells as their darts see them.
#include <algorithm>
#include <set>
#include <vector>

#include "ops/cells/map_cells.hpp"
#include "ops/cells/value.hpp"
#include "ops/maps/incidence_numbers.hpp"
#include "ops/maps/rooted_map.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_complexes.hpp"
#include "tests/support/random_maps.hpp"
#include "tests/support/snapshots.hpp"
#include "tests/support/solids.hpp"

using namespace sesame;
using namespace sesame::tests;
using ops::OrderId;
using ops::TypeId;
using ops::TypeTable;
using ops::Value;
using ops::VertexMaps;

namespace {

const std::vector<Polygons> polyhedra_of_types{tetrahedron_faces(), cube_faces(), prism_faces(3), prism_faces(5),
                                               pyramid_faces(4)};

/// Some types of cells of maps: polygons, polyhedra_of_types, and the cell of dimension 4 over two cubes.
std::vector<TypeId> some_types(TypeTable& types) {
  std::vector<TypeId> some;
  for (Dart sides = 1; sides < 6; ++sides) {
    some.push_back(types.cell_over(ops::polygon(sides).restricted(1)));
  }
  for (const Polygons& faces : polyhedra_of_types) {
    some.push_back(types.cell_over(ops::rooted_at(map_of_faces(faces), 0)));
  }
  const GMap cubes = ops::disjoint_union(map_of_faces(cube_faces()), map_of_faces(cube_faces()));
  std::vector<std::vector<Dart>> alpha = cubes.involutions();
  alpha.emplace_back();
  for (Dart d = 0; d < cubes.size(); ++d) {
    alpha.back().push_back((d + 48) % 96);
  }
  some.push_back(types.cell_over(ops::rooted_at(*GMap::make(alpha), 0)));
  return some;
}

}  // namespace

TEST_CASE("a cell of a map has the type of its canonical boundary, whichever dart sees it", "[maps]") {
  TypeTable types;
  for (const TypeId type : some_types(types)) {
    REQUIRE(type != ops::none);
    const auto canonical = types.canonical(type);
    CHECK(types.seen_from(canonical.type, canonical.root) == type);
    std::set<std::uint32_t> seen;
    for (Dart d = 0; d < types.darts(type); ++d) {
      const TypeId from_there = types.seen_from(type, d);
      seen.insert(from_there);
      CHECK(types.canonical(from_there).type == canonical.type);
      CHECK(types.dart_seen_from(type, d, types.dart_from(type, d, 1)) == 1);
      CHECK(types.dart_from(type, d, 0) == d);
    }
    const GMap& boundary = types.info(type).shape->boundary;
    CHECK(seen.size() * ops::automorphisms(boundary).size() == boundary.size());
  }
}

TEST_CASE("what is no ball has no type", "[maps]") {
  TypeTable types;
  CHECK(types.cell_over(torus_of_a_square()) == ops::none);
  CHECK(types.cell_over(ops::rooted_at(ops::polygon(3), 0)) == ops::none);  // open
  CHECK(types.cell_over(*GMap::make({{0}})) == ops::none);
  CHECK(types.cell_over(GMap::points(1)) == types.vertex());
  CHECK(types.cell_over(*GMap::make({{1, 0}})) == types.simplex(1));
}

TEST_CASE("the boundary of a type is the one that its darts count", "[maps]") {
  TypeTable types;
  for (const TypeId type : some_types(types)) {
    const ops::StandardCell& standard = types.standard(type);
    const auto complex = ops::incidence_complex(types.info(type).shape->boundary);
    REQUIRE(complex.has_value());
    std::size_t cells = 1;
    for (const ops::Orbits& layer : complex->cells) {
      cells += layer.count();
    }
    CHECK(standard.cells.size() == cells);
    // With its faces as the darts see them the boundary of a boundary is nothing.
    VertexMaps maps(types);
    for (const ops::StandardFace& cell : standard.cells) {
      std::vector<int> twice(standard.cells.size(), 0);
      for (std::size_t k = 0; k < cell.faces.size(); ++k) {
        const ops::StandardFace& face = standard.cells[cell.faces[k]];
        const OrderId order =
            cell.face_darts.empty() ? OrderId{ops::same_order} : maps.order_at(face.type, cell.face_darts[k]);
        const int sign = types.info(cell.type).faces[k].sign * maps.sign(order);
        for (std::size_t l = 0; l < face.faces.size(); ++l) {
          const OrderId below = face.face_darts.empty()
                                    ? OrderId{ops::same_order}
                                    : maps.order_at(standard.cells[face.faces[l]].type, face.face_darts[l]);
          twice[face.faces[l]] += sign * types.info(face.type).faces[l].sign * maps.sign(below);
        }
      }
      CHECK(std::ranges::all_of(twice, [](int sum) { return sum == 0; }));
    }
  }
}

TEST_CASE("darts from which a cell is seen compose as isomorphisms do", "[maps]") {
  TypeTable types;
  VertexMaps maps(types);
  Random random(7);
  for (const TypeId start : some_types(types)) {
    const TypeId type = types.canonical(start).type;
    const auto any = [&](TypeId of) {
      return maps.order_at(of, static_cast<Dart>(random.in(0, static_cast<int>(types.darts(of)) - 1)));
    };
    for (int tries = 0; tries < 40; ++tries) {
      const OrderId inner = any(type);
      const TypeId middle = maps.seen_through(inner, type);
      const OrderId outer = any(middle);
      const OrderId both = maps.compose(outer, inner);
      CHECK(maps.seen_through(both, type) == maps.seen_through(outer, middle));
      CHECK(maps.sign(both) == maps.sign(outer) * maps.sign(inner));
      CHECK(maps.compose(maps.inverse(inner), inner) == ops::same_order);
      CHECK(maps.compose(inner, maps.inverse(inner)) == ops::same_order);
      const OrderId outermost = any(maps.seen_through(outer, middle));
      CHECK(maps.compose(maps.compose(outermost, outer), inner) == maps.compose(outermost, maps.compose(outer, inner)));
      CHECK(maps.is_value_of({5, maps.seen_through(both, type), 0, both}, type));
      // Faces: each face of the cell is a face of it as seen from elsewhere, with its sign.
      const Value v{5, middle, 0, inner};
      std::set<std::uint32_t> met;
      for (std::uint32_t k = 0; k < types.info(middle).faces.size(); ++k) {
        const std::uint32_t of_cell = maps.face_of_cell(v, k);
        met.insert(of_cell);
        const Value face = maps.face(v, k, [&](ops::CellId cell, std::uint32_t number) {
          CHECK(number == of_cell);
          return Value{cell + 1 + number, types.canonical(types.info(type).faces[number].type).type, 0,
                       maps.order_at(types.canonical(types.info(type).faces[number].type).type,
                                     types.canonical(types.info(type).faces[number].type).root)};
        });
        CHECK(face.type == types.info(middle).faces[k].type);
        const auto canonical = types.canonical(types.info(type).faces[of_cell].type);
        const int sign_of_face = maps.sign(maps.order_at(canonical.type, canonical.root));
        CHECK(types.info(middle).faces[k].sign * maps.sign(face.order) ==
              maps.sign(inner) * types.info(type).faces[of_cell].sign * sign_of_face);
      }
      CHECK(met.size() == types.info(type).faces.size());
    }
  }
}

TEST_CASE("types and darts come back from an archive", "[maps][archive]") {
  TypeTable types;
  VertexMaps maps(types);
  for (const TypeId type : some_types(types)) {
    const TypeId canonical = types.canonical(type).type;
    for (Dart d = 0; d < types.darts(canonical); d += 3) {
      (void)maps.order_at(canonical, d);
    }
  }
  Bytes bytes;
  sparse::ArchiveWriter to(sink_into(bytes));
  types.save(to);
  maps.save(to);
  REQUIRE(to.finish());
  TypeTable again;
  VertexMaps maps_again(again);
  sparse::ArchiveReader from(source_of(bytes), bytes.size());
  again.load(from);
  maps_again.load(from);
  REQUIRE(from.finish());
  REQUIRE(again.size() == types.size());
  for (TypeId type = 0; type < types.size(); ++type) {
    CHECK(again.info(type).type == types.info(type).type);
    CHECK(again.info(type).faces.size() == types.info(type).faces.size());
  }
}
