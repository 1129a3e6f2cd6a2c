// Taking cells away: the third direction of the theorem, alone and mixed with all other steps.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "tests/support/engines.hpp"
#include "tests/support/groups.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

using engine::RebasePolicy;

ops::Operation removal(std::vector<std::string> cells, bool cofaces = false) {
  return ops::Remove{std::move(cells), cofaces};
}

std::string why_not(Engine& engine, const ops::Operation& op) {
  const std::string before = dump(engine);
  const auto report = engine.apply(op);
  CHECK(dump(engine) == before);
  return report ? "" : report.error().what;
}

std::vector<std::int64_t> betti(Engine& engine) { return engine.homology().betti; }

/// The torus as a square whose edges are glued.
const std::vector<std::string> torus_of_two{
    R"({"op":"simplex","name":"a","dim":2})", R"({"op":"simplex","name":"b","dim":2})",
    R"({"op":"identify","pairs":[["a.0-2","b.0-2"],["a.0-1","b.1-2"],["a.1-2","b.0-1"]]})"};

/// The projective plane: two triangles.
const std::vector<std::string> plane_of_two{
    R"({"op":"complex","name":"P","cells":[{"id":"v"},{"id":"w"},{"id":"a","faces":["w","v"]},{"id":"b","faces":["w","v"]},)"
    R"({"id":"c","faces":["v","v"]},{"id":"s","faces":["b","a","c"]},{"id":"t","faces":["a","b","c"]}]})"};

}  // namespace

TEST_CASE("a torus taken apart, cell by cell, has the groups that it should", "[engine][removal]") {
  Engine engine(ring_named(GENERATE("Z", "Z/2", "Z/3", "Q")), {}, GENERATE(RebasePolicy{}, RebasePolicy::never()));
  build(engine, torus_of_two);
  REQUIRE(betti(engine) == std::vector<std::int64_t>{1, 2, 1});
  const auto report = carry_out(engine, removal({"b"}));
  CHECK(report.kind == ops::StepKind::deletion);
  CHECK(report.sequence->direction == ops::Direction::kernel);
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 2, 0});
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, removal({"a"}));
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 3});
  carry_out(engine, removal({"a.0-1"}));
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 2});
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, removal({"a.0"}, true));
  CHECK(betti(engine).empty());
  CHECK(engine.first_defect().value_or("") == "");
  CHECK(engine.undo(4));
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 2, 1});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("without a triangle the projective plane is a Moebius strip, and it comes back", "[engine][removal]") {
  Engine engine(ring_named("Z"), {}, GENERATE(RebasePolicy{}, RebasePolicy::never()));
  build(engine, plane_of_two);
  REQUIRE(engine.homology().torsion[1] == std::vector<Integer>{Integer{2}});
  carry_out(engine, removal({"P.t"}));
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 1, 0});
  CHECK(engine.homology().torsion[1].empty());
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("isolated vertices go, and the last one too", "[engine][removal]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3", "Q");
  Engine engine(ring_named(ring), {}, RebasePolicy::never());
  build(engine, {R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"f","dim":1})",
                 R"({"op":"identify","pairs":[["e.0","f.0"],["e.1","f.1"]]})"});
  carry_out(engine, removal({"e", "f"}));
  CHECK(betti(engine) == std::vector<std::int64_t>{2});
  carry_out(engine, removal({"f.0"}));
  CHECK(betti(engine) == std::vector<std::int64_t>{1});
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, removal({"f.1"}));
  CHECK(betti(engine).empty());
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, R"({"op":"simplex","name":"g","dim":2})");
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 0, 0});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("a body without cells is a body still", "[engine][removal]") {
  Engine engine(ring_named("Z"));
  build(engine, {R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"t","dim":2})"});
  carry_out(engine, removal({"e.0", "e.1"}, true));
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, R"({"op":"product","name":"p","left":"e","right":"t"})");
  CHECK(betti(engine).empty());
  carry_out(engine, R"({"op":"cone","apex":"v","over":"p"})");
  CHECK(betti(engine) == std::vector<std::int64_t>{1});
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, removal({}));
  CHECK(betti(engine) == std::vector<std::int64_t>{1});
}

