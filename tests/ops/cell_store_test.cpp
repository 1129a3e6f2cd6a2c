#include "ops/cells/cell_store.hpp"

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

void check(const CellStore& store, const std::vector<Row>& rows) {
  REQUIRE(store.size() == rows.size());
  std::map<CellId, std::vector<std::pair<CellId, std::uint32_t>>> places;
  for (CellId c = 0; c < rows.size(); ++c) {
    const Row& row = rows[c];
    REQUIRE(store.type_id(c) == row.type);
    REQUIRE(store.name(c) == row.name);
    REQUIRE(store.body(c) == row.body);
    REQUIRE(store.lazy(c) == none);
    REQUIRE(store.faces(c).size() == row.faces.size());
    for (std::uint32_t k = 0; k < row.faces.size(); ++k) {
      REQUIRE(store.faces(c)[k] == row.faces[k].first);
      REQUIRE(store.order(c, k) == row.faces[k].second);
      auto& of_face = places[row.faces[k].first];
      of_face.insert(of_face.begin(), {c, k});
    }
  }
  for (CellId c = 0; c < rows.size(); ++c) {
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
  ops::TypeTable types;
  CellStore store{types};
  std::vector<Row> rows;
  for (int step = 0; step < 200; ++step) {
    if (draw(3) != 0 || rows.empty()) {
      Row row{types.simplex(static_cast<int>(draw(4))), draw(100), ops::BodyId{draw(5)}, {}};
      store.add(row.type, row.name, none, row.body);
      // As many as it is given, whatever the type says.
      for (std::uint32_t k = draw(5); k > 0 && !rows.empty(); --k) {
        const auto face = static_cast<CellId>(draw(rows.size()));
        const ops::OrderId order = draw(4) == 0 ? ops::OrderId{7} : ops::same_order;
        store.add_face(face, order);
        row.faces.emplace_back(face, order);
      }
      rows.push_back(std::move(row));
    } else {
      store.pop_back();
      rows.pop_back();
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
      REQUIRE(lazy == 1);
      ++asked;
      return given;
    }
    std::span<const ops::OrderId> orders(CellId lazy) const override {
      REQUIRE(lazy == 1);
      return in_orders;
    }
  };
  ops::TypeTable types;
  CellStore store{types};
  Source source;
  store.set_face_source(source);
  store.add(types.vertex(), 0, none, 0);
  store.add(types.simplex(1), none, 0, 0);
  store.add(types.vertex(), 1, none, 0);
  CHECK(store.faces(0).empty());
  CHECK(store.faces(2).empty());
  CHECK(source.asked == 0);
  CHECK(store.faces(1).size() == 2);
  CHECK(store.order(1, 1) == ops::same_order);
  source.in_orders = {0, 3};
  CHECK(store.order(1, 1) == 3);
  store.pop_back();
  store.pop_back();
  CHECK(store.size() == 1);
  store.add(types.vertex(), 1, none, 0);
  CHECK(store.faces(1).empty());
}
