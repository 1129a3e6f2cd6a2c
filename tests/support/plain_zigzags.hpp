/// \file
/// Small zigzags, and their barcodes from the definition: by ranks of linear relations between the homology groups of
/// the complexes, each from scratch. Nothing of sesame is used.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace sesame::tests {

/// An operation of a zigzag: the simplex with these labels is included ('i') or deleted ('d'), or labels[0] is
/// contracted into labels[1] ('c').
struct ZigzagStep {
  char kind = 'i';
  std::vector<std::uint64_t> labels;
};

/// [dimension, birth, death]: complexes are numbered by the operations, from 0; a bar that does not end has the death
/// -1.
struct PlainBar {
  int dimension;
  std::int64_t birth, death;
  friend auto operator<=>(const PlainBar&, const PlainBar&) = default;
};

using PlainSimplex = std::vector<std::uint64_t>;  ///< labels, ascending
using PlainSimplices = std::set<PlainSimplex>;

inline bool is_face(const PlainSimplex& face, const PlainSimplex& of) {
  return std::includes(of.begin(), of.end(), face.begin(), face.end());
}
inline bool has_cofaces(const PlainSimplices& complex, const PlainSimplex& simplex) {
  return std::ranges::any_of(complex, [&](const PlainSimplex& s) { return s != simplex && is_face(simplex, s); });
}
inline bool has_facets(const PlainSimplices& complex, const PlainSimplex& simplex) {
  for (std::size_t k = 0; simplex.size() > 1 && k < simplex.size(); ++k) {
    PlainSimplex facet = simplex;
    facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(k));
    if (!complex.contains(facet)) {
      return false;
    }
  }
  return true;
}
/// Without the simplices that the image has not got: {} where two vertices become one.
inline PlainSimplex image_of(const PlainSimplex& simplex, std::uint64_t from, std::uint64_t to) {
  std::set<std::uint64_t> image;
  for (const std::uint64_t label : simplex) {
    image.insert(label == from ? to : label);
  }
  return {image.begin(), image.end()};
}
inline void carry_out(const ZigzagStep& step, PlainSimplices& complex) {
  PlainSimplex simplex = step.labels;
  std::ranges::sort(simplex);
  if (step.kind == 'i') {
    complex.insert(simplex);
  } else if (step.kind == 'd') {
    complex.erase(simplex);
  } else {
    PlainSimplices images;
    for (const PlainSimplex& s : complex) {
      images.insert(image_of(s, step.labels[0], step.labels[1]));
    }
    complex = std::move(images);
  }
}

struct ZigzagShape {
  std::size_t steps = 30;
  std::uint32_t labels = 6;
  std::size_t most_vertices_of_simplex = 4;
  std::uint32_t deletions_in_16 = 6, contractions_in_16 = 1;
};

/// A random zigzag. Simplices that were deleted come again, and labels that were contracted away.
inline std::vector<ZigzagStep> random_zigzag(std::uint32_t seed, const ZigzagShape& shape) {
  std::mt19937 random{seed};
  PlainSimplices complex;
  std::vector<ZigzagStep> zigzag;
  std::size_t misses = 0;
  while (zigzag.size() < shape.steps && ++misses < 100 * shape.steps) {
    const std::uint32_t draw = random() % 16;
    ZigzagStep step;
    std::vector<PlainSimplex> all(complex.begin(), complex.end());
    if (draw < shape.deletions_in_16) {
      std::erase_if(all, [&](const PlainSimplex& s) { return has_cofaces(complex, s); });
      if (all.empty()) {
        continue;
      }
      step = {'d', all[random() % all.size()]};
    } else if (draw < shape.deletions_in_16 + shape.contractions_in_16) {
      std::erase_if(all, [](const PlainSimplex& s) { return s.size() != 1; });
      if (all.size() < 2) {
        continue;
      }
      const std::size_t one = random() % all.size(), other = random() % all.size();
      if (one == other) {
        continue;
      }
      step = {'c', {all[one][0], all[other][0]}};
    } else {
      const std::size_t size = 1 + random() % shape.most_vertices_of_simplex;
      std::set<std::uint64_t> labels;
      while (labels.size() < std::min<std::size_t>(size, shape.labels)) {
        labels.insert(random() % shape.labels);
      }
      PlainSimplex simplex(labels.begin(), labels.end());
      // What it lacks most: a face, so that simplices of all dimensions come about.
      for (std::size_t k = 0; k < 8 && !has_facets(complex, simplex); ++k) {
        const std::size_t without = random() % simplex.size();
        PlainSimplex face;
        for (std::size_t vertex = 0; vertex < simplex.size(); ++vertex) {
          if (vertex != without) {
            face.push_back(simplex[vertex]);
          }
        }
        if (!face.empty() && !complex.contains(face)) {
          simplex = std::move(face);
        }
      }
      if (complex.contains(simplex) || !has_facets(complex, simplex)) {
        continue;
      }
      step = {'i', simplex};
    }
    std::shuffle(step.labels.begin(), step.kind == 'c' ? step.labels.begin() : step.labels.end(), random);
    carry_out(step, complex);
    zigzag.push_back(step);
  }
  return zigzag;
}

