#include "ops/maps/chain_of_surfaces.hpp"
#include "ops/maps/chain_operations.hpp"
#include "ops/maps/order_operations.hpp"
#include "ops/maps/order_simplices.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/order_models.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

/// Whether an order is a chain of surfaces, by the definition, word by word.
bool is_literally_a_chain_of_surfaces(const Order& order) {
  return order.size() > 0 && order.is_connected() && std::ranges::all_of(order.principal_cells(), [&](OrderCell x) {
           return order.rank(x) == 0 || is_literally_a_surface(order, order.boundary(x), order.rank(x) - 1);
         });
}

/// An order with a face less, or with two cells identified, where that is possible.
Order spoilt_chain(Random& random, const Order& order) {
  const auto any = [&] { return static_cast<OrderCell>(random.in(0, static_cast<int>(order.size()) - 1)); };
  if (random.one_in(2)) {
    const std::vector<std::pair<OrderCell, OrderCell>> pairs{{any(), any()}};
    const Result<IdentifiedOrder> identified = identify_cells(order, pairs);
    return identified ? identified->order : order;
  }
  std::vector<CellSet> faces;
  for (OrderCell x = 0; x < order.size(); ++x) {
    faces.push_back(order.faces(x));
  }
  if (CellSet& list = faces[any()]; list.size() > 1) {
    list.erase(list.begin() + random.in(0, static_cast<int>(list.size()) - 1));
  }
  const Result<Order> changed = Order::make(faces);
  return changed ? *changed : order;
}

/// A connected chain of surfaces that is no surface: triangles 9, 10, 11 along the edge 4, the tetrahedron 16 with its
/// faces 9 and 17 to 19, and an edge 21 from vertex 3 to a vertex 20.
Order book_with_tetrahedron() {
  return order_of(
      {{},          {},          {},          {},      {0, 1},  {1, 2},  {0, 2},  {1, 3},          {0, 3},
       {4, 5, 6},   {4, 7, 8},   {4, 13, 14}, {},      {0, 12}, {1, 12}, {2, 22}, {9, 17, 18, 19}, {4, 23, 24},
       {5, 15, 24}, {6, 15, 23}, {},          {3, 20}, {},      {0, 22}, {1, 22}});
}

}  // namespace

TEST_CASE("cells whose boundaries are surfaces are a chain of surfaces, however they are assembled", "[maps]") {
  const Order order = book_with_tetrahedron();
  CHECK(order.f_vector() == FVector{7, 11, 6, 1});
  CHECK(refusal_of(check_chain_of_surfaces(order)) == "none");
  CHECK_FALSE(order.is_pure());
  CHECK(refusal_of(check_surface(order)).starts_with("refused: cell 10 of dimension 2 is no face"));
  const auto chain = chain_of_maps_of_surfaces(order);
  REQUIRE(chain);
  CHECK(chain->cell_counts() == order.f_vector());
  CHECK(chain->level(3).size() == 24);
  CHECK(chain->level(2).size() == 36);
  CHECK(chain->level(1).size() == 22);
  CHECK(chain->level(0).size() == 7);
  CHECK(simplicial_analogue(*chain).f_vector() == simplicial_analogue(order).f_vector());
  CHECK(homology_of(simplicial_analogue(*chain)) == GroupNames{"Z"});
  CHECK(refusal_of(gmap_of_chain(*chain)).starts_with("refused: dart"));
}

TEST_CASE("an order is called a chain of surfaces exactly when the definition says so", "[maps]") {
  Random random(14);
  int chains = 0;
  int others = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Order order = trial % 4 == 3 ? order_of_simplices(simplicial_analogue(random_surface_map(random, 2, false)))
                                 : random_order(random);
    for (int k = random.in(0, 2); k > 0; --k) {
      order = spoilt_chain(random, order);
    }
    const bool literally = is_literally_a_chain_of_surfaces(order);
    CHECK(static_cast<bool>(check_chain_of_surfaces(order)) == literally);
    ++(literally ? chains : others);
    if (!literally) {
      continue;
    }
    // Between a cell, or none, and one two dimensions above it there are two cells or none.
    for (OrderCell x = 0; x < order.size(); ++x) {
      CHECK((order.rank(x) != 1 || order.faces(x).size() == 2));
      for (OrderCell y = 0; y < order.size(); ++y) {
        CellSet between;
        std::ranges::set_intersection(order.cofaces(y), order.faces(x), std::back_inserter(between));
        CHECK((between.empty() || between.size() == 2));
      }
    }
  }
  CHECK(chains > 50);
  CHECK(others > 50);
}

