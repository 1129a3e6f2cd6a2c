#include "engine/towers/barcode_tracker.hpp"

#include <algorithm>
#include <array>

#include "tests/support/catch.hpp"
#include "tests/support/random_towers.hpp"
#include "tests/support/ranks.hpp"
#include "tests/support/tracked_towers.hpp"

namespace sesame {
namespace {

using engine::Bar;
using engine::BarcodeTracker;
using ops::Label;
using ops::TowerComplex;
using tests::TowerStep;

/// Z/p, or Q for 0.
sparse::AnyRing field(std::int64_t p) { return sparse::parse_ring(p == 0 ? "Q" : "Z/" + std::to_string(p)).value(); }

struct Run {
  std::vector<Bar> bars;
  std::uint64_t hidden = 0;
  std::vector<Bar> traced;  ///< those that have cycles
};

/// The bars of a tower, sorted; operation k happens at time times[k], or k.
Run run(const std::vector<TowerStep>& tower, std::int64_t p, const std::vector<double>& times = {},
        bool with_cycles = false) {
  Run run;
  const auto on_bar = [&](const Bar& bar) { run.bars.push_back(bar); };
  const auto tracker = engine::make_barcode_tracker(field(p), on_bar, {.keeps_cycles = with_cycles});
  TowerComplex complex;
  engine::TowerTracker* told = tracker.get();
  for (std::size_t k = 0; k < tower.size(); ++k) {
    tests::apply(tower[k], complex, {&told, 1}, times.empty() ? static_cast<double>(k) : times[k]);
  }
  tracker->for_each_open_bar(on_bar);
  std::ranges::sort(run.bars);
  run.hidden = tracker->hidden();
  if (with_cycles) {
    std::ranges::transform(tracker->cycles()->bars(), std::back_inserter(run.traced),
                           &engine::BarCycles::TracedBar::bar);
    std::erase_if(run.traced, [](const Bar& bar) { return bar.birth == bar.death; });
  }
  return run;
}

/// Calls `check` with the tracker, the complex and the time after each operation of a tower, at times 0, 1, ...
template <class Check>
void check_each_operation(const std::vector<TowerStep>& tower, std::int64_t p, Check&& check) {
  const auto tracker = engine::make_barcode_tracker(field(p), [](const Bar&) {});
  TowerComplex complex;
  tests::PlainComplex plain;
  engine::TowerTracker* told = tracker.get();
  for (std::size_t k = 0; k < tower.size(); ++k) {
    const auto time = static_cast<double>(k);
    tests::apply(tower[k], complex, {&told, 1}, time);
    plain.apply(tower[k]);
    check(*tracker, plain, time);
  }
}

std::vector<std::uint64_t> betti_of(const std::vector<Bar>& bars, double time) {
  std::vector<std::uint64_t> betti;
  for (const Bar& bar : bars) {
    if (bar.birth <= time && time < bar.death) {
      betti.resize(std::max(betti.size(), static_cast<std::size_t>(bar.dimension) + 1), 0);
      ++betti[static_cast<std::size_t>(bar.dimension)];
    }
  }
  return betti;
}

std::vector<TowerStep> inclusions(std::vector<std::vector<Label>> simplices) {
  std::vector<TowerStep> tower;
  for (std::vector<Label>& labels : simplices) {
    tower.push_back({false, std::move(labels)});
  }
  return tower;
}

TEST_CASE("Betti numbers are those of the complex, at every operation, and the sums over the bars", "[engine][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 20u));
  const std::int64_t p = GENERATE(2, 3);
  CAPTURE(seed, p);
  const std::vector<TowerStep> tower = tests::random_tower(seed, 120, 8, 1 + seed % 4);
  const std::vector<Bar> bars = run(tower, p).bars;
  check_each_operation(tower, p, [&](const BarcodeTracker& tracker, const tests::PlainComplex& plain, double time) {
    REQUIRE(tracker.betti() == tests::betti_modulo(plain, p));
    REQUIRE(tracker.betti() == betti_of(bars, time));
  });
}

TEST_CASE("Betti numbers over Q are what ranks over Z say", "[engine][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 8u));
  CAPTURE(seed);
  const std::vector<TowerStep> tower = tests::random_tower(seed, 80, 7, 1 + seed % 4);
  check_each_operation(tower, 0, [](const BarcodeTracker& tracker, const tests::PlainComplex& plain, double) {
    std::size_t rank_below = 0;
    for (std::size_t d = 0; !tests::numbered(plain, d).empty(); ++d) {
      const std::size_t rank_above = tests::invariant_factors(tests::boundary_rows(plain, d + 1)).size();  // over Q
      const std::size_t betti = tests::numbered(plain, d).size() - rank_below - rank_above;
      REQUIRE((d < tracker.betti().size() ? tracker.betti()[d] : 0) == betti);
      rank_below = rank_above;
    }
  });
}

TEST_CASE("over Q the bars are those over all but a few fields Z/p", "[engine][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 40u));
  CAPTURE(seed);
  const std::vector<TowerStep> tower = tests::random_tower(seed, 400, 12, seed % 5);
  CHECK(run(tower, 0).bars == run(tower, 2147483647).bars);
}

TEST_CASE("bars up to a dimension are those of all that there are, for less work", "[engine][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 20u));
  const bool with_cycles = GENERATE(false, true);
  const std::size_t last = GENERATE(0u, 1u, 2u, 5u);
  CAPTURE(seed, with_cycles, last);
  const std::vector<TowerStep> tower = tests::random_tower(seed, 150, 8, 1 + seed % 4);
  std::vector<Bar> bars;
  const auto on_bar = [&](const Bar& bar) { bars.push_back(bar); };
  const engine::Dimensions some{last};
  const auto make = [&](engine::Dimensions dimensions, const BarcodeTracker::OnBar& note) {
    return engine::make_barcode_tracker(field(3), note, {.dimensions = dimensions, .keeps_cycles = with_cycles});
  };
  const auto part = make(some, on_bar);
  const auto whole = make(engine::all_dimensions, [](const Bar&) {});
  const std::array<engine::TowerTracker*, 2> told{part.get(), whole.get()};
  TowerComplex complex;
  for (std::size_t k = 0; k < tower.size(); ++k) {
    tests::apply(tower[k], complex, told, static_cast<double>(k));
    std::vector<std::uint64_t> betti = whole->betti();
    betti.resize(std::min(betti.size(), last + 1));
    while (!betti.empty() && betti.back() == 0) {
      betti.pop_back();
    }
    REQUIRE(part->betti() == betti);
  }
  part->for_each_open_bar(on_bar);
  std::ranges::sort(bars);
  std::vector<Bar> expected = run(tower, 3).bars;
  std::erase_if(expected, [&](const Bar& bar) { return !some.have(static_cast<std::size_t>(bar.dimension)); });
  CHECK(bars == expected);
  CHECK(part->work().classes_held <= whole->work().classes_held);
  if (complex.counts().size() > last + 1) {
    CHECK(part->work().classes_held < whole->work().classes_held);
  }
}

TEST_CASE("two methods find the same bars: sums of classes, and reduced chains of generators", "[engine][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 40u));
  const std::int64_t p = GENERATE(0, 2, 3, 7);
  CAPTURE(seed, p);
  const std::vector<TowerStep> tower = tests::random_tower(seed, 400, 12, seed % 5);
  const Run fast = run(tower, p);
  const Run with_cycles = run(tower, p, {}, true);
  CHECK(fast.bars == with_cycles.bars);
  CHECK(fast.hidden == with_cycles.hidden);
  CHECK(fast.traced.empty());
  CHECK(with_cycles.traced == fast.bars);
}

TEST_CASE("two methods find the same bars of long towers, whose classes are numbered anew", "[engine][tower]") {
  const std::int64_t p = GENERATE(2, 3);
  const std::vector<TowerStep> tower = tests::random_tower(1, 30'000, 12, 2);
  const Run with_cycles = run(tower, p, {}, true);
  CHECK(run(tower, p).bars == with_cycles.bars);
  CHECK(with_cycles.traced == with_cycles.bars);
}

TEST_CASE("the order of operations at one time does not matter", "[engine][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 30u));
  CAPTURE(seed);
  std::mt19937 random{seed};
  // The triangles of 6 vertices; vertices at 0, edges at 1 or 2, triangles from 2 on.
  std::vector<std::vector<std::vector<Label>>> batches(6);
  for (Label a = 0; a < 6; ++a) {
    batches[0].push_back({a});
    for (Label b = a + 1; b < 6; ++b) {
      batches[1 + random() % 2].push_back({a, b});
      for (Label c = b + 1; c < 6; ++c) {
        batches[2 + random() % 4].push_back({a, b, c});
      }
    }
  }
  const auto shuffled_run = [&] {
    std::vector<std::vector<Label>> simplices;
    std::vector<double> times;
    for (std::size_t at = 0; at < batches.size(); ++at) {
      std::ranges::shuffle(batches[at], random);
      std::ranges::stable_sort(batches[at], {}, &std::vector<Label>::size);  // faces first
      for (std::vector<Label> labels : batches[at]) {
        std::ranges::shuffle(labels, random);
        simplices.push_back(std::move(labels));
        times.push_back(static_cast<double>(at));
      }
    }
    return run(inclusions(simplices), 3, times);
  };
  const Run first = shuffled_run();
  const Run second = shuffled_run();
  CHECK(first.bars == second.bars);
  CHECK(first.hidden == second.hidden);
  CHECK(first.hidden > 0);
}

TEST_CASE("a circle dies when it is contracted to a point", "[engine][tower]") {
  std::vector<TowerStep> tower = inclusions({{0}, {1}, {2}, {0, 1}, {1, 2}, {0, 2}});
  tower.push_back({true, {0, 1}});
  tower.push_back({true, {2, 1}});
  CHECK(run(tower, 2).bars == std::vector<Bar>{{0, 0, engine::never}, {0, 1, 3}, {0, 2, 4}, {1, 5, 6}});
}

TEST_CASE("maps that are isomorphisms on homology leave all bars open", "[engine][tower]") {
  // A path, and a square; edges of the path and a triangle's free edge are contracted.
  std::vector<TowerStep> tower =
      inclusions({{0}, {1}, {0, 1}, {2}, {1, 2}, {3}, {2, 3}, {0, 3}, {4}, {3, 4}, {5}, {4, 5}});
  const std::size_t built = tower.size();
  const std::vector<Bar> before = run(tower, 2).bars;
  tower.push_back({true, {5, 4}});
  tower.push_back({true, {4, 3}});
  tower.push_back({true, {1, 0}});
  CHECK(run(tower, 2).bars == before);
  tower.push_back({true, {2, 0}});
  CHECK(run(tower, 2).bars.back() == Bar{1, 7, static_cast<double>(built + 3)});
}

TEST_CASE("identifying two far points of a space makes a loop, and two components one", "[engine][tower]") {
  std::vector<TowerStep> tower = inclusions({{0}, {1}, {2}, {3}, {0, 1}, {1, 2}, {2, 3}, {9}});
  tower.push_back({true, {0, 3}});
  tower.push_back({true, {9, 1}});
  CHECK(run(tower, 2).bars ==
        std::vector<Bar>{{0, 0, engine::never}, {0, 1, 4}, {0, 2, 5}, {0, 3, 6}, {0, 7, 9}, {1, 8, engine::never}});
}

TEST_CASE("torsion shows as a difference between fields", "[engine][tower]") {
  // The projective plane with 6 vertices.
  std::vector<std::vector<Label>> simplices;
  for (Label v = 0; v < 6; ++v) {
    simplices.push_back({v});
  }
  for (Label a = 0; a < 6; ++a) {
    for (Label b = a + 1; b < 6; ++b) {
      simplices.push_back({a, b});
    }
  }
  for (const std::vector<Label>& triangle : std::vector<std::vector<Label>>{{0, 1, 2},
                                                                            {0, 2, 3},
                                                                            {0, 3, 4},
                                                                            {0, 4, 5},
                                                                            {0, 1, 5},
                                                                            {1, 2, 4},
                                                                            {2, 3, 5},
                                                                            {1, 3, 4},
                                                                            {2, 4, 5},
                                                                            {1, 3, 5}}) {
    simplices.push_back(triangle);
  }
  const double end = static_cast<double>(simplices.size());
  CHECK(betti_of(run(inclusions(simplices), 2).bars, end) == std::vector<std::uint64_t>{1, 1, 1});
  CHECK(betti_of(run(inclusions(simplices), 3).bars, end) == std::vector<std::uint64_t>{1});
  CHECK(betti_of(run(inclusions(simplices), 0).bars, end) == std::vector<std::uint64_t>{1});
}

TEST_CASE("what is kept of a long tower is what its present complex needs", "[engine][tower]") {
  // A random one; and one of a single vertex, to which another one is tied and contracted again and again.
  const bool is_random = GENERATE(true, false);
  const std::int64_t p = GENERATE(2, 3);
  std::vector<TowerStep> tower = is_random ? tests::random_tower(1, 30'000, 12, 2) : inclusions({{0}});
  for (Label v = 1; !is_random && tower.size() < 150'000; ++v) {
    tower.push_back({false, {v}});
    tower.push_back({false, {0, v}});
    tower.push_back({true, {v, 0}});
  }
  const auto tracker = engine::make_barcode_tracker(field(p), [](const Bar&) {});
  engine::TowerTracker* told = tracker.get();
  TowerComplex complex;
  std::size_t most_classes = 0;
  std::size_t most_terms = 0;
  for (std::size_t k = 0; k < tower.size(); ++k) {
    tests::apply(tower[k], complex, {&told, 1}, static_cast<double>(k));
    most_classes = std::max<std::size_t>(most_classes, tracker->work().classes_held);
    most_terms = std::max<std::size_t>(most_terms, tracker->work().terms_held);
  }
  // Some 4,000 in each of the dimensions are idle before they are looked for.
  CHECK(most_classes < 22'000);
  CHECK(most_terms < 30'000);
}

}  // namespace
}  // namespace sesame
