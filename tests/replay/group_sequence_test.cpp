#include "replay/tower/group_sequence.hpp"

#include <sstream>

#include "tests/support/catch.hpp"

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
