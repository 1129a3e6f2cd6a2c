/// \file
/// Linear algebra modulo p, and the barcode of a zigzag of vector spaces from its definition: by ranks of linear
/// relations. Nothing of sesame is used.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sesame::tests {

/// [dimension, birth, death]: complexes are numbered by the operations, from 0; a bar that does not end has the death
/// -1.
struct PlainBar {
  int dimension;
  std::int64_t birth, death;
  friend auto operator<=>(const PlainBar&, const PlainBar&) = default;
};

using PlainVector = std::vector<std::int64_t>;
using PlainRows = std::vector<PlainVector>;

class PlainField {
 public:
  explicit PlainField(std::int64_t p) : p_{p} {}

  [[nodiscard]] std::int64_t reduced(std::int64_t x) const { return (x % p_ + p_) % p_; }
  [[nodiscard]] std::int64_t inverse(std::int64_t x) const {
    std::int64_t y = 1;
    while (reduced(x * y) != 1) {
      ++y;
    }
    return y;
  }
  void add(PlainVector& x, const PlainVector& y, std::int64_t factor) const {
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] = reduced(x[k] + factor * y[k]);
    }
  }
  /// A basis of the span in echelon form by the first `columns` columns; rows that are 0 there come last.
  [[nodiscard]] PlainRows echelon(PlainRows rows, std::size_t columns, std::size_t* rank = nullptr) const {
    std::size_t found = 0;
    for (std::size_t c = 0; c < columns && found < rows.size(); ++c) {
      std::size_t pivot = found;
      while (pivot < rows.size() && rows[pivot][c] == 0) {
        ++pivot;
      }
      if (pivot == rows.size()) {
        continue;
      }
      std::swap(rows[pivot], rows[found]);
      const std::int64_t scale = inverse(rows[found][c]);
      for (std::int64_t& x : rows[found]) {
        x = reduced(x * scale);
      }
      for (std::size_t k = 0; k < rows.size(); ++k) {
        if (k != found && rows[k][c] != 0) {
          add(rows[k], rows[found], -rows[k][c]);
        }
      }
      ++found;
    }
    if (rank != nullptr) {
      *rank = found;
    }
    return rows;
  }
  [[nodiscard]] std::size_t rank(const PlainRows& rows) const {
    std::size_t rank = 0;
    static_cast<void>(echelon(rows, rows.empty() ? 0 : rows[0].size(), &rank));
    return rank;
  }
  /// A basis of the relations between rows: x with sum x_k rows[k] = 0.
  [[nodiscard]] PlainRows relations(const PlainRows& rows, std::size_t columns) const {
    PlainRows extended = rows;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      extended[k].resize(columns + rows.size(), 0);
      extended[k][columns + k] = 1;
    }
    std::size_t rank = 0;
    extended = echelon(std::move(extended), columns, &rank);
    PlainRows found;
    for (std::size_t k = rank; k < extended.size(); ++k) {
      found.emplace_back(extended[k].begin() + static_cast<std::ptrdiff_t>(columns), extended[k].end());
    }
    return found;
  }
  /// x with sum x_k rows[k] = y. Requires: there is one.
  [[nodiscard]] PlainVector solve(PlainRows rows, PlainVector y) const {
    const std::size_t columns = y.size();
    rows.insert(rows.begin(), std::move(y));
    for (const PlainVector& relation : relations(rows, columns)) {
      if (relation[0] != 0) {
        PlainVector x(relation.begin() + 1, relation.end());
        const std::int64_t scale = reduced(-inverse(relation[0]));
        for (std::int64_t& each : x) {
          each = reduced(each * scale);
        }
        return x;
      }
    }
    throw std::logic_error("a vector should be in the span");
  }

 private:
  std::int64_t p_;
};

/// The homology of one dimension of a complex, by cycles.
struct PlainGroup {
  PlainRows boundaries, classes;  ///< a basis of the boundaries, and cycles that are one modulo these

