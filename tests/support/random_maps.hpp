/// \file
/// Random maps of both kinds, lawful by construction: pieces of one dimension less, some of them alike, sewn at random.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "tests/support/maps.hpp"
#include "tests/support/random_complexes.hpp"

namespace sesame::tests {

/// What a random map may be.
struct MapKind {
  int dimension = 2;
  bool closed = false;  ///< no dart is free
  bool folds = false;   ///< of a G-map: sewn to itself in every legal way
};

using DartPairs = std::vector<std::pair<Dart, Dart>>;

/// Pairs what a and b reach, dart by dart, as they must be when a is sewn to b: next(i, x) goes to other(i, y) for each
/// i below `generators`. Nothing when that is impossible. `no_dart` is paired with itself.
template <class Next, class Other>
std::optional<DartPairs> sewing(Dart size, Dart a, Dart b, int generators, Next next, Other other) {
  Images partner(size, no_dart);
  DartPairs found{{a, b}};
  partner[a] = b;
  for (std::size_t at = 0; at < found.size(); ++at) {
    const auto [x, y] = found[at];
    if (partner[y] != no_dart && partner[y] != x) {
      return std::nullopt;
    }
    partner[y] = x;
    for (int i = 0; i < generators; ++i) {
      const Dart to = next(i, x);
      const Dart opposite = other(i, y);
      if ((to == no_dart) != (opposite == no_dart)) {
        return std::nullopt;
      }
      if (to == no_dart || partner[to] == opposite) {
        continue;
      }
      if (partner[to] != no_dart) {
        return std::nullopt;
      }
      partner[to] = opposite;
      found.emplace_back(to, opposite);
    }
  }
  return found;
}

/// An involution without fixed points, or with some.
inline Images random_involution(Random& random, Dart size, bool with_fixed_points) {
  Images images = cycles(size, {});
  std::vector<Dart> rest = images;
  while (rest.size() > 1) {
    const Dart a = rest.back();
    rest.pop_back();
    const auto at = static_cast<std::size_t>(random.in(0, static_cast<int>(rest.size()) - 1));
    const Dart b = rest[at];
    if (!with_fixed_points || !random.one_in(4)) {
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at));
      images[a] = b;
      images[b] = a;
    }
  }
  return images;
}

/// A random dart that a predicate chooses among those that it is asked of, or none.
template <class Chosen>
Dart random_dart(Random& random, Dart size, Chosen chosen) {
  const Dart d = static_cast<Dart>(random.in(0, static_cast<int>(size) - 1));
  return chosen(d) ? d : no_dart;
}

/// One map, or a few like it beside each other when that remains small.
template <class Map>
Map some_copies(Random& random, const Map& map) {
  Map copies = map;
  for (int more = random.in(0, 2); more > 0 && copies.size() + map.size() <= 40; --more) {
    copies = ops::disjoint_union(copies, map);
  }
  return copies;
}

/// From none at all to more than it takes to sew all that can be sewn.
inline int tries_of(Random& random, Dart size) { return random.in(0, 2) * random.in(1, 2 * static_cast<int>(size)); }

/// Sews pairs of darts by the last involution, as often as it can be done among some tries.
inline GMap sewn_at_random(Random& random, const GMap& map, bool folds) {
  const int n = map.dimension();
  Lists alpha = map.involutions();
  Images& last = alpha.back();
  const ops::Orbits sides = ops::orbits(map, (ops::IndexSet{1} << (n - 1)) - 1);
  const auto step = [&](int i, Dart d) { return alpha[static_cast<std::size_t>(i)][d]; };
  const auto is_free = [&](Dart d) { return last[d] == d; };
  for (int tries = tries_of(random, map.size()); tries > 0; --tries) {
    const Dart a = random_dart(random, map.size(), is_free);
    const Dart b = random_dart(random, map.size(), is_free);
    if (a == no_dart || b == no_dart || a == b) {
      continue;
    }
    if (const auto pairs = sewing(map.size(), a, b, n - 1, step, step); pairs && (folds || !sides.join(a, b))) {
      for (const auto& [x, y] : *pairs) {
        last[x] = y;
        last[y] = x;
      }
    }
  }
  return made(GMap::make(std::move(alpha)));
}

/// A map and its twin, sewn wherever it was free of the last involution.
inline GMap closed_by_twin(const GMap& map) {
  Lists alpha = ops::disjoint_union(map, map).involutions();
  for (Dart d = 0; d < map.size(); ++d) {
    if (alpha.back()[d] == d) {
      alpha.back()[d] = d + map.size();
      alpha.back()[d + map.size()] = d;
    }
  }
  return made(GMap::make(std::move(alpha)));
}

