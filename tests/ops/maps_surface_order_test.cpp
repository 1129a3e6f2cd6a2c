#include "ops/maps/order_operations.hpp"
#include "ops/maps/order_simplices.hpp"
#include "ops/maps/surface_order.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/order_models.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

/// Two vertices 0 and 1, two edges 2 and 3, two faces 4 and 5, each incident to all of other dimensions.
Order sphere_of_two_digons() { return order_of({{}, {}, {0, 1}, {0, 1}, {2, 3}, {2, 3}}); }

CellSet every_cell(const Order& order) {
  CellSet cells(order.size());
  std::iota(cells.begin(), cells.end(), OrderCell{0});
  return cells;
}

/// The proper faces of a simplex: a sphere of the dimension below.
Order boundary_of_simplex(int dimension) {
  const auto vertices = static_cast<std::size_t>(dimension) + 1;
  std::vector<CellSet> faces((std::size_t{1} << vertices) - 2);
  for (std::size_t set = 1; set <= faces.size(); ++set) {
    for (std::size_t v = 0; v < vertices; ++v) {
      const std::size_t rest = set & ~(std::size_t{1} << v);
      if (rest != set && rest != 0) {
        faces[set - 1].push_back(static_cast<OrderCell>(rest - 1));
      }
    }
  }
  return order_of(faces);
}

/// An order with a random change: a cell less that is no face, two cells identified, or a face less.
Order spoilt(Random& random, const Order& order) {
  std::vector<CellSet> faces;
  for (OrderCell x = 0; x < order.size(); ++x) {
    faces.push_back(order.faces(x));
  }
  const auto any = [&] { return static_cast<OrderCell>(random.in(0, static_cast<int>(order.size()) - 1)); };
  switch (random.in(0, 2)) {
    case 0: {
      CellSet cells = every_cell(order);
      const CellSet principal = order.principal_cells();
      std::erase(cells, principal[static_cast<std::size_t>(random.in(0, static_cast<int>(principal.size()) - 1))]);
      return cells.empty() ? order : suborder(order, cells)->order;
    }
    case 1: {
      const OrderCell x = any();
      const OrderCell y = any();
      const std::vector<std::pair<OrderCell, OrderCell>> pairs{{x, y}};
      const Result<IdentifiedOrder> identified = identify_cells(order, pairs);
      return identified ? identified->order : order;
    }
    default: {
      CellSet& list = faces[any()];
      if (list.size() > 1) {
        list.pop_back();
      }
      const Result<Order> changed = Order::make(faces);
      return changed ? *changed : order;
    }
  }
}

}  // namespace

TEST_CASE("two digons glued to a sphere are a 2-surface, and what is beside an edge a 1-surface", "[maps]") {
  const Order order = sphere_of_two_digons();
  CHECK(check_surface(order));
  CHECK(order.strict_adherence(2) == CellSet{0, 1, 4, 5});
  CHECK(order.strict_adherence(3) == order.strict_adherence(2));
  CHECK(check_surface(suborder(order, order.strict_adherence(2))->order));
  const auto map = gmap_of_surface(order);
  REQUIRE(map);
  CHECK(map->size() == 8);
  CHECK(simplicial_analogue(*map).cell_counts() == FVector{2, 2, 2});
  CHECK(homology_of(simplicial_analogue(*map)) == GroupNames{"Z", "0", "Z"});
  CHECK_FALSE(simplicial_analogue(*map).multi_incidence());
  CHECK(*surface_of_gmap(*map) == order);
}

TEST_CASE("a switch exchanges one cell between two others, fictive ones included", "[maps]") {
  const Order torus = std::move(*surface_of_gmap(quad_torus(3)));
  REQUIRE(torus.f_vector() == FVector{9, 18, 9});
  for (const CellSet& tuple : cell_tuples(torus, 2)) {
    const OrderCell vertex = switched(torus, no_order_cell, tuple[0], tuple[1]);
    CHECK(vertex != tuple[0]);
    CHECK(torus.faces(tuple[1]) == CellSet{std::min(vertex, tuple[0]), std::max(vertex, tuple[0])});
    const OrderCell edge = switched(torus, tuple[0], tuple[1], tuple[2]);
    CHECK(edge != tuple[1]);
    CHECK(std::ranges::binary_search(torus.faces(tuple[2]), edge));
    CHECK(std::ranges::binary_search(torus.cofaces(tuple[0]), edge));
    const OrderCell face = switched(torus, tuple[1], tuple[2], no_order_cell);
    CHECK(torus.cofaces(tuple[1]) == CellSet{std::min(face, tuple[2]), std::max(face, tuple[2])});
  }
  const Order points = order_of({{}, {}});
  CHECK(switched(points, no_order_cell, 0, no_order_cell) == 1);
  CHECK_THROWS_AS(switched(order_of({{}}), no_order_cell, 0, no_order_cell), sparse::ContractViolation);
  CHECK_THROWS_AS(switched(torus, 0, 1, no_order_cell), sparse::ContractViolation);
}

