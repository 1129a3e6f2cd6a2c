#include "tools/bench/filtrations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "sparse/contract.hpp"
#include "tools/bench/draws.hpp"

namespace sesame::tools {
namespace {

using sparse::expects;

constexpr std::size_t most_vertices = 4;
constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

/// Vertices ascending; behind the last one `no_vertex`.
struct Simplex {
  double value;
  std::uint8_t dimension;
  std::array<std::uint32_t, most_vertices> vertices;
};

Simplex make_simplex(double value, std::initializer_list<std::uint32_t> vertices) {
  Simplex simplex{value, static_cast<std::uint8_t>(vertices.size() - 1), {}};
  simplex.vertices.fill(no_vertex);
  std::copy(vertices.begin(), vertices.end(), simplex.vertices.begin());
  std::sort(simplex.vertices.begin(), simplex.vertices.end());
  return simplex;
}

auto filtration_order(const Simplex& simplex) { return std::tie(simplex.value, simplex.dimension, simplex.vertices); }

/// The places of simplices, found by their vertices.
class Places {
 public:
  explicit Places(const std::vector<Simplex>& simplices) : simplices_{simplices}, by_vertices_(simplices.size()) {
    std::iota(by_vertices_.begin(), by_vertices_.end(), 0U);
    std::sort(by_vertices_.begin(), by_vertices_.end(),
              [this](std::uint32_t a, std::uint32_t b) { return simplices_[a].vertices < simplices_[b].vertices; });
  }
  [[nodiscard]] std::uint32_t of(const std::array<std::uint32_t, most_vertices>& vertices) const {
    return *std::lower_bound(
        by_vertices_.begin(), by_vertices_.end(), vertices,
        [this](std::uint32_t place, const auto& wanted) { return simplices_[place].vertices < wanted; });
  }

 private:
  const std::vector<Simplex>& simplices_;
  std::vector<std::uint32_t> by_vertices_;
};

void push_faces(Filtration& filtration, const Simplex& simplex, const Places& places) {
  std::array<std::uint32_t, most_vertices> faces;
  faces.fill(no_vertex);
  const std::size_t count = simplex.dimension == 0 ? 0 : simplex.dimension + std::size_t{1};
  for (std::size_t left_out = 0; left_out < count; ++left_out) {
    auto face = simplex.vertices;
    std::copy(face.begin() + static_cast<std::ptrdiff_t>(left_out) + 1, face.end(),
              face.begin() + static_cast<std::ptrdiff_t>(left_out));
    face.back() = no_vertex;
    faces[left_out] = places.of(face);
  }
  std::sort(faces.begin(), faces.end());
  filtration.faces.push_back({faces.data(), count});
}

/// Requires every face among the simplices, and before what it is a face of.
Filtration filtration_of(const std::vector<Simplex>& simplices) {
  const Places places(simplices);
  Filtration filtration;
  for (const Simplex& simplex : simplices) {
    filtration.dimensions.push_back(simplex.dimension);
    filtration.values.push_back(simplex.value);
    filtration.vertices.push_back({simplex.vertices.data(), simplex.dimension + std::size_t{1}});
    push_faces(filtration, simplex, places);
  }
  return filtration;
}

Filtration sorted_filtration_of(std::vector<Simplex> simplices) {
  std::sort(simplices.begin(), simplices.end(),
            [](const Simplex& a, const Simplex& b) { return filtration_order(a) < filtration_order(b); });
  return filtration_of(simplices);
}

class PointCloud {
 public:
  PointCloud(std::uint32_t points, std::uint64_t seed) : points_(points) {
    Draws draws(seed);
    for (auto& point : points_) {
      for (double& coordinate : point) {
        coordinate = draws.unit();
      }
    }
  }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(points_.size()); }
  /// Without std::hypot, whose last bit differs between machines.
  [[nodiscard]] double distance(std::uint32_t a, std::uint32_t b) const {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double step = points_[a][i] - points_[b][i];
      sum += step * step;
    }
    return std::sqrt(sum);
  }

 private:
  std::vector<std::array<double, 3>> points_;
};

