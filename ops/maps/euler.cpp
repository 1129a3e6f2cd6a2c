#include "ops/maps/euler.hpp"

#include <bit>

namespace sesame::ops {
namespace {

/// Calls each(I, orbits) for every non-empty set of numbers I: the simplices that have them.
template <class Each>
void for_each_family(const GMap& map, Each each) {
  for (IndexSet numbers = 1; numbers <= map.indices(); ++numbers) {
    each(numbers, orbits(map, map.indices() & ~numbers));
  }
}

std::int64_t alternating_sum(const std::vector<std::uint64_t>& counts) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    sum += (i % 2 == 0 ? 1 : -1) * static_cast<std::int64_t>(counts[i]);
  }
  return sum;
}

std::optional<IndexedDart> find_free(const GMap& map) {
  for (int i = 0; i <= map.dimension(); ++i) {
    if (const std::vector<Dart> free = free_darts(map, i); !free.empty()) {
      return IndexedDart{i, free.front()};
    }
  }
  return std::nullopt;
}

std::optional<IndexedDart> find_folded(const GMap& map) {
  for (int i = 0; i <= map.dimension(); ++i) {
    const IndexSet near = i == 0 ? IndexSet{0b11} : IndexSet{0b111} << (i - 1);
    const Orbits far = orbits(map, map.indices() & ~near);
    for (Dart d = 0; d < map.size(); ++d) {
      if (far.join(d, map.alpha(i, d))) {
        return IndexedDart{i, d};
      }
    }
  }
  return std::nullopt;
}

std::optional<IndexedDart> find_hollow(const GMap& map) {
  for (int i = 0; i < map.dimension(); ++i) {
    const GMap part = map.restricted(i);
    const Orbits spheres = components(part);
    std::vector<std::int64_t> euler(spheres.count(), 0);
    for_each_family(part, [&](IndexSet numbers, const Orbits& simplices) {
      for (const Dart d : simplices.first) {
        euler[spheres.of[d]] += std::popcount(numbers) % 2 == 1 ? 1 : -1;
      }
    });
    for (std::uint32_t each = 0; each < spheres.count(); ++each) {
      if (euler[each] != (i % 2 == 0 ? 2 : 0)) {
        return IndexedDart{i, spheres.first[each]};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::uint64_t> simplex_counts(const GMap& map) {
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(map.dimension() + 1), 0);
  for_each_family(map, [&](IndexSet numbers, const Orbits& simplices) {
    counts[static_cast<std::size_t>(std::popcount(numbers) - 1)] += simplices.count();
  });
  return counts;
}

std::vector<std::uint64_t> cell_counts(const GMap& map) {
  std::vector<std::uint64_t> counts;
  for (int i = 0; i <= map.dimension(); ++i) {
    counts.push_back(cells(map, i).count());
  }
  return counts;
}

std::int64_t simplicial_euler(const GMap& map) { return alternating_sum(simplex_counts(map)); }

std::int64_t cellular_euler(const GMap& map) { return alternating_sum(cell_counts(map)); }

EulerConditions euler_conditions(const GMap& map) {
  return {.free = find_free(map), .folded = find_folded(map), .hollow = find_hollow(map)};
}

}  // namespace sesame::ops
