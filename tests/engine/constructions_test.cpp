// Products, cones, suspensions, joins: spaces whose homology follows from that of what they are made of.
#include <functional>

#include "tests/support/bodies.hpp"
#include "tests/support/tearing.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

using MakeBody = std::function<Body(const std::string&)>;

std::vector<MakeBody> bodies_of_simplices() {
  return {point,
          edge,
          circle,
          torus_of_triangles,
          klein_bottle_of_triangles,
          plane_of_triangles,
          plane_of_three_cells,
          [](const std::string& name) { return points(name, 2); },
          [](const std::string& name) { return squashed_sphere(name, 2); },
          [](const std::string& name) { return moore_body(name, 4); },
          [](const std::string& name) { return moore_body(name, 6); },
          [](const std::string& name) { return scattered(name, 3); }};
}

std::vector<MakeBody> all_bodies() {
  std::vector<MakeBody> bodies = bodies_of_simplices();
  bodies.insert(bodies.end(), {torus_of_square, prism, mixed_wedge});
  return bodies;
}

std::uint64_t binomial(std::uint64_t n, std::uint64_t k) {
  return k > n ? 0 : (k == 0 ? 1 : binomial(n, k - 1) * (n - k + 1) / k);
}

std::uint64_t total(const std::vector<std::uint64_t>& counts) {
  std::uint64_t sum = 0;
  for (const std::uint64_t n : counts) {
    sum += n;
  }
  return sum;
}

/// The numbers of cells of a product. Of a p-simplex and a q-simplex a simplicial one has, in dimension n, the ways to
/// choose n - p and n - q directions, none of them twice.
std::vector<std::uint64_t> counts_of_product(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b,
                                             bool simplicial) {
  std::vector<std::uint64_t> counts(a.size() + b.size() - 1);
  for (std::size_t p = 0; p < a.size(); ++p) {
    for (std::size_t q = 0; q < b.size(); ++q) {
      for (std::size_t n = simplicial ? std::max(p, q) : p + q; n <= p + q; ++n) {
        counts[n] += a[p] * b[q] * (simplicial ? binomial(n, n - p) * binomial(p, n - q) : 1);
      }
    }
  }
  return counts;
}

/// Checks the product "P" of two bodies in every way, every law too when it is small.
void check_product(const std::string& ring_name, const Body& a, const Body& b, bool simplicial) {
  const AnyRing ring = ring_named(ring_name);
  CAPTURE(ring_name, a.what, b.what, simplicial);
  Engine engine(ring);
  build(engine, a);
  if (b.name != a.name) {
    build(engine, b);
  }
  const auto expected = counts_of_product(counts_of(engine, a.name), counts_of(engine, b.name), simplicial);
  carry_out(engine, product("P", a.name, b.name, simplicial));
  CHECK(counts_of(engine, "P") == expected);
  CHECK(std::vector<std::uint64_t>(engine.cells().begin(), engine.cells().end()) == expected);
  CHECK(live_groups(engine) == over(ring, reductions::kunneth(a.groups, b.groups)));
  if (total(expected) <= 500) {
    CHECK(engine.first_defect().value_or("") == "");
  }
}

}  // namespace

TEST_CASE("the test bodies have the homology that they claim", "[engine]") {
  for (const MakeBody& make : all_bodies()) {
    const Body body = make("b");
    for (const std::string& name : test_rings) {
      CAPTURE(body.what, name);
      Engine engine(ring_named(name));
      build(engine, body);
      CHECK(live_groups(engine) == over(engine.ring(), body.groups));
      const std::vector<ops::CellId> cells = all_cells(engine);
      CHECK(body.has_only_simplices == std::all_of(cells.begin(), cells.end(), [&](ops::CellId c) {
              return ops::is_simplex(engine.structure().cells().type(c).type);
            }));
      CHECK(engine.first_defect().value_or("") == "");
    }
  }
}

TEST_CASE("products have the groups of Künneth's formula, over simploids", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  for (const MakeBody& left : all_bodies()) {
    for (const MakeBody& right : all_bodies()) {
      check_product(ring, left("A"), right("B"), false);
    }
    check_product(ring, left("A"), left("A"), false);
  }
}

TEST_CASE("products have the groups of Künneth's formula, triangulated", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  for (const MakeBody& left : bodies_of_simplices()) {
    for (const MakeBody& right : bodies_of_simplices()) {
      check_product(ring, left("A"), right("B"), true);
    }
    check_product(ring, left("A"), left("A"), true);
  }
}

