// Views: what an engine was at one moment, asked from other threads while it goes on.
#include "engine/view.hpp"

#include <condition_variable>
#include <deque>
#include <thread>

#include "sparse/contract.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;
using Catch::Contains;
using engine::View;

namespace {

using ViewPointer = std::shared_ptr<const View>;

ViewPointer view_of(const Engine& engine) {
  const auto view = View::of(engine);
  if (!view) {
    FAIL(view.error().what);
  }
  return *view;
}

/// What no choice of representatives changes, of an engine or a view.
template <class Asked>
std::string invariants(Asked& asked) {
  std::string text;
  const engine::Homology homology = asked.homology();
  for (std::size_t p = 0; p < homology.betti.size(); ++p) {
    text += "H" + std::to_string(p) + " " + std::to_string(homology.betti[p]);
    for (const Integer& t : homology.torsion[p]) {
      text += " " + t.to_string();
    }
    const auto generators = asked.generators(static_cast<int>(p));
    text += " of " + std::to_string(generators.size()) + ":";
    for (const engine::Generator& generator : generators) {
      const ClassAnswer answer = asked.classify(generator.cycle);
      text += " " + generator.order.to_string() + (answer.is_cycle && !answer.is_zero ? "" : "!");
    }
    text += "\n";
  }
  return text;
}

/// An undo now and then.
ops::Operation next_step(RandomSteps& steps, const Engine& engine) {
  if (engine.undoable() > 0 && steps.random().one_in(9)) {
    return ops::Undo{static_cast<std::uint64_t>(
        steps.random().in(1, static_cast<int>(std::min<std::uint64_t>(engine.undoable(), 4))))};
  }
  return steps.next(engine.structure());
}

const std::vector<std::string> mobius_band{R"({"op":"simploid","name":"q","type":[1,1]})",
                                           R"({"op":"identify","pairs":[["q.0-1x0","q.0-1x1",[1,0]]]})",
                                           R"({"op":"note","text":"as it is"})"};

}  // namespace

TEST_CASE("a view answers as its engine did then, whatever happened since", "[engine][view]") {
  const std::string ring = GENERATE("Z", "Q", "Z/2", "Z/3");
  const unsigned seed = GENERATE(1U, 2U, 3U, 4U);
  CAPTURE(ring, seed);
  struct Moment {
    ViewPointer view;
    std::string invariants;
    std::vector<std::vector<std::pair<Integer, std::string>>> cycles;  ///< by names, with whole coefficients
    std::vector<std::uint64_t> cells;
    std::string names;
  };
  std::vector<Moment> moments;
  const auto names_in = [](const ops::Structure& structure) {
    std::string names;
    for (const ops::CellId c : current_cells(structure)) {
      names += std::string{structure.name(c)} + " ";
    }
    return names;
  };
  {
    Engine engine(ring_named(ring));
    RandomSteps steps(seed, everything_and_maps(60));
    for (int k = 0; k < 120; ++k) {
      carry_out(engine, next_step(steps, engine));
      if (k % 10 == 0) {
        Moment moment{view_of(engine), invariants(engine), {}, {}, names_in(engine.structure())};
        moment.cells.assign(engine.cells().begin(), engine.cells().end());
        for (int p = 0; p < static_cast<int>(engine.cells().size()); ++p) {
          for (const engine::Generator& generator : engine.generators(p)) {
            sparse::Integer denominator = 1;
            for (const auto& term : generator.cycle.terms) {
              denominator *= term.coefficient.denominator();
            }
            auto& cycle = moment.cycles.emplace_back();
            for (const auto& [coefficient, cell] : generator.cycle.terms) {
              cycle.emplace_back((coefficient * denominator).numerator(), engine.structure().name(cell));
            }
          }
        }
        CHECK(moment.view->steps() == engine.log().size());
        moments.push_back(std::move(moment));
      }
    }
  }
  for (const Moment& moment : moments) {
    CHECK(moment.view->cells() == moment.cells);
    CHECK(invariants(*moment.view) == moment.invariants);
    CHECK(moment.view->first_defect() == std::nullopt);
    for (const auto& cycle : moment.cycles) {
      const auto chain = moment.view->chain(cycle);
      REQUIRE(chain);
      const ClassAnswer answer = moment.view->classify(*chain);
      CHECK(answer.is_cycle);
      CHECK_FALSE(answer.is_zero);
    }
    std::string names;
    moment.view->look_at_cells([&](const ops::Structure& structure) { names = names_in(structure); });
    CHECK(names == moment.names);
  }
}

