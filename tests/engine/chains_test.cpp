// Chains of maps by their cells, glued by identification, against their simplicial analogues.
#include "ops/maps/chain_operations.hpp"
#include "ops/maps/numbered_set.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/groups.hpp"
#include "tests/support/polytopes.hpp"
#include "tests/support/random_maps.hpp"
#include "tests/support/solids.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

using ops::ChainOfMaps;

ChainOfMaps some_cells(Random& random) {
  const int kind = random.in(0, 7);
  const std::vector<Polygons> solids{tetrahedron_faces(), cube_faces(), prism_faces(3), pyramid_faces(4)};
  const GMap map = kind < 5   ? ops::polygon(static_cast<Dart>(random.in(1, 5)))
                   : kind < 6 ? *GMap::make({{1, 0}, {0, 1}})
                              : solid_of(solids[static_cast<std::size_t>(random.in(0, 3))]);
  return std::move(*ops::chain_of_gmap(map));
}

/// A chain of maps glued the plain way, beside an engine that identifies its cells.
class GluedBoth {
 public:
  GluedBoth(AnyRing ring, const ChainOfMaps& chain) : ring_{std::move(ring)}, engine_{ring_}, chains_{chain} {
    carry_out(engine_, make_chain("m", chain));
    for (int i = 0; i <= chain.dimension(); ++i) {
      image_.emplace_back(chain.level(i).size());
      std::iota(image_.back().begin(), image_.back().end(), Dart{0});
    }
    images_.push_back(image_);
  }

  Engine& engine() { return engine_; }
  [[nodiscard]] const ChainOfMaps& chain() const { return chains_.back(); }

  /// Whether two random cells of one dimension could be glued such that two of their darts become one.
  bool glue(Random& random) {
    const int i = random.in(0, chain().dimension());
    const auto any = [&] {
      return static_cast<Dart>(random.in(0, static_cast<int>(image_[static_cast<std::size_t>(i)].size()) - 1));
    };
    const Dart a = any(), b = any();
    const Dart one = image_[static_cast<std::size_t>(i)][a], other = image_[static_cast<std::size_t>(i)][b];
    if (chain().cells(i).join(one, other)) {
      return false;  // the model glues no cell to itself
    }
    const auto plain = ops::glue_cells(chain(), i, one, other);
    const auto report = engine_.apply(ops::Identify{{{seen_cell("m", i, a), seen_cell("m", i, b)}}});
    CAPTURE(i, a, b, plain ? "" : plain.error().what, report ? "" : report.error().what);
    REQUIRE(plain.has_value() == report.has_value());
    if (!plain) {
      return false;
    }
    chains_.push_back(plain->chain);
    for (std::size_t k = 0; k < image_.size(); ++k) {
      for (Dart& d : image_[k]) {
        d = plain->image[k][d];
      }
    }
    images_.push_back(image_);
    return true;
  }
  void undo() {
    carry_out(engine_, ops::Undo{1});
    chains_.pop_back();
    images_.pop_back();
    image_ = images_.back();
  }
  [[nodiscard]] std::size_t steps() const { return images_.size() - 1; }

  void check() {
    Engine plain(ring_);
    carry_out(plain, make_chain("m", chain(), true));
    REQUIRE(live_groups(engine_) == live_groups(plain));
    REQUIRE(engine_.first_defect().value_or("") == "");
    const auto counts = chain().cell_counts();
    for (std::size_t i = 0; i < counts.size(); ++i) {
      REQUIRE(engine_.cells()[i] == counts[i]);
    }
    check_darts();
  }

 private:
  /// Darts that have become one see one cell in the same way; others do not.
  void check_darts() {
    for (std::size_t i = 0; i < image_.size(); ++i) {
      std::map<std::pair<ops::CellId, ops::OrderId>, Dart> dart_of;
      for (Dart d = 0; d < image_[i].size(); ++d) {
        const ops::DartStore::Made& made = *ops::map_named(engine_.structure(), "m");
        const auto named = ops::seen_from_dart(engine_.structure(), made, static_cast<int>(i), d).value();
        const ops::Value now = engine_.structure().values().normal_form(named);
        REQUIRE(dart_of.emplace(std::pair{now.cell, now.order}, image_[i][d]).first->second == image_[i][d]);
      }
      REQUIRE(dart_of.size() == chain().level(static_cast<int>(i)).size());
    }
  }