TEST_CASE("a product of three bodies is the same up to homology however it is bracketed", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const std::vector<MakeBody> makers{circle, plane_of_three_cells,
                                     [](const std::string& name) { return points(name, 2); },
                                     [](const std::string& name) { return moore_body(name, 4); }, torus_of_square};
  const auto check = [&](const Body& a, const Body& b, const Body& c, bool first, bool second, bool right) {
    CAPTURE(ring, a.what, b.what, c.what, first, second, right);
    Engine engine(ring_named(ring));
    build(engine, a);
    build(engine, b);
    build(engine, c);
    const auto expected =
        counts_of_product(counts_of_product(counts_of(engine, "A"), counts_of(engine, "B"), right ? second : first),
                          counts_of(engine, "C"), right ? first : second);
    carry_out(engine, right ? product("P", "B", "C", first) : product("P", "A", "B", first));
    carry_out(engine, right ? product("Q", "A", "P", second) : product("Q", "P", "C", second));
    CHECK(live_groups(engine) ==
          over(engine.ring(), reductions::kunneth(reductions::kunneth(a.groups, b.groups), c.groups)));
    if (first == second) {
      CHECK(counts_of(engine, "Q") == expected);
    }
    if (total(counts_of(engine, "Q")) <= 200) {
      CHECK(engine.first_defect().value_or("") == "");
    }
  };
  for (const MakeBody& one : makers) {
    for (const MakeBody& two : makers) {
      for (const MakeBody& three : makers) {
        const Body a = one("A");
        const Body b = two("B");
        const Body c = three("C");
        const bool simplices = a.has_only_simplices && b.has_only_simplices && c.has_only_simplices;
        for (const bool right : {false, true}) {
          check(a, b, c, false, false, right);
          if (simplices) {
            check(a, b, c, true, true, right);
            check(a, b, c, true, false, right);
          }
        }
      }
    }
  }
}

TEST_CASE("a product glued is the same object as its cells written out and glued", "[engine][stream]") {
  const bool simplicial = GENERATE(false, true);
  const unsigned seed = GENERATE(range(0U, 8U));
  CAPTURE(simplicial, seed);
  Engine lazy;
  build(lazy, moore_body("A", 2));
  build(lazy, circle("B"));
  carry_out(lazy, product("P", "A", "B", simplicial));
  Engine plain;
  carry_out(plain, written_out(lazy, "P", "K"));
  std::vector<std::string> names;
  for (const ops::CellId c : all_cells(lazy)) {
    names.emplace_back(lazy.structure().name(c));
  }
  Random random(seed);
  for (int k = 0; k < 6; ++k) {
    const auto cell = [&] { return static_cast<std::size_t>(random.in(0, static_cast<int>(names.size()) - 1)); };
    const std::size_t a = cell();
    const std::size_t b = cell();
    const auto one = lazy.apply(identify({{names[a], names[b]}}));
    const auto other = plain.apply(identify({{"K." + std::to_string(a), "K." + std::to_string(b)}}));
    REQUIRE(one.has_value() == other.has_value());
    REQUIRE(counts_of(lazy, "P") == counts_of(plain, "K"));
    REQUIRE(live_groups(lazy) == live_groups(plain));
    REQUIRE(lazy.first_defect().value_or("") == "");
  }
}

