// Replacing cells: flips, subdivisions and contractions of edges, which leave the groups as they are.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/engines.hpp"
#include "tests/support/groups.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

using engine::RebasePolicy;
using ops::CellId;
using ops::Replace;

ops::Operation flip(std::string cell, std::string by = "") {
  return Replace{Replace::Flip{std::move(cell), std::move(by), {}}};
}
ops::Operation subdivide(std::string cell, std::string by) {
  return Replace{Replace::Subdivision{std::move(cell), std::move(by), {}}};
}
ops::Operation contract(std::string from, std::string to, bool link_condition = true) {
  return Replace{Replace::Contraction{std::move(from), std::move(to), link_condition}};
}

/// Why an operation is refused, which leaves everything as it was; empty when it is done.
std::string refusal(Engine& engine, const ops::Operation& op) {
  const std::string before = dump(engine);
  const auto report = engine.apply(op);
  if (report) {
    return "";
  }
  CHECK(dump(engine) == before);
  return report.error().what;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<std::uint64_t> counts(const Engine& engine) {
  const auto cells = engine.cells();
  return {cells.begin(), cells.end()};
}

/// The torus on 7 vertices, the projective plane on 6 and the boundary of a simplex of dimension 4.
const std::vector<std::string> closed_complexes{
    R"({"op":"insert","simplices":[[0,1,3],[1,2,4],[2,3,5],[3,4,6],[4,5,0],[5,6,1],[6,0,2],[0,2,3],[1,3,4],[2,4,5],[3,5,6],[4,6,0],[5,0,1],[6,1,2]]})",
    R"({"op":"insert","simplices":[[1,2,5],[1,2,6],[1,3,4],[1,3,6],[1,4,5],[2,3,4],[2,3,5],[2,4,6],[3,5,6],[4,5,6]]})",
    R"({"op":"insert","simplices":[[0,1,2,3],[0,1,2,4],[0,1,3,4],[0,2,3,4],[1,2,3,4]]})"};

/// Whether each cell of one dimension less than the largest has two cofaces, counted with multiplicity.
bool is_closed(const ops::Structure& structure) {
  const int top = static_cast<int>(structure.counts().size()) - 1;
  for (const CellId c : current_cells(structure)) {
    std::size_t times = 0;
    for (const CellId coface : ops::cofaces(structure, c)) {
      const auto faces = structure.faces().of(coface);
      times += static_cast<std::size_t>(
          std::count_if(faces.begin(), faces.end(), [&](CellId f) { return structure.find(f) == c; }));
    }
    if (structure.dimension(c) == top - 1 && times != 2) {
      return false;
    }
  }
  return true;
}

/// A random flip that is possible, preferring those that make the complex no larger when it is large.
std::optional<ops::Operation> possible_flip(Engine& engine, Random& random, int& names, std::size_t large) {
  const std::vector<CellId> cells = current_cells(engine.structure());
  for (int tries = 0; tries < 60; ++tries) {
    const CellId cell = cells[static_cast<std::size_t>(random.in(0, static_cast<int>(cells.size()) - 1))];
    const int top = static_cast<int>(engine.structure().counts().size()) - 1;
    if (cells.size() > large && engine.structure().dimension(cell) == top) {
      continue;
    }
    for (const std::string& by : {std::string{}, "w" + std::to_string(++names)}) {
      ops::Planner planner(engine.structure());
      ops::Plan plan;
      const Replace op{Replace::Flip{engine.structure().name(cell), by, {}}};
      if (planner.plan(op, plan)) {
        return op;
      }
    }
  }
  return std::nullopt;
}

void walk_by_flips(Engine& engine, unsigned seed, int steps, std::size_t large) {
  Random random(seed);
  int names = 0, done = 0;
  const auto groups = live_groups(engine);
  const bool was_closed = is_closed(engine.structure());
  for (int k = 0; k < steps; ++k) {
    const auto op = possible_flip(engine, random, names, large);
    if (!op) {
      continue;
    }
    CAPTURE(k, ops::to_text(*op));
    const std::int64_t euler = engine.euler_characteristic();
    const auto report = carry_out(engine, *op);
    ++done;
    REQUIRE(report.kind == ops::StepKind::replacement);
    REQUIRE(live_groups(engine) == groups);
    REQUIRE(engine.euler_characteristic() == euler);
    REQUIRE(engine.first_defect().value_or("") == "");
    REQUIRE(is_closed(engine.structure()) == was_closed);
  }
  REQUIRE(done > steps / 2);
}

/// Some simplices of dimension n, whose facets are glued in pairs at random.
void glue_at_random(Engine& engine, int n, int simplices, Random& random) {
  std::vector<std::string> facets;
  for (int k = 0; k < simplices; ++k) {
    const std::string name = "t" + std::to_string(k);
    carry_out(engine, ops::MakeSimplex{name, n, {}});
    for (int left_out = 0; left_out <= n; ++left_out) {
      std::string facet = name + ".";
      for (int v = 0; v <= n; ++v) {
        facet += v == left_out ? "" : std::to_string(v) + (v == n || (left_out == n && v == n - 1) ? "" : "-");
      }
      facets.push_back(facet);
    }
  }
  while (facets.size() > 1) {
    const auto at = static_cast<std::size_t>(random.in(0, static_cast<int>(facets.size()) - 2));
    std::vector<int> order;
    for (int v = 0; v < n; ++v) {
      order.insert(order.begin() + random.in(0, v), v);
    }
    (void)engine.apply(ops::Identify{{{facets.back(), facets[at]}}, {{0, {order}}}});  // refused when it would fold
    facets.pop_back();
    facets.erase(facets.begin() + static_cast<std::ptrdiff_t>(at));
  }
}

}  // namespace

