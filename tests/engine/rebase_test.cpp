// Equivalences that are begun afresh when their history weighs more than the object: nothing but cost and
// representatives may depend on that.
#include <algorithm>
#include <numeric>

#include "tests/support/engines.hpp"
#include "tests/support/graph_sessions.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

using engine::RebasePolicy;

/// After each step that splits; and whenever a step after a split costs anything.
constexpr RebasePolicy after_each_split{1, UINT64_MAX, 0, 0, UINT64_MAX / 4096, 0, UINT64_MAX, 0};
constexpr RebasePolicy without_budget{UINT64_MAX / 2, 1, 0, 0, 0, 0, UINT64_MAX, 0};
/// The same, and no more is kept for undo than must be.
constexpr RebasePolicy forgetful{1, UINT64_MAX, 0, 0, UINT64_MAX / 4096, 0, 0, 0};

void check_graph(Engine& engine, const std::vector<std::int64_t>& betti) {
  const engine::Homology homology = engine.homology();
  REQUIRE(homology.betti == betti);
  for (const auto& torsion : homology.torsion) {
    REQUIRE(torsion.empty());
  }
}

/// Steps of a session, with the known groups after each.
void run_session(unsigned seed, const std::string& ring, int edges, bool undoes, int steps) {
  CAPTURE(seed, ring, edges, undoes);
  Engine engine(ring_named(ring));
  GraphSession session(seed, edges, undoes);
  for (int k = 0; k < steps; ++k) {
    CAPTURE(k);
    carry_out(engine, session.next());
    check_graph(engine, session.betti());
  }
  CHECK(engine.rebases() > 0);
}

std::uint64_t total(const engine::Work& work) {
  return work.boundary_entries + work.rewritten_terms + work.rule_terms + work.path_links;
}

}  // namespace

