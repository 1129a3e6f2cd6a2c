#include "ops/cells/split_history.hpp"

#include <map>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"

using namespace sesame;
using ops::CellId;
using ops::SplitHistory;

TEST_CASE("faces that move and copies are what plain lists say, through undo", "[ops]") {
  std::mt19937 random(GENERATE(range(0U, 8U)));
  const auto draw = [&](unsigned below) { return static_cast<std::uint32_t>(random() % below); };
  struct Faces {
    std::vector<CellId> faces;
    std::vector<ops::OrderId> orders;
  };
  const auto as_created = [](CellId cell) {
    return Faces{{cell + 100, cell + 200, cell + 300}, {ops::same_order, ops::same_order, 1}};
  };
  SplitHistory splits;
  std::vector<SplitHistory::MadeMove> moves;
  std::vector<CellId> before;  // per move
  std::vector<SplitHistory::Copy> copies;
  const auto faces_of = [&](CellId cell) {
    Faces faces = as_created(cell);
    for (const SplitHistory::MadeMove& made : moves) {
      if (made.cell == cell) {
        faces.faces[made.slot] = made.after;
        faces.orders[made.slot] = made.order_after;
      }
    }
    return faces;
  };
  for (int step = 0; step < 300; ++step) {
    const std::uint32_t what = draw(6);
    if (what < 3) {
      const ops::Move move{CellId{draw(6)}, draw(3), CellId{1000 + draw(4)}, ops::OrderId{draw(3)}};
      const Faces created = as_created(move.cell);
      before.push_back(faces_of(move.cell).faces[move.slot]);
      const ops::LinkId links{static_cast<unsigned>(step)};
      splits.add_move(move, links, created.faces, [&](std::uint32_t k) { return created.orders[k]; });
      moves.push_back({move.cell, move.slot, move.to, links, move.order});
    } else if (what == 3 && !moves.empty()) {
      splits.undo_last_move();
      moves.pop_back();
      before.pop_back();
    } else if (what == 4) {
      const SplitHistory::Copy copy{
          static_cast<CellId>(2000 + copies.size()), CellId{draw(5)}, {CellId{static_cast<unsigned>(step)}}};
      splits.add_copy(copy);
      copies.push_back(copy);
    } else if (what == 5 && !copies.empty()) {
      splits.undo_last_copy();
      copies.pop_back();
    }
    REQUIRE(splits.moves() == moves.size());
    for (std::uint32_t number = 0; number < moves.size(); ++number) {
      REQUIRE(splits.face_before(number) == before[number]);
      REQUIRE(splits.move(number).cell == moves[number].cell);
      REQUIRE(splits.move(number).slot == moves[number].slot);
      REQUIRE(splits.move(number).order_after == moves[number].order_after);
    }
    REQUIRE(splits.copies() == copies.size());
    for (CellId cell = 0; cell < 6; ++cell) {
      const auto moved = splits.moved_faces(cell);
      const bool has_moved = std::any_of(moves.begin(), moves.end(),
                                         [&](const SplitHistory::MadeMove& made) { return made.cell == cell; });
      REQUIRE(moved.has_value() == has_moved);
      if (has_moved) {
        REQUIRE(std::equal(moved->faces.begin(), moved->faces.end(), faces_of(cell).faces.begin()));
        REQUIRE(std::equal(moved->orders.begin(), moved->orders.end(), faces_of(cell).orders.begin()));
      }
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto first = draw(static_cast<unsigned>(moves.size()) + 1);
        const auto last = draw(static_cast<unsigned>(moves.size()) + 1);
        std::vector<CellId> seen, expected;
        const SplitHistory::MadeMove* last_expected = nullptr;
        splits.for_each_move_of(cell, k, first, last,
                                [&](const SplitHistory::MadeMove& made) { seen.push_back(made.after); });
        for (std::size_t m = 0; m < last; ++m) {
          if (moves[m].cell == cell && moves[m].slot == k) {
            last_expected = &moves[m];
            if (m >= first) {
              expected.push_back(moves[m].after);
            }
          }
        }
        REQUIRE(seen == expected);
        const auto last_move = splits.last_move_of(cell, k, last);
        REQUIRE(last_move.has_value() == (last_expected != nullptr));
        if (last_move) {
          REQUIRE(last_move->after == last_expected->after);
          REQUIRE(last_move->links == last_expected->links);
        }
      }
    }
    for (CellId node = 1000; node < 1004; ++node) {
      const auto since = draw(static_cast<unsigned>(moves.size()) + 1);
      std::vector<ops::LinkId> seen, expected;
      for (std::uint32_t m = static_cast<std::uint32_t>(moves.size()); m-- > since;) {
        if (moves[m].after == node) {
          expected.push_back(moves[m].links);
        }
      }
      splits.for_each_move_onto(node, since, [&](const SplitHistory::MadeMove& made) { seen.push_back(made.links); });
      REQUIRE(seen == expected);
    }
    for (CellId source = 0; source < 5; ++source) {
      const auto since = draw(static_cast<unsigned>(copies.size()) + 1);
      std::vector<CellId> seen, expected;
      for (std::size_t k = copies.size(); k-- > since;) {
        if (copies[k].source == source) {
          expected.push_back(copies[k].copy);
        }
      }
      splits.for_each_copy_of(source, since, [&](CellId copy) { seen.push_back(copy); });
      REQUIRE(seen == expected);
    }
    for (CellId c = 2000; c < 2010; ++c) {
      const SplitHistory::Copy* copy = splits.copy(c);
      REQUIRE((copy != nullptr) == (c - 2000 < copies.size()));
      if (copy != nullptr) {
        REQUIRE(copy->moment == copies[c - 2000].moment);
      }
    }
  }
}