TEST_CASE("flips of abstract complexes leave the groups, over each ring", "[engine][replacement]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3", "Q");
  const std::size_t which = GENERATE(0U, 1U, 2U);
  const bool rebases = GENERATE(true, false);
  CAPTURE(ring, which, rebases);
  Engine engine(ring_named(ring), {}, rebases ? RebasePolicy{} : RebasePolicy::never());
  build(engine, {closed_complexes[which]});
  walk_by_flips(engine, static_cast<unsigned>(which), 24, 60);
}

TEST_CASE("flips of simplices glued at random leave the groups", "[engine][replacement]") {
  const unsigned seed = GENERATE(range(0U, 12U));
  CAPTURE(seed);
  Random random(seed);
  Engine engine(ring_named("Z"));
  glue_at_random(engine, seed % 3 == 0 ? 2 : 3, random.in(1, 4), random);
  CAPTURE(counts(engine));
  walk_by_flips(engine, seed + 100, 20, 70);
}

TEST_CASE("replacements among all other steps leave the groups, and are undone", "[engine][replacement][stream]") {
  const unsigned seed = GENERATE(range(0U, 20U));
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(seed, ring);
  Engine engine(ring_named(ring), {}, seed % 2 == 0 ? RebasePolicy{} : RebasePolicy::never());
  RandomSteps steps(seed, everything_and_maps(40));
  int replaced = 0;
  for (int k = 0; k < 40; ++k) {
    const ops::Operation op = steps.next(engine.structure());
    CAPTURE(k, ops::to_text(op));
    const bool replaces = std::holds_alternative<Replace>(op);
    const auto groups = live_groups(engine);
    const auto all = [&] { return dump(engine.structure()) + answers(engine); };
    const std::string before = replaces ? all() : "";
    carry_out(engine, op);
    if (replaces) {
      ++replaced;
      REQUIRE(live_groups(engine) == groups);
      REQUIRE(engine.first_defect().value_or("") == "");
      REQUIRE(engine.undo(1));
      REQUIRE(all() == before);
      carry_out(engine, op);
      REQUIRE(live_groups(engine) == groups);
    }
  }
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("subdivisions of abstract complexes leave the groups", "[engine][replacement]") {
  Engine engine(ring_named("Z"));
  build(engine, {closed_complexes[1], R"({"op":"insert","simplices":[[6,7,8],[8,9],[1,7]]})"});
  const auto groups = live_groups(engine);
  carry_out(engine, subdivide("{1,2}", "a"));
  CHECK(counts(engine) == std::vector<std::uint64_t>{10, 23, 13});
  CHECK_FALSE(engine.structure().abstract().find_named("{1,2}"));
  CHECK(engine.structure().abstract().find_named("{2,5,a}"));
  carry_out(engine, subdivide("{6,7,8}", "b"));
  carry_out(engine, subdivide("{8,9}", "c"));
  CHECK(counts(engine) == std::vector<std::uint64_t>{12, 27, 15});
  CHECK(live_groups(engine) == groups);
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("a simplex that was flipped away comes back by the inverse flip", "[engine][replacement]") {
  Engine engine(ring_named("Z"));
  build(engine, {closed_complexes[2]});
  carry_out(engine, flip("{0,1,2,3}", "x"));
  CHECK(counts(engine) == std::vector<std::uint64_t>{6, 14, 16, 8});
  carry_out(engine, flip("{0,1,2}"));  // two tetrahedra become three
  CHECK(counts(engine) == std::vector<std::uint64_t>{6, 15, 18, 9});
  carry_out(engine, flip("{4,x}"));  // and back
  CHECK(counts(engine) == std::vector<std::uint64_t>{6, 14, 16, 8});
  CHECK(engine.structure().abstract().find_named("{0,1,2}"));
  carry_out(engine, flip("{x}"));
  CHECK(counts(engine) == std::vector<std::uint64_t>{5, 10, 10, 5});
  carry_out(engine, flip("{0,1,2,3}", "x"));  // the label is free again
  CHECK(counts(engine) == std::vector<std::uint64_t>{6, 14, 16, 8});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("flips of cells with names: what the new ones are called", "[engine][replacement]") {
  Engine engine(ring_named("Z"));
  build(engine, {R"({"op":"simplex","name":"s","dim":2})", R"({"op":"simplex","name":"t","dim":2})",
                 R"({"op":"identify","pairs":[["s.0-1","t.0-1"]]})"});
  carry_out(engine, flip("s.0-1", "e"));
  for (const char* name : {"e", "e.0-2-3", "e.1-2-3"}) {
    CHECK(engine.structure().lookup(name));
  }
  CHECK(counts(engine) == std::vector<std::uint64_t>{4, 5, 2});
  CHECK(has(refusal(engine, flip("s.0-1", "f")), "was removed"));
  carry_out(engine, subdivide("e", "v"));
  for (const char* name : {"v", "v*e.0", "v*e.1", "v*e.0-2-3.0", "v*e.0-2-3.0-1", "v*e.0-2-3.0-2"}) {
    CHECK(engine.structure().lookup(name));
  }
  CHECK(counts(engine) == std::vector<std::uint64_t>{5, 8, 4});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("an edge is contracted where the link condition holds, and else when that is said", "[engine][replacement]") {
  Engine engine(ring_named("Z"));
  build(engine, {closed_complexes[0]});
  CHECK(has(refusal(engine, contract("0", "1")), "link condition"));
  carry_out(engine, subdivide("{0,1,3}", "x"));
  const auto groups = live_groups(engine);
  const auto report = carry_out(engine, contract("x", "0"));
  CHECK(report.kind == ops::StepKind::removal);
  CHECK(live_groups(engine) == groups);
  CHECK(counts(engine) == std::vector<std::uint64_t>{7, 21, 14});
  carry_out(engine, contract("0", "1", false));
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("the link condition is what keeps the groups, on random complexes", "[engine][replacement]") {
  const unsigned seed = GENERATE(range(0U, 30U));
  CAPTURE(seed);
  Random random(seed);
  Engine engine(ring_named("Z"));
  ops::Insert insert;
  insert.exist_ok = true;
  for (int k = 0; k < 9; ++k) {
    std::vector<std::string> labels;
    for (int v = 0; v < 7; ++v) {
      if (random.one_in(3)) {
        labels.push_back(std::to_string(v));
      }
    }
    if (!labels.empty()) {
      insert.simplices.push_back(labels);
    }
  }
  carry_out(engine, insert);
  int contracted = 0;
  for (int a = 0; a < 7; ++a) {
    for (int b = 0; b < 7; ++b) {
      const auto groups = live_groups(engine);
      if (a != b && engine.apply(contract(std::to_string(a), std::to_string(b)))) {
        ++contracted;
        REQUIRE(live_groups(engine) == groups);
        REQUIRE(engine.first_defect().value_or("") == "");
      }
    }
  }
  CHECK(contracted < 7);
}

TEST_CASE("replacements that cannot be done are refused with the reason, and nothing changes",
          "[engine][replacement]") {
  Engine engine(ring_named("Z"));
  build(engine, {R"({"op":"insert","simplices":[[1,2,3],[2,3,4],[1,4],[4,5,6],[5,6,7],[5,6,8]]})",
                 R"({"op":"simplex","name":"s","dim":2})", R"({"op":"simploid","name":"q","type":[1,1]})",
                 R"({"op":"complex","name":"C","cells":[{"id":"v"},{"id":"e","faces":["v","v"]},)"
                 R"({"id":"t","faces":["e","e","e"]}]})"});
  CHECK(has(refusal(engine, flip("{2,3}")), "is there already"));
  CHECK(has(refusal(engine, flip("{2,3}", "x")), "leave \"by\""));
  CHECK(has(refusal(engine, flip("{5,6}")), "3 cells with 3 vertices"));
  CHECK(has(refusal(engine, flip("{1,2}")), "1 cells with 1 vertices"));
  CHECK(has(refusal(engine, flip("{1,2,3}")), "needs a name"));
  CHECK(has(refusal(engine, flip("{1,2,3}", "4")), "a vertex \"4\" already"));
  CHECK(has(refusal(engine, flip("{1,9}")), "there is no cell"));
  CHECK(has(refusal(engine, flip("s")), "needs a name"));
  CHECK(has(refusal(engine, flip("s", "q")), "in use"));
  carry_out(engine, R"({"op":"simplex","name":"s2","dim":2})");
  carry_out(engine, R"({"op":"identify","pairs":[["s.0-1","s2.0-1"]]})");
  CHECK(has(refusal(engine, Replace{Replace::Flip{"s.0-1", "e", ops::Point{}}}), "leave \"at\" out"));
  CHECK(has(refusal(engine, subdivide("{1}", "x")), "is a vertex"));
  CHECK(has(refusal(engine, subdivide("{1,2}", "a,b")), "is not a label"));
  CHECK(has(refusal(engine, subdivide("s", "")), "is not a name"));
  CHECK(has(refusal(engine, subdivide("q", "x")), "is no simplex"));
  CHECK(has(refusal(engine, flip("C.e", "x")), "more than once"));
  CHECK(has(refusal(engine, contract("1", "7")), "no edge"));
  CHECK(has(refusal(engine, contract("1", "1")), "into itself"));
  CHECK(has(refusal(engine, contract("1", "9")), "no vertex"));
}

TEST_CASE("classes live through replacements: the barcode is that of the two halves", "[engine][replacement][zigzag]") {
  const unsigned seed = GENERATE(range(0U, 16U));
  CAPTURE(seed);
  Engine engine(ring_named("Z/2")), halves(ring_named("Z/2"));
  StreamShape shape{.most_cells = 30, .splits = true, .removals = true, .replacements = true};
  RandomSteps steps(seed, shape);
  std::vector<std::uint64_t> step_of{0};  // of a step of the other engine
  int replaced = 0;
  for (std::uint64_t k = 1; k <= 20; ++k) {
    const ops::Operation op = steps.next(engine.structure());
    carry_out(engine, op);
    if (const auto* replace = std::get_if<Replace>(&op)) {
      ++replaced;
      const auto* flipped = std::get_if<Replace::Flip>(&replace->move);
      const std::string cell = flipped != nullptr ? flipped->cell : std::get<Replace::Subdivision>(replace->move).cell;
      const auto groups = live_groups(halves);
      carry_out(halves, Replace{replace->move, true});
      REQUIRE(live_groups(halves) == groups);
      carry_out(halves, ops::Remove{{cell}, true});
      REQUIRE(live_groups(halves) == groups);
      step_of.push_back(k);
    } else {
      carry_out(halves, op);
    }
    step_of.push_back(k);
  }
  const auto found = engine.barcode();
  const auto expected = halves.barcode();
  REQUIRE((found ? "" : found.error().what) == "");
  REQUIRE((expected ? "" : expected.error().what) == "");
  const auto time = [&](engine::Time t) {
    return t == engine::never ? t : engine::Time{step_of[static_cast<std::size_t>(t.nearest())]};
  };
  std::vector<engine::Bar> bars;
  for (const engine::Bar& bar : expected->bars) {
    if (time(bar.birth) != time(bar.death)) {
      bars.push_back({bar.dimension, time(bar.birth), time(bar.death)});
    }
  }
  std::sort(bars.begin(), bars.end());
  CHECK(found->bars == bars);
}

TEST_CASE("no bar ends at a flip of a closed surface", "[engine][replacement][zigzag]") {
  Engine engine(ring_named("Z/2"));
  build(engine, {closed_complexes[0]});
  carry_out(engine, subdivide("{0,1,3}", "x"));
  carry_out(engine, flip("{0,1}"));
  carry_out(engine, flip("{0,3}"));
  const auto barcode = engine.barcode();
  REQUIRE(barcode);
  REQUIRE(barcode->bars.size() == 4);
  for (const engine::Bar& bar : barcode->bars) {
    CHECK(bar.birth == engine::Time{1});
    CHECK(bar.death == engine::never);
  }
}
