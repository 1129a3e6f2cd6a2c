#include "engine/left/window.hpp"

#include <map>
#include <set>

#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::Window;
using ops::CellId;

namespace {

using SignedNodes = std::vector<std::pair<CellId, int>>;

SignedNodes first_faces(const Window& window, CellId c) {
  SignedNodes faces;
  window.for_each_first_face(c, [&](CellId face, int sign) { faces.emplace_back(face, sign); });
  return faces;
}

/// What the faces of a cell are now, as the window's history of them ends.
SignedNodes last_faces(const Window& window, CellId c) {
  const ops::Structure& structure = window.structure();
  SignedNodes faces;
  for (std::uint32_t k = 0; k < structure.faces().of(c).size(); ++k) {
    if (const CellId node = window.known(structure.faces().of(c)[k]); node != ops::none) {
      faces.emplace_back(node, 0);
    }
  }
  return faces;
}

std::vector<CellId> by_dimension(const ops::Structure& structure) {
  std::vector<CellId> cells = current_cells(structure);
  std::stable_sort(cells.begin(), cells.end(),
                   [&](CellId a, CellId b) { return structure.dimension(a) < structure.dimension(b); });
  return cells;
}

}  // namespace

TEST_CASE("a window of all of a history knows all cells as they were made", "[engine][left]") {
  Workshop shop;
  const Window window(shop.structure());
  shop.build({R"({"op": "simplex", "name": "t", "dim": 2})", R"({"op": "identify", "pairs": [["t.0", "t.1"]]})"});
  CHECK(window.cells().empty());
  CHECK(!window.has_splits());
  CHECK(window.families() == 0);
  const ops::Structure& structure = shop.structure();
  for (CellId c = 0; c < structure.cells().size(); ++c) {
    CHECK(!window.is_first(c));
    CHECK(window.known(c) == c);
    const auto faces = structure.cells().faces(c);
    SignedNodes expected;
    for (std::uint32_t k = 0; k < faces.size(); ++k) {
      expected.emplace_back(faces[k], structure.faces().sign_as_created(c, k));
    }
    CHECK(first_faces(window, c) == expected);
  }
}

TEST_CASE("a window that begins now has the object of now as its first cells", "[engine][left]") {
  Workshop shop;
  RandomSteps steps(GENERATE(range(0U, 6U)), {.most_cells = 30, .degeneracies = true, .splits = true});
  for (int step = 0; step < 20; ++step) {
    REQUIRE(shop.apply(steps.next(shop.structure())));
  }
  const ops::Structure& structure = shop.structure();
  const std::vector<CellId> cells = by_dimension(structure);
  std::map<CellId, SignedNodes> at_the_beginning;
  for (const CellId c : cells) {
    for (std::uint32_t k = 0; k < structure.faces().of(c).size(); ++k) {
      const auto [face, sign] = structure.forest().find_oriented(structure.faces().of(c)[k]);
      if (face != ops::none) {
        at_the_beginning[c].emplace_back(face, sign * structure.faces().sign(c, k));
      }
    }
  }
  const CellId created = structure.cells().size();
  std::vector<CellId> was(created);
  for (CellId node = 0; node < created; ++node) {
    was[node] = structure.find(node);
  }
  const Window window(structure, cells);
  const std::uint32_t copies_before = structure.splits().copies();
  for (int step = 0; step < 20; ++step) {
    REQUIRE(window.cells() == cells);
    for (std::uint32_t k = 0; k < cells.size(); ++k) {  // whatever has happened since
      REQUIRE(window.place(cells[k]) == k);
      REQUIRE(first_faces(window, cells[k]) == at_the_beginning[cells[k]]);
    }
    for (CellId node = 0; node < structure.cells().size(); ++node) {
      REQUIRE(window.is_first(node) == (node < created));
      REQUIRE(window.known(node) == (node < created ? was[node] : node));
      REQUIRE((window.copy(node) != nullptr) == (node >= created && structure.splits().copy(node) != nullptr));
    }
    REQUIRE(window.copies() == structure.splits().copies() - copies_before);
    REQUIRE(shop.apply(steps.next(structure)));
  }
}

TEST_CASE("a window finds members, copies and places of a node as a look at everything does", "[engine][left]") {
  const bool begins_late = GENERATE(false, true);
  const auto seed = GENERATE(range(0U, 4U));
  Workshop shop;
  RandomSteps steps(seed, {.most_cells = 30, .degeneracies = true, .splits = true});
  for (int step = 0; begins_late && step < 15; ++step) {
    REQUIRE(shop.apply(steps.next(shop.structure())));
  }
  const ops::Structure& structure = shop.structure();
  const Window window = begins_late ? Window{structure, by_dimension(structure)} : Window{structure};
  for (int step = 0; step < 25; ++step) {
    REQUIRE(shop.apply(steps.next(structure)));
  }
  std::vector<CellId> nodes = window.cells();
  for (CellId node = window.begin().created; node < structure.cells().size(); ++node) {
    nodes.push_back(node);
  }
  std::map<CellId, std::set<CellId>> members, copies;
  std::map<CellId, std::multiset<std::pair<CellId, std::uint32_t>>> places;
  for (const CellId node : nodes) {
    if (const CellId now = structure.find(node); now != ops::none) {
      members[now].insert(node);
    }
    if (const auto* copy = window.copy(node)) {
      copies[window.known(copy->source)].insert(node);
    }
    for (std::uint32_t k = 0; !is_born_degenerate(structure, node) && k < structure.cells().type(node).faces.size();
         ++k) {
      const bool is_first = window.is_first(node);
      const CellId face =
          is_first ? structure.faces().at(node, k, window.begin()).cell : structure.cells().faces(node)[k];
      if (face != ops::none) {
        places[face].emplace(node, k);
      }
    }
  }
  for (std::uint32_t m = window.begin().moves; m < structure.splits().moves(); ++m) {
    const ops::SplitHistory::MadeMove move = structure.splits().move(m);
    places[move.after].emplace(move.cell, move.slot);
  }
  for (const CellId node : nodes) {
    if (structure.is_current(node)) {
      std::set<CellId> seen;
      window.for_each_member(node, [&](CellId member) { REQUIRE(seen.insert(member).second); });
      REQUIRE(seen == members[node]);
    }
    std::set<CellId> seen;
    window.for_each_copy_of(node, [&](CellId copy) { seen.insert(copy); });
    REQUIRE(seen == copies[node]);
    const auto found = window.places_of(node);
    REQUIRE(std::multiset<std::pair<CellId, std::uint32_t>>(found.begin(), found.end()) == places[node]);
  }
}

TEST_CASE("the history of a face ends with what the face is now", "[engine][left]") {
  Workshop shop;
  RandomSteps steps(GENERATE(range(0U, 6U)), {.most_cells = 30, .splits = true});
  const ops::Structure& structure = shop.structure();
  const Window all(structure);
  for (int step = 0; step < 40; ++step) {
    REQUIRE(shop.apply(steps.next(structure)));
  }
  for (const CellId c : current_cells(structure)) {
    const auto arity = structure.faces().of(c).size();
    SignedNodes last;
    all.for_each_face_of_history(c, structure.now(), [&](CellId node, int sign, ops::LinkId links) {
      if (links == structure.forest().links()) {
        last.emplace_back(node, 0);
        CHECK((sign == 1 || sign == -1));
      }
    });
    REQUIRE(last.size() >= arity);
    for (const auto& node : last_faces(all, c)) {
      REQUIRE(std::find(last.begin(), last.end(), node) != last.end());
    }
  }
}