TEST_CASE("what cannot be removed is refused, with the reason", "[engine][removal]") {
  Engine engine(ring_named("Z"));
  build(engine, {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"simplex","name":"s","dim":2})",
                 R"({"op":"identify","pairs":[["t.0-1","s.0-1"]]})"});
  CHECK(why_not(engine, removal({"s.0-1"})) ==
        "\"t.0-1\" is a face of \"t\", which would stay: remove that too, or say \"cofaces\":true");
  CHECK(why_not(engine, removal({"t", "t.0-1"})) ==
        "\"t.0-1\" is a face of \"s\", which would stay: remove that too, or say \"cofaces\":true");
  CHECK(why_not(engine, removal({"u"})) == "there is no cell \"u\"");
  carry_out(engine, removal({"t", "s", "s.0-1"}));
  CHECK(why_not(engine, removal({"t"})) == "the cell \"t\" was removed: undo that, or name another cell");
  CHECK(why_not(engine, removal({"s.0-1"})) ==
        "the cell \"s.0-1\" was removed, as \"t.0-1\": undo that, or name another cell");
  CHECK(why_not(engine, operation(R"({"op":"simplex","name":"t","dim":0})")) ==
        "the name \"t\" is in use: names are unique, choose another");
  CHECK(why_not(engine, operation(R"({"op":"class","chain":[[1,"t.0-1"]]})")) ==
        "the cell \"t.0-1\" was removed: undo that, or name another cell");
  carry_out(engine, R"({"op":"degenerate","cell":"t.1-2","along":0})");
  CHECK(
      why_not(engine, removal({"t.1-2"})) ==
      "\"t.1-2\" is degenerate, and no cell of its own: it goes when \"t.1\" is removed, which it is degenerate over");
  CHECK(why_not(engine, removal({"t.1"})) ==
        "\"t.1\" is a face of \"t.0-2\", which would stay: remove that too, or say \"cofaces\":true");
}

TEST_CASE("simplices of abstract complexes go and come again", "[engine][removal][abstract]") {
  const std::string ring = GENERATE("Z", "Z/2");
  Engine engine(ring_named(ring), {}, GENERATE(RebasePolicy{}, RebasePolicy::never()));
  carry_out(engine, R"({"op":"insert","simplices":[["a","b","c"],["b","c","d"]]})");
  CHECK(why_not(engine, removal({"{b,c}"})).starts_with("\"{b,c}\" is a face of \"{a,b,c}\""));
  carry_out(engine, removal({"{c,b}"}, true));
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 1});
  CHECK(why_not(engine, removal({"{a,c,b}"})).find("there is no cell") == 0);
  CHECK(why_not(engine, removal({"{a,b,c}"})) == "the cell \"{a,b,c}\" was removed: undo that, or name another cell");
  carry_out(engine, R"({"op":"insert","simplex":["a","b","c"]})");
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 1, 0});
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, removal({"{a}"}, true));
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 1});
  CHECK(why_not(engine, operation(R"({"op":"collapse","from":"a","to":"b"})")) == "the vertex \"a\" was removed");
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, R"({"op":"insert","simplex":["a","d"]})");
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 1});
  carry_out(engine, R"({"op":"insert","simplex":["b","c","d"]})");
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 0, 0});
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, R"({"op":"collapse","from":"a","to":"d"})");
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 0, 0});
  CHECK(engine.undo(6));
  CHECK(engine.first_defect().value_or("") == "");
  CHECK(engine.structure().name(engine.structure().lookup("{b,c,d}").value()) == "{b,c,d}");
}

TEST_CASE("a cell of a product goes", "[engine][removal]") {
  Engine engine(ring_named(GENERATE("Z", "Z/2")), {}, GENERATE(RebasePolicy{}, RebasePolicy::never()));
  build(engine, {R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e.0","e.1"]]})",
                 R"({"op":"product","name":"P","left":"e","right":"e"})"});
  REQUIRE(betti(engine) == std::vector<std::int64_t>{1, 2, 1});
  carry_out(engine, removal({"P.(e|e)"}));
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 2});
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, removal({"P.(e|e.0)"}));
  CHECK(betti(engine) == std::vector<std::int64_t>{1, 1});
  CHECK(engine.first_defect().value_or("") == "");
  const auto again = engine.apply(removal({"P.(e|e.1)"}));
  REQUIRE(!again);
  CHECK(again.error().what == "the cell \"P.(e|e.1)\" was removed, as \"P.(e|e.0)\": undo that, or name another cell");
}

