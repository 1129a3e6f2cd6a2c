/// \file
/// The barcode of a zigzag of vector spaces and linear maps, from their matrices.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "sparse/chain.hpp"
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
/// Who keeps something of each bar is told what became of its vector by each map: a Passage.
///
/// Cost of a step: cubic in the dimensions, unless most vectors are sent to such of a basis. Requires: R is a field.
/// Source: G. Carlsson, V. de Silva, "Zigzag persistence" (2010).
template <sparse::Ring R>
class SpaceZigzag {
 public:
  using Element = typename R::Element;
  /// Coordinates in a basis.
  using Vector = std::vector<Element>;
  /// The images of a basis; or they are the other basis, in its order.
  struct Images {
    bool are_basis = false;
    std::vector<Vector> vectors;  ///< none, when they are
  };

  static constexpr std::size_t nowhere = SIZE_MAX;
  /// What a bar was among those before a map, by their places, with what has been added to its vector before that was
  /// mapped: vectors of lower rank.
  struct Place {
    std::size_t was;  ///< or `nowhere`: it begins
    std::uint64_t birth;
    sparse::Terms<R> added;
  };
  /// What became of the bars by a map. The sum of one that ends is mapped to zero, or it has no preimage.
  struct Passage {
    std::vector<Place> open, ended;
  };

  explicit SpaceZigzag(R ring) : ring_{ring} {}

  [[nodiscard]] std::size_t dimension() const { return open_.size(); }
  /// The vector of a bar, by its place among those that are open.
  [[nodiscard]] const Vector& vector(std::size_t place) const { return open_[place].vector; }
  /// Requires: the last map, which was backward, sends it to what it sends the vector so far to.
  void change_vector(std::size_t place, Vector vector) { open_[place].vector = std::move(vector); }

  /// A map to the next space, of some dimension: the images of the present basis, in coordinates of the next one.
  Passage forward(const Images& images, std::size_t dimension, std::uint64_t time) {
    if (images.are_basis) {
      return unchanged();
    }
    sparse::expects(images.vectors.size() == open_.size(), "a map has an image for each vector of a basis");
    Passage passage;
    std::vector<Open> next;
    Echelon echelon{ring_, dimension};
    for (std::size_t k = 0; k < open_.size(); ++k) {
      Vector image = combination(open_[k].vector, images.vectors, dimension);
      const sparse::Term<R> itself{static_cast<sparse::Index>(k), ring_.one()};
      if (std::optional<sparse::Terms<R>> sum = echelon.add(image, {itself})) {
        sum->pop_back();  // itself: those before it are of lower rank
        passage.ended.push_back({k, open_[k].birth, std::move(*sum)});
      } else {
        passage.open.push_back({k, open_[k].birth, {}});
        next.push_back({std::move(image), open_[k].birth});
      }
    }
    for (std::size_t k = 0; k < dimension; ++k) {
      Vector unit = unit_vector(dimension, k);
      if (!echelon.add(unit, {})) {
        passage.open.push_back({nowhere, time, {}});
        next.push_back({std::move(unit), time});
      }
    }
    open_ = std::move(next);
    return passage;
  }

