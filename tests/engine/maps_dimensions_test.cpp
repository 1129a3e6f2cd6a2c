// Random maps of dimensions 2, 3 and 4 after every sewing: live, by every law, and by Smith forms of what they stand
// for.
#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ops/maps/numbered_set.hpp"
#include "tests/support/cell_models.hpp"
#include "tests/support/random_maps.hpp"
#include "tests/support/sewn_maps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

/// The boundary of a simplex of dimension n as an (n-1)-G-map: its darts are the orders of the n + 1 vertices.
GMap boundary_of_simplex(int n) {
  std::vector<int> order(static_cast<std::size_t>(n) + 1);
  std::iota(order.begin(), order.end(), 0);
  std::vector<std::vector<int>> orders;
  do {
    orders.push_back(order);
  } while (std::next_permutation(order.begin(), order.end()));
  Lists alpha(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    for (std::vector<int> each : orders) {
      std::swap(each[i], each[i + 1]);
      alpha[i].push_back(static_cast<Dart>(std::ranges::lower_bound(orders, each) - orders.begin()));
    }
  }
  return made(GMap::make(std::move(alpha)));
}

/// A cell of dimension 4 that is a ball: over a simplex, over two solids with the same surface, or over what two cells
/// of each dimension are.
GMap cell_of_dimension_four(int kind) {
  switch (kind) {
    case 0:
      return boundary_of_simplex(4).extended();
    case 1:
      return suspension_of(map_of_faces(tetrahedron_faces())).extended();
    case 2:
      return suspension_of(suspension_of(closed_polygon(2))).extended();
    default:
      return suspension_of(suspension_of(closed_polygon(3))).extended();
  }
}

/// Maps by their simplices, and plain lists of darts beside them.
class SimplexMaps {
 public:
  SimplexMaps(const AnyRing& ring, int dimension)
      : engine_{ring}, ring_{ring}, n_{dimension}, alpha_(static_cast<std::size_t>(dimension) + 1) {}

  void make(const std::string& name, const GMap& map) {
    carry_out(engine_, make_map(name, map, true));
    maps_.push_back(name);
    const auto first = static_cast<Dart>(names_.size());
    for (std::size_t i = 0; i < alpha_.size(); ++i) {
      for (const Dart image : map.involutions()[i]) {
        alpha_[i].push_back(first + image);
      }
    }
    for (Dart d = 0; d < map.size(); ++d) {
      names_.push_back(dart_name(name, d));
    }
  }
  /// Sews two random darts along a random involution where the plain lists allow it, and is refused elsewhere.
  /// Whether something has happened.
  bool sew(Random& random) {
    const auto any = [&] { return static_cast<Dart>(random.in(0, static_cast<int>(names_.size()) - 1)); };
    const int i = random.in(0, n_);
    const Dart a = any(), b = any();
    const auto pairs = pairs_of(i, a, b);
    const auto report = engine_.apply(sew_darts(i, names_[a], names_[b]));
    CAPTURE(i, names_[a], names_[b], report ? "" : report.error().what);
    REQUIRE(report.has_value() == pairs.has_value());
    if (!pairs) {
      return false;
    }
    past_.push_back(alpha_);
    for (const auto& [x, y] : *pairs) {
      alpha_[static_cast<std::size_t>(i)][x] = y;
      alpha_[static_cast<std::size_t>(i)][y] = x;
    }
    return true;
  }
  /// Takes a random sewing back where there is one. Whether something has happened.
  bool unsew(Random& random) {
    const int i = random.in(0, n_);
    const auto a = static_cast<Dart>(random.in(0, static_cast<int>(names_.size()) - 1));
    auto& images = alpha_[static_cast<std::size_t>(i)];
    const auto report = engine_.apply(ops::Unsew{i, {names_[a]}});
    CAPTURE(i, names_[a], report ? "" : report.error().what);
    REQUIRE(report.has_value() == (images[a] != a));
    if (!report) {
      return false;
    }
    past_.push_back(alpha_);
    std::vector<Dart> orbit{a, images[a]};
    for (std::size_t at = 0; at < orbit.size(); ++at) {
      for (int j = 0; j <= n_; ++j) {
        const Dart next = alpha_[static_cast<std::size_t>(j)][orbit[at]];
        if (std::abs(j - i) >= 2 && std::ranges::find(orbit, next) == orbit.end()) {
          orbit.push_back(next);
          orbit.push_back(images[next]);
        }
      }
    }
    for (const Dart d : orbit) {
      images[d] = d;
    }
    return true;
  }
  /// All of them, by one involution more.
  void extend() {
    carry_out(engine_, ops::Extend{maps_});
    past_.push_back(alpha_);
    ++n_;
    alpha_.emplace_back(names_.size());
    std::iota(alpha_.back().begin(), alpha_.back().end(), Dart{0});
  }
  void undo_extension() {
    undo();
    --n_;
  }
  [[nodiscard]] bool can_undo() const { return !past_.empty(); }
  void undo() {
    carry_out(engine_, ops::Undo{1});
    alpha_ = past_.back();
    past_.pop_back();
  }
  void check() {
    const ops::NumberedSet set = ops::simplicial_analogue(made(GMap::make(alpha_)));
    const auto counts = set.f_vector();
    REQUIRE(std::vector<std::uint64_t>(counts.begin(), counts.end()) ==
            std::vector<std::uint64_t>(engine_.cells().begin(), engine_.cells().end()));
    REQUIRE(engine_.first_defect().value_or("") == "");
    const auto groups = live_groups(engine_);
    REQUIRE(groups == std::visit([&](const auto& r) { return groups_from_scratch(engine_.structure(), r); }, ring_));
    if (std::holds_alternative<sparse::Integers>(ring_)) {
      std::vector<std::string> texts;
      for (const AbelianGroup& group : groups) {
        texts.push_back(group.to_string());
      }
      REQUIRE(texts == homology_of(set));
    }
  }