TEST_CASE("a graph of 30 edges has the groups of a graph through 20,000 steps of editing", "[engine][rebase]") {
  run_session(4, GENERATE("Z", "Z/2", "Z/3"), 30, GENERATE(false, true), 20'000);
}

TEST_CASE("a graph of 60 edges has the groups of a graph through 20,000 steps of editing", "[engine][rebase]") {
  run_session(5, GENERATE("Z", "Z/2", "Z/3"), 60, GENERATE(false, true), 20'000);
}

TEST_CASE("a graph of 300 edges has the groups of a graph through 20,000 steps of editing", "[engine][rebase]") {
  run_session(6, GENERATE("Z", "Z/2", "Z/3"), 300, GENERATE(false, true), 20'000);
}

TEST_CASE("every law holds after every step of an edited graph, whenever its equivalence is begun afresh",
          "[engine][rebase]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const RebasePolicy policy = GENERATE(RebasePolicy{}, after_each_split, without_budget);
  CAPTURE(ring, policy.least_splits, policy.least_terms);
  Engine engine(ring_named(ring), {}, policy);
  GraphSession session(7, 10, true);
  for (int k = 0; k < 250; ++k) {
    CAPTURE(k);
    carry_out(engine, session.next());
    REQUIRE(engine.first_defect().value_or("") == "");
    check_graph(engine, session.betti());
  }
  CHECK(engine.rebases() > 5);
}

TEST_CASE("every law holds after every step of random streams, whenever the equivalence is begun afresh",
          "[engine][rebase][stream]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const RebasePolicy policy = GENERATE(after_each_split, without_budget);
  const unsigned seed = GENERATE(range(0U, 12U));
  CAPTURE(ring, policy.least_splits, seed);
  Engine engine(ring_named(ring), {}, policy);
  Engine twin(ring_named(ring), {}, RebasePolicy::never());
  RandomSteps random(seed, everything_and_maps(40));
  for (int k = 0; k < 40; ++k) {
    const ops::Operation op = random.next(engine.structure());
    CAPTURE(k, ops::to_text(op));
    carry_out(engine, op);
    carry_out(twin, op);
    REQUIRE(engine.first_defect().value_or("") == "");
    REQUIRE(live_groups(engine) == live_groups(twin));
  }
  CHECK(twin.rebases() == 0);
}

TEST_CASE("queries between steps change nothing that is said later, beginning afresh or not",
          "[engine][rebase][stream]") {
  const RebasePolicy policy = GENERATE(RebasePolicy::never(), after_each_split);
  const unsigned seed = GENERATE(range(40U, 60U));
  CAPTURE(policy.least_splits, seed);
  Engine asked(ring_named("Z"), {}, policy);
  Engine unasked(ring_named("Z"), {}, policy);
  RandomSteps random(seed, everything_and_maps(40));
  const auto named = [](Engine& engine) {
    std::string text;
    for (int p = 0; p < static_cast<int>(engine.cells().size()); ++p) {
      for (const engine::Generator& generator : engine.generators(p)) {
        text += "\norder " + generator.order.to_string();
        for (const CellChain* chain : {&generator.cycle, &generator.bounding}) {
          std::vector<std::string> terms;
          for (const auto& [coefficient, cell] : chain->terms) {
            terms.push_back(" " + coefficient.to_string() + "*" + std::string{engine.structure().name(cell)});
          }
          std::sort(terms.begin(), terms.end());
          text = std::accumulate(terms.begin(), terms.end(), text + " |");
        }
      }
    }
    return text;
  };
  for (int k = 0; k < 40; ++k) {
    const ops::Operation op = random.next(asked.structure());  // looks at all cells
    CAPTURE(k, ops::to_text(op));
    carry_out(asked, op);
    carry_out(unasked, op);
    if (random.random().one_in(3)) {
      (void)answers(asked);
    }
  }
  CHECK(number_of(asked.structure().cells().asked()) >= number_of(unasked.structure().cells().asked()));
  CHECK(first_difference(named(asked), named(unasked)) == "");
}

TEST_CASE("undo goes back through rebases to exactly what was", "[engine][rebase][undo]") {
  const std::string ring = GENERATE("Z", "Z/2");
  const RebasePolicy policy = GENERATE(after_each_split, without_budget);
  const bool all_operations = GENERATE(false, true);
  const unsigned seed = GENERATE(range(20U, 24U));
  CAPTURE(ring, policy.least_splits, all_operations, seed);
  Engine engine(ring_named(ring), {}, policy);
  RandomSteps random(seed, everything_and_maps(40));
  GraphSession session(seed, 8, false);
  std::vector<std::string> before;
  std::uint64_t rebases = 0;
  for (int k = 0; k < 60; ++k) {
    before.push_back(answers(engine));
    carry_out(engine, all_operations ? random.next(engine.structure()) : session.next());
    rebases = std::max(rebases, engine.rebases());
  }
  CHECK(rebases > 0);
  while (engine.undoable() > 0) {
    CAPTURE(engine.undoable());
    REQUIRE(engine.undo().has_value());
    REQUIRE(answers(engine) == before[engine.undoable()]);
  }
  CHECK(engine.rebases() == 0);
}

TEST_CASE("undo goes back past what was kept for it, to the same groups and every law", "[engine][rebase][undo]") {
  const std::string ring = GENERATE("Z", "Z/2");
  const bool all_operations = GENERATE(false, true);
  const unsigned seed = GENERATE(range(30U, 34U));
  const int at_once = GENERATE(1, 3, 7);
  CAPTURE(ring, all_operations, seed, at_once);
  Engine engine(ring_named(ring), {}, forgetful);
  RandomSteps random(seed, everything_and_maps(40));
  GraphSession session(seed, 8, false);
  std::vector<std::vector<AbelianGroup>> before;
  for (int k = 0; k < 60; ++k) {
    before.push_back(live_groups(engine));
    carry_out(engine, all_operations ? random.next(engine.structure()) : session.next());
  }
  while (engine.undoable() >= static_cast<std::uint64_t>(at_once)) {
    CAPTURE(engine.undoable());
    REQUIRE(engine.undo(static_cast<std::uint64_t>(at_once)).has_value());
    REQUIRE(live_groups(engine) == before[engine.undoable()]);
    REQUIRE(engine.first_defect().value_or("") == "");
    if (engine.undoable() == 30 && !all_operations) {  // and on from there again
      GraphSession other(seed, 8, false);
      for (int k = 0; k < 40; ++k) {
        const ops::Operation op = other.next();
        if (k >= 30) {
          carry_out(engine, op);
        }
      }
      REQUIRE(engine.first_defect().value_or("") == "");
      REQUIRE(engine.undo(engine.undoable() - 30).has_value());
      REQUIRE(live_groups(engine) == before[30]);
    }
  }
}

TEST_CASE("a long session is taken back past many notes of its cells, with a limit on undo too",
          "[engine][rebase][undo]") {
  const std::string ring = GENERATE("Z", "Z/2");
  const std::uint64_t undoable = GENERATE(500U, UINT32_MAX);
  const std::uint64_t at_once = GENERATE(1U, 9U);
  CAPTURE(ring, undoable, at_once);
  Engine engine(ring_named(ring), {}, forgetful, {undoable});
  GraphSession session(3, 4, true);  // so small that cells are noted after a hundred steps
  std::vector<std::vector<AbelianGroup>> before;
  for (int k = 0; k < 1500; ++k) {
    const ops::Operation op = session.next();
    if (const auto* undo = std::get_if<ops::Undo>(&op)) {
      before.resize(before.size() - undo->steps);
    } else {
      before.push_back(live_groups(engine));
    }
    carry_out(engine, op);
    check_graph(engine, session.betti());
  }
  CHECK(engine.undoable() == std::min<std::uint64_t>(undoable, before.size()));
  for (; engine.undoable() >= at_once; before.resize(before.size() - at_once)) {
    CAPTURE(engine.undoable());
    REQUIRE(engine.undo(at_once).has_value());
    REQUIRE(live_groups(engine) == before[before.size() - at_once]);
    if (engine.undoable() % 20 == 0) {
      REQUIRE(engine.first_defect().value_or("") == "");
    }
  }
  CHECK(engine.undoable() < at_once);
}

TEST_CASE("steps taken back and taken again give the same bytes, rebases or not", "[engine][rebase][undo]") {
  Engine engine;
  GraphSession session(9, 12, false);
  std::vector<ops::Operation> steps;
  for (int k = 0; k < 400; ++k) {
    steps.push_back(session.next());
    carry_out(engine, steps.back());
  }
  const std::string after = answers(engine);
  for (const std::uint64_t back : {1U, 7U, 60U, 388U}) {
    CAPTURE(back);
    REQUIRE(engine.undo(back).has_value());
    for (std::size_t k = steps.size() - back; k < steps.size(); ++k) {
      carry_out(engine, steps[k]);
    }
    REQUIRE(answers(engine) == after);
  }
}

TEST_CASE("what a step of editing costs does not grow with the history", "[engine][rebase][cost]") {
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(ring);
  Engine engine(ring_named(ring));
  GraphSession session(11, 40, false);
  const auto work_of = [&](int steps) {
    const std::uint64_t before = total(engine.work());
    for (int k = 0; k < steps; ++k) {
      carry_out(engine, session.next());
    }
    return total(engine.work()) - before;
  };
  (void)work_of(1000);
  const std::uint64_t early = work_of(1000);
  (void)work_of(6000);
  const std::uint64_t late = work_of(1000);
  CHECK(late < 2 * early);
}

TEST_CASE("a step says when the equivalence was begun afresh, and without splits it never is", "[engine][rebase]") {
  Engine engine({}, {}, after_each_split);
  CHECK_FALSE(carry_out(engine, R"({"op":"simplex","name":"t","dim":2})").rebased);
  CHECK_FALSE(carry_out(engine, R"({"op":"identify","pairs":[["t.0","t.1"],["t.1","t.2"]]})").rebased);
  CHECK(engine.rebases() == 0);
  CHECK(carry_out(engine, R"({"op":"deidentify","split":[{"cell":"t.0","as":"x","moves":[["t.0-1",1],["t.0-2",1]]}]})")
            .rebased);
  CHECK(engine.rebases() == 1);
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(1), group(1)});
  REQUIRE(engine.undo().has_value());
  CHECK(engine.rebases() == 0);
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(1), group(2)});
}
