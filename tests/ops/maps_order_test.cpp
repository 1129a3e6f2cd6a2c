#include "ops/maps/order_operations.hpp"
#include "ops/maps/order_simplices.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/order_models.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

using Cells = std::vector<OrderCell>;
using CellPairs = std::vector<std::pair<OrderCell, OrderCell>>;

/// Two triangles 9 and 10 along edge 4: vertices 0 to 3, edges 4 = 01, 5 = 12, 6 = 02, 7 = 13, 8 = 03.
Order order_of_two_triangles() {
  return order_of({{}, {}, {}, {}, {0, 1}, {1, 2}, {0, 2}, {1, 3}, {0, 3}, {4, 5, 6}, {4, 7, 8}});
}

/// Vertices 0 and 1, edges 2 and 3 between them, and a face 4.
Order digon() { return order_of({{}, {}, {0, 1}, {0, 1}, {2, 3}}); }

/// Whether y lies below x, said by the definition: steps to faces lead there.
bool is_below(const Order& order, OrderCell y, OrderCell x) {
  return std::ranges::any_of(order.faces(x), [&](OrderCell z) { return z == y || is_below(order, y, z); });
}

}  // namespace

TEST_CASE("ranks, faces, closures, stars and adherences of an order are what its definition says", "[maps]") {
  const Order order = order_of_two_triangles();
  CHECK(order.dimension() == 2);
  CHECK(order.f_vector() == FVector{4, 5, 2});
  CHECK(order.closure(9) == Cells{0, 1, 2, 4, 5, 6, 9});
  CHECK(order.boundary(9) == Cells{0, 1, 2, 4, 5, 6});
  CHECK(order.faces(9) == Cells{4, 5, 6});
  CHECK(order.star(3) == Cells{3, 7, 8, 10});
  CHECK(order.strict_star(3) == Cells{7, 8, 10});
  CHECK(order.cofaces(3) == Cells{7, 8});
  CHECK(order.adherence(4) == Cells{0, 1, 4, 9, 10});
  CHECK(order.strict_adherence(4) == Cells{0, 1, 9, 10});
  CHECK(order.neighbours(4) == Cells{0, 1, 9, 10});
  CHECK(order.neighbours(0) == Cells{4, 6, 8});
  CHECK(order.principal_cells() == Cells{9, 10});
  CHECK(order.is_pure());
  CHECK(order.is_connected());
  CHECK(Order() == order_of({}));
  CHECK(Order().dimension() == -1);
  CHECK(Order().is_connected());
  CHECK_FALSE(order_of({{}, {}}).is_connected());
  CHECK_FALSE(order_of({{}, {}, {}, {0, 1}}).is_pure());
}

TEST_CASE("relations of random orders agree with steps to faces", "[maps]") {
  Random random(3);
  for (int trial = 0; trial < 40; ++trial) {
    const Order order = random_order(random);
    for (OrderCell x = 0; x < order.size(); ++x) {
      int longest = 0;
      for (const OrderCell y : order.faces(x)) {
        longest = std::max(longest, order.rank(y) + 1);
      }
      CHECK(order.rank(x) == longest);
      for (OrderCell y = 0; y < order.size(); ++y) {
        const bool below = is_below(order, y, x);
        const bool above = is_below(order, x, y);
        CHECK(std::ranges::binary_search(order.boundary(x), y) == below);
        CHECK(std::ranges::binary_search(order.strict_star(x), y) == above);
        CHECK(std::ranges::binary_search(order.adherence(x), y) == (below || above || x == y));
        CHECK(std::ranges::binary_search(order.strict_adherence(x), y) == (below || above));
        CHECK(std::ranges::binary_search(order.cofaces(y), x) == std::ranges::binary_search(order.faces(x), y));
      }
    }
  }
}

TEST_CASE("faces that make no order without jumps are refused, naming the cell and the face", "[maps]") {
  CHECK(refusal_of(Order::make({{}, {0, 2}})) == "bad input: cell 1 has the face 2, but there are only 2 cells");
  CHECK(refusal_of(Order::make({{}, {0, 0}})) ==
        "bad input: cell 1 has the face 0 twice: in an order a cell is a face once");
  CHECK(refusal_of(Order::make({{}, {2, 0}, {3}, {1}, {1}})) ==
        "bad input: cell 1 lies below itself, by its faces and theirs: no cell may");
  CHECK(refusal_of(Order::make({{4}, {}, {1}, {1}, {0}})) ==
        "bad input: cell 0 lies below itself, by its faces and theirs: no cell may");
  CHECK(refusal_of(Order::make({{}, {}, {}, {0, 1}, {2, 3}})) ==
        "bad input: there is a jump in dimension from cell 4 of dimension 2 to its face 2 of dimension 0");
  CHECK(refusal_of(Order::make({{}, {}, {0, 1}, {0, 2}})) ==
        "bad input: cell 3 has the face 0, which lies below its face 2: only cells next below it are faces");
  const auto name = [](OrderCell x) { return std::string(1, static_cast<char>('a' + x)); };
  CHECK(refusal_of(Order::make({{}, {0, 0}}, name)) ==
        "bad input: cell b has the face a twice: in an order a cell is a face once");
  CHECK(refusal_of(Order::make({{}, {}, {}, {0, 1}, {2, 3}}, name)) ==
        "bad input: there is a jump in dimension from cell e of dimension 2 to its face c of dimension 0");
  std::vector<Cells> tower(32);
  for (OrderCell x = 1; x < 32; ++x) {
    tower[x] = {x - 1};
  }
  CHECK(refusal_of(Order::make(tower)) == "bad input: cell 31 has the dimension 31: at most 30 is possible");
}

