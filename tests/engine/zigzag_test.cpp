#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "engine/zigzag/deferred_zigzag.hpp"
#include "engine/zigzag/filtration_pairs.hpp"
#include "engine/zigzag/reduced_columns.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tracked_zigzags.hpp"

namespace sesame {
namespace {

using tests::PlainBar;
using tests::PlainSimplices;
using tests::TrackedZigzag;
using tests::ZigzagShape;
using tests::ZigzagStep;

ZigzagShape shape_of(std::uint32_t seed) {
  return {.steps = 15 + seed % 30,
          .labels = 4 + seed % 4,
          .most_vertices_of_simplex = 3 + seed % 2,
          .deletions_in_16 = 3 + seed % 6,
          .contractions_in_16 = seed % 3};
}

std::string ring_name(std::int64_t p) { return "Z/" + std::to_string(p); }

TEST_CASE("small zigzags have the bars that the ranks of their maps say", "[zigzag]") {
  std::size_t born_by_deletion = 0, contractions = 0;
  for (std::uint32_t seed = 0; seed < 150; ++seed) {
    const std::vector<ZigzagStep> zigzag = tests::random_zigzag(seed, shape_of(seed));
    for (const std::int64_t p : {2, 3, 5}) {
      CAPTURE(seed, p);
      const std::vector<PlainBar> expected = tests::plain_zigzag_bars(zigzag, p);
      const TrackedZigzag tracked(zigzag, ring_name(p));
      REQUIRE(tracked.online == expected);
      REQUIRE(tracked.offline == expected);
      for (const PlainBar& bar : expected) {
        born_by_deletion += zigzag[static_cast<std::size_t>(bar.birth)].kind == 'd' ? 1 : 0;
      }
    }
    contractions += static_cast<std::size_t>(std::ranges::count(zigzag, 'c', &ZigzagStep::kind));
  }
  CHECK(born_by_deletion > 500);
  CHECK(contractions > 100);
}

/// The projective plane on six vertices, and then all of it away again.
std::vector<ZigzagStep> projective_plane_there_and_back() {
  const std::vector<std::vector<std::uint64_t>> triangles{{0, 1, 4}, {0, 1, 5}, {0, 2, 3}, {0, 2, 5}, {0, 3, 4},
                                                          {1, 2, 3}, {1, 2, 4}, {1, 3, 5}, {2, 4, 5}, {3, 4, 5}};
  std::vector<ZigzagStep> zigzag;
  for (std::uint64_t v = 0; v < 6; ++v) {
    zigzag.push_back({'i', {v}});
  }
  for (std::uint64_t u = 0; u < 6; ++u) {
    for (std::uint64_t v = u + 1; v < 6; ++v) {
      zigzag.push_back({'i', {u, v}});
    }
  }
  for (const auto& triangle : triangles) {
    zigzag.push_back({'i', triangle});
  }
  for (std::size_t k = zigzag.size(); k-- > 0;) {
    zigzag.push_back({'d', zigzag[k].labels});
  }
  return zigzag;
}

TEST_CASE("torsion is seen by the field: the projective plane", "[zigzag]") {
  const std::vector<ZigzagStep> zigzag = projective_plane_there_and_back();
  const std::size_t surfaces_over_2 =
      static_cast<std::size_t>(std::ranges::count(TrackedZigzag(zigzag, "Z/2").online, 2, &PlainBar::dimension));
  CHECK(surfaces_over_2 == 1);
  CHECK(std::ranges::count(TrackedZigzag(zigzag, "Z/3").online, 2, &PlainBar::dimension) == 0);
  CHECK(TrackedZigzag(zigzag, "Q").online == TrackedZigzag(zigzag, "Z/3").online);
  CHECK(TrackedZigzag(zigzag, "Z/2").online == tests::plain_zigzag_bars(zigzag, 2));
}

/// A zigzag without contractions that ends with the empty complex.
std::vector<ZigzagStep> closed_zigzag(std::uint32_t seed, std::size_t steps) {
  ZigzagShape shape = shape_of(seed);
  shape.steps = steps;
  shape.contractions_in_16 = 0;
  std::vector<ZigzagStep> zigzag = tests::random_zigzag(seed, shape);
  PlainSimplices complex;
  for (const ZigzagStep& step : zigzag) {
    tests::carry_out(step, complex);
  }
  std::vector<tests::PlainSimplex> left(complex.begin(), complex.end());
  std::ranges::stable_sort(left, std::ranges::greater{}, &tests::PlainSimplex::size);
  for (const tests::PlainSimplex& simplex : left) {
    zigzag.push_back({'d', simplex});
  }
  return zigzag;
}

TEST_CASE("a zigzag that is read backwards has the mirrored bars", "[zigzag]") {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    std::vector<ZigzagStep> zigzag = closed_zigzag(seed, 300);
    const auto n = static_cast<std::int64_t>(zigzag.size());
    // The complex after operation k, from 0, is the one before operation n - 1 - k of the other, counted in the same
    // way: [b, d), the complexes b, ..., d - 1, become n - 1 - d, ..., n - 2 - b.
    std::vector<PlainBar> mirrored;
    for (const PlainBar& bar : TrackedZigzag(zigzag, "Z/3").online) {
      REQUIRE(bar.death >= 0);
      mirrored.push_back({bar.dimension, n - 1 - bar.death, n - 1 - bar.birth});
    }
    std::ranges::sort(mirrored);
    std::ranges::reverse(zigzag);
    for (ZigzagStep& step : zigzag) {
      step.kind = step.kind == 'i' ? 'd' : 'i';
    }
    const TrackedZigzag backwards(zigzag, "Z/3");
    REQUIRE(backwards.online == mirrored);
    REQUIRE(backwards.offline == mirrored);
  }
}

TEST_CASE("an insertion and a deletion that change places move the ends of bars as the diamond says", "[zigzag]") {
  std::size_t moved = 0, changed = 0;
  for (std::uint32_t seed = 0; seed < 80; ++seed) {
    CAPTURE(seed);
    std::vector<ZigzagStep> zigzag = closed_zigzag(seed, 120);
    for (std::size_t k = 0; k + 1 < zigzag.size(); ++k) {
      const bool is_diamond = zigzag[k].kind == 'i' && zigzag[k + 1].kind == 'd' &&
                              !std::ranges::is_permutation(zigzag[k].labels, zigzag[k + 1].labels);
      if (!is_diamond || k % 5 != 0) {
        continue;
      }
      // The complex in between is the union before, the intersection after; all other complexes are the same. Bars of
      // one end there move by one; a bar of this complex alone changes its dimension by one.
      const auto at = static_cast<std::int64_t>(k);
      std::vector<PlainBar> expected;
      for (const PlainBar& bar : TrackedZigzag(zigzag, "Z/2").online) {
        if (bar.birth == at && bar.death == at + 1) {
          expected.push_back({bar.dimension - 1, at, at + 1});
          ++changed;
        } else if (bar.birth == at) {
          expected.push_back({bar.dimension, at + 1, bar.death});
        } else if (bar.birth == at + 1) {
          expected.push_back({bar.dimension, at, bar.death});
        } else if (bar.death == at) {
          expected.push_back({bar.dimension, bar.birth, at + 1});
        } else if (bar.death == at + 1) {
          expected.push_back({bar.dimension, bar.birth, at});
        } else {
          expected.push_back(bar);
        }
        moved += bar != expected.back() ? 1 : 0;
      }
      std::ranges::sort(expected);
      std::vector<ZigzagStep> swapped = zigzag;
      std::swap(swapped[k], swapped[k + 1]);
      const TrackedZigzag after(swapped, "Z/2");
      REQUIRE(after.online == expected);
      REQUIRE(after.offline == expected);
    }
  }
  CHECK(moved > 100);
  CHECK(changed > 0);
}

TEST_CASE("large zigzags have the same bars while they go on and afterwards", "[zigzag]") {
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    ZigzagShape shape = shape_of(seed);
    shape.steps = 2000;
    shape.labels = 12 + seed;
    const std::vector<ZigzagStep> zigzag = tests::random_zigzag(seed, shape);
    for (const char* ring : {"Z/2", "Z/3", "Q"}) {
      CAPTURE(seed, ring);
      const TrackedZigzag tracked(zigzag, ring);
      REQUIRE(tracked.online == tracked.offline);
      REQUIRE(tracked.online.size() > 100);
    }
  }
}

