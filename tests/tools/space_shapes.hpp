/// \file
/// Closed surfaces in space of which it is known what is inside and what outside.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "tests/tools/mesh_shapes.hpp"
#include "tools/mesh/geometry.hpp"
#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

inline Point unit_vector(const Point& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

/// A closed curve of n points, and a tube of m sides around it; point (i, j) has number i m + j. The sides turn with
/// the curve as little as they can, and `turns` times more all the way round.
inline Mesh tube_around(const std::vector<Point>& curve, std::uint32_t m, double radius, int turns = 0) {
  const auto n = static_cast<std::uint32_t>(curve.size());
  std::vector<Point> tangents;
  std::vector<Point> normals;
  const auto across = [](const Point& v, const Point& tangent) {
    const double along = dot(v, tangent);
    return unit_vector({v[0] - along * tangent[0], v[1] - along * tangent[1], v[2] - along * tangent[2]});
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    tangents.push_back(unit_vector(minus(curve[(i + 1) % n], curve[(i + n - 1) % n])));
    normals.push_back(across(i == 0 ? Point{0.3, 0.2, 1} : normals.back(), tangents.back()));
  }
  const Point back = across(normals.back(), tangents[0]);
  const double missing = -std::atan2(dot(back, cross(tangents[0], normals[0])), dot(back, normals[0]));
  const double turn = missing + 2 * std::numbers::pi * turns;
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Point other = cross(tangents[i], normals[i]);
    for (std::uint32_t j = 0; j < m; ++j) {
      const double angle = 2 * std::numbers::pi * j / m + turn * i / n;
      Point point = curve[i];
      for (std::size_t k = 0; k < 3; ++k) {
        point[k] += radius * (std::cos(angle) * normals[i][k] + std::sin(angle) * other[k]);
      }
      points.push_back(point);
      const auto at = [=](std::uint32_t di, std::uint32_t dj) { return (i + di) % n * m + (j + dj) % m; };
      triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  return mesh_of(std::move(points), triangles);
}

inline std::vector<Point> trefoil(std::uint32_t n) {
  std::vector<Point> curve;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n;
    curve.push_back({std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t)});
  }
  return curve;
}

inline std::vector<Point> circle(std::uint32_t n, double radius, const Point& centre = {}) {
  std::vector<Point> curve;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n;
    curve.push_back({centre[0] + radius * std::cos(t), centre[1] + radius * std::sin(t), centre[2]});
  }
  return curve;
}

/// A turn about a random axis.
inline std::array<Point, 3> random_rotation(std::mt19937& random) {
  std::normal_distribution<double> number;
  const Point a = unit_vector({number(random), number(random), number(random)});
  const Point c = unit_vector(cross(a, {number(random), number(random), number(random)}));
  return {a, cross(c, a), c};
}

inline Mesh moved(Mesh mesh, const std::array<Point, 3>& rows, const Point& by) {
  for (Point& p : mesh.points) {
    p = {dot(rows[0], p) + by[0], dot(rows[1], p) + by[1], dot(rows[2], p) + by[2]};
  }
  return mesh;
}

/// All faces the other way round, or every third one only.
inline Mesh turned_faces(const Mesh& mesh, bool only_some = false) {
  Mesh turned;
  turned.points = mesh.points;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    std::vector<std::uint32_t> corners(mesh.faces[f].begin(), mesh.faces[f].end());
    if (!only_some || f % 3 == 0) {
      std::reverse(corners.begin(), corners.end());
    }
    turned.faces.push_face(corners);
  }
  return turned;
}

