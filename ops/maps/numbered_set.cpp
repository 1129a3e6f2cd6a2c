#include "ops/maps/numbered_set.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "ops/maps/cell_errors.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

using Lists = std::vector<std::vector<SimplexNumber>>;

/// Each p-simplex has p + 1 faces, which there are.
Status check_totality(const Lists& faces, std::size_t p, std::size_t available) {
  for (std::size_t s = 0; s < faces.size(); ++s) {
    if (faces[s].size() != p + 1) {
      return bad_cells(fmt::format("{}-simplex {} has {} faces: {} are right", p, s, faces[s].size(), p + 1));
    }
    for (std::size_t k = 0; k <= p; ++k) {
      if (faces[s][k] >= available) {
        return bad_cells(fmt::format("face {} of {}-simplex {} is {}, but there are only {} simplices of dimension {}",
                                     k, p, s, faces[s][k], available, p - 1));
      }
    }
  }
  return Done{};
}

/// d_j d_i = d_{i-1} d_j for j < i.
Status check_identities(const Lists& faces, const Lists& below, std::size_t p) {
  for (std::size_t s = 0; s < faces.size(); ++s) {
    for (std::size_t i = 1; i <= p; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const SimplexNumber one = below[faces[s][i]][j];
        const SimplexNumber other = below[faces[s][j]][i - 1];
        if (one != other) {
          return bad_cells(
              fmt::format("faces of {0}-simplex {1} do not agree: face {3} of its face {2} is {4}, but face "
                          "{5} of its face {3} is {6}",
                          p, s, i, j, one, i - 1, other));
        }
      }
    }
  }
  return Done{};
}

Status check_faces(const NumberedSet::Faces& faces, std::size_t vertices) {
  for (std::size_t p = 1; p <= faces.size(); ++p) {
    const std::size_t available = p == 1 ? vertices : faces[p - 2].size();
    if (Status s = check_totality(faces[p - 1], p, available); !s) {
      return s;
    }
    if (p >= 2) {
      if (Status s = check_identities(faces[p - 1], faces[p - 2], p); !s) {
        return s;
      }
    }
  }
  return Done{};
}

/// The set without one bit.
IndexSet without(IndexSet set, int i) { return set & ~(IndexSet{1} << i); }
int largest(IndexSet set) { return static_cast<int>(std::bit_width(set)) - 1; }

/// The non-empty sets of 0, ..., n, smaller ones first.
std::vector<IndexSet> number_sets(int n) {
  std::vector<IndexSet> sets((std::size_t{1} << (n + 1)) - 1);
  std::iota(sets.begin(), sets.end(), IndexSet{1});
  std::ranges::stable_sort(sets, {}, [](IndexSet set) { return std::popcount(set); });
  return sets;
}

}  // namespace

Result<NumberedSet> NumberedSet::make(std::vector<int> numbers_of_vertices, Faces faces) {
  for (std::size_t v = 0; v < numbers_of_vertices.size(); ++v) {
    if (numbers_of_vertices[v] < 0 || numbers_of_vertices[v] > largest_map_dimension) {
      return bad_cells(fmt::format("vertex {} has the number {}: 0 to {} are possible", v, numbers_of_vertices[v],
                                   largest_map_dimension));
    }
  }
  while (!faces.empty() && faces.back().empty()) {
    faces.pop_back();
  }
  if (Status s = check_faces(faces, numbers_of_vertices.size()); !s) {
    return s.error();
  }
  NumberedSet set;
  set.numbers_ = std::move(numbers_of_vertices);
  set.faces_ = std::move(faces);
  if (Status s = set.find_vertices(); !s) {
    return s.error();
  }
  if (Status s = set.check_principal(); !s) {
    return s.error();
  }
  return set;
}

