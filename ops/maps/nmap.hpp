/// \file
/// Combinatorial maps: oriented objects of any dimension, by half as many darts as a G-map takes.
#pragma once

#include <initializer_list>
#include <vector>

#include "ops/maps/gmap.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// An n-map, n >= 0, with or without boundary: darts with beta_1, ..., beta_n, where beta_i leads from a dart to
/// another one or nowhere (`no_dart`): there it is *i-free*. beta_1 goes to the next dart of the face and never from
/// two darts to one; it may fix a dart, which is a loop then and not free. beta_0 is its inverse. Each other beta_i
/// goes back where it came from and fixes nothing. Two of them, beta_i after beta_j with j >= 3 and 0 <= i <= j - 2,
/// lead back as well, where they lead anywhere.
///
/// No fixed points above beta_1 is a law of this source, not of all: P. Lienhardt (1994) allows them. Source: the
/// definition of open combinatorial maps by M. Poudret, A. Arnould, Y. Bertrand and P. Lienhardt (2007), with that law.
class NMap {
 public:
  /// The map of dimension 0 without darts.
  NMap() = default;
  /// Lists of images for beta_1, ..., beta_n, n >= 1, each as long as the first; `no_dart` where a dart is free.
  /// Errors    bad_input, naming the law that is broken and a dart. Cost: n^2 times the darts.
  [[nodiscard]] static Result<NMap> make(std::vector<std::vector<Dart>> beta);
  /// A map of dimension 0, which is a number of darts with nothing between them.
  [[nodiscard]] static NMap points(Dart count);

  [[nodiscard]] int dimension() const { return beta_.empty() ? 0 : static_cast<int>(beta_.size()) - 1; }
  /// How many darts there are.
  [[nodiscard]] Dart size() const { return size_; }
  /// beta_i, for i = 0, ..., n; from `no_dart` nowhere. With n = 0, all darts are 0-free.
  [[nodiscard]] Dart beta(int i, Dart d) const {
    return d == no_dart || beta_.empty() ? no_dart : beta_[static_cast<std::size_t>(i)][d];
  }
  /// Several, the first index first: `beta({2, 1}, d)` is beta_1 of beta_2 of d, which is written beta_21.
  [[nodiscard]] Dart beta(std::initializer_list<int> indices, Dart d) const;
  [[nodiscard]] bool is_free(int i, Dart d) const { return beta(i, d) == no_dart; }
  /// The lists that `make` takes: n of them.
  [[nodiscard]] std::vector<std::vector<Dart>> images() const;

  /// The same object with the other orientation: beta_0 in the place of beta_1.
  [[nodiscard]] NMap inverse() const;

  friend bool operator==(const NMap&, const NMap&) = default;

 private:
  std::vector<std::vector<Dart>> beta_;  // beta_0, ..., beta_n; none at all for n = 0
  Dart size_ = 0;
};

/// The 2-map of a graph that is drawn on a surface: `alpha` leads from each half of an edge to the other one, `sigma`
/// to the next half around the vertex. beta_2 is alpha, and beta_1, around the faces, is alpha and then sigma. Errors
/// bad_input: alpha is free or fixes a dart or is no involution, sigma is no permutation. Cost: the darts.
[[nodiscard]] Result<NMap> map_of_rotations(const std::vector<Dart>& alpha, const std::vector<Dart>& sigma);

/// Maps beside each other: the darts of the first, then those of the second. Requires: equal dimensions.
[[nodiscard]] NMap disjoint_union(const NMap& a, const NMap& b);

}  // namespace sesame::ops
