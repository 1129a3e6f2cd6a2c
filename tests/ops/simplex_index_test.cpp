// Simplices by their vertices and the stars of vertices, beside a map from sets.
#include "ops/simplicial/simplex_index.hpp"

#include <map>
#include <set>

#include "tests/support/catch.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame::ops;
using namespace sesame::tests;

namespace {

using Vertex = SimplexIndex::Vertex;
using Slot = SimplexIndex::Slot;
using Vertices = std::vector<Vertex>;
using Fate = SimplexIndex::Fate;

constexpr Vertex vertices = 8;

Vertices of(const SimplexIndex& index, std::size_t dimension, Slot slot) {
  const auto own = index.vertices(dimension, slot);
  return {own.begin(), own.end()};
}

/// An index, and the same as a map; with all that happened, so that it can be taken back.
class Twins {
 public:
  explicit Twins(unsigned seed) : random_{seed} { index.build_stars(); }

  void include_any() {
    Vertices simplex;
    while (simplex.empty() || random_.in(0, 2) > 0) {
      const Vertex v = any_vertex(0);
      if (std::ranges::find(simplex, v) != simplex.end()) {
        break;
      }
      simplex.push_back(v);
    }
    if (slots.contains(as_set(simplex))) {
      return;
    }
    const Slot slot = index.slots(simplex.size() - 1);
    index.include(SimplexIndex::key(simplex), slot);
    slots[as_set(simplex)] = slot;
    past_.push_back({What::inclusion, simplex.size() - 1, slot, {}});
  }

  /// Of any two vertices: the one with the smaller star goes.
  void contract_any() {
    const Vertex u = any_vertex(0);
    const Vertex v{(u + any_vertex(1)) % unsigned{vertices}};
    const Vertex moved = index.star_size(u) <= index.star_size(v) ? u : v;
    const Vertex kept = moved == u ? v : u;
    std::vector<std::pair<std::size_t, Slot>> star;
    index.for_each_in_star(moved, [&](std::size_t dimension, Slot slot) { star.emplace_back(dimension, slot); });
    for (const auto& [dimension, slot] : star) {
      carry_out(dimension, slot, moved, kept);
    }
    CHECK(index.star_size(moved) == 0);
  }

  void take_back_one() {
    const auto [what, dimension, slot, before] = past_.back();
    past_.pop_back();
    switch (what) {
      case What::inclusion:
        slots.erase(as_set(of(index, dimension, slot)));
        index.exclude(dimension, slot);
        return index.drop_last_slot(dimension);
      case What::exclusion:
        index.include_again(dimension, slot);
        slots[as_set(of(index, dimension, slot))] = slot;
        return;
      case What::renaming:
        slots.erase(as_set(of(index, dimension, slot)));
        index.rename(dimension, slot, before);
        slots[as_set(before)] = slot;
        return;
    }
  }

  void check() {
    std::map<Vertex, std::set<std::pair<std::size_t, Slot>>> stars;
    for (const auto& [simplex, slot] : slots) {
      Vertices shuffled(simplex.begin(), simplex.end());
      const auto key = [&] { return SimplexIndex::key(shuffled); };
      REQUIRE(index.find(key()) == slot);
      std::ranges::reverse(shuffled);
      REQUIRE(index.find(key()) == slot);
      REQUIRE(as_set(of(index, simplex.size() - 1, slot)) == simplex);
      for (std::size_t k = 0; k < shuffled.size() && shuffled.size() > 1; ++k) {
        std::set<Vertex> facet = simplex;
        facet.erase(shuffled[k]);
        const auto there = slots.find(facet);
        REQUIRE(index.find_facet(key(), k) == (there == slots.end() ? SimplexIndex::nothing : there->second));
      }
      for (const Vertex v : simplex) {
        stars[v].emplace(simplex.size() - 1, slot);
      }
    }
    for (Vertex v = 0; v < vertices; ++v) {
      std::set<std::pair<std::size_t, Slot>> star;
      index.for_each_in_star(v, [&](std::size_t dimension, Slot slot) { star.emplace(dimension, slot); });
      REQUIRE(star == stars[v]);
      REQUIRE(index.star_size(v) == star.size());
    }
  }

