#include "ops/maps/chain_operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "ops/maps/cell_errors.hpp"

namespace sesame::ops {
namespace {

using Images = std::vector<Dart>;

/// alpha_{i+1}, ..., alpha_n.
IndexSet indices_above(const GMap& map, int i) { return map.indices() & ~((IndexSet{2} << i) - 1); }

GMap level_or_none(const ChainOfMaps& chain, int i) {
  if (i <= chain.dimension()) {
    return chain.level(i);
  }
  return i == 0 ? GMap::points(0) : std::move(*GMap::make(std::vector<Images>(static_cast<std::size_t>(i))));
}

/// A map of dimension i-1 on orbits, or on other classes, that its involutions permute.
GMap quotient(const GMap& map, int i, const Images& of, const std::vector<Dart>& first) {
  if (i == 0) {
    return GMap::points(static_cast<Dart>(first.size()));
  }
  std::vector<Images> alpha(static_cast<std::size_t>(i));
  for (int j = 0; j < i; ++j) {
    std::ranges::transform(first, std::back_inserter(alpha[static_cast<std::size_t>(j)]),
                           [&](Dart d) { return of[map.alpha(j, d)]; });
  }
  return std::move(*GMap::make(std::move(alpha)));
}

/// The dart of level n beside each: the other one with the same face, or itself.
Result<Images> joined_by_faces(const ChainOfMaps& chain) {
  const int n = chain.dimension();
  Images joined(chain.level(n).size());
  std::iota(joined.begin(), joined.end(), Dart{0});
  if (n == 0) {
    return joined;
  }
  Images earlier(chain.level(n - 1).size(), no_dart);  // with that face
  for (Dart d = 0; d < joined.size(); ++d) {
    const Dart face = chain.sigma(n, d);
    if (earlier[face] == no_dart) {
      earlier[face] = d;
    } else if (joined[earlier[face]] == earlier[face]) {
      joined[d] = std::exchange(joined[earlier[face]], d);
    } else {
      return refused_cells(
          fmt::format("dart {} of level {} is the face of the darts {}, {} and {}: of two at most, where the "
                      "cells are assembled to a quasi-manifold",
                      face, n - 1, earlier[face], joined[earlier[face]], d));
    }
  }
  return joined;
}

/// That the darts of level i are the orbits of the involutions above.
Status check_orbits(const ChainOfMaps& chain, const GMap& map, int i) {
  const Orbits parts = orbits(map, indices_above(map, i));
  Images found(chain.level(i).size(), no_dart);  // the first dart above
  for (const Dart d : parts.first) {
    const Dart below = chain.lowered(d, chain.dimension(), i);
    if (found[below] != no_dart) {
      return refused_cells(
          fmt::format("dart {} of level {} lies below the darts {} and {} of level {}, which no gluing along "
                      "cells of dimension {} joins around it: this is no quasi-manifold",
                      below, i, found[below], d, chain.dimension(), chain.dimension() - 1));
    }
    found[below] = d;
  }
  if (const auto lost = std::ranges::find(found, no_dart); lost != found.end()) {
    return refused_cells(
        fmt::format("dart {} of level {} lies below no dart of level {}: in a quasi-manifold all cells are "
                    "cells of dimension {} or lie in the boundary of one",
                    lost - found.begin(), i, chain.dimension(), chain.dimension()));
  }
  return Done{};
}

using Pairs = std::vector<std::pair<Dart, Dart>>;

/// The darts of two components that correspond, when two of them do.
Result<Pairs> correspondence(const GMap& level, Dart one, Dart other) {
  Images partner(level.size(), no_dart);
  Pairs pairs{{one, other}};
  partner[one] = other;
  for (std::size_t at = 0; at < pairs.size(); ++at) {
    const auto [d, e] = pairs[at];
    for (int j = 0; j <= level.dimension(); ++j) {
      const Dart next = level.alpha(j, d);
      const Dart expected = level.alpha(j, e);
      if (partner[next] == no_dart) {
        partner[next] = expected;
        pairs.emplace_back(next, expected);
      } else if (partner[next] != expected) {
        return refused_cells(
            fmt::format("dart {0} corresponds to dart {1}, but by alpha_{2} they lead to darts {3} and {4}, "
                        "and dart {3} corresponds to {5}",
                        d, e, j, next, expected, partner[next]));
      }
    }
  }
  return pairs;
}

/// The pairs that are to be one: by two darts of one level.
Result<Pairs> pairs_of_cells(const GMap& level, Dart one, Dart other) {
  const Orbits cells = components(level);
  if (cells.join(one, other)) {
    return refused_cells(fmt::format("darts {} and {} are of one cell: a cell is glued to another one", one, other));
  }
  Result<Pairs> pairs = correspondence(level, one, other);
  if (!pairs) {
    return pairs;
  }
  const auto size = [&](Dart d) { return std::ranges::count(cells.of, cells.of[d]); };
  if (size(one) != size(other)) {
    return refused_cells(
        fmt::format("the cells of darts {} and {} have {} and {} darts", one, other, size(one), size(other)));
  }
  return pairs;
}

/// Darts that are one when pairs are.
Orbits classes(Dart size, const Pairs& pairs) {
  Images parent(size);
  std::iota(parent.begin(), parent.end(), Dart{0});
  const auto root = [&](Dart d) {
    while (parent[d] != d) {
      d = parent[d] = parent[parent[d]];
    }
    return d;
  };
  for (const auto& [one, other] : pairs) {
    const auto [least, greatest] = std::minmax({root(one), root(other)});
    parent[greatest] = least;
  }
  Orbits found;
  for (Dart d = 0; d < size; ++d) {
    if (root(d) == d) {
      found.of.push_back(found.count());
      found.first.push_back(d);
    } else {
      found.of.push_back(found.of[root(d)]);
    }
  }
  return found;
}

}  // namespace

ChainOfMaps disjoint_union(const ChainOfMaps& a, const ChainOfMaps& b) {
  std::vector<GMap> levels;
  std::vector<Images> sigma;
  for (int i = 0; i <= std::max(a.dimension(), b.dimension()); ++i) {
    const GMap of_a = level_or_none(a, i);
    const GMap of_b = level_or_none(b, i);
    if (i > 0) {
      Images& images = sigma.emplace_back();
      for (Dart d = 0; d < of_a.size(); ++d) {
        images.push_back(a.sigma(i, d));
      }
      for (Dart d = 0; d < of_b.size(); ++d) {
        images.push_back(level_or_none(a, i - 1).size() + b.sigma(i, d));
      }
    }
    levels.push_back(disjoint_union(of_a, of_b));
  }
  return std::move(*ChainOfMaps::make(std::move(levels), std::move(sigma)));
}

Result<ChainOfMaps> chain_of_gmap(const GMap& map) {
  if (map.dimension() < 0) {
    return bad_cells("a map of dimension -1 has no cells that a chain of maps could have");
  }
  std::vector<GMap> levels;
  std::vector<Images> sigma;
  Images below;  // per dart of the map: its dart of the level below
  for (int i = 0; i <= map.dimension(); ++i) {
    Orbits parts = orbits(map, indices_above(map, i));
    if (i > 0) {
      std::ranges::transform(parts.first, std::back_inserter(sigma.emplace_back()), [&](Dart d) { return below[d]; });
    }
    levels.push_back(quotient(map, i, parts.of, parts.first));
    below = std::move(parts.of);
  }
  Result<ChainOfMaps> chain = ChainOfMaps::make(std::move(levels), std::move(sigma));
  if (!chain) {
    return refused_cells("the map has a cell that is sewn to itself, which no chain of maps has: " +
                         chain.error().what);
  }
  return chain;
}

Result<GMap> gmap_of_chain(const ChainOfMaps& chain) {
  const int n = chain.dimension();
  if (n < 0) {
    return bad_cells("a chain of maps without levels comes from no map");
  }
  Result<Images> joined = joined_by_faces(chain);
  if (!joined) {
    return joined.error();
  }
  std::vector<Images> alpha = chain.level(n).involutions();
  alpha.push_back(std::move(*joined));
  Result<GMap> map = GMap::make(std::move(alpha));
  if (!map) {
    return map;
  }
  for (int i = n - 1; i >= 0; --i) {
    if (Status s = check_orbits(chain, *map, i); !s) {
      return s.error();
    }
  }
  return map;
}

Result<GluedChain> glue_cells(const ChainOfMaps& chain, int i, Dart one, Dart other) {
  if (i < 0 || i > chain.dimension() || one >= chain.level(i).size() || other >= chain.level(i).size()) {
    return bad_cells(fmt::format("there are no darts {} and {} of level {}", one, other, i));
  }
  Result<Pairs> pairs = pairs_of_cells(chain.level(i), one, other);
  if (!pairs) {
    return refused_cells(fmt::format("{}-cells cannot be glued: {}", i, pairs.error().what));
  }
  std::vector<GMap> levels(static_cast<std::size_t>(chain.dimension()) + 1);
  std::vector<Orbits> glued(levels.size());
  for (int k = chain.dimension(); k >= 0; --k) {
    const auto at = static_cast<std::size_t>(k);
    glued[at] = classes(chain.level(k).size(), k > i ? Pairs{} : *pairs);
    levels[at] = quotient(chain.level(k), k, glued[at].of, glued[at].first);
    if (k <= i && k > 0) {
      for (auto& [d, e] : *pairs) {
        d = chain.sigma(k, d);
        e = chain.sigma(k, e);
      }
    }
  }
  std::vector<Images> sigma;
  for (int k = 1; k <= chain.dimension(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    std::ranges::transform(glued[at].first, std::back_inserter(sigma.emplace_back()),
                           [&](Dart d) { return glued[at - 1].of[chain.sigma(k, d)]; });
  }
  Result<ChainOfMaps> result = ChainOfMaps::make(std::move(levels), std::move(sigma));
  if (!result) {
    return refused_cells(fmt::format("{}-cells cannot be glued: in the result, {}", i, result.error().what));
  }
  GluedChain answer{std::move(*result), {}};
  for (Orbits& each : glued) {
    answer.image.push_back(std::move(each.of));
  }
  return answer;
}

}  // namespace sesame::ops