  AnyRing ring_;
  Engine engine_;
  std::vector<ChainOfMaps> chains_;
  std::vector<std::vector<Dart>> image_;  ///< per level and dart made: what it has become
  std::vector<std::vector<std::vector<Dart>>> images_;
};

std::string error_of(Engine& engine, const ops::Operation& op) {
  const std::string before = dump(engine.structure());
  const auto report = engine.apply(op);
  CHECK(dump(engine.structure()) == before);
  return report ? "" : report.error().what;
}

bool says(const std::string& text, const std::string& part) {
  CAPTURE(text);
  const bool found = text.find(part) != std::string::npos;
  CHECK(found);
  return found;
}

}  // namespace

TEST_CASE("cells of chains of maps glued at random have the groups of the analogue after every gluing") {
  const auto seed = GENERATE(range(0U, 14U));
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  CAPTURE(seed, ring);
  Random random(seed);
  ChainOfMaps chain = some_cells(random);
  for (int more = random.in(1, 4); more > 0; --more) {
    chain = disjoint_union(chain, some_cells(random));
  }
  GluedBoth both(ring_named(ring), chain);
  both.check();
  int done = 0;
  for (int tries = 0; tries < 60; ++tries) {
    if (both.steps() > 0 && random.one_in(12)) {
      both.undo();
    } else if (both.glue(random)) {
      ++done;
    } else {
      continue;
    }
    both.check();
  }
  REQUIRE(done > 3);
}

TEST_CASE("the chain of a map is the map, by cells and by simplices") {
  const auto seed = GENERATE(range(0U, 40U));
  CAPTURE(seed);
  Random random(seed);
  const GMap map = random_gmap(random, {.dimension = random.in(1, 3), .closed = random.one_in(2), .folds = false});
  const auto chain = ops::chain_of_gmap(map);
  if (!chain) {
    return;
  }
  Engine as_map(ring_named("Z")), as_chain(ring_named("Z")), by_simplices(ring_named("Z"));
  const auto of_map = as_map.apply(make_map("m", map));
  const auto of_chain = as_chain.apply(make_chain("m", *chain));
  REQUIRE((of_map.has_value() || !of_chain.has_value()));
  if (of_map.has_value() != of_chain.has_value()) {  // a chain has no cells that are no balls
    REQUIRE(map.dimension() >= 2);
    REQUIRE(of_chain.error().what.find("is no ball") != std::string::npos);
  }
  carry_out(by_simplices, make_chain("m", *chain, true));
  Engine analogue(ring_named("Z"));
  carry_out(analogue, make_map("m", map, true));
  REQUIRE(live_groups(by_simplices) == live_groups(analogue));
  REQUIRE(by_simplices.first_defect().value_or("") == "");
  if (of_map) {
    REQUIRE(live_groups(as_map) == live_groups(analogue));
    REQUIRE(as_map.first_defect().value_or("") == "");
  }
  if (of_chain) {
    REQUIRE(std::ranges::equal(as_map.cells(), as_chain.cells()));
    REQUIRE(live_groups(as_chain) == live_groups(by_simplices));
    REQUIRE(as_chain.first_defect().value_or("") == "");
  }
}

TEST_CASE("simplices of a chain of maps are those of the model, called by their least darts") {
  Random random(5);
  ChainOfMaps chain = some_cells(random);
  for (int k = 0; k < 5; ++k) {
    chain = disjoint_union(chain, some_cells(random));
  }
  Engine engine(ring_named("Z"));
  carry_out(engine, make_chain("m", chain, true));
  const auto counts = ops::simplicial_analogue(chain).f_vector();
  REQUIRE(engine.cells().size() == counts.size());
  CHECK(std::ranges::equal(engine.cells(), counts));
  for (Dart d = 0; d < chain.level(2).size(); ++d) {
    CHECK(engine.structure().lookup("m.<0-1-2>:" + std::to_string(d)).has_value());
  }
  const auto face = engine.structure().lookup("m.<0-2>:0").value();  // its face without 2 is a vertex of level 0
  CHECK(engine.structure().find(engine.structure().faces().of(face)[1]) ==
        engine.structure().lookup("m.<0>:" + std::to_string(chain.lowered(0, 2, 0))));
}