/// Calls `visit(value, {vertices})` for all simplices, up to tetrahedra, of diameter at most `longest`, until it
/// returns false.
template <class Visit>
void for_each_rips_simplex(const PointCloud& cloud, double longest, Visit&& visit) {
  std::vector<std::vector<std::pair<std::uint32_t, double>>> larger(cloud.size());
  for (std::uint32_t a = 0; a < cloud.size(); ++a) {
    for (std::uint32_t b = a + 1; b < cloud.size(); ++b) {
      if (const double length = cloud.distance(a, b); length <= longest) {
        larger[a].emplace_back(b, length);
      }
    }
  }
  for (std::uint32_t a = 0; a < cloud.size(); ++a) {
    if (!visit(0.0, {a})) {
      return;
    }
    for (std::size_t i = 0; i < larger[a].size(); ++i) {
      const auto [b, ab] = larger[a][i];
      if (!visit(ab, {a, b})) {
        return;
      }
      for (std::size_t j = i + 1; j < larger[a].size(); ++j) {
        const auto [c, ac] = larger[a][j];
        const double abc = std::max({ab, ac, cloud.distance(b, c)});
        if (abc > longest) {
          continue;
        }
        if (!visit(abc, {a, b, c})) {
          return;
        }
        for (std::size_t k = j + 1; k < larger[a].size(); ++k) {
          const auto [d, ad] = larger[a][k];
          const double abcd = std::max({abc, ad, cloud.distance(b, d), cloud.distance(c, d)});
          if (abcd <= longest && !visit(abcd, {a, b, c, d})) {
            return;
          }
        }
      }
    }
  }
}

bool has_cells(const PointCloud& cloud, double longest, std::size_t cells) {
  std::size_t found = 0;
  for_each_rips_simplex(cloud, longest, [&](double, std::initializer_list<std::uint32_t>) { return ++found < cells; });
  return found >= cells;
}

/// The shortest distance of two points at which the complex has that many cells; without one, the longest.
double length_for(const PointCloud& cloud, std::size_t cells) {
  std::vector<double> lengths;
  for (std::uint32_t a = 0; a < cloud.size(); ++a) {
    for (std::uint32_t b = a + 1; b < cloud.size(); ++b) {
      lengths.push_back(cloud.distance(a, b));
    }
  }
  if (lengths.empty()) {
    return 0;
  }
  std::sort(lengths.begin(), lengths.end());
  const auto found = std::partition_point(lengths.begin(), lengths.end() - 1,
                                          [&](double length) { return !has_cells(cloud, length, cells); });
  return *found;
}

using Grid = std::vector<double>;

/// One pass of the mean along the direction in which neighbours are `stride` apart.
Grid mean_along(const Grid& values, std::uint32_t n, std::size_t stride) {
  Grid means(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t coordinate = i / stride % n;
    double sum = values[i];
    int count = 1;
    if (coordinate > 0) {
      sum += values[i - stride];
      ++count;
    }
    if (coordinate + 1 < n) {
      sum += values[i + stride];
      ++count;
    }
    means[i] = sum / count;
  }
  return means;
}

/// The cells of a grid of n^3 vertices are the vertices of one of (2n - 1)^3: a coordinate is odd where a cell extends.
class CubicalCells {
 public:
  explicit CubicalCells(std::uint32_t n) : n_{n}, side_{2 * n - 1} {}

  [[nodiscard]] std::size_t count() const { return std::size_t{side_} * side_ * side_; }
  [[nodiscard]] std::array<std::uint32_t, 3> coordinates(std::uint32_t cell) const {
    return {cell / side_ / side_, cell / side_ % side_, cell % side_};
  }
  [[nodiscard]] std::uint8_t dimension(std::uint32_t cell) const {
    const auto [x, y, z] = coordinates(cell);
    return static_cast<std::uint8_t>(x % 2 + y % 2 + z % 2);
  }
  [[nodiscard]] double value(std::uint32_t cell, const Grid& of_vertices) const {
    const auto [x, y, z] = coordinates(cell);
    double largest = 0;
    for (std::uint32_t i = x / 2; i <= (x + 1) / 2; ++i) {
      for (std::uint32_t j = y / 2; j <= (y + 1) / 2; ++j) {
        for (std::uint32_t k = z / 2; k <= (z + 1) / 2; ++k) {
          largest = std::max(largest, of_vertices[(std::size_t{i} * n_ + j) * n_ + k]);
        }
      }
    }
    return largest;
  }
  /// Calls `visit` with every face of codimension 1.
  template <class Visit>
  void for_each_face(std::uint32_t cell, Visit&& visit) const {
    const auto coordinate = coordinates(cell);
    const std::array<std::uint32_t, 3> strides{side_ * side_, side_, 1};
    for (std::size_t i = 0; i < 3; ++i) {
      if (coordinate[i] % 2 == 1) {
        visit(cell - strides[i]);
        visit(cell + strides[i]);
      }
    }
  }