TEST_CASE("steps of every kind on a product keep every law, and can be taken back", "[engine][stream]") {
  const unsigned seed = GENERATE(range(0U, 10U));
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const bool simplicial = GENERATE(false, true);
  CAPTURE(seed, ring, simplicial);
  Random random(seed);
  Engine engine(ring_named(ring), limits(seed % 2 == 1));
  const std::vector<MakeBody> makers = simplicial ? bodies_of_simplices() : all_bodies();
  const auto any_body = [&] {
    return makers[static_cast<std::size_t>(random.in(1, static_cast<int>(makers.size()) - 1))];
  };
  build(engine, any_body()("A"));
  build(engine, circle("B"));
  carry_out(engine, product("P", "A", "B", simplicial));
  const Groups start = live_groups(engine);
  const std::uint64_t steps_before = engine.undoable();
  for (int k = 0; k < 12; ++k) {
    const std::vector<ops::CellId> cells = all_cells(engine);
    const ops::CellId cell = cells[static_cast<std::size_t>(random.in(0, static_cast<int>(cells.size()) - 1))];
    const std::string name{engine.structure().name(cell)};
    const std::string fresh = "n" + std::to_string(k);
    const Groups before = live_groups(engine);
    const auto try_step = [&](const ops::Operation& op) {
      if (!engine.apply(op)) {
        CHECK(live_groups(engine) == before);
      }
    };
    const int kind = random.in(0, cells.size() > 120 ? 5 : 9);
    if (kind <= 2) {
      try_step(RandomSteps(seed + static_cast<unsigned>(k)).identification(engine.structure(), cells));
    } else if (kind <= 3) {
      try_step(ops::Degenerate{name, 1, 0});
    } else if (kind <= 5) {
      if (const auto split = isolating_split(engine.structure(), cell, fresh + "_")) {
        try_step(*split);
      }
    } else if (kind <= 7) {
      try_step(cone_over_cells(fresh, {name}));
    } else if (kind == 8 && cells.size() < 40) {
      const Body other = point(fresh);
      build(engine, other);
      try_step(product(fresh + "P",
                       std::string{engine.structure().directory().name_of_body(engine.structure().body_of(cell))},
                       fresh, simplicial));
    } else {
      carry_out(engine, ops::MakeCone{fresh, {}, {}});
      CHECK(live_groups(engine) == Groups{group(1)});
    }
    REQUIRE(engine.first_defect().value_or("") == "");
  }
  carry_out(engine, ops::Undo{engine.undoable() - steps_before});
  CHECK(live_groups(engine) == start);
  CHECK(engine.first_defect().value_or("") == "");
}

namespace {

/// The n-cube as a product of edges E1, E2, ...: Q2 = E1 x E2, Q3 = Q2 x E3, ...
void make_cube(Engine& engine, int n, bool simplicial) {
  build(engine, edge("E1"));
  for (int k = 2; k <= n; ++k) {
    const std::string number = std::to_string(k);
    build(engine, edge("E" + number));
    carry_out(engine, product("Q" + number, k == 2 ? "E1" : "Q" + std::to_string(k - 1), "E" + number, simplicial));
  }
}

/// Glues the facets of a cube where coordinate `axis` is 0 and 1.
ops::Operation glue_opposite(const Engine& engine, const std::string& body, int axis) {
  const std::string low = "E" + std::to_string(axis) + ".0";
  const std::string high = "E" + std::to_string(axis) + ".1";
  Pairs pairs;
  for (const ops::CellId c : engine.structure().lazy().cells_of(body_named(engine, body))) {
    const std::string name{engine.structure().name(c)};
    if (const std::size_t at = name.find(low); at != std::string::npos) {
      pairs.emplace_back(name, std::string{name}.replace(at, low.size(), high));
    }
  }
  return identify(pairs);
}

Groups exterior_powers(int n) {
  Groups groups;
  for (int k = 0; k <= n; ++k) {
    groups.push_back(group(static_cast<Index>(binomial(static_cast<std::uint64_t>(n), static_cast<std::uint64_t>(k)))));
  }
  return groups;
}

}  // namespace

TEST_CASE("a cube made as a product becomes a torus when its opposite sides are glued", "[engine]") {
  const int n = GENERATE(range(1, 5));
  const bool simplicial = GENERATE(false, true);
  CAPTURE(n, simplicial);
  Engine engine;
  make_cube(engine, n, simplicial);
  const std::string body = n == 1 ? "E1" : "Q" + std::to_string(n);
  for (int axis = 1; axis <= n; ++axis) {
    CHECK(live_groups(engine) == exterior_powers(axis - 1));
    carry_out(engine, glue_opposite(engine, body, axis));
    if (n <= 3) {
      CHECK(engine.first_defect().value_or("") == "");
    }
  }
  CHECK(live_groups(engine) == exterior_powers(n));
  CHECK(live_groups(engine) == [&] {
    Engine factors;
    build(factors, circle("C0"));
    for (int k = 1; k < n; ++k) {
      build(factors, circle("D" + std::to_string(k)));
      carry_out(factors, product("C" + std::to_string(k), "C" + std::to_string(k - 1), "D" + std::to_string(k), false));
    }
    return live_groups(factors);
  }());
  for (int axis = n; axis >= 1; --axis) {
    carry_out(engine, ops::Undo{1});
    CHECK(live_groups(engine) == exterior_powers(axis - 1));
  }
}