TEST_CASE("boundaries of simplices and random closed maps give surfaces", "[maps]") {
  for (int dimension = 1; dimension <= 5; ++dimension) {
    const Order order = boundary_of_simplex(dimension);
    CHECK(check_surface(order));
    std::size_t factorial = 1;
    for (int k = 2; k <= dimension + 1; ++k) {
      factorial *= static_cast<std::size_t>(k);
    }
    CHECK(cell_tuples(order, dimension - 1).size() == factorial);
    const auto map = gmap_of_surface(order);
    REQUIRE(map);
    CHECK(surface_of_gmap(*map)->f_vector() == order.f_vector());
  }
  Random random(6);
  for (int trial = 0; trial < 60; ++trial) {
    CHECK(refusal_of(check_surface(random_surface(random))) == "none");
  }
}

TEST_CASE("an order is called a surface exactly when the recursive definition says so", "[maps]") {
  Random random(7);
  int surfaces = 0;
  int others = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Order order = random.one_in(4) ? boundary_of_simplex(random.in(1, 3))
                  : random.one_in(3)
                      ? *surface_of_gmap(suspension_of(closed_polygon(static_cast<Dart>(random.in(2, 4)))))
                  : random.one_in(2) ? order_of_simplices(simplicial_analogue(closed_polygon(2)))
                                     : random_order(random);
    for (int k = random.in(0, 2); k > 0; --k) {
      order = spoilt(random, order);
    }
    const bool literally = is_literally_a_surface(order, every_cell(order), order.dimension());
    CAPTURE(trial, order.f_vector());
    CHECK(static_cast<bool>(check_surface(order)) == literally);
    ++(literally ? surfaces : others);
  }
  CHECK(surfaces > 50);
  CHECK(others > 50);
}

TEST_CASE("closed maps without multi-incidence and surfaces are the same, dart by dart", "[maps]") {
  Random random(8);
  for (int trial = 0; trial < 40; ++trial) {
    const Order order = random_surface(random);
    const auto map = gmap_of_surface(order);
    REQUIRE(map);
    const auto tuples = cell_tuples(order, order.dimension());
    REQUIRE(tuples.size() == map->size());
    for (Dart d = 0; d < map->size(); ++d) {
      for (int i = 0; i <= order.dimension(); ++i) {
        const CellSet& beyond = tuples[map->alpha(i, d)];
        for (std::size_t k = 0; k < beyond.size(); ++k) {
          CHECK((beyond[k] == tuples[d][k]) == (k != static_cast<std::size_t>(i)));
        }
      }
    }
    const auto back = surface_of_gmap(*map);
    REQUIRE(back);
    REQUIRE(back->f_vector() == order.f_vector());
    // The cell of a dart in the surface that comes back is that of its tuple, whatever their numbers.
    std::vector<OrderCell> image(order.size(), no_order_cell);
    OrderCell before = 0;
    for (int i = 0; i <= order.dimension(); ++i) {
      const Orbits parts = cells(*map, i);
      for (Dart d = 0; d < map->size(); ++d) {
        OrderCell& place = image[tuples[d][static_cast<std::size_t>(i)]];
        CHECK((place == no_order_cell || place == before + parts.of[d]));
        place = before + parts.of[d];
      }
      before += parts.count();
    }
    for (OrderCell x = 0; x < order.size(); ++x) {
      CellSet faces;
      std::ranges::transform(order.faces(x), std::back_inserter(faces), [&](OrderCell y) { return image[y]; });
      std::ranges::sort(faces);
      CHECK(back->faces(image[x]) == faces);
    }
    // Both stand for the same simplices.
    for (int p = 0; p <= order.dimension(); ++p) {
      CHECK(vertex_lists(simplicial_analogue(*back), p) == vertex_lists(simplicial_analogue(*map), p));
    }
  }
}

TEST_CASE("known closed maps without multi-incidence are surfaces, whose maps are isomorphic to them", "[maps]") {
  std::vector<GMap> maps{surface_of_a_cube(), quad_torus(3), suspension_of(surface_of_a_cube()),
                         suspension_of(quad_torus(3)), closed_polygon(3)};
  Random random(10);
  for (int trial = 0; trial < 10; ++trial) {
    maps.push_back(std::move(*gmap_of_surface(random_surface(random))));
  }
  for (const GMap& map : maps) {
    const auto order = surface_of_gmap(map);
    REQUIRE(order);
    CHECK(check_surface(*order));
    CHECK(order->f_vector() == simplicial_analogue(map).cell_counts());
    CHECK(homology_of(simplicial_analogue(*order)) == homology_of(simplicial_analogue(map)));
    const auto tuples = cell_tuples(*order, order->dimension());
    REQUIRE(tuples.size() == map.size());
    std::vector<CellSet> tuple_of(map.size());
    OrderCell before = 0;
    for (int i = 0; i <= map.dimension(); ++i) {
      const Orbits parts = cells(map, i);
      for (Dart d = 0; d < map.size(); ++d) {
        tuple_of[d].push_back(before + parts.of[d]);
      }
      before += parts.count();
    }
    const auto back = gmap_of_surface(*order);
    REQUIRE(back);
    const auto image = [&](Dart d) {
      return static_cast<Dart>(std::ranges::lower_bound(tuples, tuple_of[d]) - tuples.begin());
    };
    for (Dart d = 0; d < map.size(); ++d) {
      REQUIRE(tuples[image(d)] == tuple_of[d]);
      for (int i = 0; i <= map.dimension(); ++i) {
        CHECK(back->alpha(i, image(d)) == image(map.alpha(i, d)));
      }
    }
  }
}

