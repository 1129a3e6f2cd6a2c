// Incidence graphs by their cells, glued by identification, against the chains of their cells.
#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ops/maps/chain_of_surfaces.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/order_models.hpp"
#include "tests/support/polytopes.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

using ops::Dart;
using ops::Order;
using ops::OrderCell;

std::string refused(Engine& engine, const ops::Operation& op) {
  const std::string before = dump(engine.structure());
  const auto report = engine.apply(op);
  CHECK(dump(engine.structure()) == before);
  return report ? "" : report.error().what;
}
std::string refused_graph(Engine& engine, const std::string& cells) {
  return refused(engine, operation(R"({"op":"incidence","name":"K","cells":)" + cells + "}"));
}

bool mentions(const std::string& text, const std::string& part) {
  CAPTURE(text);
  const bool found = text.find(part) != std::string::npos;
  CHECK(found);
  return found;
}

/// An order in an engine by its cells and in one by its chains, and the darts that are the cell-tuples.
class BothWays {
 public:
  BothWays(const AnyRing& ring, const Order& order, Random& random) : by_cells_{ring}, by_chains_{ring} {
    for (int i = 0; i <= order.dimension(); ++i) {
      tuples_.push_back(ops::cell_tuples(order, i));
      darts_.push_back(0);
    }
    chain_ = ops::chain_of_tuples(order, tuples_);
    carry_out(by_cells_, make_order("K", order, false, &random));
    carry_out(by_chains_, make_order("K", order, true, &random));
  }

  Engine& by_cells() { return by_cells_; }
  void check() {
    REQUIRE(live_groups(by_cells_) == live_groups(by_chains_));
    REQUIRE(by_cells_.euler_characteristic() == by_chains_.euler_characteristic());
    REQUIRE(by_cells_.first_defect().value_or("") == "");
  }
  /// Whether the cells of two random darts could be glued. All their chains are, then, as the darts lie to each other.
  bool glue(Random& random) {
    const int i = random.in(0, chain_.dimension());
    const auto any = [&] { return static_cast<Dart>(random.in(0, static_cast<int>(chain_.level(i).size()) - 1)); };
    const Dart a = any(), b = any();
    if (!by_cells_.apply(ops::Identify{{{seen_cell("K", i, a), seen_cell("K", i, b)}}})) {
      return false;
    }
    ops::Identify identify;
    std::vector<std::pair<Dart, Dart>> pairs{{a, b}};
    std::set<Dart> met{a};
    for (std::size_t at = 0; at < pairs.size(); ++at) {
      const auto [one, other] = pairs[at];
      identify.pairs.emplace_back(simplex(i, one), simplex(i, other));
      for (int j = 0; j < i; ++j) {
        if (met.insert(chain_.level(i).alpha(j, one)).second) {
          pairs.emplace_back(chain_.level(i).alpha(j, one), chain_.level(i).alpha(j, other));
        }
      }
    }
    carry_out(by_chains_, identify);
    return true;
  }
  void undo() {
    carry_out(by_cells_, ops::Undo{1});
    carry_out(by_chains_, ops::Undo{1});
  }

 private:
  [[nodiscard]] std::string simplex(int i, Dart d) const {
    std::string name;
    for (const OrderCell x : tuples_[static_cast<std::size_t>(i)][d]) {
      name += "<c" + std::to_string(x);
    }
    return "K." + name + ">";
  }

  Engine by_cells_, by_chains_;
  std::vector<std::vector<std::vector<OrderCell>>> tuples_;
  std::vector<Dart> darts_;
  ops::ChainOfMaps chain_;
};

}  // namespace

TEST_CASE("an incidence graph has the groups of its chains, by cells and by simplices") {
  const auto seed = GENERATE(range(0U, 40U));
  CAPTURE(seed);
  Random random(seed);
  const Order order = random.one_in(3)   ? random_order(random)
                      : random.one_in(2) ? boundary_of(random_polytope(random))
                                         : random_polytope(random);
  BothWays both(ring_named("Z"), order, random);
  both.check();
  CHECK(std::ranges::equal(both.by_cells().cells(), order.f_vector()));
  std::vector<std::string> groups;
  for (const AbelianGroup& group : live_groups(both.by_cells())) {
    groups.push_back(group.to_string());
  }
  CHECK(groups == homology_of(ops::simplicial_analogue(order)));
}

TEST_CASE("surfaces in any number of pieces are incidence graphs with one generator for each cell") {
  const auto seed = GENERATE(range(0U, 15U));
  CAPTURE(seed);
  Random random(seed);
  BothWays both(ring_named(seed % 2 == 0 ? "Z" : "Z/2"), beside(random_surface(random), random_surface(random)),
                random);
  both.check();
}

