#include "tools/bench/constructions.hpp"

#include <array>
#include <map>
#include <numeric>
#include <set>

#include "tests/support/bodies.hpp"
#include "tools/bench/sessions.hpp"

using namespace sesame;
using namespace sesame::tests;
using tools::Assembly;
using tools::Operations;
using tools::Order;

namespace {

using Counts = std::vector<std::uint64_t>;

Counts cells_of(const Engine& engine) { return {engine.cells().begin(), engine.cells().end()}; }

void build(Engine& engine, const Operations& operations) {
  for (const ops::Operation& operation : operations) {
    carry_out(engine, operation);
  }
}

/// Builds it over several rings; checks the number of cells and the homology in the end.
void check(const Operations& operations, const Counts& cells, const Groups& groups) {
  for (const std::string& ring : test_rings) {
    CAPTURE(ring);
    Engine engine(ring_named(ring));
    build(engine, operations);
    CHECK(cells_of(engine) == cells);
    CHECK(live_groups(engine) == over(ring_named(ring), groups));
  }
}

std::string text_of(const Operations& operations) {
  std::string text;
  for (const ops::Operation& operation : operations) {
    text += ops::to_text(operation) + "\n";
  }
  return text;
}

const std::vector<Order> orders{Order::inside_out, Order::random, Order::tiles_first};

const Groups torus_groups{group(1), group(2), group(1)};
const Groups klein_groups{group(1), group(1, {Integer{2}})};

using Cube = std::array<int, 3>;

/// The sponge as its definition builds it: every cube is cut into 27, of which seven go.
std::vector<Cube> cubes_of_sponge(int level) {
  std::vector<Cube> cubes{{0, 0, 0}};
  for (; level > 0; --level) {
    std::vector<Cube> finer;
    for (const auto& [x, y, z] : cubes) {
      for (int part = 0; part < 27; ++part) {
        const int i = part / 9, j = part / 3 % 3, k = part % 3;
        if (std::abs(i - 1) + std::abs(j - 1) + std::abs(k - 1) > 1) {
          finer.push_back({3 * x + i, 3 * y + j, 3 * z + k});
        }
      }
    }
    cubes = std::move(finer);
  }
  return cubes;
}

/// The cells of a set of cubes in space, by dimension. A cell is its centre, in half edges.
std::vector<std::map<Cube, Index>> cells_in_space(const std::vector<Cube>& cubes) {
  std::vector<std::map<Cube, Index>> cells(4);
  for (const auto& [x, y, z] : cubes) {
    for (int part = 0; part < 27; ++part) {
      const Cube centre{2 * x + part / 9, 2 * y + part / 3 % 3, 2 * z + part % 3};
      cells[static_cast<std::size_t>(centre[0] % 2 + centre[1] % 2 + centre[2] % 2)].emplace(centre, 0);
    }
  }
  for (auto& dimension : cells) {
    Index number = 0;
    for (auto& cell : dimension) {
      cell.second = number++;
    }
  }
  return cells;
}

Counts sizes_of(const std::vector<std::map<Cube, Index>>& cells) {
  Counts sizes;
  for (const auto& dimension : cells) {
    sizes.push_back(dimension.size());
  }
  return sizes;
}

std::vector<AbelianGroup> groups_in_space(const std::vector<std::map<Cube, Index>>& cells) {
  std::vector<std::vector<std::vector<Entry>>> boundaries;
  for (std::size_t p = 1; p < cells.size(); ++p) {
    auto& columns = boundaries.emplace_back();
    for (const auto& [centre, number] : cells[p]) {
      auto& column = columns.emplace_back();
      int sign = 1;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (centre[axis] % 2 != 0) {
          for (const int side : {-1, 1}) {
            Cube face = centre;
            face[axis] += side;
            column.emplace_back(cells[p - 1].at(face), sign * side);
          }
          sign = -sign;
        }
      }
    }
  }
  Sizes sizes;
  for (const std::uint64_t size : sizes_of(cells)) {
    sizes.push_back(static_cast<Index>(size));
  }
  return trimmed(reductions::homology_groups(complex_of(sparse::Integers{}, sizes, boundaries)));
}

}  // namespace