 private:
  std::uint32_t n_, side_;
};

}  // namespace

Filtration torus_filtration(std::uint32_t n) {
  expects(n >= 3 && n <= 20'000, "a torus has 3 to 20000 vertices a side");
  std::vector<Simplex> simplices;
  simplices.reserve(std::size_t{6} * n * n);
  const auto push = [&simplices](std::initializer_list<std::uint32_t> vertices) {
    simplices.push_back(make_simplex(std::max(vertices), vertices));
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t right = (j + 1) % n, below = (i + 1) % n;
      const std::uint32_t a = i * n + j, b = i * n + right, c = below * n + j, d = below * n + right;
      push({a});
      push({a, b});
      push({a, c});
      push({a, d});
      push({a, b, d});
      push({a, c, d});
    }
  }
  return sorted_filtration_of(std::move(simplices));
}

Filtration rips_filtration(std::uint32_t points, std::size_t cells, std::uint64_t seed) {
  const PointCloud cloud(points, seed);
  std::vector<Simplex> simplices;
  for_each_rips_simplex(cloud, length_for(cloud, cells),
                        [&](double value, std::initializer_list<std::uint32_t> vertices) {
                          simplices.push_back(make_simplex(value, vertices));
                          return true;
                        });
  return sorted_filtration_of(std::move(simplices));
}

Filtration cubical_filtration(std::uint32_t n, unsigned rounds_of_smoothing, std::uint64_t seed) {
  expects(n >= 1 && n <= 800, "a grid has 1 to 800 vertices a side");
  Grid grid(std::size_t{n} * n * n);
  Draws draws(seed);
  std::generate(grid.begin(), grid.end(), [&draws] { return draws.unit(); });
  for (unsigned round = 0; round < rounds_of_smoothing; ++round) {
    for (const std::size_t stride : {std::size_t{1}, std::size_t{n}, std::size_t{n} * n}) {
      grid = mean_along(grid, n, stride);
    }
  }
  const CubicalCells cells(n);
  std::vector<std::uint32_t> order(cells.count());
  std::vector<double> values(cells.count());
  std::iota(order.begin(), order.end(), 0U);
  std::transform(order.begin(), order.end(), values.begin(), [&](std::uint32_t c) { return cells.value(c, grid); });
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(values[a], cells.dimension(a), a) < std::tuple(values[b], cells.dimension(b), b);
  });
  std::vector<std::uint32_t> place(cells.count());
  Filtration filtration;
  for (const std::uint32_t cell : order) {
    place[cell] = static_cast<std::uint32_t>(filtration.size());
    std::vector<std::uint32_t> faces;
    cells.for_each_face(cell, [&](std::uint32_t face) { faces.push_back(place[face]); });
    std::sort(faces.begin(), faces.end());
    filtration.dimensions.push_back(cells.dimension(cell));
    filtration.values.push_back(values[cell]);
    filtration.faces.push_back(faces);
  }
  return filtration;
}

Filtration random_two_complex(std::uint32_t vertices, std::size_t triangles, std::uint64_t seed) {
  expects(vertices <= 2000, "a complete graph has at most 2000 vertices");
  std::vector<Simplex> simplices;
  std::vector<Simplex> all_triangles;
  for (std::uint32_t a = 0; a < vertices; ++a) {
    simplices.push_back(make_simplex(0, {a}));
  }
  for (std::uint32_t a = 0; a < vertices; ++a) {
    for (std::uint32_t b = a + 1; b < vertices; ++b) {
      simplices.push_back(make_simplex(0, {a, b}));
      for (std::uint32_t c = b + 1; c < vertices; ++c) {
        all_triangles.push_back(make_simplex(0, {a, b, c}));
      }
    }
  }
  const std::size_t count = std::min(triangles, all_triangles.size());
  Draws(seed).shuffle_to_front(all_triangles, count);
  simplices.insert(simplices.end(), all_triangles.begin(), all_triangles.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    simplices[i].value = static_cast<double>(i);
  }
  return filtration_of(simplices);
}

}  // namespace sesame::tools
