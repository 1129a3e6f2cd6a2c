/// \file
/// The span of vectors that come one after another.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "sparse/contract.hpp"
#include "sparse/ring.hpp"

namespace sesame::sparse {

/// What dense vectors of one length generate over a Euclidean ring: a subgroup of Z^n, a subspace over a field. For few
/// and short vectors, as those of coordinates in a homology group.
///
/// Source: Hermite's normal form by Euclid's algorithm, without reducing above the pivots.
template <Ring R>
class GrowingSpan {
 public:
  using Vector = std::vector<typename R::Element>;

  GrowingSpan(R ring, std::size_t length) : ring_{std::move(ring)}, rows_(length) {}

  /// Requires: a vector of the length. Cost: its length squared, times the divisions of Euclid's algorithm over Z.
  void add(Vector v) {
    expects(v.size() == rows_.size(), "a span: a vector of another length");
    for (std::size_t k = 0; k < v.size(); ++k) {
      if (ring_.is_zero(v[k])) {
        continue;
      }
      if (rows_[k].empty()) {
        rows_[k] = std::move(v);
        return;
      }
      while (!ring_.is_zero(v[k])) {
        subtract(rows_[k], ring_.quotient(rows_[k][k], v[k]), v, k);
        rows_[k].swap(v);
      }
    }
  }

  /// Requires: a vector of the length. Cost: its length squared.
  [[nodiscard]] bool contains(Vector v) const {
    expects(v.size() == rows_.size(), "a span: a vector of another length");
    for (std::size_t k = 0; k < v.size(); ++k) {
      if (ring_.is_zero(v[k])) {
        continue;
      }
      if (rows_[k].empty()) {
        return false;
      }
      subtract(v, ring_.quotient(v[k], rows_[k][k]), rows_[k], k);
      if (!ring_.is_zero(v[k])) {
        return false;
      }
    }
    return true;
  }

 private:
  /// from - factor * what, from one place on.
  void subtract(Vector& from, const typename R::Element& factor, const Vector& what, std::size_t first) const {
    const typename R::Element opposite = ring_.negate(factor);
    for (std::size_t k = first; k < from.size(); ++k) {
      ring_.add_product(from[k], opposite, what[k]);
    }
  }

  R ring_;
  std::vector<Vector> rows_;  ///< by the place of the first entry, empty where there is none
};

}  // namespace sesame::sparse