TEST_CASE("boundaries have the pairs that coboundaries have", "[zigzag]") {
  const auto pairs_of = []<class R>(R ring, const engine::ZigzagFiltration& filtration, std::uint64_t most_entries) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    engine::FiltrationPairs<R>(ring, filtration, most_entries).for_each([&](std::uint32_t place, std::uint32_t killer) {
      pairs.emplace_back(place, killer);
    });
    return pairs;
  };
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    CAPTURE(seed);
    ZigzagShape shape = shape_of(seed);
    shape.steps = 1500;
    shape.labels = 14 + seed;
    engine::OfflineZigzag offline;
    ops::ZigzagComplex complex;
    const std::vector<ZigzagStep> zigzag = tests::random_zigzag(seed, shape);
    for (std::size_t k = 0; k < zigzag.size(); ++k) {
      tests::apply(zigzag[k], complex, {&offline}, {k, static_cast<double>(k)});
    }
    const engine::ZigzagFiltration filtration(offline);
    const auto require_same = [&](auto ring) {
      const auto pairs = pairs_of(ring, filtration, 64);
      REQUIRE(pairs_of(ring, filtration, 0) == pairs);
      REQUIRE(2 * pairs.size() > filtration.size());
    };
    require_same(sparse::Z2{});
    require_same(std::get<sparse::Zp>(sparse::parse_ring("Z/3").value()));
    require_same(sparse::Rationals{});
  }
}

