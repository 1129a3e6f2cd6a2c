#include "ops/maps/gmap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

Error no_map(std::string what) { return {Errc::bad_input, std::move(what)}; }

Status check_involution(const std::vector<Dart>& alpha, std::size_t i, std::size_t darts) {
  if (alpha.size() != darts) {
    return no_map(
        fmt::format("alpha_{} has {} images, but alpha_0 has {}: each has one for every dart", i, alpha.size(), darts));
  }
  for (std::size_t d = 0; d < darts; ++d) {
    if (alpha[d] >= darts) {
      return no_map(
          fmt::format("alpha_{} sends dart {} to {}, but there are only the darts 0 to {}", i, d, alpha[d], darts - 1));
    }
    if (alpha[alpha[d]] != d) {
      return no_map(fmt::format("alpha_{} is no involution: it sends dart {} to {}, and that one to {}", i, d, alpha[d],
                                alpha[alpha[d]]));
    }
  }
  return Done{};
}

Status check_product(const std::vector<std::vector<Dart>>& alpha, std::size_t i, std::size_t j) {
  for (std::size_t d = 0; d < alpha[i].size(); ++d) {
    if (alpha[j][alpha[i][d]] != alpha[i][alpha[j][d]]) {
      return no_map(
          fmt::format("alpha_{0} alpha_{1} is no involution: from dart {2}, alpha_{0} and then alpha_{1} lead "
                      "to dart {3}, but alpha_{1} and then alpha_{0} to {4}",
                      i, j, d, alpha[j][alpha[i][d]], alpha[i][alpha[j][d]]));
    }
  }
  return Done{};
}

}  // namespace

Result<GMap> GMap::make(std::vector<std::vector<Dart>> alpha) {
  if (alpha.empty()) {
    return no_map("a map needs a list of images for alpha_0, at least");
  }
  if (alpha.size() > std::size_t{largest_map_dimension} + 1) {
    return no_map(fmt::format("{} involutions make a map of dimension {}: at most {} is possible", alpha.size(),
                              alpha.size() - 1, largest_map_dimension));
  }
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    if (Status s = check_involution(alpha[i], i, alpha[0].size()); !s) {
      return s.error();
    }
  }
  for (std::size_t j = 2; j < alpha.size(); ++j) {
    for (std::size_t i = 0; i + 2 <= j; ++i) {
      if (Status s = check_product(alpha, i, j); !s) {
        return s.error();
      }
    }
  }
  GMap map;
  map.size_ = static_cast<Dart>(alpha[0].size());
  map.alpha_ = std::move(alpha);
  return map;
}

GMap GMap::points(Dart count) {
  GMap map;
  map.size_ = count;
  return map;
}

GMap GMap::dual() const {
  GMap dual = *this;
  std::ranges::reverse(dual.alpha_);
  return dual;
}

GMap GMap::extended() const {
  GMap map = *this;
  map.alpha_.emplace_back();
  for (Dart d = 0; d < size_; ++d) {
    map.alpha_.back().push_back(d);
  }
  return map;
}

GMap GMap::restricted(int n) const {
  sparse::expects(n >= -1 && n <= dimension(), "a map is restricted to some of its involutions");
  GMap map = *this;
  map.alpha_.resize(static_cast<std::size_t>(n + 1));
  return map;
}

GMap disjoint_union(const GMap& a, const GMap& b) {
  sparse::expects(a.dimension() == b.dimension(), "maps of different dimensions have no union");
  if (a.dimension() < 0) {
    return GMap::points(a.size() + b.size());
  }
  std::vector<std::vector<Dart>> alpha = a.involutions();
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    for (const Dart image : b.involutions()[i]) {
      alpha[i].push_back(a.size() + image);
    }
  }
  return std::move(*GMap::make(std::move(alpha)));
}

GMap polygon(Dart sides) {
  sparse::expects(sides >= 1, "a polygon has a side");
  std::vector<std::vector<Dart>> alpha(3);
  for (Dart d = 0; d < 2 * sides; ++d) {
    alpha[0].push_back(d ^ 1U);
    alpha[1].push_back(d % 2 == 0 ? (d + 2 * sides - 1) % (2 * sides) : (d + 1) % (2 * sides));
    alpha[2].push_back(d);
  }
  return std::move(*GMap::make(std::move(alpha)));
}

}  // namespace sesame::ops