TEST_CASE("prisms of every type are solid, and are products of simplices", "[engine]") {
  const int n = GENERATE(range(1, 6));
  for (const ops::CellType& type : types_of_dimension(n)) {
    CAPTURE(ops::describe(type));
    Engine standard;
    carry_out(standard, simploid("T", type));
    CHECK(live_groups(standard) == Groups{group(1)});
    for (const bool simplicial : {false, true}) {
      CAPTURE(simplicial);
      Engine engine;
      std::string last = "S0";
      std::vector<std::uint64_t> expected;
      for (std::size_t k = 0; k < type.size(); ++k) {
        const std::string factor = "S" + std::to_string(k);
        carry_out(engine, ops::MakeSimplex{factor, type[k], {}});
        const auto own = counts_of(engine, factor);
        expected = k == 0 ? own : counts_of_product(expected, own, simplicial);
        if (k > 0) {
          carry_out(engine, product("P" + std::to_string(k), last, factor, simplicial));
          last = "P" + std::to_string(k);
        }
      }
      CHECK(counts_of(engine, last) == expected);
      CHECK((simplicial || expected == counts_of(standard, "T")));
      CHECK(live_groups(engine) == Groups{group(1)});
      CHECK(engine.euler_characteristic() == 1);
      if (total(expected) <= 300) {
        CHECK(engine.first_defect().value_or("") == "");
      }
    }
  }
}

TEST_CASE("the boundary of a prism of any type is a sphere, so is its suspension, and a cone over it is solid",
          "[engine]") {
  const int n = GENERATE(range(1, 6));
  const bool lazy_cones = GENERATE(false, true);
  for (const ops::CellType& type : types_of_dimension(n)) {
    CAPTURE(ops::describe(type), limits);
    Engine engine(ring_named("Z"), limits(lazy_cones));
    carry_out(engine, boundary_of_standard("K", type));
    CHECK(live_groups(engine) == groups_of_sphere(n - 1));
    suspend(engine, "K", "v", "w");
    CHECK(live_groups(engine) == groups_of_sphere(n));
    if (n <= 3) {
      CHECK(engine.first_defect().value_or("") == "");
    }
    carry_out(engine, ops::Undo{1});
    CHECK(live_groups(engine) == Groups{group(1)});
    if (n <= 4) {
      CHECK(engine.first_defect().value_or("") == "");
    }
  }
}

TEST_CASE("the boundary of a product is glued from two products", "[engine]") {
  // The boundary of A x B is A x (boundary of B) and (boundary of A) x B, along their common part.
  for (int n = 2; n <= 4; ++n) {
    for (const ops::CellType& type : types_of_dimension(n)) {
      for (const bool simplicial : {false, true}) {
        if (type.size() < 2 || (simplicial && type.size() > 2)) {
          continue;
        }
        const ops::CellType rest{type.begin() + 1, type.end()};
        CAPTURE(ops::describe(type), simplicial);
        Engine engine;
        carry_out(engine, simploid("A", {type.front()}));
        carry_out(engine, boundary_of_standard("dA", {type.front()}));
        carry_out(engine, simploid("B", rest));
        carry_out(engine, boundary_of_standard("dB", rest));
        carry_out(engine, product("P", "A", "dB", simplicial));
        carry_out(engine, product("Q", "dA", "B", simplicial));
        CHECK(live_groups(engine) ==
              trimmed(sum(groups_of_sphere(dimension_of(rest) - 1), groups_of_sphere(type.front() - 1))));
        Pairs pairs;
        for (const ops::CellId c : engine.structure().lazy().cells_of(body_named(engine, "P"))) {
          const std::string name{engine.structure().name(c)};
          if (name.starts_with("P.(A.")) {
            const std::size_t bar = name.find("|dB.");
            pairs.emplace_back(name, "Q.(dA." + name.substr(5, bar - 5) + "|B." + name.substr(bar + 4));
          }
        }
        carry_out(engine, identify(pairs));
        CHECK(live_groups(engine) == groups_of_sphere(n - 1));
        if (n <= 3) {
          CHECK(engine.first_defect().value_or("") == "");
        }
      }
    }
  }
}

TEST_CASE("cross-polytopes are iterated suspensions of two points", "[engine]") {
  const bool lazy_cones = GENERATE(false, true);
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(lazy_cones, ring);
  Engine engine(ring_named(ring), limits(lazy_cones));
  build(engine, points("K", 2));
  for (int n = 1; n <= 5; ++n) {
    const std::string number = std::to_string(n);
    suspend(engine, "K", "v" + number, "w" + number);
    CHECK(live_groups(engine) == groups_of_sphere(n));
    // Simplices of dimension p have p + 1 of the n + 1 axes, each in one of two directions.
    for (int p = 0; p <= n; ++p) {
      const auto axes = static_cast<std::uint64_t>(p + 1);
      CHECK(engine.cells()[static_cast<std::size_t>(p)] ==
            binomial(static_cast<std::uint64_t>(n) + 1, axes) * (std::uint64_t{1} << axes));
    }
    if (n <= 3) {
      CHECK(engine.first_defect().value_or("") == "");
    }
  }
}

