#include "ops/cells/forest.hpp"

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "tests/support/catch.hpp"

using namespace sesame;
using ops::CellId;
using ops::Forest;
using ops::LinkId;
using ops::none;

namespace {

/// What each node is, by plain lists: the history of a forest as one picture after each removal.
struct Picture {
  std::vector<CellId> cell;  ///< per node: the current cell, or none
  std::vector<int> sign;
};

void check(const Forest& forest, const std::vector<Picture>& after) {
  const Picture& now = after.back();
  const auto nodes = static_cast<CellId>(now.cell.size());
  for (CellId c = 0; c < nodes; ++c) {
    REQUIRE(forest.find(c) == now.cell[c]);
    REQUIRE(forest.is_current(c) == (now.cell[c] == c));
    for (LinkId links = 0; links < after.size(); ++links) {
      if (c < after[links].cell.size()) {
        const ops::OrientedCell was = forest.find_oriented_at(c, links);
        REQUIRE(was.cell == after[links].cell[c]);
        REQUIRE((was.cell == none || was.sign == after[links].sign[c]));
      }
    }
    if (now.cell[c] == c) {
      std::vector<CellId> members;
      forest.for_each_member(c, [&](CellId node) { members.push_back(node); });
      std::sort(members.begin(), members.end());
      std::vector<CellId> wanted;
      for (CellId node = 0; node < nodes; ++node) {
        if (now.cell[node] == c) {
          wanted.push_back(node);
        }
      }
      REQUIRE(members == wanted);
      REQUIRE(forest.members(c) == wanted.size());
      REQUIRE(forest.oldest(c) == wanted.front());
      for (LinkId links = 0; links < after.size(); ++links) {
        const auto& cells = after[links].cell;
        if (c < cells.size() && cells[c] == c) {
          const auto first = std::find(cells.begin(), cells.end(), c) - cells.begin();
          REQUIRE(forest.oldest_at(c, links) == static_cast<CellId>(first));
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("what nodes are and were is what plain lists say, with signs, through undo", "[ops]") {
  std::mt19937 random(GENERATE(range(0U, 12U)));
  const auto draw = [&](std::size_t below) { return static_cast<CellId>(random() % below); };
  Forest forest;
  std::vector<Picture> after{{}};  // after each removal: the nodes that there were then
  std::vector<bool> adds;          // what happened, in order: nodes added, else removals
  for (int step = 0; step < 250; ++step) {
    std::vector<CellId> current;
    for (CellId c = 0; c < after.back().cell.size(); ++c) {
      if (after.back().cell[c] == c) {
        current.push_back(c);
      }
    }
    const CellId what = draw(7);
    if (what < 3) {
      forest.add();
      after.back().cell.push_back(static_cast<CellId>(after.back().cell.size()));
      after.back().sign.push_back(1);
      adds.push_back(true);
    } else if (what < 6 && current.size() > 1) {
      std::shuffle(current.begin(), current.end(), random);
      const int sign = draw(2) == 0 ? 1 : -1;
      Picture next = after.back();
      const bool squashes = draw(5) == 0;
      for (CellId c = 0; c < next.cell.size(); ++c) {
        if (next.cell[c] == current[0]) {
          next.cell[c] = squashes ? none : current[1];
          next.sign[c] *= sign;
        }
      }
      forest.begin_step();
      if (squashes) {
        forest.link_squashed(current[0], {current[1], 0, 1});
        REQUIRE(forest.squashed(current[0]).cell == current[1]);
        REQUIRE(forest.squashed_onto(current[1]).back() == current[0]);
      } else {
        forest.link(current[0], current[1], sign < 0 ? ops::OrderId{1} : ops::same_order, sign,
                    std::min(forest.oldest(current[0]), forest.oldest(current[1])));
      }
      REQUIRE(forest.removed(forest.links() - 1) == current[0]);
      REQUIRE(forest.link_of(current[0]) == forest.links() - 1);
      after.push_back(std::move(next));
      adds.push_back(false);
    } else if (!adds.empty()) {
      if (adds.back()) {
        forest.pop_back();
        after.back().cell.pop_back();
        after.back().sign.pop_back();
      } else {
        const CellId removed = forest.removed(forest.links() - 1);
        REQUIRE(forest.undo_last_link() == removed);
        after.pop_back();
      }
      adds.pop_back();
    }
    REQUIRE(forest.links() == after.size() - 1);
    check(forest, after);
  }
}

TEST_CASE("a removal knows how many there were before its step", "[ops]") {
  Forest forest;
  for (int k = 0; k < 5; ++k) {
    forest.add();
  }
  forest.begin_step();
  forest.link(1, 0, ops::same_order, 1, 0);
  forest.link(2, 0, ops::same_order, 1, 0);
  forest.begin_step();
  forest.link(3, 0, ops::same_order, 1, 0);
  CHECK(forest.links_before_step(0) == 0);
  CHECK(forest.links_before_step(1) == 0);
  CHECK(forest.links_before_step(2) == 2);
  forest.undo_last_link();
  forest.begin_step();
  forest.link(4, 0, ops::same_order, 1, 0);
  CHECK(forest.links_before_step(2) == 2);
}

TEST_CASE("a node degenerate from the start is no cell at any moment", "[ops]") {
  Forest forest;
  forest.add();
  forest.add();
  forest.squash(1, {0, 0, 1});
  CHECK(forest.find(1) == none);
  CHECK(forest.find_at(1, 0) == none);
  CHECK(forest.last_root(1) == 1);
  CHECK(forest.link_of(1) == none);
  forest.unsquash(1);
  CHECK(forest.find(1) == 1);
}
