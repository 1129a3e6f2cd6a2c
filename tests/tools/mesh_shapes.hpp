/// \file
/// Meshes with known homology, made by formula.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

inline Mesh mesh_of(std::vector<Point> points, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  Mesh mesh;
  mesh.points = std::move(points);
  for (const auto& triangle : triangles) {
    mesh.faces.push_face(triangle);
  }
  return mesh;
}

/// n steps along, m around, the point (i, j) has number i m + j; a tube of the given radius around a circle of
/// radius 4.
inline Mesh grid_torus(std::uint32_t n, std::uint32_t m, double radius) {
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const double u = 2 * std::numbers::pi * i / n;
      const double v = 2 * std::numbers::pi * j / m;
      const double r = 4 + radius * std::cos(v);
      points.push_back({r * std::cos(u), r * std::sin(u), radius * std::sin(v)});
      const auto at = [=](std::uint32_t di, std::uint32_t dj) { return (i + di) % n * m + (j + dj) % m; };
      triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  return mesh_of(std::move(points), triangles);
}

/// The figure-8 immersion; the seam at i = n joins j to -j.
inline Mesh klein_bottle(std::uint32_t n, std::uint32_t m) {
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const double u = 2 * std::numbers::pi * i / n;
      const double v = 2 * std::numbers::pi * j / m;
      const double across = std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
      const double up = std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
      points.push_back({(3 + across) * std::cos(u), (3 + across) * std::sin(u), up});
      const auto at = [=](std::uint32_t di, std::uint32_t dj) {
        const std::uint32_t to = (j + dj) % m;
        return i + di == n ? (m - to) % m : (i + di) * m + to;
      };
      triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  return mesh_of(std::move(points), triangles);
}

/// Six points, ten triangles.
inline Mesh projective_plane() {
  std::vector<Point> points{{0, 0, 1}};
  for (int k = 0; k < 5; ++k) {
    points.push_back({std::cos(k * 0.4 * std::numbers::pi), std::sin(k * 1.2566), 0});
  }
  return mesh_of(
      std::move(points),
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}, {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}});
}

/// A disc of which every third of the boundary runs along the same triangle: H_1 = Z/3.
inline Mesh moore_space() {
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const auto on_circle = [&](double radius, int k, int n, double z) {
    const double angle = 2 * std::numbers::pi * k / n;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
  };
  for (int k = 0; k < 3; ++k) {
    on_circle(1, k, 3, 0);
  }
  for (int k = 0; k < 9; ++k) {
    on_circle(5, k, 9, 1);
  }
  points.push_back({0, 0, 9});
  for (std::uint32_t k = 0; k < 9; ++k) {
    const std::uint32_t next = (k + 1) % 9;
    triangles.push_back({k % 3, next % 3, 3 + k});
    triangles.push_back({next % 3, 3 + next, 3 + k});
    triangles.push_back({3 + k, 3 + next, 12});
  }
  return mesh_of(std::move(points), triangles);
}

/// A regular tetrahedron, faces outwards, moved by `x`.
inline Mesh tetrahedron(double x = 0) {
  return mesh_of({{x + 1, 1, 1}, {x + 1, -1, -1}, {x - 1, 1, -1}, {x - 1, -1, 1}},
                 {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
}

/// A ring of 2 n triangles between two regular polygons.
inline Mesh annulus(std::uint32_t n) {
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    points.push_back({std::cos(angle), std::sin(angle), 0});
    points.push_back({2 * std::cos(angle), 2 * std::sin(angle), 0});
    const std::uint32_t next = (k + 1) % n;
    triangles.push_back({2 * k, 2 * k + 1, 2 * next});
    triangles.push_back({2 * next, 2 * k + 1, 2 * next + 1});
  }
  return mesh_of(std::move(points), triangles);
}

/// Both meshes, as one.
inline Mesh together(Mesh a, const Mesh& b) {
  const auto shift = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (std::size_t f = 0; f < b.faces.size(); ++f) {
    for (const auto corner : b.faces[f]) {
      a.faces.push_corner(corner + shift);
    }
    a.faces.close_face();
  }
  return a;
}

/// Two tori, glued along a triangle that both lose: genus 2.
inline Mesh double_torus() {
  const Mesh one = grid_torus(12, 5, 1);
  const auto shift = static_cast<std::uint32_t>(one.points.size());
  Mesh glued;
  glued.points = one.points;
  for (const auto& [x, y, z] : one.points) {
    glued.points.push_back({-x + 12, y, z});
  }
  for (std::size_t f = 1; f < one.faces.size(); ++f) {
    glued.faces.push_face(one.faces[f]);
  }
  for (std::size_t f = 1; f < one.faces.size(); ++f) {
    for (const auto corner : one.faces[f]) {
      const auto seam = one.faces[0];
      const bool is_on_seam = corner == seam[0] || corner == seam[1] || corner == seam[2];
      glued.faces.push_corner(is_on_seam ? corner : corner + shift);
    }
    glued.faces.close_face();
  }
  return glued;
}

}  // namespace sesame::tools
