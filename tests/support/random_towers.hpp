/// \file
/// Small random towers: inclusions of simplices whose faces are there, and contractions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "ops/simplicial/tower_complex.hpp"

namespace sesame::tests {

/// An operation of a tower: the contraction of labels[0] into labels[1], or an inclusion.
struct TowerStep {
  bool is_contraction = false;
  std::vector<ops::Label> labels;
};

/// A model of the complex that knows nothing of slots, stars or hashes.
class PlainComplex {
 public:
  using Simplex = std::set<ops::Label>;

  [[nodiscard]] bool has(const Simplex& s) const { return simplices_.contains(s); }
  [[nodiscard]] const std::set<Simplex>& simplices() const { return simplices_; }
  [[nodiscard]] std::vector<ops::Label> vertices() const {
    std::vector<ops::Label> found;
    for (const Simplex& s : simplices_) {
      if (s.size() == 1) {
        found.push_back(*s.begin());
      }
    }
    return found;
  }
  /// Whether a simplex is not there, and all its facets are.
  [[nodiscard]] bool can_include(const Simplex& s) const {
    return !has(s) && std::ranges::all_of(s, [&](ops::Label v) {
      Simplex facet = s;
      facet.erase(v);
      return facet.empty() || has(facet);
    });
  }
  void apply(const TowerStep& step) {
    if (!step.is_contraction) {
      simplices_.emplace(step.labels.begin(), step.labels.end());
      return;
    }
    std::set<Simplex> images;
    for (Simplex s : simplices_) {
      if (s.erase(step.labels[0]) > 0) {
        s.insert(step.labels[1]);
      }
      images.insert(std::move(s));
    }
    simplices_ = std::move(images);
  }

 private:
  std::set<Simplex> simplices_;
};

/// A random tower. Labels of contracted vertices are used again now and then.
inline std::vector<TowerStep> random_tower(std::uint32_t seed, std::size_t steps, std::uint32_t labels,
                                           std::uint32_t contractions_in_16) {
  std::mt19937 random{seed};
  PlainComplex complex;
  std::vector<TowerStep> tower;
  while (tower.size() < steps) {
    const std::vector<ops::Label> vertices = complex.vertices();
    TowerStep step;
    if (vertices.size() > 1 && random() % 16 < contractions_in_16) {
      const ops::Label u = vertices[random() % vertices.size()];
      const ops::Label v = vertices[random() % vertices.size()];
      if (u == v) {
        continue;
      }
      step = {true, {u, v}};
    } else {
      PlainComplex::Simplex simplex;
      const std::size_t size = 1 + random() % 4;
      while (simplex.size() < size) {
        simplex.insert(random() % labels);
      }
      if (!complex.can_include(simplex)) {
        continue;
      }
      step = {false, {simplex.begin(), simplex.end()}};
      std::ranges::shuffle(step.labels, random);
    }
    complex.apply(step);
    tower.push_back(std::move(step));
  }
  return tower;
}

/// Applies a step to a complex.
inline void apply(const TowerStep& step, ops::TowerComplex& complex) {
  if (step.is_contraction) {
    static_cast<void>(complex.plan_contraction(step.labels[0], step.labels[1]).value());
    complex.contract();
  } else {
    static_cast<void>(complex.include(step.labels).value());
  }
}

}  // namespace sesame::tests
