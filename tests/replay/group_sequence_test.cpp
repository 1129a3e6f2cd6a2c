#include "replay/tower/group_sequence.hpp"

#include <sstream>
#include <utility>

#include "engine/group_tracker.hpp"
#include "replay/tower/tower_replay.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/engine_tower.hpp"
#include "tests/support/random_towers.hpp"

using namespace sesame;
using replay::GroupSequence;

namespace {

engine::Homology points(std::int64_t number) { return {{number}, {{}}, {}, {}}; }

/// Of so many points at those times.
void add(GroupSequence& groups, const std::vector<std::pair<double, std::int64_t>>& states) {
  for (const auto& [time, number] : states) {
    groups.add(time, points(number), sparse::Integers{});
  }
  groups.finish();
}

std::string json(const std::vector<std::pair<double, std::int64_t>>& states) {
  GroupSequence groups(nullptr);
  add(groups, states);
  std::ostringstream out;
  {
    replay::TextBuffer text(out);
    groups.add_json(text);
  }
  return out.str();
}

}  // namespace

TEST_CASE("of operations at one time only the last counts", "[replay]") {
  CHECK(json({{0, 1}, {0, 2}, {0.5, 3}, {0.5, 2}, {1, 1}}) ==
        R"([[0,[{"rank":2,"torsion":[]}]],[1,[{"rank":1,"torsion":[]}]]])");
}

TEST_CASE("groups that do not change are written once, as lines too", "[replay]") {
  std::ostringstream lines;
  GroupSequence groups(&lines);
  add(groups, {{0, 1}, {1, 1}, {2, 2}, {2, 1}, {3, 4}, {3, 5}});
  CHECK(lines.str() == "         0  H0 = Z\n         3  H0 = Z^5\n");
}

TEST_CASE("a sequence without operations is empty", "[replay]") { CHECK(json({}) == "[]"); }

TEST_CASE("over Z what is wrong with an operation is said as over a field, and changes nothing", "[replay][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 8u));
  CAPTURE(seed);
  using Kind = replay::TowerOperation::Kind;
  tests::EngineTower over_z(sparse::Integers{});
  replay::TowerReplay over_a_field({});
  std::mt19937 random(seed);
  const auto operation_of = [](const tests::TowerStep& step) {
    return replay::TowerOperation{step.is_contraction ? Kind::contract : Kind::insert, 0.0,
                                  static_cast<int>(step.labels.size()) - 1, step.labels};
  };
  for (const tests::TowerStep& step : tests::random_tower(seed, 60, 8, 1 + seed % 4)) {
    for (int trial = 0; trial < 5; ++trial) {
      tests::TowerStep wrong{random() % 4 == 0, {random() % 9, random() % 9}};
      if (!wrong.is_contraction && random() % 2 == 0) {
        wrong.labels.push_back(wrong.labels[0]);
      }
      const Status refused = wrong.is_contraction
                                 ? over_a_field.rules().check_contraction(wrong.labels[0], wrong.labels[1])
                                 : over_a_field.rules().check_inclusion(wrong.labels);
      if (!refused) {
        const std::size_t done = over_z.engine().log().size();
        CHECK(over_a_field.apply(operation_of(wrong)).error().what == refused.error().what);
        CHECK(over_z.apply(operation_of(wrong)).error().what == refused.error().what);
        CHECK(over_z.engine().log().size() == done);
      }
    }
    REQUIRE(over_z.apply(operation_of(step)));
    REQUIRE(over_a_field.apply(operation_of(step)));
    REQUIRE(std::ranges::equal(over_z.engine().cells(), over_a_field.cells()));
  }
}

TEST_CASE("a tracker of groups and an engine agree along random towers", "[replay][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 12u));
  CAPTURE(seed);
  using Kind = replay::TowerOperation::Kind;
  engine::GroupTracker tracker;
  replay::TowerReplay fast({&tracker});
  tests::EngineTower slow(sparse::Integers{});
  for (const tests::TowerStep& step : tests::random_tower(seed, 400, 12, seed % 5)) {
    const replay::TowerOperation operation{step.is_contraction ? Kind::contract : Kind::insert, 0.0,
                                           static_cast<int>(step.labels.size()) - 1, step.labels};
    REQUIRE(fast.apply(operation));
    REQUIRE(slow.apply(operation));
    const engine::Homology expected = slow.engine().homology();
    const engine::Homology& found = tracker.homology(fast.cells().size());
    REQUIRE(found.betti == expected.betti);
    REQUIRE(found.torsion == expected.torsion);
  }
}

TEST_CASE("torsion that stays, goes and comes back is written when it changes", "[replay]") {
  GroupSequence groups(nullptr);
  const auto add = [&](double time, std::vector<std::int64_t> betti,
                       std::vector<std::vector<sparse::Integer>> torsion) {
    groups.add(time, {std::move(betti), std::move(torsion), {}, {}}, sparse::Integers{});
  };
  add(0, {1, 0}, {{}, {}});
  add(1, {1, 0, 0}, {{}, {2}, {}});
  add(2, {2, 0, 0}, {{}, {2}, {}});
  add(3, {2, 0, 0, 0}, {{}, {2}, {}, {}});
  add(4, {2, 0, 0}, {{}, {2, 4}, {}});
  add(5, {2, 0}, {{}, {}});
  groups.finish();
  std::ostringstream out;
  {
    replay::TextBuffer text(out);
    groups.add_json(text);
  }
  CHECK(out.str() == R"([[0,[{"rank":1,"torsion":[]}]],[1,[{"rank":1,"torsion":[]},{"rank":0,"torsion":[2]}]],)"
                     R"([2,[{"rank":2,"torsion":[]},{"rank":0,"torsion":[2]}]],)"
                     R"([4,[{"rank":2,"torsion":[]},{"rank":0,"torsion":[2,4]}]],[5,[{"rank":2,"torsion":[]}]]])");
}
