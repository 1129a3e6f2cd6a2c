#include "tools/mesh/triangulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <unordered_set>
#include <utility>

#include "tools/mesh/text.hpp"

namespace sesame::tools {

namespace {

class Triangulator {
 public:
  Triangulator(Mesh& mesh, Polygons how) : mesh_{mesh}, how_{how}, last_face_(mesh.points.size(), none) {}

  std::vector<std::uint32_t> run() {
    note_edges();
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      const auto face = mesh_.faces[f];
      if (face.size() == 3) {
        triangles_.push_face(face);
      } else if (meets_a_point_twice(f)) {
        cut_along_ring(face);
      } else if (how_ == Polygons::cone || !fan(face)) {
        cone(face);
        ++cones_;
      }
      face_of_triangle_.resize(triangles_.size(), f);
    }
    mesh_.faces = std::move(triangles_);
    add_remarks();
    return std::move(face_of_triangle_);
  }

 private:
  static constexpr std::uint32_t none = 0xffffffff;

  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
  }

  void note_edges() {
    if (how_ == Polygons::cone) {
      return;
    }
    edges_.reserve(mesh_.faces.corners().size());
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const auto face = mesh_.faces[f];
      for (std::size_t i = 0; i < face.size(); ++i) {
        edges_.insert(key(face[i], face[(i + 1) % face.size()]));
      }
    }
    for (const auto& [from, to] : mesh_.lines) {
      edges_.insert(key(from, to));
    }
  }

  bool meets_a_point_twice(std::uint32_t f) {
    const auto face = mesh_.faces[f];
    return std::any_of(face.begin(), face.end(),
                       [&](std::uint32_t corner) { return std::exchange(last_face_[corner], f) == f; });
  }

  bool diagonals_are_new(std::span<const std::uint32_t> face, std::size_t apex) const {
    for (std::size_t i = 2; i + 1 < face.size(); ++i) {
      if (edges_.contains(key(face[apex], face[(apex + i) % face.size()]))) {
        return false;
      }
    }
    return true;
  }

  bool fan(std::span<const std::uint32_t> face) {
    // A limit, so that a polygon with very many corners costs no more than a few passes over it.
    const std::size_t tries = std::min<std::size_t>(face.size(), 16);
    for (std::size_t apex = 0; apex < tries; ++apex) {
      if (!diagonals_are_new(face, apex)) {
        continue;
      }
      fan_from(face, apex);
      for (std::size_t i = 2; i + 1 < face.size(); ++i) {
        edges_.insert(key(face[apex], face[(apex + i) % face.size()]));
      }
      ++fans_;
      return true;
    }
    return false;
  }

  void fan_from(std::span<const std::uint32_t> face, std::size_t apex) {
    const auto corner = [&](std::size_t i) { return face[(apex + i) % face.size()]; };
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      triangles_.push_face(std::array{corner(0), corner(i), corner(i + 1)});
    }
  }

  void cone(std::span<const std::uint32_t> face) {
    const auto apex = add_point(middle(face));
    for (std::size_t i = 0; i < face.size(); ++i) {
      triangles_.push_face(std::array{face[i], face[(i + 1) % face.size()], apex});
    }
  }

  void cut_along_ring(std::span<const std::uint32_t> face) {
    const Point centre = middle(face);
    std::vector<std::uint32_t> ring;
    for (const auto corner : face) {
      Point point{};
      for (std::size_t i = 0; i < 3; ++i) {
        point[i] = std::midpoint(mesh_.points[corner][i], centre[i]);
      }
      ring.push_back(add_point(point));
    }
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::size_t next = (i + 1) % face.size();
      triangles_.push_face(std::array{face[i], face[next], ring[i]});
      triangles_.push_face(std::array{face[next], ring[next], ring[i]});
    }
    // No edge elsewhere joins points of the ring.
    if (how_ == Polygons::cone) {
      cone(ring);
    } else {
      fan_from(ring, 0);
    }
    ++rings_;
  }

  [[nodiscard]] Point middle(std::span<const std::uint32_t> face) const {
    Point centre{};
    for (const auto corner : face) {
      for (std::size_t i = 0; i < 3; ++i) {
        centre[i] += mesh_.points[corner][i] / static_cast<double>(face.size());
      }
    }
    return centre;
  }

  std::uint32_t add_point(const Point& point) {
    mesh_.points.push_back(point);
    return static_cast<std::uint32_t>(mesh_.points.size() - 1);
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
    if (rings_ > 0) {
      mesh_.remarks.push_back(fmt::format("put a ring of new points into {} that {} a point twice, and cut along it",
                                          counted(rings_, "face", "faces"), rings_ == 1 ? "meets" : "meet"));
    }
  }

  Mesh& mesh_;
  Polygons how_;
  Faces triangles_;
  std::vector<std::uint32_t> face_of_triangle_;
  std::unordered_set<std::uint64_t> edges_;
  std::vector<std::uint32_t> last_face_;  ///< of each point of the mesh: the face that met it last
  std::size_t fans_ = 0;
  std::size_t cones_ = 0;
  std::size_t rings_ = 0;
};

}  // namespace

std::vector<std::uint32_t> triangulate(Mesh& mesh, Polygons how) {
  bool has_polygons = false;
  for (std::size_t f = 0; f < mesh.faces.size() && !has_polygons; ++f) {
    has_polygons = mesh.faces[f].size() > 3;
  }
  if (has_polygons) {
    return Triangulator{mesh, how}.run();
  }
  std::vector<std::uint32_t> face_of_triangle(mesh.faces.size());
  std::iota(face_of_triangle.begin(), face_of_triangle.end(), 0U);
  return face_of_triangle;
}

}  // namespace sesame::tools