TEST_CASE("suborders have the order of the whole, and ranks of their own", "[maps]") {
  const Order order = order_of_two_triangles();
  const auto sub = [&](Cells cells) { return std::move(*suborder(order, std::move(cells))); };
  CHECK(sub(order.closure(9)).order == order_of({{}, {}, {}, {0, 1}, {1, 2}, {0, 2}, {3, 4, 5}}));
  CHECK(sub(order.closure(9)).cells == Cells{0, 1, 2, 4, 5, 6, 9});
  CHECK(sub(order.adherence(4)).order == order_of({{}, {}, {0, 1}, {2}, {2}}));
  CHECK(sub(order.strict_adherence(4)).order == order_of({{}, {}, {0, 1}, {0, 1}}));
  CHECK(sub(order.faces(9)).order == order_of({{}, {}, {}}));
  CHECK(sub(order.star(3)).order == order_of({{}, {0}, {0}, {1, 2}}));
  CHECK(sub({10, 3, 3}).order == order_of({{}, {0}}));
  CHECK(sub({10, 3, 3}).cells == Cells{3, 10});
  CHECK(
      refusal_of(suborder(order, {0, 1, 4, 9, 2})) ==
      "refused: these cells have a jump in dimension among them: cell 9 has the rank 2 there, and cell 2 next below it "
      "the rank 0");
  const Order triangle = order_of({{3, 4}, {4, 5}, {3, 5}, {}, {}, {}, {0, 1, 2}});
  CHECK(
      refusal_of(suborder(triangle, {0, 3, 4, 5, 6})) ==
      "refused: these cells have a jump in dimension among them: cell 6 has the rank 2 there, and cell 5 next below it "
      "the rank 0");
  CHECK(refusal_of(suborder(order, {11})) == "bad input: there is no cell 11, only 11 cells");
}

TEST_CASE("the analogue of an order are its chains", "[maps]") {
  CHECK(simplicial_analogue(order_of_two_triangles()).f_vector() == FVector{11, 22, 12});
  CHECK(homology_of(simplicial_analogue(order_of_two_triangles())) == GroupNames{"Z"});
  CHECK(simplicial_analogue(Order()) == NumberedSet());
  Random random(4);
  for (int trial = 0; trial < 40; ++trial) {
    const Order order = random_order(random);
    const NumberedSet set = simplicial_analogue(order);
    CHECK(set.cell_counts() == order.f_vector());
    for (int p = 1; p <= order.dimension(); ++p) {
      const auto lists = vertex_lists(set, p);
      CHECK(std::ranges::adjacent_find(lists) == lists.end());
      for (const auto& list : lists) {
        for (std::size_t k = 0; k + 1 < list.size(); ++k) {
          REQUIRE(is_below(order, list[k], list[k + 1]));
        }
      }
    }
    std::size_t edges = 0;
    for (OrderCell x = 0; x < order.size(); ++x) {
      edges += order.boundary(x).size();
    }
    CHECK(set.count(1) == edges);
    CHECK(*order_of_cells(set) == order);
  }
}

TEST_CASE("the order of the simplices of a numbered set has its homology", "[maps]") {
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const NumberedSet set = simplicial_analogue(random_surface_map(random, random.in(1, 6), false));
    const Order order = order_of_simplices(set);
    CHECK(order.f_vector() == set.f_vector());
    CHECK(homology_of(simplicial_analogue(order)) == homology_of(set));
  }
}