TEST_CASE("every law holds after every step of streams with removals", "[engine][removal][stream]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const RebasePolicy policy = GENERATE(RebasePolicy{}, taking_splits_in, RebasePolicy::never());
  const unsigned seed = GENERATE(range(0U, 20U));
  CAPTURE(ring, policy.least_splits, policy.cells_begun_at_once, seed);
  Engine engine(ring_named(ring), {}, policy);
  StreamShape shape = everything_and_maps(30);
  shape.products = shape.pyramids = seed % 2 == 0;
  RandomSteps random(seed, shape);
  for (int k = 0; k < 40; ++k) {
    const ops::Operation op = random.next(engine.structure());
    CAPTURE(k, ops::to_text(op));
    carry_out(engine, op);
    REQUIRE(engine.first_defect().value_or("") == "");
    if (random.random().one_in(6)) {
      const std::uint64_t steps = static_cast<std::uint64_t>(random.random().in(1, 4));
      if (engine.undo(std::min(steps, engine.undoable()))) {
        REQUIRE(engine.first_defect().value_or("") == "");
      }
    }
  }
}

namespace {

using Labels = std::vector<int>;

std::string name_of(const Labels& simplex) { return fmt::format("{{{}}}", fmt::join(simplex, ",")); }

ops::Operation insertion(const Labels& simplex) {
  return operation(fmt::format(R"({{"op":"insert","simplex":[{}]}})", fmt::join(simplex, ",")));
}

/// A torus of 4 times 4 squares in which a loop is filled twice, and a Klein bottle beside it.
std::vector<Labels> triangles_of_surfaces() {
  constexpr int n = 4;
  std::vector<Labels> triangles{{0, 4, 8}, {0, 8, 12}, {0, 4, 100}, {4, 8, 100}, {8, 12, 100}, {0, 12, 100}};
  for (const bool is_klein_bottle : {false, true}) {
    const auto vertex = [=](int i, int j) {
      return (is_klein_bottle ? 200 : 0) + (i % n) * n + (is_klein_bottle && i >= n ? 2 * n - j : j) % n;
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
        triangles.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
      }
    }
  }
  for (Labels& t : triangles) {
    std::sort(t.begin(), t.end());
  }
  return triangles;
}

/// A simplicial complex as the set of its simplices, beside an engine: simplices go and come back at random.
struct TornSurfaces {
  TornSurfaces(Engine& e, unsigned seed) : engine{e}, random{seed} {
    for (const Labels& t : triangles_of_surfaces()) {
      insert(t);
    }
  }

  Engine& engine;
  Random random;
  std::set<Labels> there;

  void insert(const Labels& simplex) {
    carry_out(engine, insertion(simplex));
    for (unsigned faces = 1; faces < 1U << simplex.size(); ++faces) {
      Labels face;
      for (std::size_t k = 0; k < simplex.size(); ++k) {
        if ((faces >> k & 1U) != 0) {
          face.push_back(simplex[k]);
        }
      }
      there.insert(face);
    }
  }
  void insert_again(const std::vector<Labels>& gone) {
    const Labels& any = gone[static_cast<std::size_t>(random.in(0, static_cast<int>(gone.size()) - 1))];
    if (!there.contains(any)) {
      insert(any);
    }
  }
  /// One of a size without cofaces, if there is one.
  std::optional<Labels> any_free(std::size_t size) {
    std::vector<Labels> free;
    for (const Labels& s : there) {
      const auto has_it = [&s](const Labels& t) {
        return t.size() > s.size() && std::includes(t.begin(), t.end(), s.begin(), s.end());
      };
      if (s.size() == size && std::none_of(there.begin(), there.end(), has_it)) {
        free.push_back(s);
      }
    }
    return free.empty()
               ? std::nullopt
               : std::optional{free[static_cast<std::size_t>(random.in(0, static_cast<int>(free.size()) - 1))]};
  }
  std::optional<Labels> remove(std::size_t size) {
    const std::optional<Labels> simplex = any_free(size);
    if (simplex) {
      carry_out(engine, removal({name_of(*simplex)}));
      there.erase(*simplex);
    }
    return simplex;
  }
};

}  // namespace

