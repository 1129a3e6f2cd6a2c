#include "ops/maps/nmap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

using Images = std::vector<Dart>;

Error broken(std::string what) { return {Errc::bad_input, std::move(what)}; }

/// A dart, or that there is none.
std::string said(Dart d) { return d == no_dart ? std::string{"nowhere"} : fmt::format("to dart {}", d); }

Status check_range(const Images& beta, std::size_t i, std::size_t darts) {
  if (beta.size() != darts) {
    return broken(
        fmt::format("beta_{} has {} images, but beta_1 has {}: each has one for every dart", i, beta.size(), darts));
  }
  for (std::size_t d = 0; d < darts; ++d) {
    if (beta[d] >= darts && beta[d] != no_dart) {
      return broken(
          fmt::format("beta_{} sends dart {} to {}, but there are only the darts 0 to {}", i, d, beta[d], darts - 1));
    }
  }
  return Done{};
}

/// The inverse, or which two darts have one image.
Result<Images> inverse_of(const Images& beta) {
  Images inverse(beta.size(), no_dart);
  for (Dart d = 0; d < beta.size(); ++d) {
    if (beta[d] == no_dart) {
      continue;
    }
    if (const Dart other = std::exchange(inverse[beta[d]], d); other != no_dart) {
      return broken(fmt::format("beta_1 sends darts {} and {} both to dart {}: each dart follows one dart at most",
                                other, d, beta[d]));
    }
  }
  return inverse;
}

Status check_involution(const Images& beta, std::size_t i) {
  for (Dart d = 0; d < beta.size(); ++d) {
    if (beta[d] == d) {
      return broken(fmt::format("beta_{} fixes dart {}, which only beta_1 may; a free dart is sent nowhere", i, d));
    }
    if (beta[d] != no_dart && beta[beta[d]] != d) {
      return broken(fmt::format("beta_{} is no involution: it sends dart {} to dart {}, and that one {}", i, d, beta[d],
                                said(beta[beta[d]])));
    }
  }
  return Done{};
}

/// beta_i after beta_j.
Status check_product(const Images& beta_i, const Images& beta_j, std::size_t i, std::size_t j) {
  const auto both = [&](Dart d) { return beta_j[d] == no_dart ? no_dart : beta_i[beta_j[d]]; };
  for (Dart d = 0; d < beta_j.size(); ++d) {
    if (const Dart image = both(d); image != no_dart && both(image) != d) {
      return broken(
          fmt::format("beta_{0} after beta_{1} is no involution: they send dart {2} to dart {3}, and that one {4}", i,
                      j, d, image, said(both(image))));
    }
  }
  return Done{};
}

}  // namespace

Result<NMap> NMap::make(std::vector<Images> beta) {
  if (beta.empty()) {
    return broken("a map needs a list of images for beta_1, at least");
  }
  if (beta.size() > std::size_t{largest_map_dimension}) {
    return broken(
        fmt::format("a map of dimension {} is too large: at most {} is possible", beta.size(), largest_map_dimension));
  }
  const std::size_t darts = beta[0].size();
  for (std::size_t i = 1; i <= beta.size(); ++i) {
    if (Status s = check_range(beta[i - 1], i, darts); !s) {
      return s.error();
    }
  }
  Result<Images> inverse = inverse_of(beta[0]);
  if (!inverse) {
    return inverse.error();
  }
  beta.insert(beta.begin(), std::move(*inverse));
  for (std::size_t i = 2; i < beta.size(); ++i) {
    if (Status s = check_involution(beta[i], i); !s) {
      return s.error();
    }
  }
  // Both beta_0 and beta_1 are asked: where darts are free, neither follows from the other.
  for (std::size_t j = 3; j < beta.size(); ++j) {
    for (std::size_t i = 0; i + 2 <= j; ++i) {
      if (Status s = check_product(beta[i], beta[j], i, j); !s) {
        return s.error();
      }
    }
  }
  NMap map;
  map.size_ = static_cast<Dart>(darts);
  map.beta_ = std::move(beta);
  return map;
}

NMap NMap::points(Dart count) {
  NMap map;
  map.size_ = count;
  return map;
}

Dart NMap::beta(std::initializer_list<int> indices, Dart d) const {
  for (const int i : indices) {
    d = beta(i, d);
  }
  return d;
}

std::vector<Images> NMap::images() const {
  return beta_.empty() ? std::vector<Images>{} : std::vector<Images>(beta_.begin() + 1, beta_.end());
}

NMap NMap::inverse() const {
  NMap inverse = *this;
  if (!beta_.empty()) {
    std::swap(inverse.beta_[0], inverse.beta_[1]);
  }
  return inverse;
}

Result<NMap> map_of_rotations(const std::vector<Dart>& alpha, const std::vector<Dart>& sigma) {
  const std::size_t darts = alpha.size();
  if (sigma.size() != darts) {
    return broken(fmt::format("sigma has {} images, but alpha has {}: each has one for every half of an edge",
                              sigma.size(), darts));
  }
  if (const auto beyond = std::ranges::find_if(alpha, [&](Dart d) { return d >= darts; }); beyond != alpha.end()) {
    return broken(
        fmt::format("alpha sends half-edge {} nowhere: each half of an edge has another one", beyond - alpha.begin()));
  }
  for (Dart d = 0; d < darts; ++d) {
    if (alpha[d] == d) {
      return broken(fmt::format("alpha fixes half-edge {}: each half of an edge has another one", d));
    }
    if (alpha[alpha[d]] != d) {
      return broken(fmt::format("alpha is no involution: it sends half-edge {} to {}, and that one to {}", d, alpha[d],
                                alpha[alpha[d]]));
    }
  }
  Images phi(darts, no_dart);
  std::vector<bool> met(darts, false);
  for (Dart d = 0; d < darts; ++d) {
    if (sigma[d] >= darts || met[sigma[d]]) {
      return broken(fmt::format("sigma is no permutation: it sends half-edge {} {}", d,
                                sigma[d] >= darts ? "nowhere" : "where it sends another one"));
    }
    met[sigma[d]] = true;
    phi[alpha[d]] = sigma[d];
  }
  return NMap::make({std::move(phi), alpha});
}

NMap disjoint_union(const NMap& a, const NMap& b) {
  sparse::expects(a.dimension() == b.dimension(), "maps of different dimensions have no union");
  if (a.dimension() == 0) {
    return NMap::points(a.size() + b.size());
  }
  std::vector<Images> beta = a.images();
  for (int i = 1; i <= a.dimension(); ++i) {
    for (Dart d = 0; d < b.size(); ++d) {
      const Dart image = b.beta(i, d);
      beta[static_cast<std::size_t>(i) - 1].push_back(image == no_dart ? no_dart : a.size() + image);
    }
  }
  return std::move(*NMap::make(std::move(beta)));
}

}  // namespace sesame::ops