TEST_CASE("a barcode that is asked for at the end is the same, remembered or handed over on the way", "[zigzag]") {
  std::size_t handed_over = 0, remembered = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    ZigzagShape shape = shape_of(seed);
    shape.steps = 4000;
    shape.labels = seed % 2 == 0 ? 5 : 25;  // few make small complexes, of which nothing is left soon
    shape.deletions_in_16 = 7;
    const std::vector<ZigzagStep> zigzag = tests::random_zigzag(seed, shape);
    for (const char* ring : {"Z/2", "Z/3", "Q"}) {
      CAPTURE(seed, ring);
      std::vector<PlainBar> bars;
      engine::DeferredZigzag deferred(sparse::parse_ring(ring).value(), [&](const engine::MomentBar& bar) {
        REQUIRE((bars.empty() || bars.back().death < 0 || tests::plain_bar(bar).death >= bars.back().death ||
                 tests::plain_bar(bar).death < 0));
        bars.push_back(tests::plain_bar(bar));
      });
      ops::ZigzagComplex complex;
      for (std::size_t k = 0; k < zigzag.size(); ++k) {
        tests::apply(zigzag[k], complex, {&deferred}, {k, static_cast<double>(k)});
      }
      deferred.finish();
      ++(deferred.is_online() ? handed_over : remembered);
      std::ranges::sort(bars);
      REQUIRE(bars == TrackedZigzag(zigzag, ring).online);
    }
  }
  CHECK(handed_over > 0);
  CHECK(remembered > 0);
}

