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

#include "tests/support/plain_relations.hpp"

namespace sesame::tests {

/// An operation of a zigzag: the simplex with these labels is included ('i') or deleted ('d'), or labels[0] is
/// contracted into labels[1] ('c').
struct ZigzagStep {
  char kind = 'i';
  std::vector<std::uint64_t> labels;
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

/// The homology of one dimension of a simplicial complex.
struct PlainHomology : PlainGroup {
  std::map<PlainSimplex, std::size_t> numbers;

  PlainHomology(const PlainSimplices& complex, std::size_t dimension, const PlainField& field)
      : PlainGroup{rows_of(complex, dimension, field), numbered(complex, dimension).size(),
                   rows_of(complex, dimension + 1, field), field},
        numbers{numbered(complex, dimension + 1)} {}

  /// The simplices with so many vertices, in order.
  static std::map<PlainSimplex, std::size_t> numbered(const PlainSimplices& complex, std::size_t vertices) {
    std::map<PlainSimplex, std::size_t> numbers;
    for (const PlainSimplex& s : complex) {
      if (s.size() == vertices && vertices > 0) {
        numbers.emplace(s, numbers.size());
      }
    }
    return numbers;
  }
  /// The boundaries of those of a dimension.
  static PlainRows rows_of(const PlainSimplices& complex, std::size_t dimension, const PlainField& field) {
    const auto of = numbered(complex, dimension);
    PlainRows rows;
    for (const auto& [s, number] : numbered(complex, dimension + 1)) {
      PlainVector row(of.size(), 0);
      for (std::size_t k = 0; s.size() > 1 && k < s.size(); ++k) {
        PlainSimplex facet = s;
        facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(k));
        row[of.at(facet)] = field.reduced(k % 2 == 0 ? 1 : -1);
      }
      rows.push_back(row);
    }
    return rows;
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

/// All bars of a zigzag of simplicial complexes, sorted.
inline std::vector<PlainBar> plain_zigzag_bars(const std::vector<ZigzagStep>& zigzag, std::int64_t p,
                                               std::size_t dimensions = 4) {
  const PlainField field{p};
  const std::size_t n = zigzag.size();
  std::vector<PlainBar> bars;
  for (std::size_t dimension = 0; dimension < dimensions; ++dimension) {
    std::vector<PlainHomology> groups;
    std::vector<std::size_t> sizes;
    std::vector<bool> is_backward;
    PlainSimplices complex;
    for (const ZigzagStep& step : zigzag) {
      carry_out(step, complex);
      groups.emplace_back(complex, dimension, field);
      sizes.push_back(groups.back().classes.size());
      is_backward.push_back(step.kind == 'd');
    }
    std::vector<PlainRows> maps(n);
    for (std::size_t k = 1; k < n; ++k) {
      maps[k] = is_backward[k] ? groups[k - 1].images(groups[k], zigzag[k], field)
                               : groups[k].images(groups[k - 1], zigzag[k], field);
    }
    const std::vector<PlainBar> more = plain_bars_of_maps(static_cast<int>(dimension), sizes, maps, is_backward, field);
    bars.insert(bars.end(), more.begin(), more.end());
  }
  std::ranges::sort(bars);
  return bars;
}

}  // namespace sesame::tests