/// Requires: dimension >= 0.
inline GMap random_gmap(Random& random, MapKind kind) {
  if (kind.dimension == 0) {
    const Dart size = 2 * static_cast<Dart>(random.in(1, 3));
    return made(GMap::make({random_involution(random, size, !kind.closed && random.one_in(2))}));
  }
  MapKind pieces = kind;
  --pieces.dimension;
  pieces.closed = kind.closed || random.one_in(2);
  GMap map = some_copies(random, random_gmap(random, pieces));
  map = sewn_at_random(random, raised(map), kind.folds);
  return kind.closed ? closed_by_twin(map) : map;
}

/// A permutation, or a partial one.
inline Images random_permutation(Random& random, Dart size, bool whole) {
  Images images = cycles(size, {});
  for (Dart d = size; d > 1; --d) {
    std::swap(images[d - 1], images[static_cast<std::size_t>(random.in(0, static_cast<int>(d) - 1))]);
  }
  for (Dart& image : images) {
    image = !whole && random.one_in(4) ? no_dart : image;
  }
  return images;
}

inline NMap sewn_at_random(Random& random, const NMap& map) {
  const int n = map.dimension();
  Lists beta = map.images();
  Images& last = beta.back();
  // The other side runs backwards: what beta_1 leads to is sewn to what beta_0 leads to. In dimension 2 nothing
  // follows.
  const auto next = [&](int i, Dart d) { return map.beta(i, d); };
  const auto other = [&](int i, Dart d) { return map.beta(i <= 1 ? 1 - i : i, d); };
  const auto is_free = [&](Dart d) { return last[d] == no_dart; };
  for (int tries = tries_of(random, map.size()); tries > 0; --tries) {
    const Dart a = random_dart(random, map.size(), is_free);
    const Dart b = random_dart(random, map.size(), is_free);
    if (a == no_dart || b == no_dart || a == b) {
      continue;
    }
    const auto pairs = sewing(map.size(), a, b, n > 2 ? n - 1 : 0, next, other);
    if (!pairs || std::ranges::any_of(*pairs, [](const auto& pair) { return pair.first == pair.second; })) {
      continue;
    }
    for (const auto& [x, y] : *pairs) {
      last[x] = y;
      last[y] = x;
    }
  }
  return made(NMap::make(std::move(beta)));
}

inline NMap closed_by_twin(const NMap& map) {
  Lists beta = ops::disjoint_union(map, map.inverse()).images();
  for (Dart d = 0; d < map.size(); ++d) {
    if (beta.back()[d] == no_dart) {
      beta.back()[d] = d + map.size();
      beta.back()[d + map.size()] = d;
    }
  }
  return made(NMap::make(std::move(beta)));
}

/// Requires: dimension >= 1.
inline NMap random_nmap(Random& random, MapKind kind) {
  if (kind.dimension == 1) {
    const Dart size = static_cast<Dart>(random.in(1, 6));
    return made(NMap::make({random_permutation(random, size, kind.closed || random.one_in(3))}));
  }
  MapKind pieces = kind;
  --pieces.dimension;
  pieces.closed = kind.closed || random.one_in(3);
  NMap map = some_copies(random, random_nmap(random, pieces));
  map = sewn_at_random(random, raised(map));
  return kind.closed ? closed_by_twin(map) : map;
}

/// One component of a map.
inline GMap component_of(const GMap& map, Dart start) {
  const Images darts = ops::OrbitWalk{map}.from(start, map.indices());
  Images number(map.size(), no_dart);
  for (Dart d = 0; d < darts.size(); ++d) {
    number[darts[d]] = d;
  }
  Lists alpha;
  for (int i = 0; i <= map.dimension(); ++i) {
    alpha.emplace_back();
    for (const Dart d : darts) {
      alpha.back().push_back(number[map.alpha(i, d)]);
    }
  }
  return made(GMap::make(std::move(alpha)));
}
inline NMap component_of(const NMap& map, Dart start) {
  const ops::Orbits parts = ops::components(map);
  Images darts;
  Images number(map.size(), no_dart);
  for (Dart d = 0; d < map.size(); ++d) {
    if (parts.join(d, start)) {
      number[d] = static_cast<Dart>(darts.size());
      darts.push_back(d);
    }
  }
  Lists beta;
  for (int i = 1; i <= map.dimension(); ++i) {
    beta.emplace_back();
    for (const Dart d : darts) {
      beta.back().push_back(map.is_free(i, d) ? no_dart : number[map.beta(i, d)]);
    }
  }
  return made(NMap::make(std::move(beta)));
}

}  // namespace sesame::tests