 private:
  [[nodiscard]] std::optional<DartPairs> pairs_of(int i, Dart a, Dart b) const {
    const auto& images = alpha_[static_cast<std::size_t>(i)];
    if (a == b || images[a] != a || images[b] != b) {
      return std::nullopt;
    }
    std::vector<std::size_t> generators;
    for (int j = 0; j <= n_; ++j) {
      if (std::abs(j - i) >= 2) {
        generators.push_back(static_cast<std::size_t>(j));
      }
    }
    const auto step = [&](int k, Dart d) { return alpha_[generators[static_cast<std::size_t>(k)]][d]; };
    return sewing(static_cast<Dart>(names_.size()), a, b, static_cast<int>(generators.size()), step, step);
  }

  Engine engine_;
  AnyRing ring_;
  int n_;
  Lists alpha_;
  std::vector<Lists> past_;
  std::vector<std::string> names_, maps_;
};

/// A map of one dimension more than a surface that is no sphere: its cell of that dimension is no ball.
GMap over_a_surface(int kind) {
  return (kind == 0   ? torus_of_a_square()
          : kind == 1 ? klein_bottle_of_a_square()
                      : projective_plane_of_a_square())
      .extended();
}

}  // namespace

TEST_CASE("maps with folds, free darts and cells of any kind are what their darts are after every sewing and undo") {
  const int dimension = GENERATE(2, 3, 4);
  const auto seed = GENERATE(range(0U, 8U));
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(dimension, seed, ring);
  Random random(seed);
  SimplexMaps maps(ring_named(ring), dimension);
  for (int k = random.in(1, 3); k > 0; --k) {
    GMap map = random_gmap(random, {.dimension = dimension, .folds = random.one_in(2)});
    if (dimension > 2 && random.one_in(2)) {
      map = over_a_surface(random.in(0, 2));
      map = dimension == 3 ? map : raised(map);
    }
    maps.make("m" + std::to_string(k), map.size() <= 40 ? map : component_of(map, 0));
  }
  maps.check();
  int tries = 60;
  for (int done = 0; done < 12 && tries > 0; --tries) {
    if (maps.can_undo() && random.one_in(5)) {
      maps.undo();
    } else if (random.one_in(4) ? !maps.unsew(random) : !maps.sew(random)) {
      continue;
    }
    ++done;
    maps.check();
  }
  if (dimension < 4) {
    maps.extend();
    maps.check();
    for (int k = 0; k < 8; ++k) {
      if (random.one_in(2) ? maps.sew(random) : maps.unsew(random)) {
        maps.check();
        maps.undo();
      }
    }
    maps.undo_extension();
    maps.check();
  }
}

TEST_CASE("cells of dimension four are balls over spheres of dimension three") {
  const int kind = GENERATE(0, 1, 2, 3);
  CAPTURE(kind);
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("m", cell_of_dimension_four(kind)));
  const std::vector<std::vector<std::uint64_t>> counts{
      {5, 10, 10, 5, 1}, {4, 6, 4, 2, 1}, {2, 2, 2, 2, 1}, {3, 3, 2, 2, 1}};
  CHECK(std::vector<std::uint64_t>(engine.cells().begin(), engine.cells().end()) ==
        counts[static_cast<std::size_t>(kind)]);
  CHECK(live_groups(engine).size() == 1);
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("cells of dimension four sewn at random have the groups of their simplicial analogues after every sewing") {
  const auto seed = GENERATE(range(0U, 6U));
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(seed, ring);
  Random random(seed);
  Sewn sewn(ring_named(ring), 4);
  for (int k = 0; k < 3; ++k) {
    sewn.make("c" + std::to_string(k), cell_of_dimension_four(random.in(seed == 0 ? 0 : 1, 3)));
  }
  sew_at_random(sewn, random, 50);
}

TEST_CASE("cells of dimension four sewn and unsewn at random are the map that their darts are") {
  const auto seed = GENERATE(range(0U, 6U));
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(seed, ring);
  Random random(seed);
  PlainMaps maps(ring_named(ring), 4);
  const int kind = random.in(1, 3);
  for (int k = 0; k < 2; ++k) {
    maps.make("c" + std::to_string(k), cell_of_dimension_four(kind));
  }
  maps.make("c2", cell_of_dimension_four(random.in(1, 3)));
  sew_and_unsew(maps, random, 60);
}

TEST_CASE("two simplices of dimension four sewn all over are the sphere of dimension four") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("a", cell_of_dimension_four(0)));
  carry_out(engine, make_map("b", cell_of_dimension_four(0)));
  int sewn = 0;
  for (Dart d = 0; d < 120; ++d) {
    if (engine.apply(sew_darts(4, dart_name("a", d), dart_name("b", d)))) {
      ++sewn;
      CHECK(engine.first_defect().value_or("") == "");
    }
  }
  CHECK(sewn == 5);
  CHECK(std::vector<std::uint64_t>(engine.cells().begin(), engine.cells().end()) ==
        std::vector<std::uint64_t>{5, 10, 10, 5, 2});
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0, 0, 1});
  CHECK(engine.euler_characteristic() == 2);
}
