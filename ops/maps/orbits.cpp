#include "ops/maps/orbits.hpp"

namespace sesame::ops {
namespace {

/// Appends what is reached from the last dart of a list, each once.
template <class IsNew>
void walk(const GMap& map, IndexSet generators, std::vector<Dart>& found, IsNew is_new) {
  for (std::size_t at = found.size() - 1; at < found.size(); ++at) {
    for (int i = 0; i <= map.dimension(); ++i) {
      if ((generators >> i & 1U) == 0) {
        continue;
      }
      if (const Dart next = map.alpha(i, found[at]); is_new(next)) {
        found.push_back(next);
      }
    }
  }
}

}  // namespace

Orbits orbits(const GMap& map, IndexSet generators) {
  Orbits all;
  all.of.assign(map.size(), no_dart);
  std::vector<Dart> found;
  for (Dart d = 0; d < map.size(); ++d) {
    if (all.of[d] != no_dart) {
      continue;
    }
    const std::uint32_t number = all.count();
    all.first.push_back(d);
    all.of[d] = number;
    found.assign(1, d);
    walk(map, generators, found, [&](Dart next) {
      const bool is_new = all.of[next] == no_dart;
      all.of[next] = number;
      return is_new;
    });
  }
  return all;
}

Orbits cells(const GMap& map, int i) { return orbits(map, map.indices() & ~(IndexSet{1} << i)); }

Orbits components(const GMap& map) { return orbits(map, map.indices()); }

bool is_connected(const GMap& map) { return components(map).count() == 1; }

std::vector<Dart> OrbitWalk::from(Dart start, IndexSet generators) {
  std::vector<Dart> found{start};
  met_[start] = true;
  walk(map_, generators, found, [&](Dart next) {
    const bool is_new = !met_[next];
    met_[next] = true;
    return is_new;
  });
  for (const Dart d : found) {
    met_[d] = false;
  }
  return found;
}

}  // namespace sesame::ops
