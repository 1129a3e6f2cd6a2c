#include "tools/mesh/triangulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "tools/mesh/text.hpp"

namespace sesame::tools {

namespace {

class Triangulator {
 public:
  Triangulator(Mesh& mesh, Polygons how) : mesh_{mesh}, how_{how} {}

  void run() {
    note_edges();
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const auto face = mesh_.faces[f];
      if (face.size() == 3) {
        triangles_.push_face(face);
      } else if (how_ == Polygons::cone || !fan(face)) {
        cone(face);
      }
    }
    mesh_.faces = std::move(triangles_);
    add_remarks();
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
  }

  void note_edges() {
    if (how_ == Polygons::cone) return;
    edges_.reserve(mesh_.faces.corners().size());
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const auto face = mesh_.faces[f];
      for (std::size_t i = 0; i < face.size(); ++i) edges_.insert(key(face[i], face[(i + 1) % face.size()]));
    }
    for (const auto& [from, to] : mesh_.lines) edges_.insert(key(from, to));
  }

  bool diagonals_are_new(std::span<const std::uint32_t> face, std::size_t apex) const {
    for (std::size_t i = 2; i + 1 < face.size(); ++i) {
      if (edges_.contains(key(face[apex], face[(apex + i) % face.size()]))) return false;
    }
    return true;
  }

  bool fan(std::span<const std::uint32_t> face) {
    // A limit, so that a polygon with very many corners costs no more than a few passes over it.
    const std::size_t tries = std::min<std::size_t>(face.size(), 16);
    for (std::size_t apex = 0; apex < tries; ++apex) {
      if (!diagonals_are_new(face, apex)) continue;
      const auto corner = [&](std::size_t i) { return face[(apex + i) % face.size()]; };
      for (std::size_t i = 1; i + 1 < face.size(); ++i) {
        triangles_.push_face(std::array{corner(0), corner(i), corner(i + 1)});
        if (i > 1) edges_.insert(key(corner(0), corner(i)));
      }
      ++fans_;
      return true;
    }
    return false;
  }

  void cone(std::span<const std::uint32_t> face) {
    Point centre{};
    for (const auto corner : face) {
      for (std::size_t i = 0; i < 3; ++i) centre[i] += mesh_.points[corner][i] / static_cast<double>(face.size());
    }
    const auto apex = static_cast<std::uint32_t>(mesh_.points.size());
    mesh_.points.push_back(centre);
    for (std::size_t i = 0; i < face.size(); ++i) {
      triangles_.push_face(std::array{face[i], face[(i + 1) % face.size()], apex});
    }
    ++cones_;
  }

  void add_remarks() {
    if (fans_ > 0) {
      mesh_.remarks.push_back(
          fmt::format("cut {} with more than three corners into fans of triangles", counted(fans_, "face", "faces")));
    }
    if (cones_ > 0) {
      mesh_.remarks.push_back(fmt::format(
          "made {} with more than three corners into cones over the boundary, with a "
          "new point in the middle{}",
          counted(cones_, "face", "faces"), how_ == Polygons::fan ? ", as their diagonals are edges elsewhere" : ""));
    }
  }

  Mesh& mesh_;
  Polygons how_;
  Faces triangles_;
  std::unordered_set<std::uint64_t> edges_;
  std::size_t fans_ = 0;
  std::size_t cones_ = 0;
};

}  // namespace

void triangulate(Mesh& mesh, Polygons how) {
  bool has_polygons = false;
  for (std::size_t f = 0; f < mesh.faces.size() && !has_polygons; ++f) has_polygons = mesh.faces[f].size() > 3;
  if (has_polygons) Triangulator{mesh, how}.run();
}

}  // namespace sesame::tools
