#include "ops/maps/rooted_map.hpp"

#include <algorithm>
#include <compare>
#include <numeric>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// Depth first searches in one map. Keeps its memory between them.
class DepthFirst {
 public:
  explicit DepthFirst(const GMap& map) : map_{map}, place_(map.size(), no_dart) {}
  ~DepthFirst() = default;
  DepthFirst(const DepthFirst&) = delete;
  DepthFirst& operator=(const DepthFirst&) = delete;

  const std::vector<Dart>& from(Dart root, IndexSet generators) {
    forget();
    meet(root);
    stack_.assign(1, {root, 0});
    while (!stack_.empty()) {
      auto& [dart, index] = stack_.back();
      if (index > map_.dimension()) {
        stack_.pop_back();
        continue;
      }
      const int i = index++;
      if ((generators >> i & 1U) == 0) {
        continue;
      }
      if (const Dart next = map_.alpha(i, dart); place_[next] == no_dart) {
        meet(next);
        stack_.emplace_back(next, 0);
      }
    }
    return found_;
  }

  /// How the map looks from a root, compared with how it looks from another one whose order is known.
  std::strong_ordering compare(Dart root, const std::vector<Dart>& other, const std::vector<Dart>& place_of_other) {
    from(root, map_.indices());
    for (std::size_t k = 0; k < found_.size(); ++k) {
      for (int i = 0; i <= map_.dimension(); ++i) {
        const auto order = place_[map_.alpha(i, found_[k])] <=> place_of_other[map_.alpha(i, other[k])];
        if (order != 0) {
          return order;
        }
      }
    }
    return std::strong_ordering::equal;
  }
  [[nodiscard]] const std::vector<Dart>& places() const { return place_; }

 private:
  void meet(Dart d) {
    place_[d] = static_cast<Dart>(found_.size());
    found_.push_back(d);
  }
  void forget() {
    for (const Dart d : found_) {
      place_[d] = no_dart;
    }
    found_.clear();
  }

  const GMap& map_;
  std::vector<Dart> place_, found_;
  std::vector<std::pair<Dart, int>> stack_;
};

}  // namespace

std::vector<Dart> darts_from(const GMap& map, Dart root, IndexSet generators) {
  return DepthFirst(map).from(root, generators);
}

GMap restricted_to(const GMap& map, std::span<const Dart> darts, int n) {
  if (n < 0) {
    return GMap::points(static_cast<Dart>(darts.size()));
  }
  std::vector<Dart> place(map.size(), no_dart);
  for (std::size_t k = 0; k < darts.size(); ++k) {
    place[darts[k]] = static_cast<Dart>(k);
  }
  std::vector<std::vector<Dart>> alpha(static_cast<std::size_t>(n) + 1);
  for (int i = 0; i <= n; ++i) {
    for (const Dart d : darts) {
      alpha[static_cast<std::size_t>(i)].push_back(place[map.alpha(i, d)]);
    }
  }
  Result<GMap> restricted = GMap::make(std::move(alpha));
  sparse::expects(restricted.has_value(), "involutions that keep to some darts are a map of these");
  return std::move(*restricted);
}

/// A closed 1-map is a circle, which looks alike from everywhere: that is not found out dart by dart.
Dart canonical_root(const GMap& map) {
  if (map.dimension() == 1 && std::ranges::none_of(std::vector<int>{0, 1}, [&](int i) {
        return std::ranges::any_of(darts_from(map, 0), [&](Dart d) { return map.is_free(i, d); });
      })) {
    return 0;
  }
  DepthFirst search(map);
  Dart least = 0;
  std::vector<Dart> order = search.from(0, map.indices());
  std::vector<Dart> places = search.places();
  for (Dart d = 1; d < map.size(); ++d) {
    if (search.compare(d, order, places) < 0) {
      least = d;
      order = search.from(d, map.indices());
      places = search.places();
    }
  }
  return least;
}

std::optional<std::vector<Dart>> isomorphism(const GMap& from, Dart root, const GMap& to, Dart image) {
  if (from.dimension() != to.dimension() || from.size() != to.size()) {
    return std::nullopt;
  }
  const std::vector<Dart> ours = darts_from(from, root);
  const std::vector<Dart> theirs = darts_from(to, image);
  sparse::expects(ours.size() == from.size(), "an isomorphism is one of connected maps");
  if (theirs.size() != ours.size() ||
      restricted_to(from, ours, from.dimension()) != restricted_to(to, theirs, to.dimension())) {
    return std::nullopt;
  }
  std::vector<Dart> images(from.size());
  for (std::size_t k = 0; k < ours.size(); ++k) {
    images[ours[k]] = theirs[k];
  }
  return images;
}

std::optional<std::vector<Dart>> isomorphism(const GMap& from, const GMap& to) {
  if (from.size() != to.size()) {
    return std::nullopt;
  }
  return from.size() == 0 ? std::optional{std::vector<Dart>{}}
                          : isomorphism(from, canonical_root(from), to, canonical_root(to));
}

std::vector<Dart> automorphisms(const GMap& map) {
  std::vector<Dart> images;
  if (map.size() == 0) {
    return images;
  }
  DepthFirst search(map);
  const std::vector<Dart> order = search.from(0, map.indices());
  const std::vector<Dart> places = search.places();
  for (Dart d = 0; d < map.size(); ++d) {
    if (search.compare(d, order, places) == 0) {
      images.push_back(d);
    }
  }
  return images;
}

}  // namespace sesame::ops
