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
  std::vector<CellId> node;  ///< by age, those that steps made and those that were asked for
  std::vector<CellId> cell;  ///< per node: the current cell, or none
  std::vector<int> sign;
};

void check(const Forest& forest, const std::vector<Picture>& after) {
  const Picture& now = after.back();
  for (std::size_t k = 0; k < now.node.size(); ++k) {
    const CellId c = now.node[k];
    REQUIRE(forest.find(c) == now.cell[k]);
    REQUIRE(forest.is_current(c) == (now.cell[k] == c));
    for (LinkId links = 0; links < after.size(); ++links) {
      if (k < after[links].cell.size()) {
        const ops::OrientedCell was = forest.find_oriented_at(c, links);
        REQUIRE(was.cell == after[links].cell[k]);
        REQUIRE((was.cell == none || was.sign == after[links].sign[k]));
      }
    }
    if (now.cell[k] == c) {
      std::set<CellId> members;
      forest.for_each_member(c, [&](CellId node) { REQUIRE(members.insert(node).second); });
      std::vector<CellId> wanted;
      for (std::size_t j = 0; j < now.node.size(); ++j) {
        if (now.cell[j] == c) {
          wanted.push_back(now.node[j]);
        }
      }
      REQUIRE(members == std::set<CellId>(wanted.begin(), wanted.end()));
      REQUIRE(forest.members(c) == wanted.size());
      REQUIRE(forest.oldest(c) == wanted.front());
      for (LinkId links = 0; links < after.size(); ++links) {
        const auto& cells = after[links].cell;
        if (k < cells.size() && cells[k] == c) {
          const auto first = std::find(cells.begin(), cells.end(), c) - cells.begin();
          REQUIRE(forest.oldest_at(c, links) == now.node[static_cast<std::size_t>(first)]);
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
    Picture& now = after.back();
    for (std::size_t k = 0; k < now.node.size(); ++k) {
      if (now.cell[k] == now.node[k]) {
        current.push_back(now.node[k]);
      }
    }
    const CellId what = draw(7);
    if (what < 3) {
      const auto asked = static_cast<std::size_t>(std::count_if(now.node.begin(), now.node.end(), ops::is_asked_for));
      const CellId node = draw(3) == 0 ? ops::asked_node(static_cast<std::uint32_t>(asked))
                                       : static_cast<CellId>(now.node.size() - asked);
      forest.add(node);
      now.node.push_back(node);
      now.cell.push_back(node);
      now.sign.push_back(1);
      adds.push_back(true);
    } else if (what < 6 && current.size() > 1) {
      std::shuffle(current.begin(), current.end(), random);
      const int sign = draw(2) == 0 ? 1 : -1;
      Picture next = now;
      const bool squashes = draw(5) == 0;
      for (std::size_t k = 0; k < next.cell.size(); ++k) {
        if (next.cell[k] == current[0]) {
          next.cell[k] = squashes ? CellId{none} : current[1];
          next.sign[k] *= sign;
        }
      }
      const auto age = [&](CellId node) { return std::find(now.node.begin(), now.node.end(), node); };
      forest.begin_step();
      if (squashes) {
        forest.link_squashed(current[0], {current[1], 0, 1});
        REQUIRE(forest.squashed(current[0]).cell == current[1]);
        REQUIRE(forest.squashed_onto(current[1]).back() == current[0]);
      } else {
        forest.link(current[0], current[1], sign < 0 ? ops::OrderId{1} : ops::same_order, sign,
                    *std::min(age(forest.oldest(current[0])), age(forest.oldest(current[1]))));
      }
      REQUIRE(forest.removed(forest.links() - 1) == current[0]);
      REQUIRE(forest.link_of(current[0]) == forest.links() - 1);
      after.push_back(std::move(next));
      adds.push_back(false);
    } else if (!adds.empty()) {
      if (adds.back()) {
        forest.pop_back(now.node.back());
        now.node.pop_back();
        now.cell.pop_back();
        now.sign.pop_back();
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
  for (CellId node = 0; node < 5; ++node) {
    forest.add(node);
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
  const CellId degenerate = ops::asked_node(0);
  forest.add(0);
  forest.add(degenerate);
  forest.squash(degenerate, {0, 0, 1});
  CHECK(forest.find(degenerate) == none);
  CHECK(forest.find_at(degenerate, 0) == none);
  CHECK(forest.last_root(degenerate) == degenerate);
  CHECK(forest.link_of(degenerate) == none);
  forest.unsquash(degenerate);
  CHECK(forest.find(degenerate) == degenerate);
}