TEST_CASE("two cones over a body move its reduced homology up, as often as one likes", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const bool lazy_cones = GENERATE(false, true);
  for (const MakeBody& make : all_bodies()) {
    const Body body = make("A");
    CAPTURE(ring, lazy_cones, body.what);
    Engine engine(ring_named(ring), limits(lazy_cones));
    build(engine, body);
    Groups expected = body.groups;
    for (int k = 1; k <= 3; ++k) {
      suspend(engine, "A", "v" + std::to_string(k), "w" + std::to_string(k));
      expected = suspended(expected);
      CHECK(live_groups(engine) == over(engine.ring(), expected));
      if (k == 1 || total(counts_of(engine, "A")) <= 100) {
        CHECK(engine.first_defect().value_or("") == "");
      }
    }
  }
}

TEST_CASE("cones over two copies of a body, glued at their bases, are its suspension", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const bool lazy_cones = GENERATE(false, true);
  for (const MakeBody& make : all_bodies()) {
    const Body body = make("A");
    CAPTURE(ring, lazy_cones, body.what);
    Engine engine(ring_named(ring), limits(lazy_cones));
    build(engine, body);
    build(engine, make("B"));
    const std::vector<std::string> ours = top_cells(engine, "A");
    const std::vector<std::string> theirs = top_cells(engine, "B");
    Pairs pairs;
    for (std::size_t k = 0; k < ours.size(); ++k) {
      pairs.emplace_back(ours[k], theirs[k]);
    }
    carry_out(engine, cone_over_body("v", "A"));
    carry_out(engine, cone_over_body("w", "B"));
    CHECK(live_groups(engine) == Groups{group(2)});
    carry_out(engine, identify(pairs));
    CHECK(live_groups(engine) == over(engine.ring(), suspended(body.groups)));
    CHECK(engine.first_defect().value_or("") == "");
  }
}

TEST_CASE("a product with an edge becomes a suspension when its ends are squashed", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const bool simplicial = GENERATE(false, true);
  for (const MakeBody& make : all_bodies()) {
    const Body body = make("A");
    if (body.groups.front().rank > 1 || (simplicial && !body.has_only_simplices)) {
      continue;  // an end in several pieces would be squashed to as many points
    }
    CAPTURE(ring, simplicial, body.what);
    Engine engine(ring_named(ring));
    build(engine, body);
    build(engine, edge("I"));
    carry_out(engine, product("P", "A", "I", simplicial));
    std::vector<ops::CellId> cells = all_cells(engine);
    std::stable_sort(cells.begin(), cells.end(), [&](ops::CellId a, ops::CellId b) {
      return engine.structure().dimension(a) < engine.structure().dimension(b);
    });
    for (const ops::CellId c : cells) {
      const std::string name{engine.structure().name(c)};
      if (engine.structure().dimension(c) > 0 && name.find("|I.") != std::string::npos) {
        carry_out(engine, ops::Degenerate{name, 1, 0});
      }
    }
    CHECK(live_groups(engine) == over(engine.ring(), suspended(body.groups)));
    CHECK(engine.first_defect().value_or("") == "");
  }
}

TEST_CASE("a join with points is a cone for each of them", "[engine]") {
  const bool lazy_cones = GENERATE(false, true);
  for (const MakeBody& make : all_bodies()) {
    const Body body = make("A");
    CAPTURE(lazy_cones, body.what);
    Engine engine(ring_named("Z"), limits(lazy_cones));
    build(engine, body);
    const std::vector<std::string> tops = top_cells(engine, "A");
    carry_out(engine, cone_over_body("v1", "A"));
    Groups expected{group(1)};
    Groups once = suspended(body.groups);
    once.front().rank -= 1;
    for (int k = 2; k <= 4; ++k) {
      carry_out(engine, cone_over_cells("v" + std::to_string(k), tops));
      expected = sum(expected, once);
      CHECK(live_groups(engine) == trimmed(expected));
    }
    CHECK(engine.first_defect().value_or("") == "");
  }
}