  /// A map from the next space: the images of its basis, in coordinates of the present one.
  Passage backward(const Images& images, std::uint64_t time) {
    if (images.are_basis) {
      return unchanged();
    }
    Passage passage;
    std::vector<Open> next;
    // Columns are reduced by others until each has another highest bar, with what they are images of.
    std::vector<Column> with_highest(open_.size());
    std::size_t k = 0;
    for (Vector& image : solve(images.vectors)) {
      Column column{std::move(image), unit_vector(images.vectors.size(), k++)};
      if (!place(column, with_highest)) {
        passage.open.push_back({nowhere, time, {}});
        next.push_back({std::move(column.preimage), time});
      }
    }
    clean(with_highest);
    for (std::size_t bar = 0; bar < open_.size(); ++bar) {
      Column& column = with_highest[bar];
      if (column.image.empty()) {
        passage.ended.push_back({bar, open_[bar].birth, {}});
        continue;
      }
      passage.open.push_back({bar, open_[bar].birth, entries_below(bar, column.image)});
      next.push_back({std::move(column.preimage), open_[bar].birth});
    }
    open_ = std::move(next);
    return passage;
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
  /// A vector of the next space and its image, as a combination of those of the bars.
  struct Column {
    Vector image, preimage;
  };

  /// Independent vectors, each with an entry where those after it have none, and what they are sums of.
  class Echelon {
   public:
    Echelon(R ring, std::size_t dimension) : ring_{ring}, with_pivot_(dimension) {}
    /// Takes multiples of the vectors so far from another one, and keeps what is left; or, when that is zero, returns
    /// what it is a sum of.
    std::optional<sparse::Terms<R>> add(Vector vector, sparse::Terms<R> of) {
      for (std::size_t k = 0; k < vector.size(); ++k) {
        if (ring_.is_zero(vector[k])) {
          continue;
        }
        Row& row = with_pivot_[k];
        if (row.vector.empty()) {
          row = {std::move(vector), std::move(of)};
          return std::nullopt;
        }
        const Element factor = ring_.negate(ring_.multiply(vector[k], ring_.inverse(row.vector[k])));
        for (std::size_t i = k; i < vector.size(); ++i) {
          ring_.add_product(vector[i], factor, row.vector[i]);
        }
        sparse::add_multiple(ring_, of, factor, row.of);
      }
      return of;
    }

   private:
    struct Row {
      Vector vector;
      sparse::Terms<R> of;
    };
    R ring_;
    std::vector<Row> with_pivot_;
  };

  /// All bars live on with the vectors that they have.
  [[nodiscard]] Passage unchanged() const {
    Passage passage;
    for (std::size_t k = 0; k < open_.size(); ++k) {
      passage.open.push_back({k, open_[k].birth, {}});
    }
    return passage;
  }
  /// Reduces a column by others, and puts it to its highest bar, unless its image is zero then.
  bool place(Column& column, std::vector<Column>& with_highest) const {
    for (std::size_t highest = open_.size(); highest-- > 0;) {
      if (ring_.is_zero(column.image[highest])) {
        continue;
      }
      Column& other = with_highest[highest];
      if (other.image.empty()) {
        other = std::move(column);
        return true;
      }
      take(column, highest, other);
    }
    return false;
  }
  /// Makes the highest entry of every column one, and those zero that are the highest ones of others: what can live on
  /// as it is does.
  void clean(std::vector<Column>& with_highest) const {
    for (std::size_t bar = 0; bar < with_highest.size(); ++bar) {
      Column& column = with_highest[bar];
      if (column.image.empty()) {
        continue;
      }
      const Element to_one = ring_.inverse(column.image[bar]);
      for (Vector* vector : {&column.image, &column.preimage}) {
        for (Element& entry : *vector) {
          entry = ring_.multiply(entry, to_one);
        }
      }
      for (std::size_t lower = 0; lower < bar; ++lower) {
        if (!with_highest[lower].image.empty() && !ring_.is_zero(column.image[lower])) {
          take(column, lower, with_highest[lower]);
        }
      }
    }
  }
  /// Takes a multiple of another column, so that there is no entry at its highest bar.
  void take(Column& column, std::size_t highest, const Column& other) const {
    const Element factor = ring_.negate(ring_.multiply(column.image[highest], ring_.inverse(other.image[highest])));
    add(column.image, factor, other.image);
    add(column.preimage, factor, other.preimage);
  }
  [[nodiscard]] sparse::Terms<R> entries_below(std::size_t bar, const Vector& image) const {
    sparse::Terms<R> entries;
    for (std::size_t k = 0; k < bar; ++k) {
      if (!ring_.is_zero(image[k])) {
        entries.push_back({static_cast<sparse::Index>(k), image[k]});
      }
    }
    return entries;
  }
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
