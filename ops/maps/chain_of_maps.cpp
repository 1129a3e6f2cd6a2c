#include "ops/maps/chain_of_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>
#include <utility>

#include "ops/maps/cell_errors.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

using Images = std::vector<Dart>;

/// alpha_0, ..., alpha_{i-1}.
IndexSet indices_below(int i) { return i <= 0 ? 0 : (IndexSet{1} << i) - 1; }

Status check_images(const Images& sigma, int i, const GMap& level, const GMap& below) {
  if (sigma.size() != level.size()) {
    return bad_cells(fmt::format("sigma_{0} has {1} images, but level {0} has {2} darts: each has one", i, sigma.size(),
                                 level.size()));
  }
  for (Dart d = 0; d < level.size(); ++d) {
    if (sigma[d] >= below.size()) {
      return bad_cells(fmt::format("sigma_{} sends dart {} to {}, but level {} has only {} darts", i, d, sigma[d],
                                   i - 1, below.size()));
    }
  }
  return Done{};
}

/// (a), first half: sigma_i goes with the involutions.
Status check_morphism(const Images& sigma, int i, const GMap& level, const GMap& below) {
  for (int j = 0; j + 2 <= i; ++j) {
    for (Dart d = 0; d < level.size(); ++d) {
      if (sigma[level.alpha(j, d)] != below.alpha(j, sigma[d])) {
        return bad_cells(
            fmt::format("condition (a): from dart {0} of level {1}, alpha_{2} and then sigma_{1} lead to dart "
                        "{3}, but sigma_{1} and then alpha_{2} to {4}",
                        d, i, j, sigma[level.alpha(j, d)], below.alpha(j, sigma[d])));
      }
    }
  }
  return Done{};
}

/// (a), second half: sigma_i is injective on orbits; then it is onto one by the first half.
Status check_injective(const Images& sigma, int i, const GMap& level) {
  const Orbits faces = orbits(level, indices_below(i - 1));
  std::vector<Dart> darts(level.size());
  std::iota(darts.begin(), darts.end(), Dart{0});
  const auto place = [&](Dart d) { return std::pair(faces.of[d], sigma[d]); };
  std::ranges::stable_sort(darts, {}, place);
  if (const auto twice = std::ranges::adjacent_find(darts, {}, place); twice != darts.end()) {
    return bad_cells(
        fmt::format("condition (a): sigma_{} sends both dart {} and dart {} of level {} to {}, though one face "
                    "has both: no cell may be folded",
                    i, twice[0], twice[1], i, sigma[twice[0]]));
  }
  return Done{};
}

/// (b).
Status check_faces_of_faces(const Images& sigma, const Images& sigma_below, int i, const GMap& level) {
  for (Dart d = 0; d < level.size(); ++d) {
    const Dart one = sigma_below[sigma[d]];
    const Dart other = sigma_below[sigma[level.alpha(i - 1, d)]];
    if (one != other) {
      return bad_cells(
          fmt::format("condition (b): sigma_{0} sigma_{1} lead from dart {2} of level {0} to dart {3}, but from "
                      "its image by alpha_{1}, dart {4}, to {5}",
                      i, i - 1, d, one, level.alpha(i - 1, d), other));
    }
  }
  return Done{};
}

/// Some darts of a map that its involutions permute.
GMap restricted_to(const GMap& map, const std::vector<Dart>& darts) {
  if (map.dimension() < 0) {
    return GMap::points(static_cast<Dart>(darts.size()));
  }
  std::vector<Dart> place(map.size(), no_dart);
  for (std::size_t at = 0; at < darts.size(); ++at) {
    place[darts[at]] = static_cast<Dart>(at);
  }
  std::vector<Images> alpha(static_cast<std::size_t>(map.dimension() + 1));
  for (int j = 0; j <= map.dimension(); ++j) {
    std::ranges::transform(darts, std::back_inserter(alpha[static_cast<std::size_t>(j)]),
                           [&](Dart d) { return place[map.alpha(j, d)]; });
  }
  return std::move(*GMap::make(std::move(alpha)));
}

/// (a) and (b) for sigma_i, i >= 2.
Status check_conditions(const std::vector<GMap>& levels, const std::vector<Images>& sigma, int i) {
  const auto at = static_cast<std::size_t>(i);
  if (Status s = check_morphism(sigma[at - 1], i, levels[at], levels[at - 1]); !s) {
    return s;
  }
  if (Status s = check_injective(sigma[at - 1], i, levels[at]); !s) {
    return s;
  }
  return check_faces_of_faces(sigma[at - 1], sigma[at - 2], i, levels[at]);
}

}  // namespace

Result<ChainOfMaps> ChainOfMaps::make(std::vector<GMap> levels, std::vector<std::vector<Dart>> sigma) {
  if (sigma.size() != (levels.empty() ? 0 : levels.size() - 1)) {
    return bad_cells(
        fmt::format("{} levels have {} lists of faces: each but level 0 has one", levels.size(), sigma.size()));
  }
  for (int i = 0; i < static_cast<int>(levels.size()); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (levels[at].dimension() != i - 1) {
      return bad_cells(fmt::format("level {} has {} involutions: alpha_0 to alpha_{} would be right, {} of them", i,
                                   levels[at].dimension() + 1, i - 1, i));
    }
    if (i >= 1) {
      if (Status s = check_images(sigma[at - 1], i, levels[at], levels[at - 1]); !s) {
        return s.error();
      }
    }
    if (i >= 2) {
      if (Status s = check_conditions(levels, sigma, i); !s) {
        return s.error();
      }
    }
  }
  ChainOfMaps chain;
  chain.levels_ = std::move(levels);
  chain.sigma_ = std::move(sigma);
  return chain;
}

Dart ChainOfMaps::lowered(Dart d, int from, int to) const {
  for (int i = from; i > to; --i) {
    d = sigma(i, d);
  }
  return d;
}

std::vector<std::uint32_t> ChainOfMaps::cell_counts() const {
  std::vector<std::uint32_t> counts;
  for (int i = 0; i <= dimension(); ++i) {
    counts.push_back(cells(i).count());
  }
  return counts;
}

GMap ChainOfMaps::canonical_boundary(int i, Dart d) const {
  sparse::expects(i >= 0 && i <= dimension() && d < level(i).size(), "a cell is named by a dart of its level");
  std::vector<Dart> darts = OrbitWalk(level(i)).from(d, level(i).indices());
  std::ranges::sort(darts);
  return restricted_to(level(i), darts);
}

Orbits orbits_numbered(const ChainOfMaps& chain, IndexSet numbers) {
  const GMap& level = chain.level(static_cast<int>(std::bit_width(numbers)) - 1);
  return orbits(level, level.indices() & ~numbers);
}

NumberedSet simplicial_analogue(const ChainOfMaps& chain) {
  return set_of_orbits(
      chain.dimension(), [&](IndexSet set) { return orbits_numbered(chain, set); },
      [&](Dart d, int from, int to) { return chain.lowered(d, from, to); });
}

}  // namespace sesame::ops
