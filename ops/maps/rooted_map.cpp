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

/// How a connected map looks from a root: its darts are numbered breadth first, and the images of dart 0, of dart 1,
/// and so on are what is seen, as far as anybody has looked.
class Look {
 public:
  explicit Look(const GMap& map) : map_{&map}, place_(map.size(), no_dart) {}

  void begin(Dart root) {
    for (const Dart d : order_) {
      place_[d] = no_dart;
    }
    order_.clear();
    seen_ = 0;
    meet(root);
  }
  [[nodiscard]] const std::vector<Dart>& order() const { return order_; }

  /// Compares what is seen, image by image. Cost: as far as that is the same.
  std::strong_ordering compare(Look& other) {
    for (Dart k = 0; k < map_->size(); ++k) {
      see(k);
      other.see(k);
      for (int i = 0; i <= map_->dimension(); ++i) {
        const auto order = image(k, i) <=> other.image(k, i);
        if (order != 0) {
          return order;
        }
      }
    }
    return std::strong_ordering::equal;
  }

 private:
  [[nodiscard]] Dart image(Dart k, int i) const { return place_[map_->alpha(i, order_[k])]; }
  /// The images of the darts up to this one have numbers then.
  void see(Dart k) {
    for (; seen_ <= k; ++seen_) {
      for (int i = 0; i <= map_->dimension(); ++i) {
        if (const Dart next = map_->alpha(i, order_[seen_]); place_[next] == no_dart) {
          meet(next);
        }
      }
    }
  }
  void meet(Dart d) {
    place_[d] = static_cast<Dart>(order_.size());
    order_.push_back(d);
  }

  const GMap* map_;
  std::vector<Dart> place_, order_;
  Dart seen_ = 0;  ///< how many darts have images with numbers
};

/// Darts that automorphisms take to one another, as far as is known.
class AlikeDarts {
 public:
  explicit AlikeDarts(std::size_t darts) : parent_(darts) { std::iota(parent_.begin(), parent_.end(), Dart{0}); }

  /// Whether no smaller dart is known to be alike.
  [[nodiscard]] bool is_first(Dart d) const { return parent_[d] == d; }
  void join(Dart a, Dart b) {
    a = first(a);
    b = first(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  Dart first(Dart d) {
    while (parent_[d] != d) {
      d = parent_[d] = parent_[parent_[d]];
    }
    return d;
  }

  std::vector<Dart> parent_;
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
  Look least(map), other(map);
  least.begin(0);
  AlikeDarts alike(map.size());
  for (Dart d = 1; d < map.size(); ++d) {
    if (!alike.is_first(d)) {
      continue;  // an automorphism takes one that was looked from to it
    }
    other.begin(d);
    const std::strong_ordering order = other.compare(least);
    if (order < 0) {
      std::swap(other, least);
    } else if (order == 0) {
      for (Dart k = 0; k < map.size(); ++k) {
        alike.join(least.order()[k], other.order()[k]);
      }
    }
  }
  return least.order().front();
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