TEST_CASE("threads ask views, the same ones and different ones, while the engine takes steps", "[engine][view]") {
  struct Asked {
    ViewPointer view;
    std::string right, found[3];
  };
  std::deque<Asked> all;  // whose elements stay where they are
  std::mutex mutex;
  std::condition_variable more;
  bool has_ended = false;
  // Each of them asks every view. What they find is looked at in the end, by one thread.
  std::vector<std::thread> askers;
  for (std::size_t asker = 0; asker < 3; ++asker) {
    askers.emplace_back([&, asker] {
      for (std::size_t next = 0;; ++next) {
        Asked* asked = nullptr;
        {
          std::unique_lock lock(mutex);
          more.wait(lock, [&] { return has_ended || next < all.size(); });
          if (next == all.size()) {
            return;
          }
          asked = &all[next];
        }
        asked->found[asker] = invariants(*asked->view) + asked->view->first_defect().value_or("");
      }
    });
  }
  {
    Engine engine;
    RandomSteps steps(5, everything_and_maps(50));
    for (int k = 0; k < 150; ++k) {
      carry_out(engine, next_step(steps, engine));
      if (k % 5 == 0) {
        Asked asked{view_of(engine), invariants(engine), {}};
        const std::lock_guard lock(mutex);
        all.push_back(std::move(asked));
        more.notify_all();
      }
    }
  }
  {
    const std::lock_guard lock(mutex);
    has_ended = true;
  }
  more.notify_all();
  for (std::thread& asker : askers) {
    asker.join();
  }
  REQUIRE(all.size() == 30);
  for (const Asked& asked : all) {
    for (const std::string& found : asked.found) {
      CHECK(found == asked.right);
    }
  }
}

TEST_CASE("engines of different threads do not meet", "[engine][view]") {
  std::string found[2];
  const auto work = [](unsigned seed) {
    Engine engine(ring_named(seed % 2 == 0 ? "Z" : "Z/3"));
    RandomSteps steps(seed, everything_and_maps(50));
    std::string text;
    for (int k = 0; k < 60; ++k) {
      if (engine.apply(next_step(steps, engine))) {
        text += invariants(engine);
      }
    }
    return text;
  };
  std::thread one([&] { found[0] = work(8); });
  std::thread other([&] { found[1] = work(9); });
  one.join();
  other.join();
  CHECK(found[0] == work(8));
  CHECK(found[1] == work(9));
}

TEST_CASE("a view of lazy cells does the steps again, which have to be there", "[engine][view]") {
  std::vector<std::string> lines{R"({"op":"simplex","name":"a","dim":11})", R"({"op":"simplex","name":"b","dim":11})",
                                 R"({"op":"product","name":"P","left":"a","right":"b"})"};
  Engine engine;
  build(engine, lines);
  const ViewPointer view = view_of(engine);
  CHECK(view->cells().size() == 23);
  CHECK(view->homology().betti == engine.homology().betti);

  Engine forgetful(sparse::Integers{}, {}, {}, engine::HistoryPolicy{1000, false});
  build(forgetful, lines);
  const auto refused = View::of(forgetful);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Errc::refused);
  CHECK_THAT(refused.error().what, Contains("not written out"));
}

TEST_CASE("a view is not asked from within its own answer, and goes on after an exception", "[engine][view]") {
  Engine engine;
  build(engine, mobius_band);
  const ViewPointer view = view_of(engine);
  const auto again = [&](const ops::Structure&) { (void)view->homology(); };
  CHECK_THROWS_AS(view->look_at_cells(again), sparse::ContractViolation);
  CHECK(view->homology().betti == std::vector<std::int64_t>{1, 1, 0});
  int visited = 0;
  view->visit_generators(1, UINT64_MAX, [&](const engine::Generator&) {
    ++visited;
    return true;
  });
  CHECK(visited == 1);
  CHECK(view->chain({{1, "q.0x0"}}).has_value());
  CHECK_FALSE(view->chain({{1, "nobody"}}).has_value());
}