/// By the laws of faces the vertices of a simplex are those of its last face and the last one of its first face. Their
/// numbers increase in every simplex where they do in edges.
Status NumberedSet::find_vertices() {
  if (numbers_.empty()) {
    return Done{};
  }
  vertices_.resize(faces_.size() + 1);
  for (SimplexNumber v = 0; v < numbers_.size(); ++v) {
    vertices_[0].push_back({v});
  }
  for (std::size_t p = 1; p < vertices_.size(); ++p) {
    for (const std::vector<SimplexNumber>& faces : faces_[p - 1]) {
      std::vector<SimplexNumber> vertices = vertices_[p - 1][faces.back()];
      vertices.push_back(vertices_[p - 1][faces.front()].back());
      const std::size_t simplex = vertices_[p].size();
      if (p == 1 && numbers_[vertices[0]] >= numbers_[vertices[1]]) {
        return bad_cells(
            fmt::format("edge {} has a vertex numbered {} as face 0, and one numbered {} as face 1: face 0 is "
                        "the one with the larger number",
                        simplex, numbers_[vertices[1]], numbers_[vertices[0]]));
      }
      vertices_[p].push_back(std::move(vertices));
    }
  }
  return Done{};
}

Status NumberedSet::check_principal() const {
  for (int p = 0; p <= dimension(); ++p) {
    std::vector<bool> is_face(count(p), false);
    for (SimplexNumber s = 0; s < count(p + 1); ++s) {
      for (const SimplexNumber face : faces(p + 1, s)) {
        is_face[face] = true;
      }
    }
    for (SimplexNumber s = 0; s < count(p); ++s) {
      if (!is_face[s] && numbers(p, s) != (IndexSet{2} << p) - 1) {
        std::vector<int> found;
        std::ranges::transform(vertices(p, s), std::back_inserter(found), [&](SimplexNumber v) { return numbers_[v]; });
        return bad_cells(
            fmt::format("{0}-simplex {1} is no face of another one and numbered {2}: it should be numbered 0 "
                        "to {0}",
                        p, s, fmt::join(found, ", ")));
      }
    }
  }
  return Done{};
}

SimplexNumber NumberedSet::count(int p) const {
  return p < 0 || p > dimension() ? 0 : static_cast<SimplexNumber>(vertices_[static_cast<std::size_t>(p)].size());
}

std::vector<std::uint32_t> NumberedSet::f_vector() const {
  std::vector<std::uint32_t> counts;
  for (int p = 0; p <= dimension(); ++p) {
    counts.push_back(count(p));
  }
  return counts;
}

std::int64_t NumberedSet::euler_characteristic() const {
  std::int64_t sum = 0;
  for (int p = 0; p <= dimension(); ++p) {
    sum += p % 2 == 0 ? std::int64_t{count(p)} : -std::int64_t{count(p)};
  }
  return sum;
}

IndexSet NumberedSet::numbers(int p, SimplexNumber simplex) const {
  IndexSet set = 0;
  for (const SimplexNumber v : vertices(p, simplex)) {
    set |= IndexSet{1} << numbers_[v];
  }
  return set;
}

std::vector<std::uint32_t> NumberedSet::cell_counts() const {
  std::vector<std::uint32_t> counts(vertices_.size());
  for (const int number : numbers_) {
    ++counts[static_cast<std::size_t>(number)];
  }
  return counts;
}

std::vector<std::vector<SimplexNumber>> NumberedSet::cell(SimplexNumber vertex) const {
  sparse::expects(vertex < count(0), "a cell is named by a vertex");
  std::vector<std::vector<SimplexNumber>> simplices(static_cast<std::size_t>(numbers_[vertex]) + 1);
  for (std::size_t p = 0; p < simplices.size(); ++p) {
    for (SimplexNumber s = 0; s < vertices_[p].size(); ++s) {
      if (vertices_[p][s].back() == vertex) {
        simplices[p].push_back(s);
      }
    }
  }
  return simplices;
}