  [[nodiscard]] std::size_t past() const { return past_.size(); }

  SimplexIndex index;
  std::map<std::set<Vertex>, Slot> slots;

 private:
  Vertex any_vertex(int from) { return Vertex{static_cast<unsigned>(random_.in(from, vertices - 1))}; }
  enum class What : std::uint8_t { inclusion, exclusion, renaming };
  struct Event {
    What what;
    std::size_t dimension;
    Slot slot;
    Vertices before;  ///< of a renaming
  };

  static std::set<Vertex> as_set(const Vertices& simplex) { return {simplex.begin(), simplex.end()}; }

  void carry_out(std::size_t dimension, Slot slot, Vertex moved, Vertex kept) {
    const Vertices old = of(index, dimension, slot);
    Vertices image = old;
    std::ranges::replace(image, moved, kept);
    const auto other = slots.find(as_set(image));
    const Fate fate = std::ranges::count(image, kept) > 1 ? Fate::squashed
                      : other != slots.end()              ? Fate::merged
                                                          : Fate::renamed;
    const SimplexIndex::Change change = index.change_of(dimension, slot, moved, kept);
    REQUIRE(change.fate == fate);
    CHECK(old[change.moved_at] == moved);
    CHECK(change.survivor == (fate == Fate::merged ? other->second : SimplexIndex::nothing));
    slots.erase(as_set(old));
    if (fate == Fate::renamed) {
      index.rename(dimension, slot, image);
      slots[as_set(image)] = slot;
      past_.push_back({What::renaming, dimension, slot, old});
    } else {
      index.exclude(dimension, slot);
      past_.push_back({What::exclusion, dimension, slot, {}});
    }
  }

  Random random_;
  std::vector<Event> past_;
};

}  // namespace

TEST_CASE("an index of simplices is a map from their vertices, whatever is included, contracted, taken back", "[ops]") {
  const unsigned seed = GENERATE(range(0U, 30U));
  CAPTURE(seed);
  Twins twins(seed);
  Random random(seed + 1000);
  for (int step = 0; step < 150; ++step) {
    CAPTURE(step);
    if (random.one_in(6)) {
      twins.contract_any();
    } else if (random.one_in(8)) {
      for (int back = random.in(1, 12); back > 0 && twins.past() > 0; --back) {
        twins.take_back_one();
      }
    } else {
      twins.include_any();
    }
    twins.check();
  }
  while (twins.past() > 0) {
    twins.take_back_one();
  }
  twins.check();
  CHECK(twins.slots.empty());
  for (std::size_t dimension = 0; dimension < vertices; ++dimension) {
    CHECK(twins.index.slots(dimension) == 0);
  }
}

TEST_CASE("stars that are asked for late are those that were kept from the start", "[ops]") {
  Twins early(7);
  for (int k = 0; k < 200; ++k) {
    early.include_any();
  }
  SimplexIndex late;
  for (const auto& [simplex, slot] : early.slots) {
    const Vertices listed(simplex.begin(), simplex.end());
    late.include(SimplexIndex::key(listed), late.slots(listed.size() - 1));
  }
  late.build_stars();
  for (Vertex v = 0; v < vertices; ++v) {
    CHECK(late.star_size(v) == early.index.star_size(v));
    std::size_t found = 0;
    late.for_each_in_star(v, [&](std::size_t dimension, Slot slot) {
      const Vertices own = of(late, dimension, slot);
      CHECK(std::ranges::count(own, v) == 1);
      ++found;
    });
    CHECK(found == late.star_size(v));
  }
}

TEST_CASE("a slot whose simplex is gone can be given to another one", "[ops]") {
  SimplexIndex index;
  const Vertices edge{3, 1}, other{0, 2};
  index.include(SimplexIndex::key(edge), 0);
  index.build_stars();
  index.exclude(1, 0);
  CHECK(index.find(SimplexIndex::key(edge)) == SimplexIndex::nothing);
  CHECK(of(index, 1, 0) == edge);
  index.include(SimplexIndex::key(other), 0);
  CHECK(index.slots(1) == 1);
  CHECK(index.find(SimplexIndex::key(other)) == 0);
  CHECK(index.star_size(1) == 0);
  CHECK(index.star_size(2) == 1);
}
