#include "ops/cells/cell_store.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/catch.hpp"

using namespace sesame;
using ops::CellId;
using ops::CellStore;
using ops::none;

namespace {

/// A node as a plain value.
struct Row {
  ops::TypeId type;
  std::uint32_t name;
  ops::BodyId body;
  std::vector<std::pair<CellId, ops::OrderId>> faces;
};

/// Those that steps made, and those that were asked for: without faces, with the number of a lazy cell for a name.
struct Rows {
  std::vector<Row> made, asked;
};

void check(const CellStore& store, const Rows& rows) {
  REQUIRE(store.size() == rows.made.size());
  REQUIRE(store.asked() == ops::asked_node(static_cast<std::uint32_t>(rows.asked.size())));
  std::map<CellId, std::vector<std::pair<CellId, std::uint32_t>>> places;
  std::vector<CellId> nodes;
  store.for_each_node([&](CellId c) { nodes.push_back(c); });
  REQUIRE(nodes.size() == rows.made.size() + rows.asked.size());
  REQUIRE(std::is_sorted(nodes.begin(), nodes.end()));
  for (const CellId c : nodes) {
    const Row& row = ops::is_asked_for(c) ? rows.asked.at(ops::number_of(c)) : rows.made.at(c);
    REQUIRE(store.type_id(c) == row.type);
    REQUIRE(store.name(c) == (ops::is_asked_for(c) ? std::uint32_t{none} : row.name));
    REQUIRE(store.body(c) == row.body);
    REQUIRE(store.lazy(c) == (ops::is_asked_for(c) ? row.name : std::uint32_t{none}));
    if (store.lazy(c) != none) {
      continue;  // its faces are those of a source
    }
    REQUIRE(store.faces(c).size() == row.faces.size());
    for (std::uint32_t k = 0; k < row.faces.size(); ++k) {
      REQUIRE(store.faces(c)[k] == row.faces[k].first);
      REQUIRE(store.order(c, k) == row.faces[k].second);
      auto& of_face = places[row.faces[k].first];
      of_face.insert(of_face.begin(), {c, k});
    }
  }
  for (const CellId c : nodes) {
    std::vector<std::pair<CellId, std::uint32_t>> found;
    store.for_each_incidence(c, [&](CellId owner, std::uint32_t k) {
      found.emplace_back(owner, k);
      return true;
    });
    REQUIRE(found == places[c]);
  }
}

}  // namespace

TEST_CASE("nodes, faces and where a node is a face are what plain rows say, through undo", "[ops]") {
  std::mt19937 random(GENERATE(range(0U, 10U)));
  const auto draw = [&](std::size_t below) { return static_cast<std::uint32_t>(random() % below); };
  const auto number = [](const std::vector<Row>& of) { return static_cast<std::uint32_t>(of.size()); };
  ops::TypeTable types;
  CellStore store{types};
  Rows rows;
  std::vector<bool> asks;  // what happened, in order
  for (int step = 0; step < 200; ++step) {
    if (draw(3) != 0 || asks.empty()) {
      Row row{types.simplex(static_cast<int>(draw(4))), draw(100), ops::BodyId{draw(5)}, {}};
      if (asks.push_back(draw(4) == 0); asks.back()) {
        row.name = draw(2) == 0 ? row.name : std::uint32_t{none};
        REQUIRE(store.add_asked(row.type, row.name, row.body) == ops::asked_node(number(rows.asked)));
        rows.asked.push_back(std::move(row));
      } else {
        REQUIRE(store.add(row.type, row.name, row.body) == rows.made.size());
        // As many as it is given, whatever the type says.
        for (std::uint32_t k = draw(5); k > 0 && asks.size() > 1; --k) {
          const std::uint32_t at = draw(asks.size() - 1);
          const CellId face = at < rows.made.size() ? CellId{at} : ops::asked_node(at - number(rows.made));
          const ops::OrderId order = draw(4) == 0 ? ops::OrderId{7} : ops::same_order;
          store.add_face(face, order);
          row.faces.emplace_back(face, order);
        }
        rows.made.push_back(std::move(row));
      }
    } else {
      if (asks.back()) {
        store.pop_asked();
        rows.asked.pop_back();
      } else {
        store.pop_back();
        rows.made.pop_back();
      }
      asks.pop_back();
    }
    check(store, rows);
  }
}

TEST_CASE("the faces of lazy nodes are asked of their source, those of others never", "[ops]") {
  struct Source final : ops::FaceSource {
    std::vector<CellId> given{4, 5};
    std::vector<ops::OrderId> in_orders;
    mutable int asked = 0;
    std::span<const CellId> faces(CellId lazy) const override {
      REQUIRE(lazy == ops::asked_node(1));
      ++asked;
      return given;
    }
    std::span<const ops::OrderId> orders(CellId lazy) const override {
      REQUIRE(lazy == ops::asked_node(1));
      return in_orders;
    }
  };
  ops::TypeTable types;
  CellStore store{types};
  Source source;
  store.set_face_source(source);
  store.add(types.vertex(), 0, 0);
  const CellId degenerate = store.add_asked(types.simplex(1), none, 0);
  const CellId lazy = store.add_asked(types.simplex(1), 0, 0);
  store.add(types.vertex(), 1, 0);
  CHECK(store.faces(0).empty());
  CHECK(store.faces(1).empty());
  CHECK(store.faces(degenerate).empty());
  CHECK(source.asked == 0);
  CHECK(store.faces(lazy).size() == 2);
  CHECK(store.order(lazy, 1) == ops::same_order);
  source.in_orders = {0, 3};
  CHECK(store.order(lazy, 1) == 3);
  store.pop_asked();
  store.pop_back();
  CHECK(store.size() == 1);
  CHECK(store.add_asked(types.simplex(1), none, 0) == lazy);
  CHECK(store.faces(lazy).empty());
}
