#include "ops/cells/bodies.hpp"

#include <functional>
#include <random>
#include <set>
#include <vector>

#include "tests/support/catch.hpp"

using namespace sesame;
using ops::Bodies;
using ops::BodyId;
using ops::BodyKind;

namespace {

/// What Bodies are, each as the set of those that were made.
struct PlainBodies {
  struct Body {
    std::set<BodyId> members;
    std::vector<std::uint64_t> counts{0, 0, 0};
    std::uint64_t simploids = 0;
    BodyKind kind;
    bool is_consumed = false;
    std::uint32_t nesting = 0;
  };
  std::vector<Body> bodies;

  [[nodiscard]] std::size_t at(BodyId b) const {
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      if (bodies[k].members.contains(b)) {
        return k;
      }
    }
    FAIL("no body " << b);
    return 0;
  }
  [[nodiscard]] Body& of(BodyId b) { return bodies[at(b)]; }
  void join(BodyId a, BodyId b) {
    const std::size_t k = at(a), other = at(b);
    if (k == other) {
      return;
    }
    Body& one = bodies[k];
    const Body two = bodies[other];
    one.members.insert(two.members.begin(), two.members.end());
    for (std::size_t p = 0; p < 3; ++p) {
      one.counts[p] += two.counts[p];
    }
    one.simploids += two.simploids;
    one.kind = {one.kind.is_abstract && two.kind.is_abstract, one.kind.keeps_orders && two.kind.keeps_orders};
    one.nesting = std::max(one.nesting, two.nesting);
    bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(other));
  }
};

void check_same(const Bodies& bodies, PlainBodies& plain) {
  std::set<BodyId> oldest;
  for (const PlainBodies::Body& body : plain.bodies) {
    if (!body.is_consumed) {
      oldest.insert(*body.members.begin());
    }
  }
  std::vector<std::uint32_t> names;
  for (const BodyId b : bodies.current()) {
    names.push_back(bodies.name(b));
  }
  REQUIRE(names == std::vector<std::uint32_t>(oldest.begin(), oldest.end()));
  for (BodyId b = 0; b < bodies.size(); ++b) {
    const PlainBodies::Body& body = plain.of(b);
    REQUIRE(bodies.name(b) == *body.members.begin());
    REQUIRE(body.members.contains(bodies.find(b)));
    std::vector<std::uint64_t> counts(bodies.counts(b).begin(), bodies.counts(b).end());
    counts.resize(3, 0);
    REQUIRE(counts == body.counts);
    REQUIRE(bodies.simploids(b) == body.simploids);
    REQUIRE(bodies.has_only_simplices(b) == (body.simploids == 0));
    REQUIRE(bodies.kind(b) == body.kind);
    REQUIRE((bodies.consumed_by(b) != ops::none) == body.is_consumed);
    REQUIRE(bodies.nesting(b) == body.nesting);
  }
}

}  // namespace

TEST_CASE("bodies are what sets of bodies are, through every change and its undoing", "[ops]") {
  std::mt19937 random(GENERATE(range(0U, 10U)));
  const auto draw = [&](std::size_t below) { return static_cast<std::uint32_t>(random() % below); };
  Bodies bodies;
  PlainBodies plain;
  std::vector<std::pair<PlainBodies, std::function<void()>>> past;  // the state before a change, and how to undo it
  const auto remember = [&](std::function<void()> undo) { past.emplace_back(plain, std::move(undo)); };
  ops::FamilyId families = 0;
  for (int step = 0; step < 300; ++step) {
    if (bodies.size() == 0 || draw(5) == 0) {
      remember([&] { bodies.undo_last(); });
      const BodyKind kind{draw(2) == 0, draw(3) != 0};
      const BodyId b = bodies.add(kind);
      bodies.set_name(b, b);
      plain.bodies.push_back({{b}, {0, 0, 0}, 0, kind});
    } else if (draw(3) == 0 && !past.empty()) {
      past.back().second();
      plain = past.back().first;
      past.pop_back();
    } else if (const BodyId a{draw(bodies.size())}, b{draw(bodies.size())};
               plain.of(a).is_consumed || plain.of(b).is_consumed) {
      continue;
    } else if (const std::uint32_t change = draw(4); change == 0 && bodies.find(a) != bodies.find(b)) {
      remember([&] { bodies.undo_last_union(); });
      const std::uint32_t unions = bodies.unions();
      CHECK(bodies.join(a, b));
      CHECK(bodies.unions() == unions + 1);
      CHECK_FALSE(bodies.join(b, a));
      plain.join(a, b);
    } else if (change == 1) {
      const std::size_t p = draw(3);
      const bool is_simplex = draw(2) == 0;
      remember([&bodies, a, p, is_simplex] { bodies.count(a, p, is_simplex, -1); });
      bodies.count(a, p, is_simplex, 1);
      ++plain.of(a).counts[p];
      plain.of(a).simploids += is_simplex ? 0 : 1;
    } else if (change == 2 && plain.of(a).kind.is_abstract) {
      remember([&] { bodies.undo_last_kind_change(); });
      const BodyKind lower{false, plain.of(a).kind.keeps_orders};
      CHECK(bodies.lower_kind(a, lower));
      CHECK_FALSE(bodies.lower_kind(a, lower));
      plain.of(a).kind = lower;
    } else if (change == 3 && draw(3) == 0) {
      const std::vector<BodyId> of{bodies.find(a), bodies.find(b)};
      const PlainBodies before = plain;
      const BodyId product = bodies.add({});
      bodies.set_name(product, product);
      std::size_t removed = 0;
      bodies.become_family(product, families++, of, std::vector<std::uint64_t>{4, 5}, 2, false,
                           [&](std::span<const std::uint64_t>) { ++removed; });
      CHECK(removed == (of[0] == of[1] ? 1 : 2));
      past.emplace_back(before, [&bodies, product, of] {
        bodies.undo_family(product, of, std::vector<std::uint64_t>{4, 5}, [](std::span<const std::uint64_t>) {});
        bodies.undo_last();
      });
      const std::uint32_t nesting = std::max(plain.of(a).nesting, plain.of(b).nesting) + 1;
      plain.of(a).is_consumed = plain.of(b).is_consumed = true;
      plain.bodies.push_back({{product}, {4, 5, 0}, 2, {}, false, nesting});
    }
    check_same(bodies, plain);
  }
}

TEST_CASE("a body lists what was made in it, and forgets its last cell", "[ops]") {
  Bodies bodies;
  const BodyId b = bodies.add({});
  bodies.add_cells(b, {3, 5});
  bodies.add_cells(b, {9, 10});
  bodies.drop_cell(b, 20);  // not of those listed
  CHECK(bodies.made(b).cells.size() == 2);
  bodies.drop_cell(b, 9);
  bodies.drop_cell(b, 4);
  REQUIRE(bodies.made(b).cells.size() == 1);
  CHECK(bodies.made(b).cells[0].first == 3);
  CHECK(bodies.made(b).cells[0].last == 4);
}