TEST_CASE("cells of incidence graphs glued at random have the groups of their chains after every gluing") {
  const auto seed = GENERATE(range(0U, 14U));
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  CAPTURE(seed, ring);
  Random random(seed);
  const Order one = random_polytope(random);
  Order order = beside(one, random.one_in(2) ? one : random_polytope(random));
  if (order.size() < 40) {
    order = beside(order, polygon_order(4));
  }
  BothWays both(ring_named(ring), order, random);
  int done = 0;
  for (int tries = 0; tries < 50; ++tries) {
    if (done > 0 && random.one_in(10)) {
      both.undo();
      --done;
    } else if (both.glue(random)) {
      ++done;
    } else {
      continue;
    }
    both.check();
  }
  REQUIRE(done > 0);
}

TEST_CASE("a cell of an incidence graph has its first face once in its boundary, however cells are listed") {
  const auto seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  Random random(seed);
  const Order order = random_polytope(random);
  const ops::MakeIncidence op = make_order("K", order, false, &random);
  Engine engine(ring_named("Z"));
  carry_out(engine, op);
  for (std::size_t k = 0; k < op.cells.size(); ++k) {
    const ops::MakeComplex::Cell cell = op.cells[k];
    if (cell.faces.empty()) {
      continue;
    }
    const auto denoted = engine.structure().denoted("K." + cell.id).value();
    const auto face = engine.structure().denoted("K." + cell.faces[0]).value();
    // Chains have cells as their names orient them.
    const CellChain boundary =
        engine.maps().boundary({engine.structure().dimension(denoted.node), {{1, denoted.node}}});
    CAPTURE(cell.id, to_text(boundary));
    REQUIRE(boundary.terms.size() == cell.faces.size());
    REQUIRE(std::ranges::count_if(boundary.terms, [&](const auto& term) {
              return term.generator == face.node && term.coefficient == sparse::Rational{1};
            }) == 1);
  }
}

TEST_CASE("cells with isomorphic closures are identified by name, first face to first face, or through darts") {
  Engine engine(ring_named("Z"));
  carry_out(engine, R"({"op":"incidence","name":"K","cells":[{"id":"a"},{"id":"b"},{"id":"c"},)"
                    R"({"id":"ab","faces":["a","b"]},{"id":"bc","faces":["b","c"]},{"id":"ca","faces":["c","a"]},)"
                    R"({"id":"f","faces":["ab","bc","ca"]}]})");
  carry_out(engine, R"({"op":"incidence","name":"L","cells":[{"id":"x"},{"id":"y"},{"id":"z"},)"
                    R"({"id":"zx","faces":["x","z"]},{"id":"yz","faces":["z","y"]},{"id":"xy","faces":["x","y"]},)"
                    R"({"id":"g","faces":["yz","zx","xy"]}]})");
  const auto cell = [&](const std::string& name) {
    return engine.structure().find(engine.structure().lookup(name).value());
  };
  carry_out(engine, R"({"op":"identify","pairs":[["K.f","L.g"]]})");  // a to z and b to y
  CHECK(cell("K.ab") == cell("L.yz"));
  CHECK(cell("K.a") == cell("L.z"));
  CHECK(cell("K.c") == cell("L.x"));
  carry_out(engine, ops::Undo{1});
  // Cell-tuples (vertex, edge, face) of L by the places in its list: (x, zx, g), (x, xy, g), (y, yz, g), ...
  CHECK(cell("L.1:0") == cell("L.zx"));
  CHECK(cell("L.1:1") == cell("L.xy"));
  carry_out(engine, R"({"op":"identify","pairs":[["K.2:0","L.2:1"]]})");  // (a, ab, f) to (x, xy, g)
  CHECK(cell("K.ab") == cell("L.xy"));
  CHECK(cell("K.a") == cell("L.x"));
  CHECK(cell("K.c") == cell("L.z"));
  CHECK(engine.first_defect().value_or("") == "");
  CHECK(live_groups(engine).size() == 1);
}

TEST_CASE("cells that are alike are not identified by name where their first faces do not correspond") {
  Engine engine(ring_named("Z"));
  const Order prism = product_of(polygon_order(3), edge_order());
  ops::MakeIncidence op = make_order("K", prism, false);
  carry_out(engine, op);
  op.name = "L";
  ops::CellList turned;
  for (std::size_t k = 0; k < op.cells.size(); ++k) {
    ops::MakeComplex::Cell cell = op.cells[k];
    if (k + 1 == op.cells.size()) {
      std::ranges::reverse(cell.faces);
    }
    turned.push_back(cell);
  }
  op.cells = turned;
  carry_out(engine, op);
  const std::string top = "c" + std::to_string(prism.size() - 1);
  mentions(refused(engine, ops::Identify{{{"K." + top, "L." + top}}}),
           "no isomorphism takes the one dart to the other");
  carry_out(engine, ops::Identify{{{"K.3:0", "L.3:0"}}});
  CHECK(engine.first_defect().value_or("") == "");
  CHECK(live_groups(engine).size() == 1);
  CHECK(engine.cells().back() == 1);
  mentions(refused(engine, operation(R"({"op":"sew","dim":3,"pairs":[["K:0","L:0"]]})")), "identify glues these");
}