TEST_CASE("surfaces have the cells and the homology that they should, in every order", "[bench]") {
  for (const Order order : orders) {
    const Assembly assembly{order, 7};
    CAPTURE(static_cast<int>(order));
    for (const std::uint64_t n : {1U, 2U, 5U}) {
      check(tools::torus(static_cast<std::uint32_t>(n), assembly), {n * n, 2 * n * n, n * n}, torus_groups);
    }
    for (const std::uint64_t n : {3U, 4U}) {
      check(tools::klein_bottle(static_cast<std::uint32_t>(n), assembly), {n * n, 3 * n * n, 2 * n * n}, klein_groups);
    }
    for (const std::uint32_t genus : {1U, 2U, 4U}) {
      const std::uint64_t squares = std::uint64_t{16} * genus, joints = genus - 1;
      check(tools::surface_of_genus(genus, 4, assembly),
            {squares - 3 * joints, 3 * squares - 3 * joints, 2 * squares - 2 * joints},
            {group(1), group(2 * genus), group(1)});
    }
  }
}

TEST_CASE("3-tori of tetrahedra have the cells and the homology that they should, in every order", "[bench]") {
  for (const Order order : orders) {
    CAPTURE(static_cast<int>(order));
    for (const std::uint32_t n : {1U, 2U, 3U}) {
      const std::uint64_t cubes = std::uint64_t{n} * n * n;
      check(tools::freudenthal_torus(n, {order, 3}), {cubes, 7 * cubes, 12 * cubes, 6 * cubes},
            {group(1), group(3), group(3), group(1)});
    }
  }
}

TEST_CASE("the assembled sponge is the one in space", "[bench]") {
  for (const int level : {0, 1, 2}) {
    CAPTURE(level);
    const auto cells = cells_in_space(cubes_of_sponge(level));
    Groups groups{group(1), group(static_cast<Index>(tools::menger_tunnels(level)))};
    groups = trimmed(groups);
    CHECK(groups_in_space(cells) == groups);
    for (const Order order : orders) {
      check(tools::menger_sponge(level, {order, 11}), sizes_of(cells), groups);
      check(tools::menger_sponge_of_maps(level, {order, 11}), sizes_of(cells), groups);
    }
  }
}

TEST_CASE("a sponge of maps is simplified to one volume, and its groups stay", "[bench]") {
  const std::size_t assembled = tools::menger_sponge_of_maps(1).size();
  const Operations operations = tools::simplified_menger_sponge(1);
  const Groups groups = trimmed(Groups{group(1), group(static_cast<Index>(tools::menger_tunnels(1)))});
  for (const std::string& ring : test_rings) {
    CAPTURE(ring);
    Engine engine(ring_named(ring));
    build(engine, Operations(operations.begin(), operations.begin() + static_cast<std::ptrdiff_t>(assembled)));
    REQUIRE(cells_of(engine).back() == 20);
    for (std::size_t k = assembled; k < operations.size(); ++k) {
      const Counts before = cells_of(engine);
      carry_out(engine, operations[k]);
      CAPTURE(k);
      const Counts after = cells_of(engine);
      CHECK(std::accumulate(after.begin(), after.end(), 0U) < std::accumulate(before.begin(), before.end(), 0U));
      REQUIRE(live_groups(engine) == over(ring_named(ring), groups));
    }
    CHECK(cells_of(engine)[3] == 1);
    CHECK(cells_of(engine)[2] == 6);  // one for each of the tunnels, and the outside
  }
}

TEST_CASE("a torus of polygons is sewn side by side", "[bench]") {
  for (const std::uint32_t n : {1U, 2U, 3U, 8U}) {
    CAPTURE(n);
    const Operations operations = tools::torus_of_polygons(n);
    CHECK(operations.size() == 3 * std::size_t{n} * n);
    check(operations, {n * n, 2 * n * n, n * n}, torus_groups);
  }
}

TEST_CASE("the number of tunnels of a sponge is what its Euler characteristic says", "[bench]") {
  for (const int level : {0, 1, 2, 3}) {
    const Counts sizes = sizes_of(cells_in_space(cubes_of_sponge(level)));
    const auto euler = static_cast<std::int64_t>(sizes[0] + sizes[2]) - static_cast<std::int64_t>(sizes[1] + sizes[3]);
    CHECK(tools::menger_tunnels(level) == 1 - euler);
  }
  CHECK(tools::menger_tunnels(4) == 26433);
}

TEST_CASE("from the inside out there is one piece after every gluing, with the tiles first as many as there are",
          "[bench]") {
  Engine inside_out;
  for (const ops::Operation& operation : tools::klein_bottle(4)) {
    carry_out(inside_out, operation);
    const bool glues = std::holds_alternative<ops::Identify>(operation);
    CHECK(inside_out.homology().betti[0] == (glues || inside_out.undoable() == 1 ? 1 : 2));
  }
  Engine tiles_first;
  std::int64_t pieces = 0;
  for (const ops::Operation& operation : tools::klein_bottle(4, {Order::tiles_first, 1})) {
    carry_out(tiles_first, operation);
    pieces += std::holds_alternative<ops::MakeSimplex>(operation) ? 1 : 0;
    if (tiles_first.undoable() <= 32) {
      CHECK(tiles_first.homology().betti[0] == pieces);
    }
  }
  CHECK(pieces == 32);
  CHECK(tiles_first.undoable() == 32 + 48);  // a gluing for every edge
}