TEST_CASE("a join has the reduced homology of a product, one higher", "[engine]") {
  // X * Y is X x (cone over Y) and (cone over X) x Y, along X x Y.
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const bool lazy_cones = GENERATE(false, true);
  const bool simplicial = GENERATE(false, true);
  const std::vector<MakeBody> makers{[](const std::string& name) { return points(name, 3); },
                                     circle,
                                     plane_of_three_cells,
                                     [](const std::string& name) { return moore_body(name, 3); },
                                     [](const std::string& name) { return squashed_sphere(name, 2); },
                                     torus_of_square};
  for (const MakeBody& x : makers) {
    for (const MakeBody& y : makers) {
      const Body x1 = x("X1");
      const Body y1 = y("Y1");
      if (simplicial && !(x1.has_only_simplices && y1.has_only_simplices)) {
        continue;
      }
      CAPTURE(ring, lazy_cones, simplicial, x1.what, y1.what);
      Engine engine(ring_named(ring), limits(lazy_cones));
      build(engine, x1);
      build(engine, y1);
      build(engine, x("X2"));
      build(engine, y("Y2"));
      carry_out(engine, cone_over_body("v", "Y1"));
      carry_out(engine, cone_over_body("w", "X2"));
      carry_out(engine, product("P", "X1", "Y1", simplicial));
      carry_out(engine, product("Q", "X2", "Y2", simplicial));
      Pairs pairs;
      for (const ops::CellId c : engine.structure().lazy().cells_of(body_named(engine, "P"))) {
        const std::string name{engine.structure().name(c)};
        if (const std::size_t bar = name.find("|Y1"); bar != std::string::npos) {
          pairs.emplace_back(name, "Q.(X2" + name.substr(5, bar - 5) + "|Y2" + name.substr(bar + 3));
        }
      }
      carry_out(engine, identify(pairs));
      const auto reduced = [](Groups groups) {
        groups.front().rank -= 1;
        return groups;
      };
      Groups expected = reductions::kunneth(reduced(x1.groups), reduced(y1.groups));
      expected.insert(expected.begin(), group(1));
      CHECK(live_groups(engine) == over(engine.ring(), expected));
      if (total(counts_of(engine, "P")) <= 150) {
        CHECK(engine.first_defect().value_or("") == "");
      }
    }
  }
}

TEST_CASE("a cone over a square is a pyramid", "[engine]") {
  const bool lazy_cones = GENERATE(false, true);
  Engine engine(ring_named("Z"), limits(lazy_cones));
  carry_out(engine, simploid("q", {1, 1}));
  carry_out(engine, cone_over_body("v", "q"));
  CHECK(counts_of(engine, "q") == std::vector<std::uint64_t>{5, 8, 5, 1});
  CHECK(engine.structure().cells().type(*engine.structure().lookup("v*q")).type == ops::CellType{1, 1, 1});
  CHECK(live_groups(engine) == Groups{group(1)});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("a cone over everything is acyclic, whatever was built before", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const bool lazy_cones = GENERATE(false, true);
  CAPTURE(ring, lazy_cones);
  Engine engine(ring_named(ring), limits(lazy_cones));
  int apexes = 0;
  const auto check_cone = [&] {
    carry_out(engine, ops::MakeCone{"apex" + std::to_string(apexes++), {}, {}});
    CHECK(live_groups(engine) == Groups{group(1)});
    CHECK(engine.structure().bodies().current().size() == 1);
    CHECK(engine.first_defect().value_or("") == "");
    carry_out(engine, ops::Undo{1});
  };
  build(engine, plane_of_three_cells("A"));
  build(engine, circle("B"));
  check_cone();
  carry_out(engine, product("P", "A", "B", true));
  check_cone();
  carry_out(engine, identify({{pair_name("P", "A.0-1", "B.e"), pair_name("P", "A.0-1", "B.v^0")}}));
  check_cone();
  build(engine, mixed_wedge("C"));
  check_cone();
  carry_out(engine, cone_over_cells("v", {"C"}));
  check_cone();
  carry_out(engine, ops::Degenerate{"v*C.0x0", {}, 0});
  check_cone();
  build(engine, moore_body("M", 3));
  carry_out(engine, product("Q", "M", "M", false));
  check_cone();
  carry_out(engine, ops::MakeCone{"w", {}, {}});
  build(engine, points("N", 3));
  check_cone();
  carry_out(engine, cone_over_cells("x", {"N.0", "C"}));
  check_cone();
}
