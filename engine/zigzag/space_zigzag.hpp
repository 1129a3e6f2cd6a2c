/// \file
/// The barcode of a zigzag of vector spaces and linear maps, from their matrices.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "sparse/contract.hpp"
#include "sparse/ring.hpp"

namespace sesame::engine {

/// A zigzag V_0 - V_1 - V_2 - ..., each map one way or the other, and its barcode so far. Each space comes with a basis
/// that somebody else has chosen; what is kept is one of its own, with a bar for each vector.
///
/// These vectors are ranked: those born forwards in the order of their births, and before all of them those born
/// backwards, the last one first. A vector may be changed by those of lower rank and still stands for its bar. So of
/// vectors whose images are dependent the highest dies; and backwards those live on that are the highest one in the
/// image of some vector.
///
/// Cost of a step: cubic in the dimensions, unless the map is an inclusion of bases. Requires: R is a field.
/// Source: G. Carlsson, V. de Silva, "Zigzag persistence" (2010).
template <sparse::Ring R>
class SpaceZigzag {
 public:
  using Element = typename R::Element;
  /// Coordinates in a basis.
  using Vector = std::vector<Element>;
  /// Told of a bar that ends, by its birth and death.
  using OnBar = std::function<void(std::uint64_t birth, std::uint64_t death)>;

  explicit SpaceZigzag(R ring) : ring_{ring} {}

  [[nodiscard]] std::size_t dimension() const { return open_.size(); }

  /// A map to the next space, of some dimension: the images of the present basis, in coordinates of the next one.
  void forward(const std::vector<Vector>& images, std::size_t dimension, std::uint64_t time, const OnBar& on_bar) {
    sparse::expects(images.size() == open_.size(), "a map has an image for each vector of a basis");
    std::vector<Open> next;
    Echelon echelon{ring_, dimension};
    for (Open& bar : open_) {
      Vector image = combination(bar.vector, images, dimension);
      if (echelon.add(image)) {
        next.push_back({std::move(image), bar.birth});
      } else {
        on_bar(bar.birth, time);
      }
    }
    for (std::size_t k = 0; k < dimension; ++k) {
      Vector unit = unit_vector(dimension, k);
      if (echelon.add(unit)) {
        next.push_back({std::move(unit), time});
      }
    }
    open_ = std::move(next);
  }

  /// A map from the next space: the images of its basis, in coordinates of the present one.
  void backward(const std::vector<Vector>& images, std::uint64_t time, const OnBar& on_bar) {
    const std::size_t dimension = images.size();
    const std::vector<Vector> in_bars = solve(images);
    // Columns are reduced by others until each has another highest bar, with what they are images of.
    std::vector<Vector> reduced(open_.size()), of(open_.size());
    std::vector<Open> next;
    for (std::size_t k = 0; k < dimension; ++k) {
      Vector column = in_bars[k], preimage = unit_vector(dimension, k);
      std::size_t highest = open_.size();
      while (highest-- > 0) {
        if (ring_.is_zero(column[highest])) {
          continue;
        }
        if (reduced[highest].empty()) {
          reduced[highest] = std::move(column);
          of[highest] = std::move(preimage);
          break;
        }
        const Element factor = ring_.negate(ring_.multiply(column[highest], ring_.inverse(reduced[highest][highest])));
        add(column, factor, reduced[highest]);
        add(preimage, factor, of[highest]);
      }
      if (!preimage.empty()) {
        next.push_back({std::move(preimage), time});
      }
    }
    for (std::size_t k = 0; k < open_.size(); ++k) {
      if (reduced[k].empty()) {
        on_bar(open_[k].birth, time);
      } else {
        next.push_back({std::move(of[k]), open_[k].birth});
      }
    }
    open_ = std::move(next);
  }

  /// Calls visit(birth) for each bar that has not ended.
  template <class Visit>
  void for_each_open_bar(Visit visit) const {
    for (const Open& bar : open_) {
      visit(bar.birth);
    }
  }

 private:
  struct Open {
    Vector vector;
    std::uint64_t birth;
  };

  /// Independent vectors, each with an entry where those after it have none.
  class Echelon {
   public:
    Echelon(R ring, std::size_t dimension) : ring_{ring}, with_pivot_(dimension) {}
    /// Takes multiples of the vectors so far from another one, and takes it, too, if it is not zero then.
    bool add(Vector& vector) {
      for (std::size_t k = 0; k < vector.size(); ++k) {
        if (ring_.is_zero(vector[k])) {
          continue;
        }
        if (with_pivot_[k].empty()) {
          with_pivot_[k] = vector;
          return true;
        }
        const Element factor = ring_.negate(ring_.multiply(vector[k], ring_.inverse(with_pivot_[k][k])));
        for (std::size_t i = k; i < vector.size(); ++i) {
          ring_.add_product(vector[i], factor, with_pivot_[k][i]);
        }
      }
      return false;
    }

   private:
    R ring_;
    std::vector<Vector> with_pivot_;
  };

  [[nodiscard]] Vector unit_vector(std::size_t dimension, std::size_t k) const {
    Vector unit(dimension, ring_.zero());
    unit[k] = ring_.one();
    return unit;
  }
  void add(Vector& to, const Element& factor, const Vector& from) const {
    for (std::size_t i = 0; i < to.size(); ++i) {
      ring_.add_product(to[i], factor, from[i]);
    }
  }
  [[nodiscard]] Vector combination(const Vector& coefficients, const std::vector<Vector>& of,
                                   std::size_t dimension) const {
    Vector sum(dimension, ring_.zero());
    for (std::size_t k = 0; k < of.size(); ++k) {
      if (!ring_.is_zero(coefficients[k])) {
        add(sum, coefficients[k], of[k]);
      }
    }
    return sum;
  }
  /// Vectors in coordinates of the space as combinations of those of the bars.
  [[nodiscard]] std::vector<Vector> solve(const std::vector<Vector>& vectors) const {
    const std::size_t n = open_.size();
    std::vector<Vector> rows(n);  // of the matrix of the bars, then of the vectors
    for (std::size_t i = 0; i < n; ++i) {
      for (const Open& bar : open_) {
        rows[i].push_back(bar.vector[i]);
      }
      for (const Vector& vector : vectors) {
        sparse::expects(vector.size() == n, "images are written in the basis of the space");
        rows[i].push_back(vector[i]);
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      const auto pivot = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(k), rows.end(),
                                      [&](const Vector& row) { return !ring_.is_zero(row[k]); });
      sparse::expects(pivot != rows.end(), "the bars' vectors are a basis");
      std::swap(*pivot, rows[k]);
      const Element to_one = ring_.inverse(rows[k][k]);
      for (Element& entry : rows[k]) {
        entry = ring_.multiply(entry, to_one);
      }
      for (std::size_t i = 0; i < n; ++i) {
        if (i != k && !ring_.is_zero(rows[i][k])) {
          const Element factor = ring_.negate(rows[i][k]);
          add(rows[i], factor, rows[k]);
        }
      }
    }
    std::vector<Vector> solved(vectors.size(), Vector(n, ring_.zero()));
    for (std::size_t j = 0; j < vectors.size(); ++j) {
      for (std::size_t i = 0; i < n; ++i) {
        solved[j][i] = rows[i][n + j];
      }
    }
    return solved;
  }

  R ring_;
  std::vector<Open> open_;  ///< by rank
};

}  // namespace sesame::engine