// ------------------------------------------------------------------------------------------- linear algebra modulo p

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
struct PlainHomology {
  std::map<PlainSimplex, std::size_t> numbers;
  PlainRows boundaries, classes;  ///< a basis of the boundaries, and cycles that are one modulo these

  PlainHomology(const PlainSimplices& complex, std::size_t dimension, const PlainField& field) {
    std::map<PlainSimplex, std::size_t> below;
    std::vector<PlainSimplex> above;
    for (const PlainSimplex& s : complex) {
      if (s.size() == dimension + 1) {
        numbers.emplace(s, numbers.size());
      } else if (s.size() == dimension) {
        below.emplace(s, below.size());
      } else if (s.size() == dimension + 2) {
        above.push_back(s);
      }
    }
    const auto boundary = [&](const PlainSimplex& s, const std::map<PlainSimplex, std::size_t>& of) {
      PlainVector row(of.size(), 0);
      for (std::size_t k = 0; s.size() > 1 && k < s.size(); ++k) {
        PlainSimplex facet = s;
        facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(k));
        row[of.at(facet)] = field.reduced(k % 2 == 0 ? 1 : -1);
      }
      return row;
    };
    PlainRows rows(numbers.size());
    for (const auto& [s, number] : numbers) {
      rows[number] = boundary(s, below);
    }
    PlainRows filled;
    for (const PlainSimplex& s : above) {
      filled.push_back(boundary(s, numbers));
    }
    std::size_t rank = 0;
    filled = field.echelon(std::move(filled), numbers.size(), &rank);
    filled.resize(rank);
    boundaries = filled;
    for (const PlainVector& cycle : field.relations(rows, below.size())) {
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
  /// The classes of another complex, sent here by a map of vertices: a row for each.
  [[nodiscard]] PlainRows images(const PlainHomology& of, const ZigzagStep& step, const PlainField& field) const {
    PlainRows rows;
    for (const PlainVector& cycle : of.classes) {
      PlainVector image(numbers.size(), 0);
      for (const auto& [s, number] : of.numbers) {
        PlainSimplex sent = s;
        if (step.kind == 'c') {
          std::ranges::replace(sent, step.labels[0], step.labels[1]);
        }
        std::int64_t sign = 1;
        for (std::size_t k = 0; k < sent.size(); ++k) {
          for (std::size_t j = 0; j < k; ++j) {
            sign = sent[j] == sent[k] ? 0 : sent[j] > sent[k] ? -sign : sign;
          }
        }
        std::ranges::sort(sent);
        if (sign != 0) {
          image[numbers.at(sent)] = field.reduced(image[numbers.at(sent)] + sign * cycle[number]);
        }
      }
      rows.push_back(class_of(image, field));
    }
    return rows;
  }
};

/// All bars, sorted. The number of bars over [b, d] is the rank of the relation that the maps in between are, which is
/// that of the map from their limit to their colimit; multiplicities follow by inclusion and exclusion.
inline std::vector<PlainBar> plain_zigzag_bars(const std::vector<ZigzagStep>& zigzag, std::int64_t p,
                                               std::size_t dimensions = 4) {
  const PlainField field{p};
  const std::size_t n = zigzag.size();
  std::vector<PlainBar> bars;
  for (std::size_t dimension = 0; dimension < dimensions; ++dimension) {
    std::vector<PlainHomology> groups;
    PlainSimplices complex;
    for (const ZigzagStep& step : zigzag) {
      carry_out(step, complex);
      groups.emplace_back(complex, dimension, field);
    }
    std::vector<PlainRows> maps(n);  ///< from the complex before to the one with this number, or back
    for (std::size_t k = 1; k < n; ++k) {
      maps[k] = zigzag[k].kind == 'd' ? groups[k - 1].images(groups[k], zigzag[k], field)
                                      : groups[k].images(groups[k - 1], zigzag[k], field);
    }
    std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> over;
    for (std::size_t b = 0; b < n; ++b) {
      const std::size_t first = groups[b].classes.size();
      PlainRows relation(first, PlainVector(2 * first, 0));  // rows (x, y)
      for (std::size_t k = 0; k < first; ++k) {
        relation[k][k] = relation[k][first + k] = 1;
      }
      for (std::size_t d = b; d < n; ++d) {
        const std::size_t last = groups[d].classes.size();
        if (d > b) {
          const std::size_t before = groups[d - 1].classes.size();
          PlainRows next;
          if (zigzag[d].kind == 'd') {
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
                field.add(row,
                          PlainVector(relation[k].begin(), relation[k].begin() + static_cast<std::ptrdiff_t>(first)),
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
        bars.insert(bars.end(), static_cast<std::size_t>(times),
                    {static_cast<int>(dimension), b, d + 1 == end ? -1 : d + 1});
      }
    }
  }
  std::ranges::sort(bars);
  return bars;
}

}  // namespace sesame::tests