/// Unit cubes, those from (1, 1, 1) to (size, size, size) of which may be full.
class Cubes {
 public:
  explicit Cubes(int size) : width_{size + 2}, is_full_(static_cast<std::size_t>(width_ * width_ * width_), false) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] bool at(int x, int y, int z) const {
    const bool is_in = std::min({x, y, z}) >= 0 && std::max({x, y, z}) < width_;
    return is_in && is_full_[place(x, y, z)];
  }
  void set(int x, int y, int z, bool is_full) { is_full_[place(x, y, z)] = is_full; }
  /// Fills a row of cubes along an axis, with both ends.
  void fill(std::array<int, 3> from, const std::array<int, 3>& to) {
    for (;;) {
      set(from[0], from[1], from[2], true);
      if (from == to) {
        return;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        from[k] += (to[k] > from[k] ? 1 : 0) - (to[k] < from[k] ? 1 : 0);
      }
    }
  }
  /// Whether the surface of the full cubes is one: at each corner of the cube the full ones are connected by faces, and
  /// the empty ones.
  [[nodiscard]] bool is_surface_around(int x, int y, int z) const {
    for (int corner = 0; corner < 8; ++corner) {
      if (!is_surface_at(x + corner % 2, y + corner / 2 % 2, z + corner / 4)) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] std::uint32_t point(int x, int y, int z) const {
    return static_cast<std::uint32_t>((x * (width_ + 1) + y) * (width_ + 1) + z);
  }
  /// Squares, from outside counterclockwise; points are on the lattice, those of no square too.
  [[nodiscard]] Mesh surface() const {
    Mesh mesh;
    for (int x = 0; x <= width_; ++x) {
      for (int y = 0; y <= width_; ++y) {
        for (int z = 0; z <= width_; ++z) {
          mesh.points.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        }
      }
    }
    for (int x = 0; x < width_; ++x) {
      for (int y = 0; y < width_; ++y) {
        for (int z = 0; z < width_; ++z) {
          add_squares(mesh, {x, y, z});
        }
      }
    }
    return mesh;
  }
  /// The closed full cubes, or the closed empty ones, cut into tetrahedra all in the same way, by the numbers of
  /// points.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 4>> tetrahedra(bool full) const {
    std::vector<std::array<std::uint32_t, 4>> all;
    for (int x = 0; x < width_; ++x) {
      for (int y = 0; y < width_; ++y) {
        for (int z = 0; z < width_; ++z) {
          if (at(x, y, z) != full) {
            continue;
          }
          std::array<std::size_t, 3> order{0, 1, 2};
          do {
            std::array<int, 3> p{x, y, z};
            std::array<std::uint32_t, 4> tetrahedron{point(x, y, z)};
            for (std::size_t k = 0; k < 3; ++k) {
              ++p[order[k]];
              tetrahedron[k + 1] = point(p[0], p[1], p[2]);
            }
            all.push_back(tetrahedron);
          } while (std::next_permutation(order.begin(), order.end()));
        }
      }
    }
    return all;
  }

 private:
  [[nodiscard]] std::size_t place(int x, int y, int z) const {
    return static_cast<std::size_t>((x * width_ + y) * width_ + z);
  }
  [[nodiscard]] bool is_surface_at(int x, int y, int z) const {
    std::array<bool, 8> is_full{};
    for (int c = 0; c < 8; ++c) {
      is_full[static_cast<std::size_t>(c)] = at(x - 1 + c % 2, y - 1 + c / 2 % 2, z - 1 + c / 4);
    }
    for (const bool kind : {false, true}) {
      // Cubes that are reached from the first of their kind across faces.
      std::array<bool, 8> is_reached{};
      std::vector<std::size_t> next;
      for (std::size_t c = 0; c < 8 && next.empty(); ++c) {
        if (is_full[c] == kind) {
          next.push_back(c);
          is_reached[c] = true;
        }
      }
      while (!next.empty()) {
        const std::size_t here = next.back();
        next.pop_back();
        for (const std::size_t axis : {std::size_t{1}, std::size_t{2}, std::size_t{4}}) {
          if (const std::size_t there = here ^ axis; is_full[there] == kind && !is_reached[there]) {
            is_reached[there] = true;
            next.push_back(there);
          }
        }
      }
      for (std::size_t c = 0; c < 8; ++c) {
        if (is_full[c] == kind && !is_reached[c]) {
          return false;
        }
      }
    }
    return true;
  }
  void add_squares(Mesh& mesh, const std::array<int, 3>& cube) const {
    if (!at(cube[0], cube[1], cube[2])) {
      return;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int step : {0, 1}) {
        std::array<int, 3> beside = cube;
        beside[axis] += step == 1 ? 1 : -1;
        if (at(beside[0], beside[1], beside[2])) {
          continue;
        }
        std::vector<std::uint32_t> corners;
        for (const auto& [u, v] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          std::array<int, 3> p = cube;
          p[axis] += step;
          p[(axis + 1) % 3] += u;
          p[(axis + 2) % 3] += v;
          corners.push_back(point(p[0], p[1], p[2]));
        }
        if (step == 0) {
          std::reverse(corners.begin(), corners.end());
        }
        mesh.faces.push_face(corners);
      }
    }
  }

  int width_;
  std::vector<bool> is_full_;
};

/// A closed path through middles of cubes, by its corners; the cubes along it become full.
inline std::vector<Point> fill_ring(Cubes& cubes, const std::vector<std::array<int, 3>>& corners) {
  std::vector<Point> path;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto& [x, y, z] = corners[k];
    cubes.fill(corners[k], corners[(k + 1) % corners.size()]);
    path.push_back({x + 0.5, y + 0.5, z + 0.5});
  }
  return path;
}

/// Cubes that are turned full and empty at random, as long as their surface is one.
inline Cubes random_cubes(int size, int steps, std::mt19937& random) {
  Cubes cubes(size);
  std::uniform_int_distribution<int> place(1, size);
  std::bernoulli_distribution fills(0.6);
  cubes.set((size + 1) / 2, (size + 1) / 2, (size + 1) / 2, true);
  for (int step = 0; step < steps; ++step) {
    const int x = place(random);
    const int y = place(random);
    const int z = place(random);
    const bool before = cubes.at(x, y, z);
    cubes.set(x, y, z, fills(random));
    if (!cubes.is_surface_around(x, y, z)) {
      cubes.set(x, y, z, before);
    }
  }
  return cubes;
}

}  // namespace sesame::tools