TEST_CASE("a cell of a chain of maps has its face seen through sigma once in its boundary") {
  Random random(2);
  for (int trial = 0; trial < 12; ++trial) {
    const ChainOfMaps chain = disjoint_union(some_cells(random), some_cells(random));
    Engine engine(ring_named("Z"));
    carry_out(engine, make_chain("m", chain));
    for (int i = 1; i <= chain.dimension(); ++i) {
      for (Dart d = 0; d < chain.level(i).size(); ++d) {
        const auto cell = engine.structure().denoted(seen_cell("m", i, d)).value();
        const auto face = engine.structure().denoted(seen_cell("m", i - 1, chain.sigma(i, d))).value();
        const auto& maps = engine.structure().maps();
        const CellChain boundary = engine.maps().boundary({i, {{maps.sign(cell.order), cell.node}}});
        CAPTURE(i, d, to_text(boundary));
        const bool is_loop = i == 1 && chain.sigma(1, chain.level(1).alpha(0, d)) == chain.sigma(1, d);
        REQUIRE(std::ranges::count_if(boundary.terms, [&](const auto& term) {
                  return term.generator == face.node && term.coefficient == sparse::Rational{maps.sign(face.order)};
                }) == (is_loop ? 0 : 1));
      }
    }
  }
}

TEST_CASE("darts of a chain of maps are named by their level, and are not sewn") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_chain("m", *ops::chain_of_gmap(ops::polygon(4))));
  CHECK(engine.structure().lookup("m.2:7") == engine.structure().lookup("m.2:0"));
  CHECK(engine.structure().lookup("m.0:3").has_value());
  CHECK_FALSE(engine.structure().lookup("m.0:4").has_value());
  CHECK_FALSE(engine.structure().lookup("m.2:8").has_value());
  CHECK_FALSE(engine.structure().lookup("m.3:0").has_value());
  CHECK_FALSE(engine.structure().lookup("m:0").has_value());
  says(error_of(engine, operation(R"({"op":"sew","dim":2,"pairs":[["m:0","m:4"]]})")), "identify glues these");
  says(error_of(engine, operation(R"({"op":"unsew","dim":2,"darts":["m:0"]})")), "identify glues these");
  says(error_of(engine, operation(R"({"op":"extend","maps":["m"]})")), "make it with one level more");
  carry_out(engine, make_chain("k", *ops::chain_of_gmap(ops::polygon(4)), true));
  says(error_of(engine, operation(R"({"op":"sew","dim":2,"pairs":[["k:0","m:4"]]})")), "glued by identify");
  carry_out(engine, R"({"op":"identify","pairs":[["m.1:0","m.1:5"],["m.1:2","m.1:7"]]})");
  CHECK(live_groups(engine).size() == 3);  // a torus and a disc
  CHECK(engine.homology().betti == std::vector<std::int64_t>{2, 2, 1});
}

TEST_CASE("what is no chain of maps is refused, with the level and the dart") {
  Engine engine(ring_named("Z"));
  const auto made = [&](const std::string& levels) {
    return error_of(engine, operation(R"({"op":"chain_of_maps","name":"m","levels":)" + levels + "}"));
  };
  says(made(R"([{"darts":0}])"), "needs one at least on level 0");
  says(made(R"([{"darts":2},{"alpha":[[1,0]],"sigma":[0,2]}])"), "sigma_1 sends dart 1 to 2");
  says(made(R"([{"darts":2},{"alpha":[[0,2,1]],"sigma":[0,1,1]}])"), "the 1-cell of dart 0 is no ball");
  says(made(R"([{"darts":2},{"alpha":[[1,1]],"sigma":[0,1]}])"), "level 1: ");
  says(made(R"([{"darts":2},{"alpha":[[1,0]],"sigma":[0,1]},{"alpha":[[1,0],[1,0]],"sigma":[0,0]}])"), "condition (a)");
  ops::MakeChainOfMaps torus = make_chain("t", *ops::chain_of_gmap(torus_of_a_square().extended()));
  says(error_of(engine, torus),
       "the 3-cell of dart 0 is no ball: its canonical boundary has not the homology of a "
       "sphere: make \"t\" \"as\":\"simplices\"");
  torus.as_simplices = true;
  carry_out(engine, torus);
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0, 0});
  ops::MakeChainOfMaps placed = make_chain("p", *ops::chain_of_gmap(ops::polygon(3)));
  placed.at = {{0, 0, 0}};
  says(error_of(engine, placed), "3 vertices, but 1 points");
  carry_out(engine, R"({"op":"simplex","name":"q.1:4","dim":0})");
  placed.at = {};
  placed.name = "q";
  says(error_of(engine, placed), "the name \"q.1:4\" is in use");
}