TEST_CASE("surfaces whose cells go and come back have the groups from scratch at each step", "[engine][removal]") {
  const auto ring = ring_named(GENERATE("Z", "Z/2", "Z/3", "Q"));
  const RebasePolicy policy = GENERATE(RebasePolicy{}, RebasePolicy::never());
  const unsigned seed = GENERATE(range(0U, 4U));
  CAPTURE(policy.least_deletions, seed);
  Engine engine(ring, {}, policy);
  TornSurfaces surfaces(engine, seed);
  int steps = 0;
  const auto check = [&] {
    if (++steps % 3 == 0) {
      REQUIRE(live_groups(engine) ==
              std::visit([&](const auto& k) { return groups_from_scratch(engine.structure(), k); }, ring));
    }
    if (steps % 8 == 0) {
      REQUIRE(engine.first_defect().value_or("") == "");
    }
  };
  for (int k = 0; k < 8; ++k) {  // one at a time: the surface is open, and closed again
    const auto gone = surfaces.remove(3);
    check();
    surfaces.insert(*gone);
    check();
  }
  for (int k = 0; k < 8; ++k) {  // some at a time, edges too, and all back
    std::vector<Labels> out;
    for (int cells = surfaces.random.in(2, 8); cells > 0; --cells) {
      if (const auto gone = surfaces.remove(static_cast<std::size_t>(surfaces.random.in(2, 3)))) {
        out.push_back(*gone);
        check();
      }
    }
    while (!out.empty()) {
      const auto at = out.begin() + surfaces.random.in(0, static_cast<int>(out.size()) - 1);
      if (!surfaces.there.contains(*at)) {
        surfaces.insert(*at);
        check();
      }
      out.erase(at);
    }
  }
  for (std::vector<Labels> out; const auto gone = surfaces.remove(3);) {
    out.push_back(*gone);
    check();
    if (surfaces.random.one_in(4)) {
      surfaces.insert_again(out);
      check();
    }
  }
  for (std::vector<Labels> out; const auto gone = surfaces.remove(2);) {
    out.push_back(*gone);
    check();
    if (surfaces.random.one_in(5)) {
      surfaces.insert_again(out);
      check();
    }
  }
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("groups with torsion are those of a Smith form, step by step, where cells go", "[engine][removal][torsion]") {
  const unsigned seed = GENERATE(range(0U, 50U));
  CAPTURE(seed);
  Engine engine(ring_named("Z"), {}, seed % 3 == 0 ? RebasePolicy{} : RebasePolicy::never());
  RandomSteps steps(seed, everything_and_maps(70));
  Random& random = steps.random();
  int names = 0;
  for (int k = 0; k < 60; ++k) {
    const std::vector<ops::CellId> cells = current_cells(engine.structure());
    const auto any = [&] {
      return engine.structure().name(cells[static_cast<std::size_t>(random.in(0, static_cast<int>(cells.size()) - 1))]);
    };
    const std::string name = "m" + std::to_string(++names);
    ops::Operation op = steps.next(engine.structure());
    if (!cells.empty() && random.one_in(3)) {
      op = ops::Remove{{any(), any()}, true};
    } else if (cells.size() < 120 && random.one_in(3)) {
      op = random.one_in(2) ? random_relations(name, random) : multiples_of_a_loop(name, random.in(2, 6), true);
    } else if (!cells.empty() && cells.size() < 120 && random.one_in(4)) {
      op = ops::MakeSuspension{{name + "n", name + "s"}, std::vector<std::string>{any(), any()}, {}};
    }
    CAPTURE(k, ops::to_text(op));
    (void)engine.apply(op);  // what is refused changes nothing
    REQUIRE(live_groups(engine) == groups_from_scratch(engine.structure(), sparse::Integers{}));
  }
}

TEST_CASE("every law holds where rules are brought up to date late: removals, replacements, few questions",
          "[engine][removal][replacement][stream]") {
  const std::string ring = GENERATE("Z", "Z/3");
  const unsigned seed = GENERATE(range(0U, 30U));
  CAPTURE(ring, seed);
  Engine engine(ring_named(ring), {}, RebasePolicy::never());
  StreamShape shape = everything_and_maps(40);
  shape.products = shape.pyramids = seed % 2 == 0;
  shape.splits = seed % 3 == 0;
  RandomSteps random(seed, shape);
  for (int k = 1; k <= 90; ++k) {
    const ops::Operation op = random.next(engine.structure());
    CAPTURE(k, ops::to_text(op));
    carry_out(engine, op);
    if (random.random().one_in(12)) {
      REQUIRE(engine.undo(std::min<std::uint64_t>(engine.undoable(), 2)));
    }
    if (k % 15 == 0) {
      REQUIRE(engine.first_defect().value_or("") == "");
    }
  }
}