TEST_CASE("an assembly is determined by its seed", "[bench]") {
  for (const Order order : {Order::random, Order::tiles_first}) {
    const std::string text = text_of(tools::torus(4, {order, 1}));
    CHECK(text_of(tools::torus(4, {order, 1})) == text);
    CHECK(text_of(tools::torus(4, {order, 2})) != text);
  }
  CHECK(text_of(tools::torus(4, {Order::inside_out, 1})) == text_of(tools::torus(4, {Order::inside_out, 2})));
  CHECK(text_of(tools::random_triangles(6, 10, 1)) != text_of(tools::random_triangles(6, 10, 2)));
}

TEST_CASE("gluing a place makes a loop, and taking it back opens that again", "[bench]") {
  for (const bool split : {true, false}) {
    CAPTURE(split);
    Engine engine;
    const Operations operations = split ? tools::glued_and_split(2, 7) : tools::glued_and_undone(2, 7);
    REQUIRE(operations.size() == 6 + 14);
    for (std::size_t k = 0; k < operations.size(); ++k) {
      CAPTURE(k);
      carry_out(engine, operations[k]);
      if (k >= 5) {
        CHECK(live_groups(engine) == (k % 2 == 0 ? Groups{group(2), group(1)} : Groups{group(2)}));
      }
    }
    CHECK(cells_of(engine) == Counts{8, 10, 4});
  }
}

TEST_CASE("a square is glued to a torus and cut open to a square again", "[bench]") {
  Engine engine;
  const Operations operations = tools::glued_and_cut_square(4);
  for (std::size_t k = 0; k < operations.size(); ++k) {
    carry_out(engine, operations[k]);
    CHECK(live_groups(engine) == (k % 2 == 1 ? torus_groups : Groups{group(1)}));
    CHECK(cells_of(engine) == (k % 2 == 1 ? Counts{1, 2, 1} : Counts{4, 4, 1}));
  }
}

TEST_CASE("a torus whose triangles are removed and inserted again has a loop more for each but one that is away",
          "[bench]") {
  const std::uint64_t seed = GENERATE(1U, 2U);
  Engine engine;
  std::int64_t away = 0, most = 0, whole = 0;
  for (const ops::Operation& operation : tools::torus_with_triangles_edited(4, 200, seed)) {
    carry_out(engine, operation);
    away = 32 - static_cast<std::int64_t>(cells_of(engine).at(2));
    most = std::max(most, away);
    whole += away == 0 ? 1 : 0;
    CHECK(live_groups(engine) == (away == 0 ? torus_groups : Groups{group(1), group(static_cast<Index>(1 + away))}));
  }
  CHECK(engine.undoable() == 201);
  CHECK(most > 3);
  CHECK(whole > 1);
  CHECK(text_of(tools::torus_with_triangles_edited(3, 20, 1)) != text_of(tools::torus_with_triangles_edited(3, 20, 2)));
}

TEST_CASE("separate Klein bottles have a summand of order 2 each", "[bench]") {
  check(tools::separate_klein_bottles(3), {3, 6, 3}, {group(3), group(3, {Integer{2}, Integer{2}, Integer{2}})});
}

TEST_CASE("a graph that is edited has the homology that counting says, at every step", "[bench]") {
  const bool with_undo = GENERATE(false, true);
  const std::uint64_t seed = GENERATE(1U, 2U);
  tools::GraphEditing editing(7, with_undo, seed);
  Engine engine(sparse::Z2{});
  std::set<std::string_view> kinds;
  for (int step = 0; step < 1500; ++step) {
    const ops::Operation operation = editing.next();
    CAPTURE(with_undo, seed, step, ops::to_text(operation));
    carry_out(engine, operation);
    kinds.insert(ops::keyword(operation));
    REQUIRE(cells_of(engine) == Counts{editing.vertices(), editing.edges()});
    const std::int64_t pieces = editing.components();
    const std::int64_t loops = std::int64_t{editing.edges()} - editing.vertices() + pieces;
    REQUIRE(engine.homology().betti == std::vector<std::int64_t>{pieces, loops});
  }
  CHECK(kinds.contains("undo") == with_undo);
  CHECK(kinds.size() == (with_undo ? 4 : 3));
}