TEST_CASE("cells of incidence graphs, maps and simplices of one kind are glued to each other") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_order("K", cube_order(2), false));
  carry_out(engine, R"({"op":"polygon","name":"p","sides":4})");
  carry_out(engine, R"({"op":"simplex","name":"t","dim":1})");
  carry_out(engine, R"({"op":"identify","pairs":[["K.2:0","p.2:3"],["t","K.1:0"]]})");
  CHECK(std::ranges::equal(engine.cells(), std::vector<std::uint64_t>{4, 4, 1}));
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("what is no incidence graph is refused, naming its cells") {
  Engine engine(ring_named("Z"));
  mentions(refused_graph(engine, R"([])"), "needs one at least");
  mentions(refused_graph(engine, R"([{"id":"a"},{"id":"a"}])"), "lists cell \"a\" twice");
  mentions(refused_graph(engine, R"([{"id":"a"},{"id":"e","faces":["a","b"]}])"), "names a face \"b\"");
  mentions(refused_graph(engine, R"([{"id":"a"},{"id":"e","faces":["a","a"]}])"),
           "cell \"e\" has the face \"a\" twice");
  mentions(refused_graph(engine, R"([{"id":"a","faces":["e"]},{"id":"e","faces":["a"]}])"), "lies below itself");
  mentions(
      refused_graph(engine,
                    R"([{"id":"a"},{"id":"b"},{"id":"c"},{"id":"e","faces":["a","b"]},{"id":"f","faces":["e","c"]}])"),
      "a jump in dimension from cell \"f\" of dimension 2 to its face \"c\"");
  mentions(refused_graph(engine, R"([{"id":"a"},{"id":"b"},{"id":"1:1"},{"id":"0:3","faces":["a","b"]},)"
                                 R"({"id":"1:0","faces":["a","b"]}])"),
           "cannot have the id \"1:1\"");
  carry_out(engine, R"({"op":"simplex","name":"K.b","dim":0})");
  mentions(refused_graph(engine, R"([{"id":"a"},{"id":"b"}])"), "the name \"K.b\" is in use");
}

TEST_CASE("a cell that is no ball is refused by cells, with the reason, and goes in by chains") {
  Engine engine(ring_named("Z"));
  const auto both_ways = [&](const std::string& name, const Order& order, const std::string& why) {
    mentions(refused(engine, make_order(name, order, false)), why);
    mentions(refused(engine, make_order(name, order, false)), "make \"" + name + "\" \"as\":\"simplices\"");
    Engine alone(ring_named("Z"));
    carry_out(alone, make_order(name, order, true));
    CHECK(alone.first_defect().value_or("") == "");
    return alone.homology().betti;
  };
  // An edge with three ends, and a face over two circles.
  CHECK(both_ways("E", made_order({{}, {}, {}, {0, 1, 2}}),
                  "below cell \"c3\" the number of cells of dimension 0 is 3") == std::vector<std::int64_t>{1, 0});
  CHECK(both_ways("A", made_order({{}, {}, {0, 1}, {0, 1}, {}, {}, {4, 5}, {4, 5}, {2, 3, 6, 7}}),
                  "below cell \"c8\" the cells are not connected") == std::vector<std::int64_t>{1, 0, 0});
  // A cell over two spheres, and one over a torus, which is the product of two circles.
  const Order sphere = boundary_of(cube_order(3));
  CHECK(both_ways("S", filled(beside(sphere, sphere)), "the cells are not connected") ==
        std::vector<std::int64_t>{1, 0, 0, 0});
  const Order circle = boundary_of(polygon_order(3));
  CHECK(both_ways("T", filled(product_of(circle, circle)), "is no ball: its canonical boundary has not the homology") ==
        std::vector<std::int64_t>{1, 0, 0, 0});
  CHECK(engine.cells().empty());
}

TEST_CASE("chains are called by the ids of their cells, which no id may part") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_order("K", polygon_order(3), true));
  CHECK(engine.structure().lookup("K.<c0<c3<c6>").has_value());
  CHECK(engine.structure().lookup("K.<c6>").has_value());
  CHECK_FALSE(engine.structure().lookup("K.<c3<c0>").has_value());
  CHECK_FALSE(engine.structure().lookup("K.c0").has_value());
  mentions(refused(engine, operation(R"({"op":"incidence","name":"L","cells":[{"id":"a<b"}],"as":"simplices"})")),
           "has a \"<\"");
  carry_out(engine, R"({"op":"incidence","name":"L","cells":[{"id":"a<b"}]})");
}