TEST_CASE("a random closed map is a surface, or refused where cells have the same cells but no simplex twice",
          "[maps]") {
  Random random(9);
  int refusals = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const GMap map = random_surface_map(random, random.in(1, 7), true);
    const NumberedSet set = simplicial_analogue(map);
    bool multiple = false;
    for (int p = 1; p <= 2; ++p) {
      const auto lists = vertex_lists(set, p);
      multiple = multiple || std::ranges::adjacent_find(lists) != lists.end();
    }
    const auto order = surface_of_gmap(map);
    CHECK(order.has_value() == !multiple);
    if (order) {
      CHECK(check_surface(*order));
    } else {
      CHECK(refusal_of(order).starts_with("refused: no order has these cells: the cells "));
      ++refusals;
    }
  }
  CHECK(refusals > 20);
}

TEST_CASE("maps that are no surfaces are refused, naming darts or cells", "[maps]") {
  CHECK(refusal_of(surface_of_gmap(sewn_square(moebius_strip_pairs))) ==
        "refused: dart 2 is 2-free: a surface has no boundary, so each dart has another one by alpha_2");
  CHECK(refusal_of(surface_of_gmap(disjoint_union(quad_torus(3), quad_torus(3)))) ==
        "refused: the map is not connected: nothing leads from dart 0 to dart 72, and a surface is");
  CHECK(refusal_of(surface_of_gmap(sewn_square(torus_pairs))) ==
        "refused: no order has these cells: the cells 0, 1 are incident more than once, by the 1-simplices 0 and 1");
  CHECK(refusal_of(surface_of_gmap(*GMap::make({{1, 0}, {1, 0}, {1, 0}}))) ==
        "refused: no order has these cells: the cells 0, 1, 2 are incident more than once, by the 2-simplices 0 and 1");
  CHECK(refusal_of(surface_of_gmap(GMap::points(2))) ==
        "refused: a map without involutions or without darts is no surface");
  CHECK(refusal_of(surface_of_gmap(closed_polygon(1))) ==
        "refused: no order has these cells: the cells 0, 1 are incident more than once, by the 1-simplices 0 and 1");
  CHECK(*surface_of_gmap(*GMap::make({{1, 0}})) == order_of({{}, {}}));
}

TEST_CASE("orders that are no surfaces are refused, naming cells", "[maps]") {
  const auto said = [](std::vector<CellSet> faces) { return refusal_of(check_surface(order_of(std::move(faces)))); };
  CHECK(said({}) == "refused: an order without a cell is no surface: one of dimension 0 has two cells");
  CHECK(said({{}, {}, {}}) == "refused: in the whole the number of cells of dimension 0 is 3: in a surface it is 2");
  CHECK(said({{}, {}, {}, {0, 1}, {0, 1}}) ==
        "refused: cell 2 of dimension 0 is no face: in a surface of dimension 1 all cells of smaller dimensions are");
  CHECK(said({{}, {}, {}, {0, 1}, {0, 1, 2}, {0, 2}}) ==
        "refused: below cell 4 the number of cells of dimension 0 is 3: in a surface it is 2");
  CHECK(said({{}, {}, {}, {0, 1}, {1, 2}}) ==
        "refused: above cell 0 the number of cells of dimension 1 is 1: in a surface it is 2");
  CHECK(said({{}, {}, {0, 1}, {0, 1}, {}, {}, {4, 5}, {4, 5}}) ==
        "refused: in the whole the cells are not connected, such as cells 0 and 4: in a surface they are");
  CHECK(said({{}, {}, {0, 1}, {0, 1}, {0, 1}, {2, 3, 4}, {2, 3, 4}}) ==
        "refused: between cell 0 and cell 5 the number of cells of dimension 1 is 3: in a surface it is 2");
  // Two spheres that have a vertex in common.
  CHECK(said({{}, {}, {}, {0, 1}, {0, 1}, {0, 2}, {0, 2}, {3, 4}, {3, 4}, {5, 6}, {5, 6}}) ==
        "refused: above cell 0 the cells are not connected, such as cells 3 and 5: in a surface they are");
  // A face with two boundaries, twice.
  CHECK(said({{}, {}, {0, 1}, {0, 1}, {}, {}, {4, 5}, {4, 5}, {2, 3, 6, 7}, {2, 3, 6, 7}}) ==
        "refused: below cell 8 the cells are not connected, such as cells 0 and 4: in a surface they are");
  CHECK(refusal_of(gmap_of_surface(order_of({{}}))) ==
        "refused: in the whole the number of cells of dimension 0 is 1: in a surface it is 2");
}
