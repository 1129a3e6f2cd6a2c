#include "replay/zigzag/zigzag_history.hpp"

#include <map>
#include <sstream>
#include <string>

#include "replay/zigzag/zigzag_replay.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/plain_zigzags.hpp"

namespace sesame::replay {
namespace {

using tests::PlainBar;
using tests::PlainField;
using tests::PlainHomology;
using tests::PlainRows;
using tests::PlainSimplex;
using tests::PlainSimplices;
using tests::PlainVector;
using tests::ZigzagShape;
using tests::ZigzagStep;

/// A chain by the labels of its simplices, which ascend.
using PlainChain = std::map<PlainSimplex, std::int64_t>;

/// A bar with its cycle after each operation, from that of the birth to the one before the death.
struct PlainCycles {
  PlainBar bar;
  std::vector<PlainChain> cycles;
};

PlainChain plain_chain(const NamedChain& chain, const PlainField& field) {
  PlainChain plain;
  for (const auto& [coefficient, name] : chain.terms) {
    const std::int64_t denominator = field.reduced(coefficient.denominator().to_int64().value());
    const std::int64_t value = field.reduced(coefficient.numerator().to_int64().value());
    plain[name] = field.reduced(value * field.inverse(denominator));
  }
  REQUIRE(plain.size() == chain.terms.size());
  return plain;
}

/// The cycles that are told of a zigzag whose operation k happens at time k / `at_once`, with the times as numbers.
std::vector<PlainCycles> told_cycles(const std::vector<ZigzagStep>& zigzag, const std::string& ring_name,
                                     const PlainField& field, std::int64_t at_once = 1) {
  const sparse::AnyRing ring = sparse::parse_ring(ring_name).value();
  ZigzagHistory history(std::visit([](const auto& r) { return r.characteristic(); }, ring));
  const auto end = static_cast<std::int64_t>((zigzag.size() - 1) / static_cast<std::size_t>(at_once)) + 1;
  std::vector<PlainCycles> told;
  const auto take = [&](const engine::MomentBar& bar, const engine::ZigzagBarcode::Pieces& pieces) {
    if (bar.birth.time == bar.death.time) {
      return;
    }
    const auto number = [](engine::Time time) { return static_cast<std::int64_t>(time.nearest()); };
    const bool is_open = bar.death.time == engine::never;
    PlainCycles each{{bar.dimension, number(bar.birth.time), is_open ? -1 : number(bar.death.time)}, {}};
    const std::vector<engine::CyclePiece> unnamed = pieces();
    REQUIRE(unnamed.front().from.operation == bar.birth.operation);
    REQUIRE(unnamed.back().from.operation < bar.death.operation);
    engine::Time at = bar.birth.time;
    for (const NamedPiece& piece : history.named(bar, unnamed)) {
      REQUIRE(piece.from == at);
      REQUIRE(piece.until > piece.from);
      at = piece.until;
      const std::int64_t until = piece.until == engine::never ? end : number(piece.until);
      each.cycles.resize(each.cycles.size() + static_cast<std::size_t>(until - number(piece.from)),
                         plain_chain(piece.cycle, field));
    }
    REQUIRE(at == bar.death.time);
    told.push_back(std::move(each));
  };
  const auto barcode = engine::make_online_zigzag_barcode(
      ring, [](const auto&) {}, take, [](int) { return true; });
  ZigzagReplay replay({barcode.get()}, engine::all_dimensions, &history);
  for (std::size_t k = 0; k < zigzag.size(); ++k) {
    const auto kind = zigzag[k].kind == 'i'   ? TowerOperation::Kind::insert
                      : zigzag[k].kind == 'd' ? TowerOperation::Kind::remove
                                              : TowerOperation::Kind::contract;
    const auto time = static_cast<std::int64_t>(k) / at_once;
    REQUIRE(replay.apply({kind, time, static_cast<int>(zigzag[k].labels.size()) - 1, zigzag[k].labels}).has_value());
  }
  barcode->for_each_open_cycle(take);
  std::ranges::stable_sort(told, {}, &PlainCycles::bar);
  return told;
}

/// Where a map of vertices sends a chain.
PlainChain sent(const PlainChain& chain, const ZigzagStep& step, const PlainField& field) {
  if (step.kind != 'c') {
    return chain;
  }
  PlainChain image;
  for (const auto& [simplex, coefficient] : chain) {
    PlainSimplex to = simplex;
    std::ranges::replace(to, step.labels[0], step.labels[1]);
    std::int64_t sign = 1;
    for (std::size_t k = 0; k < to.size(); ++k) {
      for (std::size_t j = 0; j < k; ++j) {
        sign = to[j] == to[k] ? 0 : to[j] > to[k] ? -sign : sign;
      }
    }
    std::ranges::sort(to);
    if (sign != 0) {
      image[to] = field.reduced(image[to] + sign * coefficient);
    }
  }
  return image;
}

/// Of a cycle; whatever is none throws.
PlainVector class_of(const PlainChain& chain, const PlainHomology& homology, const PlainField& field) {
  PlainVector vector(homology.numbers.size(), 0);
  for (const auto& [simplex, coefficient] : chain) {
    vector[homology.numbers.at(simplex)] = coefficient;
  }
  return homology.class_of(vector, field);
}

/// The classes of a bar's cycles are those of an interval: each is sent to the next one, or comes from it, and at the
/// ends to 0 where a map leads out of the interval.
void check_interval(const PlainCycles& each, const std::vector<ZigzagStep>& zigzag,
                    const std::vector<PlainHomology>& groups, const PlainField& field) {
  const auto birth = static_cast<std::size_t>(each.bar.birth);
  const std::size_t death = birth + each.cycles.size();
  const auto cycle = [&](std::size_t k) { return k < birth || k >= death ? PlainChain{} : each.cycles[k - birth]; };
  for (std::size_t k = birth; k <= death && k < groups.size(); ++k) {
    CAPTURE(k);
    if (k == 0 || (k == death && zigzag[k].kind == 'd') || (k == birth && zigzag[k].kind != 'd')) {
      continue;  // nothing comes before, or no map leads out
    }
    const std::size_t at = zigzag[k].kind == 'd' ? k - 1 : k;
    const PlainChain before = zigzag[k].kind == 'd' ? cycle(k - 1) : sent(cycle(k - 1), zigzag[k], field);
    REQUIRE(class_of(before, groups[at], field) == class_of(cycle(k), groups[at], field));
  }
}

/// After each operation the cycles of the bars that are alive are a basis.
void check_bases(const std::vector<PlainCycles>& told, std::size_t dimension, const std::vector<PlainHomology>& groups,
                 const PlainField& field) {
  for (std::size_t k = 0; k < groups.size(); ++k) {
    CAPTURE(k);
    PlainRows classes;
    for (const PlainCycles& each : told) {
      const auto birth = static_cast<std::size_t>(each.bar.birth);
      if (each.bar.dimension == static_cast<int>(dimension) && birth <= k && k < birth + each.cycles.size()) {
        classes.push_back(class_of(each.cycles[k - birth], groups[k], field));
      }
    }
    REQUIRE(classes.size() == groups[k].classes.size());
    REQUIRE(field.rank(classes) == classes.size());
  }
}

std::vector<PlainHomology> groups_of(const std::vector<ZigzagStep>& zigzag, std::size_t dimension,
                                     const PlainField& field, std::size_t at_once = 1) {
  std::vector<PlainHomology> groups;
  PlainSimplices complex;
  for (std::size_t k = 0; k < zigzag.size(); ++k) {
    tests::carry_out(zigzag[k], complex);
    if ((k + 1) % at_once == 0 || k + 1 == zigzag.size()) {
      groups.emplace_back(complex, dimension, field);
    }
  }
  return groups;
}

/// What is told over a ring, looked at modulo p, is an interval decomposition.
void check_decomposition(const std::vector<PlainCycles>& told, const std::vector<ZigzagStep>& zigzag,
                         const PlainField& field) {
  for (std::size_t dimension = 0; dimension < 4; ++dimension) {
    const std::vector<PlainHomology> groups = groups_of(zigzag, dimension, field);
    check_bases(told, dimension, groups, field);
    for (const PlainCycles& each : told) {
      if (each.bar.dimension == static_cast<int>(dimension)) {
        CAPTURE(each.bar.dimension, each.bar.birth, each.bar.death);
        check_interval(each, zigzag, groups, field);
      }
    }
  }
}

/// The same, and has the bars of the definition. Returns how many cycles differ from those an operation before.
std::size_t check_cycles(const std::vector<ZigzagStep>& zigzag, const std::string& ring, std::int64_t p) {
  const PlainField field{p};
  const std::vector<PlainCycles> told = told_cycles(zigzag, ring, field);
  std::vector<PlainBar> bars;
  std::ranges::transform(told, std::back_inserter(bars), &PlainCycles::bar);
  REQUIRE(bars == tests::plain_zigzag_bars(zigzag, p));
  check_decomposition(told, zigzag, field);
  std::size_t changes = 0;
  for (const PlainCycles& each : told) {
    for (std::size_t k = 1; k < each.cycles.size(); ++k) {
      changes += each.cycles[k] != each.cycles[k - 1] ? 1 : 0;
    }
  }
  return changes;
}

ZigzagShape shape_with_contractions(std::uint32_t seed) {
  return {.steps = 20 + seed % 40,
          .labels = 4 + seed % 4,
          .most_vertices_of_simplex = 3 + seed % 2,
          .deletions_in_16 = 3 + seed % 5,
          .contractions_in_16 = seed % 3};
}

constexpr std::int64_t large_prime = 103;  // a fraction that is wrong is so modulo it, too, almost certainly

TEST_CASE("the cycles of the bars of small zigzags are interval decompositions", "[zigzag]") {
  std::size_t changes = 0;
  for (std::uint32_t seed = 0; seed < 120; ++seed) {
    const std::vector<ZigzagStep> zigzag = tests::random_zigzag(seed, shape_with_contractions(seed));
    CAPTURE(seed);
    changes += check_cycles(zigzag, "Z/2", 2);
    changes += check_cycles(zigzag, "Z/3", 3);
    changes += check_cycles(zigzag, "Q", large_prime);
  }
  CHECK(changes > 300);
}

TEST_CASE("cycles of a long zigzag are right when parts of pasts have gone", "[zigzag]") {
  const PlainField field{3};
  for (std::uint32_t seed = 0; seed < 2; ++seed) {
    CAPTURE(seed);
    const std::vector<ZigzagStep> zigzag =
        tests::random_zigzag(seed, {.steps = 2500, .labels = 7, .deletions_in_16 = 5, .contractions_in_16 = 0});
    check_decomposition(told_cycles(zigzag, "Z/3", field), zigzag, field);
  }
}

TEST_CASE("after operations at one time the cycles are a basis of the last complex", "[zigzag]") {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const std::vector<ZigzagStep> zigzag = tests::random_zigzag(seed, shape_with_contractions(seed));
    for (const std::size_t at_once : {std::size_t{2}, std::size_t{5}}) {
      CAPTURE(seed, at_once);
      const PlainField field{3};
      const std::vector<PlainCycles> told = told_cycles(zigzag, "Z/3", field, static_cast<std::int64_t>(at_once));
      for (std::size_t dimension = 0; dimension < 4; ++dimension) {
        check_bases(told, dimension, groups_of(zigzag, dimension, field, at_once), field);
      }
    }
  }
}

}  // namespace
}  // namespace sesame::replay