TEST_CASE("chains of surfaces and chains of maps without multi-incidence are the same, dart by dart", "[maps]") {
  Random random(15);
  int compared = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const Order order = random_order(random);
    const auto chain = chain_of_maps_of_surfaces(order);
    if (!chain) {
      CHECK_FALSE(order.is_connected());
      continue;
    }
    ++compared;
    const auto back = chain_of_surfaces_of_maps(*chain);
    REQUIRE(back);
    REQUIRE(back->f_vector() == order.f_vector());
    std::vector<OrderCell> image(order.size(), no_order_cell);
    OrderCell before = 0;
    for (int i = 0; i <= order.dimension(); ++i) {
      const Orbits parts = chain->cells(i);
      const auto tuples = cell_tuples(order, i);
      REQUIRE(tuples.size() == chain->level(i).size());
      for (Dart d = 0; d < tuples.size(); ++d) {
        OrderCell& place = image[tuples[d].back()];
        CHECK((place == no_order_cell || place == before + parts.of[d]));
        place = before + parts.of[d];
        if (i > 0) {
          CHECK(cell_tuples(order, i - 1)[chain->sigma(i, d)] == CellSet(tuples[d].begin(), tuples[d].end() - 1));
        }
      }
      before += parts.count();
    }
    for (OrderCell x = 0; x < order.size(); ++x) {
      CellSet faces;
      std::ranges::transform(order.faces(x), std::back_inserter(faces), [&](OrderCell y) { return image[y]; });
      std::ranges::sort(faces);
      CHECK(back->faces(image[x]) == faces);
    }
    for (int p = 0; p <= order.dimension(); ++p) {
      CHECK(vertex_lists(simplicial_analogue(*back), p) == vertex_lists(simplicial_analogue(*chain), p));
    }
    CHECK(homology_of(simplicial_analogue(order)) == homology_of(simplicial_analogue(*chain)));
  }
  CHECK(compared > 60);
}

TEST_CASE("surfaces lead to the same chain of maps by their G-map, and maps to the same order by their chain",
          "[maps]") {
  Random random(16);
  for (int trial = 0; trial < 30; ++trial) {
    const Order order = random_surface(random);
    const auto map = gmap_of_surface(order);
    REQUIRE(map);
    const auto chain = chain_of_gmap(*map);
    REQUIRE(chain);
    if (order.dimension() == 0) {
      CHECK(refusal_of(chain_of_surfaces_of_maps(*chain)) ==
            "refused: the cells are not connected: those of a chain of surfaces are");
      continue;
    }
    CHECK(*chain_of_maps_of_surfaces(order) == *chain);
    CHECK(*chain_of_surfaces_of_maps(*chain) == *surface_of_gmap(*map));
    CHECK(*gmap_of_chain(*chain) == *map);
  }
  for (const GMap& map :
       {surface_of_a_cube(), quad_torus(3), suspension_of(surface_of_a_cube()), suspension_of(quad_torus(3))}) {
    CHECK(*chain_of_surfaces_of_maps(*chain_of_gmap(map)) == *surface_of_gmap(map));
  }
}

TEST_CASE("a solid cell whose sides are free is a chain of surfaces, though no surface", "[maps]") {
  for (const GMap& map : {polygon(4), extended(surface_of_a_cube()), extended(quad_torus(3))}) {
    const auto order = chain_of_surfaces_of_maps(*chain_of_gmap(map));
    REQUIRE(order);
    CHECK(check_chain_of_surfaces(*order));
    CHECK_FALSE(check_surface(*order));
    const auto back = gmap_of_chain(*chain_of_maps_of_surfaces(*order));
    REQUIRE(back);
    CHECK(back->size() == map.size());
    CHECK(simplicial_analogue(*back).f_vector() == simplicial_analogue(map).f_vector());
    CHECK(homology_of(simplicial_analogue(*back)) == GroupNames{"Z"});
    CHECK(chain_of_surfaces_of_maps(*chain_of_gmap(*back))->f_vector() == order->f_vector());
  }
}

TEST_CASE("what is no chain of surfaces is refused, naming darts or cells", "[maps]") {
  const auto said = [](std::vector<CellSet> faces) {
    return refusal_of(check_chain_of_surfaces(order_of(std::move(faces))));
  };
  CHECK(said({}) == "refused: a chain of surfaces has a cell");
  CHECK(said({{}}) == "none");
  CHECK(said({{}, {}}) == "refused: the cells are not connected: those of a chain of surfaces are");
  CHECK(said({{}, {0}}) == "refused: below cell 1 the number of cells of dimension 0 is 1: in a surface it is 2");
  CHECK(said({{}, {}, {0, 1}, {0, 1}, {0, 1}, {2, 3, 4}}) ==
        "refused: between cell 0 and cell 5 the number of cells of dimension 1 is 3: in a surface it is 2");
  // A face with two boundaries, and an edge between these.
  CHECK(said({{}, {}, {0, 1}, {0, 1}, {}, {}, {4, 5}, {4, 5}, {2, 3, 6, 7}, {0, 4}}) ==
        "refused: below cell 8 the cells are not connected, such as cells 0 and 4: in a surface they are");
  CHECK(refusal_of(chain_of_maps_of_surfaces(order_of({{}, {0}}))) ==
        "refused: below cell 1 the number of cells of dimension 0 is 1: in a surface it is 2");
  CHECK(
      refusal_of(chain_of_surfaces_of_maps(*chain_of_gmap(*GMap::make({{0}, {0}})))) ==
      "refused: dart 0 of level 1 is 0-free: a chain of surfaces has cells whose boundaries have no boundary, so each "
      "dart has another one by alpha_0");
  CHECK(refusal_of(chain_of_surfaces_of_maps(*chain_of_gmap(sewn_square(torus_pairs)))) ==
        "refused: no order has these cells: the cells 0, 1 are incident more than once, by the 1-simplices 0 and 1");
  CHECK(refusal_of(chain_of_surfaces_of_maps(*chain_of_gmap(disjoint_union(polygon(3), polygon(3))))) ==
        "refused: the cells are not connected: those of a chain of surfaces are");
  CHECK(refusal_of(chain_of_surfaces_of_maps(ChainOfMaps())) == "refused: a chain of surfaces has a cell");
}