  /// `rows`: the boundaries of the cells of the dimension, in `below` faces; `above`: of those of one more, in these.
  PlainGroup(const PlainRows& rows, std::size_t below, PlainRows above, const PlainField& field) {
    std::size_t rank = 0;
    boundaries = field.echelon(std::move(above), rows.size(), &rank);
    boundaries.resize(rank);
    for (const PlainVector& cycle : field.relations(rows, below)) {
      PlainRows more = boundaries;
      more.insert(more.end(), classes.begin(), classes.end());
      more.push_back(cycle);
      if (field.rank(more) == more.size()) {
        classes.push_back(cycle);
      }
    }
  }
  /// The class of a cycle, in `classes`.
  [[nodiscard]] PlainVector class_of(const PlainVector& cycle, const PlainField& field) const {
    PlainRows all = classes;
    all.insert(all.end(), boundaries.begin(), boundaries.end());
    PlainVector x = field.solve(all, cycle);
    x.resize(classes.size());
    return x;
  }
};

/// The bars of a zigzag of spaces of these dimensions, of which `maps[k]` leads from space k - 1 to k, or back. The
/// number of bars over [b, d] is the rank of the relation that the maps in between are, which is that of the map from
/// their limit to their colimit; multiplicities follow by inclusion and exclusion.
inline std::vector<PlainBar> plain_bars_of_maps(int dimension, const std::vector<std::size_t>& dimensions,
                                                const std::vector<PlainRows>& maps,
                                                const std::vector<bool>& is_backward, const PlainField& field) {
  const std::size_t n = dimensions.size();
  std::vector<PlainBar> bars;
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> over;
  for (std::size_t b = 0; b < n; ++b) {
    const std::size_t first = dimensions[b];
    PlainRows relation(first, PlainVector(2 * first, 0));  // rows (x, y)
    for (std::size_t k = 0; k < first; ++k) {
      relation[k][k] = relation[k][first + k] = 1;
    }
    for (std::size_t d = b; d < n; ++d) {
      const std::size_t last = dimensions[d];
      if (d > b) {
        const std::size_t before = dimensions[d - 1];
        PlainRows next;
        if (is_backward[d]) {
          // (x, g(y)) in the relation: relations between its second halves and the images of g.
          PlainRows ends;
          for (const PlainVector& row : relation) {
            ends.emplace_back(row.begin() + static_cast<std::ptrdiff_t>(first), row.end());
          }
          for (const PlainVector& image : maps[d]) {
            PlainVector minus(image.size());
            std::ranges::transform(image, minus.begin(), [&](std::int64_t x) { return field.reduced(-x); });
            ends.push_back(minus);
          }
          for (const PlainVector& x : field.relations(ends, before)) {
            PlainVector row(first, 0);
            for (std::size_t k = 0; k < relation.size(); ++k) {
              field.add(row, PlainVector(relation[k].begin(), relation[k].begin() + static_cast<std::ptrdiff_t>(first)),
                        x[k]);
            }
            row.insert(row.end(), x.begin() + static_cast<std::ptrdiff_t>(relation.size()), x.end());
            next.push_back(row);
          }
        } else {
          for (const PlainVector& row : relation) {
            PlainVector end(last, 0);
            for (std::size_t k = 0; k < before; ++k) {
              field.add(end, maps[d][k], row[first + k]);
            }
            PlainVector sent(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(first));
            sent.insert(sent.end(), end.begin(), end.end());
            next.push_back(sent);
          }
        }
        std::size_t rank = 0;
        relation = field.echelon(std::move(next), first + last, &rank);
        relation.resize(rank);
      }
      PlainRows firsts, lasts;
      for (const PlainVector& row : relation) {
        firsts.emplace_back(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(first));
        lasts.emplace_back(row.begin() + static_cast<std::ptrdiff_t>(first), row.end());
      }
      // (x, 0) and (0, y) are the kernels of the projections.
      over[{b, d}] = static_cast<std::int64_t>(field.rank(firsts) + field.rank(lasts)) -
                     static_cast<std::int64_t>(relation.size());
    }
  }
  const auto count = [&](std::int64_t b, std::int64_t d) {
    const auto at = over.find({b, d});
    return at == over.end() ? 0 : at->second;
  };
  const auto end = static_cast<std::int64_t>(n);
  for (std::int64_t b = 0; b < end; ++b) {
    for (std::int64_t d = b; d < end; ++d) {
      const std::int64_t times = count(b, d) - count(b - 1, d) - count(b, d + 1) + count(b - 1, d + 1);
      bars.insert(bars.end(), static_cast<std::size_t>(times), {dimension, b, d + 1 == end ? -1 : d + 1});
    }
  }
  return bars;
}

}  // namespace sesame::tests