TEST_CASE("a graph that is contracted has the homology that counting says, at every step", "[bench]") {
  const std::uint64_t seed = GENERATE(1U, 2U);
  tools::GraphContraction contraction(6, seed);
  Engine engine(ring_named("Z"));
  std::set<std::string_view> kinds;
  for (int step = 0; step < 800; ++step) {
    const ops::Operation operation = contraction.next();
    CAPTURE(seed, step, ops::to_text(operation));
    carry_out(engine, operation);
    kinds.insert(ops::keyword(operation));
    Counts cells{contraction.vertices(), contraction.edges()};
    if (contraction.edges() == 0) {
      cells.pop_back();
    }
    REQUIRE(cells_of(engine) == cells);
    const std::int64_t pieces = contraction.components();
    const std::int64_t loops = std::int64_t{contraction.edges()} - contraction.vertices() + pieces;
    std::vector<std::int64_t> betti{pieces, loops};
    betti.resize(cells.size());
    REQUIRE(engine.homology().betti == betti);
  }
  CHECK(kinds.size() == 2);
}

TEST_CASE("triangles with one vertex are free when all that was glued is split apart", "[bench]") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  const Operations operations = tools::glued_triangles(5, seed);
  CHECK(operations.size() > 5 + 1 + 50);
  check(operations, {1, 15, 5}, {group(1), group(10)});
}

TEST_CASE("an editing session is determined by its seed", "[bench]") {
  const auto session = [](std::uint64_t seed) {
    return text_of(tools::steps_of(tools::GraphEditing(20, true, seed), 800));
  };
  CHECK(session(1) == session(1));
  CHECK(session(1) != session(2));
  const auto contracted = [](std::uint64_t seed) {
    return text_of(tools::steps_of(tools::GraphContraction(9, seed), 300));
  };
  CHECK(contracted(1) == contracted(1));
  CHECK(contracted(1) != contracted(2));
  CHECK(text_of(tools::glued_triangles(4, 1)) == text_of(tools::glued_triangles(4, 1)));
  CHECK(text_of(tools::glued_triangles(4, 1)) != text_of(tools::glued_triangles(4, 2)));
}

TEST_CASE("a script replayed backwards comes to nothing", "[bench]") {
  const Operations forwards = tools::torus(2);
  const Operations operations = tools::replayed_backwards(forwards);
  CHECK(operations.size() == 2 * forwards.size());
  Engine engine;
  build(engine, forwards);
  CHECK(live_groups(engine) == torus_groups);
  for (std::size_t k = forwards.size(); k < operations.size(); ++k) {
    carry_out(engine, operations[k]);
  }
  CHECK(engine.cells().empty());
}

TEST_CASE("random triangles fill the complete graph", "[bench]") {
  Engine engine(sparse::Z2{});
  build(engine, tools::random_triangles(8, 30, 4));
  CHECK(cells_of(engine) == Counts{8, 28, 30});
  CHECK(engine.undoable() == 66);
  const auto betti = engine.homology().betti;
  CHECK(betti[0] == 1);
  CHECK(betti[1] - betti[2] == 21 - 30);
}

TEST_CASE("cones are points, and suspensions move homology up", "[bench]") {
  for (const std::uint32_t cones : {1U, 2U, 4U}) {
    Engine engine;
    build(engine, tools::iterated_cones(3, cones));
    std::uint64_t total = 0;
    for (const std::uint64_t count : engine.cells()) {
      total += count;
    }
    CHECK(total == (std::uint64_t{4} << cones) - 1);
    CHECK(live_groups(engine) == Groups{group(1)});
  }
  check(tools::suspended_points(0), {2}, groups_of_sphere(0));
  check(tools::suspended_points(2), {6, 12, 8}, groups_of_sphere(2));
  check(tools::suspended_points(4), {10, 40, 80, 80, 32}, groups_of_sphere(4));
  check(tools::suspended_klein_bottle(3), {9 + 2, 27 + 18, 18 + 54, 36}, suspended(klein_groups));
}

TEST_CASE("products of circles are tori, and gluings inside them add loops", "[bench]") {
  check(tools::product_of_circles(3, 1), {3, 3}, {group(1), group(1)});
  check(tools::product_of_circles(3, 2), {9, 18, 9}, torus_groups);
  check(tools::product_of_circles(2, 3), {8, 24, 24, 8}, {group(1), group(3), group(3), group(1)});
  check(tools::glued_product_of_circles(4, 2, 3), {13, 32, 16}, {group(1), group(5), group(1)});
  check(tools::glued_product_of_circles(3, 3, 1), {26, 81, 81, 27}, {group(1), group(4), group(3), group(1)});
}
