// The groups of towers over Z, beside Smith forms from scratch.
#include "engine/group_tracker.hpp"

#include <algorithm>
#include <random>

#include "tests/support/catch.hpp"
#include "tests/support/random_towers.hpp"
#include "tests/support/ranks.hpp"
#include "tests/support/tracked_towers.hpp"

namespace sesame {
namespace {

using engine::GroupTracker;
using ops::Label;
using sparse::Integer;
using tests::PlainComplex;
using tests::TowerStep;

engine::Homology homology_of(const PlainComplex& complex) {
  engine::Homology homology;
  std::size_t rank_below = 0;
  for (std::size_t d = 0; !tests::numbered(complex, d).empty(); ++d) {
    std::vector<Integer> factors = tests::invariant_factors(tests::boundary_rows(complex, d + 1));
    const std::size_t rank_above = factors.size();
    homology.betti.push_back(static_cast<std::int64_t>(tests::numbered(complex, d).size() - rank_below - rank_above));
    std::erase_if(factors, [](const Integer& factor) { return factor.is_unit(); });
    homology.torsion.push_back(std::move(factors));
    rank_below = rank_above;
  }
  return homology;
}

struct Seen {
  bool has_core = false;
  bool has_torsion = false;
};

/// Compares all groups after every operation.
Seen check_each_operation(const std::vector<TowerStep>& tower) {
  GroupTracker tracker;
  engine::TowerTracker* told = &tracker;
  ops::TowerComplex complex;
  PlainComplex plain;
  Seen seen;
  for (std::size_t k = 0; k < tower.size(); ++k) {
    tests::apply(tower[k], complex, {&told, 1}, static_cast<double>(k));
    plain.apply(tower[k]);
    const engine::Homology expected = homology_of(plain);
    const engine::Homology& found = tracker.homology(complex.counts().size());
    CAPTURE(k);
    REQUIRE(found.betti == expected.betti);
    REQUIRE(found.torsion == expected.torsion);
    seen.has_torsion |= std::ranges::any_of(found.torsion, [](const auto& factors) { return !factors.empty(); });
  }
  seen.has_core = tracker.has_core();
  return seen;
}

using Simplex = std::vector<Label>;

/// The triangles of a disk whose boundary goes n times round a circle of three edges: H_1 = Z/n.
std::vector<Simplex> moore_space(std::uint64_t n, Label first) {
  std::vector<Simplex> triangles;
  const std::uint64_t sides = 3 * n;
  const auto outer = [&](std::uint64_t k) { return first + k % 3; };
  const auto inner = [&](std::uint64_t k) { return first + 3 + k % sides; };
  for (std::uint64_t k = 0; k < sides; ++k) {
    triangles.push_back({outer(k), outer(k + 1), inner(k)});
    triangles.push_back({outer(k + 1), inner(k), inner(k + 1)});
    triangles.push_back({inner(k), inner(k + 1), first + 3 + sides});
  }
  return triangles;
}

/// Grows by steps that are possible, and knows which are.
class TowerMaker {
 public:
  explicit TowerMaker(std::uint32_t seed) : random{seed} {}

  /// With the faces that are missing.
  void add(const Simplex& simplex) {
    if (complex_.has({simplex.begin(), simplex.end()})) {
      return;
    }
    for (std::size_t k = 0; simplex.size() > 1 && k < simplex.size(); ++k) {
      Simplex face = simplex;
      face.erase(face.begin() + static_cast<std::ptrdiff_t>(k));
      add(face);
    }
    take({false, simplex});
  }
  void contract(Label u, Label v) { take({true, {u, v}}); }
  void contract_some() {
    const std::vector<Label> vertices = complex_.vertices();
    const Label u = vertices[random() % vertices.size()];
    const Label v = vertices[random() % vertices.size()];
    if (u != v) {
      contract(u, v);
    }
  }
  /// A simplex on vertices that are there.
  void add_some() {
    std::vector<Label> vertices = complex_.vertices();
    std::ranges::shuffle(vertices, random);
    vertices.resize(std::min<std::size_t>(vertices.size(), 2 + random() % 3));
    add(vertices);
  }

  std::mt19937 random;
  std::vector<TowerStep> tower;

 private:
  void take(TowerStep step) {
    complex_.apply(step);
    tower.push_back(std::move(step));
  }

  PlainComplex complex_;
};

TEST_CASE("the groups of random towers are those of Smith forms, at every operation", "[engine][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 16u));
  CAPTURE(seed);
  check_each_operation(tests::random_tower(seed, 120, 8, seed % 5));
}

TEST_CASE("a filtration without torsion needs no core", "[engine][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 8u));
  CAPTURE(seed);
  const Seen seen = check_each_operation(tests::random_tower(seed, 110, 9, 0));
  CHECK_FALSE(seen.has_torsion);
  CHECK_FALSE(seen.has_core);
}

TEST_CASE("torsion comes and goes with the simplices of a filtration", "[engine][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 10u));
  CAPTURE(seed);
  TowerMaker maker(seed);
  std::vector<Simplex> triangles = moore_space(2 + seed % 3, 0);
  if (seed % 2 == 0) {
    const std::vector<Simplex> more = moore_space(2 + seed / 2 % 3, 100);
    triangles.insert(triangles.end(), more.begin(), more.end());
  }
  std::ranges::shuffle(triangles, maker.random);
  for (const Simplex& triangle : triangles) {
    maker.add(triangle);
  }
  for (int k = 0; k < 12; ++k) {
    maker.add_some();
  }
  const Seen seen = check_each_operation(maker.tower);
  CHECK(seen.has_torsion);
  CHECK(seen.has_core);
}

TEST_CASE("contractions of spaces with torsion have the groups of Smith forms", "[engine][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 16u));
  CAPTURE(seed);
  TowerMaker maker(seed);
  std::vector<Simplex> triangles = moore_space(2 + seed % 4, 0);
  const std::vector<Simplex> more = moore_space(2 + seed % 3, 100);
  triangles.insert(triangles.end(), more.begin(), more.end());
  std::ranges::shuffle(triangles, maker.random);
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    maker.add(triangles[k]);
    if (k % 9 == 8 && seed % 2 == 0) {
      maker.contract_some();
    }
  }
  for (int k = 0; k < 12; ++k) {
    maker.contract_some();
    maker.add_some();
  }
  const bool may_lose_torsion = seed % 2 == 0;
  CHECK((check_each_operation(maker.tower).has_core || may_lose_torsion));
}

TEST_CASE("circles of two Moore spaces that become one leave the greatest common divisor", "[engine][tower]") {
  TowerMaker maker(1);
  for (const Label first : {Label{0}, Label{100}}) {
    for (const Simplex& triangle : moore_space(first == 0 ? 4 : 6, first)) {
      maker.add(triangle);
    }
  }
  for (const Label k : {0, 1, 2}) {
    maker.contract(100 + k, k);
  }
  CHECK(check_each_operation(maker.tower).has_torsion);
}

}  // namespace
}  // namespace sesame