TEST_CASE("columns of Z/2 that are kept as rows and as words add up as sets", "[zigzag]") {
  using Columns = engine::ReducedColumns<sparse::Z2>;
  constexpr std::uint32_t rows = 600'000;  // which has words of all levels
  Columns columns(sparse::Z2{}, rows, 40);
  std::vector<std::set<std::uint32_t>> plain;
  std::uint64_t state = 1;
  const auto draw = [&](std::uint64_t below) {
    state = state * 6364136223846793005 + 1442695040888963407;
    return static_cast<std::uint32_t>((state >> 33) % below);
  };
  for (std::uint32_t number = 0; number < 40; ++number) {
    CAPTURE(number);
    std::set<std::uint32_t> set;
    std::vector<engine::SignedRow> entries;
    const std::uint32_t begin = draw(rows - 1000);
    for (std::uint32_t k = 0; k < 300; ++k) {  // close together, or all over
      const std::uint32_t row = number % 2 == 0 ? begin + draw(900) : draw(rows);
      if (set.insert(row).second) {
        entries.emplace_back(row, false);
      }
    }
    columns.begin(entries);
    for (std::uint32_t other = 0; other < number; other += 1 + number / 4) {
      columns.eliminate(std::size_t{other});
      for (const std::uint32_t row : plain[other]) {
        if (!set.insert(row).second) {
          set.erase(row);
        }
      }
    }
    REQUIRE(columns.lead() == *set.rbegin());
    columns.store(number);
    REQUIRE(columns.lead() == Columns::no_row);
    REQUIRE(columns.has(number));
    plain.push_back(std::move(set));
  }
  for (std::uint32_t number = 0; number < 40; ++number) {
    columns.eliminate(std::size_t{number});
    for (std::set<std::uint32_t> left = plain[number]; !left.empty(); left.erase(std::prev(left.end()))) {
      REQUIRE(columns.lead() == *left.rbegin());
      columns.eliminate(std::vector<engine::SignedRow>{{*left.rbegin(), false}});
    }
    REQUIRE(columns.lead() == Columns::no_row);
  }
}

TEST_CASE("Betti numbers are those of the present complex, and what is held is its basis", "[zigzag]") {
  const std::vector<ZigzagStep> zigzag = tests::random_zigzag(7, {.steps = 60, .labels = 6, .contractions_in_16 = 2});
  const auto barcode = engine::make_online_zigzag_barcode(sparse::parse_ring("Z/3").value(), [](const auto&) {});
  ops::ZigzagComplex complex;
  PlainSimplices plain;
  for (std::size_t k = 0; k < zigzag.size(); ++k) {
    CAPTURE(k);
    tests::apply(zigzag[k], complex, {barcode.get()}, {k, static_cast<double>(k)});
    tests::carry_out(zigzag[k], plain);
    const std::vector<std::uint64_t> betti = barcode->betti();
    for (std::size_t d = 0; d < 4; ++d) {
      const tests::PlainHomology expected(plain, d, tests::PlainField{3});
      REQUIRE((d < betti.size() ? betti[d] : 0) == expected.classes.size());
    }
    const auto counts = complex.counts();
    REQUIRE(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) == plain.size());
  }
}

TEST_CASE("a stream on a complex that keeps its size keeps its memory", "[zigzag]") {
  const auto barcode = engine::make_online_zigzag_barcode(sparse::Z2{}, [](const auto&) {});
  ops::ZigzagComplex complex;
  std::uint64_t most_in_the_beginning = 0, most = 0;
  // A window of twenty steps over a strip of triangles that never ends.
  std::uint64_t k = 0;
  const auto apply = [&](char kind, std::vector<std::uint64_t> labels) {
    tests::apply({kind, std::move(labels)}, complex, {barcode.get()}, {k, static_cast<double>(k)});
    ++k;
  };
  for (std::uint64_t v = 0; v < 4000; ++v) {
    apply('i', {v});
    for (const std::uint64_t back : {std::uint64_t{1}, std::uint64_t{2}}) {
      if (v >= back) {
        apply('i', {v - back, v});
      }
    }
    if (v >= 2 && v % 3 != 0) {
      apply('i', {v - 2, v - 1, v});
    }
    if (v >= 20) {
      const std::uint64_t w = v - 20;
      if (complex.rules().contains(std::vector<std::uint64_t>{w, w + 1, w + 2})) {
        apply('d', {w, w + 1, w + 2});
      }
      apply('d', {w, w + 2});
      apply('d', {w, w + 1});
      apply('d', {w});
    }
    most = std::max(most, barcode->work().terms_held);
    most_in_the_beginning = v < 400 ? most : most_in_the_beginning;
  }
  CHECK(most <= most_in_the_beginning);
}

}  // namespace
}  // namespace sesame