NumberedSet NumberedSet::canonical_boundary(SimplexNumber vertex) const {
  const std::vector<std::vector<SimplexNumber>> simplices = cell(vertex);
  std::vector<int> numbers;
  Faces faces(simplices.size());
  for (std::size_t p = 1; p < simplices.size(); ++p) {
    for (const SimplexNumber s : simplices[p]) {
      if (p == 1) {
        numbers.push_back(numbers_[vertices_[1][s].front()]);
        continue;
      }
      std::vector<SimplexNumber>& places = faces[p - 2].emplace_back();
      for (std::size_t k = 0; k < p; ++k) {  // the last face is the one without the vertex
        const auto place = std::ranges::lower_bound(simplices[p - 1], faces_[p - 1][s][k]);
        places.push_back(static_cast<SimplexNumber>(place - simplices[p - 1].begin()));
      }
    }
  }
  return std::move(*make(std::move(numbers), std::move(faces)));
}

std::optional<NumberedSet::Multiple> NumberedSet::multi_incidence() const {
  for (int p = 1; p <= dimension(); ++p) {
    std::vector<SimplexNumber> order(count(p));
    std::iota(order.begin(), order.end(), SimplexNumber{0});
    const auto by_vertices = [&](SimplexNumber s) -> const std::vector<SimplexNumber>& { return vertices(p, s); };
    std::ranges::stable_sort(order, {}, by_vertices);
    const auto found = std::ranges::adjacent_find(order, {}, by_vertices);
    if (found != order.end()) {
      return Multiple{p, found[0], found[1]};
    }
  }
  return std::nullopt;
}

reductions::ChainComplex<sparse::Integers> chain_complex(const NumberedSet& set) {
  const sparse::Integers ring;
  reductions::Sizes sizes;
  std::vector<reductions::Matrix<sparse::Integers>> boundaries;
  for (int p = 0; p <= set.dimension(); ++p) {
    sizes.push_back(set.count(p));
    auto& boundary = boundaries.emplace_back(ring, set.count(p - 1), p == 0 ? set.count(0) : 0);
    for (SimplexNumber s = 0; p > 0 && s < set.count(p); ++s) {
      reductions::RawTerms<sparse::Integers> terms;
      for (std::size_t k = 0; k <= static_cast<std::size_t>(p); ++k) {
        terms.push_back({set.faces(p, s)[k], ring.from(k % 2 == 0 ? 1 : -1)});
      }
      boundary.append_column(std::move(terms).normal(ring));
    }
  }
  return {ring, std::move(sizes), std::move(boundaries)};
}

NumberedSet set_of_orbits(int n, const std::function<Orbits(IndexSet)>& family,
                          const std::function<Dart(Dart, int, int)>& lower) {
  if (n < 0) {
    return {};
  }
  std::vector<Orbits> orbits_of(std::size_t{1} << (n + 1));
  std::vector<SimplexNumber> before(orbits_of.size());  // those of other sets of the same size
  std::vector<SimplexNumber> counts(static_cast<std::size_t>(n) + 2);
  std::vector<int> numbers;
  NumberedSet::Faces faces(static_cast<std::size_t>(n));
  for (const IndexSet set : number_sets(n)) {
    const auto size = static_cast<std::size_t>(std::popcount(set));
    orbits_of[set] = family(set);
    before[set] = std::exchange(counts[size], counts[size] + orbits_of[set].count());
    for (const Dart d : orbits_of[set].first) {
      if (size == 1) {
        numbers.push_back(largest(set));
        continue;
      }
      std::vector<SimplexNumber>& places = faces[size - 2].emplace_back();
      for (int i = 0; i <= largest(set); ++i) {
        if ((set >> i & 1U) != 0) {
          const IndexSet rest = without(set, i);
          const Dart there = i == largest(set) ? lower(d, i, largest(rest)) : d;
          places.push_back(before[rest] + orbits_of[rest].of[there]);
        }
      }
    }
  }
  return std::move(*NumberedSet::make(std::move(numbers), std::move(faces)));
}

NumberedSet simplicial_analogue(const GMap& map) {
  return set_of_orbits(
      map.dimension(), [&](IndexSet set) { return orbits(map, map.indices() & ~set); },
      [](Dart d, int, int) { return d; });
}

}  // namespace sesame::ops