TEST_CASE("multi-incident objects with the same incidences have one order, which describes none of them", "[maps]") {
  // A torus and a Klein bottle of one square; and a projective plane of one square against a disk of two sides.
  CHECK(homology_of(simplicial_analogue(order_of({{}, {0}, {0}, {1, 2}}))) == GroupNames{"Z"});
  CHECK(simplicial_analogue(order_of({{}, {0}, {0}, {1, 2}})).f_vector() == FVector{4, 5, 2});
  CHECK(homology_of(simplicial_analogue(digon())) == GroupNames{"Z"});
  CHECK(refusal_of(order_of_cells(simplicial_analogue(sewn_square(torus_pairs)))) ==
        "refused: no order has these cells: the cells 0, 1 are incident more than once, by the 1-simplices 0 and 1");
  CHECK(refusal_of(order_of_cells(simplicial_analogue(sewn_square(klein_bottle_pairs))))
            .starts_with("refused: no order"));
  CHECK(refusal_of(order_of_cells(simplicial_analogue(sewn_square(projective_plane_pairs)))) ==
        "refused: no order has these cells: the cells 0, 4 are incident more than once, by the 1-simplices 4 and 6");
  CHECK(*order_of_cells(simplicial_analogue(polygon(2))) == digon());
}

TEST_CASE("faces that are sewn along half an edge are no order, since a chain of cells has no simplex", "[maps]") {
  // Vertices 0, 1, 2 are numbered 0, vertex 3 is the edge, which so has three ends, and 4, 5 are faces that have it.
  // Face 4 has the ends 0 and 1, face 5 the ends 0 and 2.
  const auto set =
      NumberedSet::make({0, 0, 0, 1, 2, 2}, {{{3, 0}, {3, 1}, {3, 2}, {4, 3}, {5, 3}, {4, 0}, {4, 1}, {5, 0}, {5, 2}},
                                             {{3, 5, 0}, {3, 6, 1}, {4, 7, 0}, {4, 8, 2}}});
  REQUIRE(set);
  CHECK(set->cell_counts() == FVector{3, 1, 2});
  CHECK(
      refusal_of(order_of_cells(*set)) ==
      "refused: no order has these cells: of the cells 1, 5 each lies below the next one, but no simplex has them all");
}

TEST_CASE("cells need not be balls: an edge with three ends, a face with two boundaries", "[maps]") {
  // Vertices 0 to 4; edge 5 has three ends; edges 6, 7 join 0 and 1, edges 8, 9 join 2 and 3, and 10 joins 3 and 4.
  const Order order =
      order_of({{}, {}, {}, {}, {}, {0, 1, 2}, {0, 1}, {0, 1}, {2, 3}, {2, 3}, {3, 4}, {5, 8, 10}, {6, 7, 8, 9}});
  CHECK(order.is_pure());
  const NumberedSet set = simplicial_analogue(order);
  CHECK(set.canonical_boundary(5).f_vector() == FVector{3});
  CHECK(homology_of(set.canonical_boundary(12)) == GroupNames{"Z^2", "Z^2"});
  CHECK(homology_of(set.canonical_boundary(6)) == GroupNames{"Z^2"});
}

TEST_CASE("a cone on a pure suborder is an order, another one would have a jump and is refused", "[maps]") {
  // Two triangles, and an edge 12 from vertex 3 to a new one, 11.
  std::vector<Cells> faces;
  for (OrderCell x = 0; x < 11; ++x) {
    faces.push_back(order_of_two_triangles().faces(x));
  }
  faces.push_back({});
  faces.push_back({3, 11});
  const Order order = order_of(faces);
  Cells all(13);
  std::iota(all.begin(), all.end(), OrderCell{0});
  CHECK(refusal_of(cellular_cone(order, all)) ==
        "refused: the base is not pure: cell 10 of dimension 2 and cell 12 of dimension 1 are no faces within it, so "
        "from "
        "the cone, of dimension 3, there would be a jump to cell 12");
  const auto solid = cellular_cone(order, Cells(all.begin(), all.begin() + 11));
  REQUIRE(solid);
  CHECK(solid->size() == 14);
  CHECK(solid->rank(13) == 3);
  CHECK(solid->faces(13) == Cells{9, 10});
  CHECK(homology_of(simplicial_analogue(*solid)) == GroupNames{"Z"});
  const auto face = cellular_cone(order, order.closure(12));
  REQUIRE(face);
  CHECK(face->rank(13) == 2);
  CHECK(face->faces(13) == Cells{12});
  const auto vertex = cellular_cone(order, {});
  REQUIRE(vertex);
  CHECK(vertex->rank(13) == 0);
  const auto edge = cellular_cone(order, {0, 2, 11});
  REQUIRE(edge);
  CHECK(edge->faces(13) == Cells{0, 2, 11});
  CHECK(refusal_of(cellular_cone(order, {4, 0})) ==
        "bad input: a cone over cell 4 is one over its face 1, too, which is not in the base");
  CHECK(refusal_of(cellular_cone(order, {13})) == "bad input: there is no cell 13, only 13 cells");
}

TEST_CASE("cones build a sphere, a ball, and the 3-sphere of two balls", "[maps]") {
  Order order;
  for (int dimension = 0; dimension <= 3; ++dimension) {  // two cells over all cells of smaller dimensions
    Cells below(order.size());
    std::iota(below.begin(), below.end(), OrderCell{0});
    order = std::move(*cellular_cone(order, below));
    if (dimension > 0) {
      CHECK(homology_of(simplicial_analogue(order)) == GroupNames{"Z"});
    }
    order = std::move(*cellular_cone(order, below));
    GroupNames sphere(static_cast<std::size_t>(dimension) + 1, "0");
    sphere.front() = sphere.back() = "Z";
    CHECK(homology_of(simplicial_analogue(order)) == (dimension == 0 ? GroupNames{"Z^2"} : sphere));
  }
  CHECK(order.f_vector() == FVector{2, 2, 2, 2});
}

TEST_CASE("identified cells become one, with their faces", "[maps]") {
  // Two squares 8 and 17, each with vertices v to v + 3 and edges v + 4 to v + 7.
  const Order squares = order_of({{},
                                  {},
                                  {},
                                  {},
                                  {0, 1},
                                  {1, 2},
                                  {2, 3},
                                  {0, 3},
                                  {4, 5, 6, 7},
                                  {},
                                  {},
                                  {},
                                  {},
                                  {9, 10},
                                  {10, 11},
                                  {11, 12},
                                  {9, 12},
                                  {13, 14, 15, 16}});
  const auto along_edge = identify_cells(squares, CellPairs{{4, 13}, {0, 9}, {1, 10}});
  REQUIRE(along_edge);
  CHECK(along_edge->order.f_vector() == FVector{6, 7, 2});
  CHECK(along_edge->image == Cells{0, 1, 2, 3, 4, 5, 6, 7, 8, 0, 1, 9, 10, 4, 11, 12, 13, 14});
  CHECK(along_edge->order.cofaces(4) == Cells{8, 14});
  CHECK(homology_of(simplicial_analogue(along_edge->order)) == GroupNames{"Z"});
  // The four edges of both, one pair after the other: a sphere.
  const auto sphere =
      identify_cells(squares, CellPairs{{4, 13}, {5, 14}, {6, 15}, {7, 16}, {0, 9}, {1, 10}, {2, 11}, {3, 12}});
  REQUIRE(sphere);
  CHECK(sphere->order.f_vector() == FVector{4, 4, 2});
  CHECK(homology_of(simplicial_analogue(sphere->order)) == GroupNames{"Z", "0", "Z"});
  // The faces too: one square is left.
  const auto one = identify_cells(sphere->order, CellPairs{{8, 9}});
  REQUIRE(one);
  CHECK(one->order.f_vector() == FVector{4, 4, 1});
  // Opposite sides of a square: an annulus.
  const auto annulus = identify_cells(squares, CellPairs{{4, 6}, {0, 3}, {1, 2}});
  REQUIRE(annulus);
  CHECK(annulus->order.f_vector() == FVector{6, 7, 2});
}

TEST_CASE("edges that follow each other are identified by a chain of vertices, and faces that become one are one",
          "[maps]") {
  const Order path = order_of({{}, {}, {}, {0, 1}, {1, 2}});
  const auto loop = identify_cells(path, CellPairs{{3, 4}, {0, 1}, {1, 2}});
  REQUIRE(loop);
  CHECK(loop->order == order_of({{}, {0}}));
  CHECK(loop->image == Cells{0, 0, 0, 1, 1});
  const auto folded = identify_cells(path, CellPairs{{3, 4}, {0, 2}});
  REQUIRE(folded);
  CHECK(folded->order == order_of({{}, {}, {0, 1}}));
}

TEST_CASE("cells are not identified unless the pairs are an isomorphism of their closures", "[maps]") {
  const Order order = order_of({{}, {}, {}, {}, {0, 1}, {2, 3}, {1, 2}, {4, 5, 6}});
  CHECK(refusal_of(identify_cells(order, CellPairs{{4, 5}, {0, 2}})) ==
        "refused: cells 4 and 5 cannot be identified: their faces do not correspond at cell 1, since the pairs are no "
        "isomorphism of closures");
  CHECK(refusal_of(identify_cells(order, CellPairs{{0, 4}})) ==
        "refused: cells 0 and 4 cannot be identified: their faces do not correspond at cell 0, since the pairs are no "
        "isomorphism of closures");
  CHECK(refusal_of(identify_cells(order, CellPairs{{0, 2}, {0, 3}})) ==
        "bad input: cell 0 is paired twice: each cell has one that corresponds to it");
  CHECK(refusal_of(identify_cells(order, CellPairs{{0, 2}, {1, 2}})) ==
        "bad input: cell 2 is paired twice: each cell has one that corresponds to it");
  CHECK(refusal_of(identify_cells(order, CellPairs{{0, 8}})) == "bad input: there is no cell 8, only 8 cells");
}
