/// \file
/// Polygon meshes as their files give them, and the readers of OFF, OBJ, PLY and STL.
///
/// A mesh here is what the file says and no more: broken faces, doubled faces and unused points are kept, so that
/// `validate` can report them; `normalise` (normalise.hpp) makes a clean cell complex of it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sparse/result.hpp"

namespace sesame::tools {

using Point = std::array<double, 3>;
using Edge = std::array<std::uint32_t, 2>;

/// Faces as rows of point numbers, in one block: face i has the corners [starts_[i], starts_[i + 1]).
class Faces {
 public:
  [[nodiscard]] std::size_t size() const { return starts_.size() - 1; }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t face) const {
    return std::span{corners_}.subspan(starts_[face], starts_[face + 1] - starts_[face]);
  }
  /// Position in corners() of the first corner of a face; also defined for face == size().
  [[nodiscard]] std::uint32_t start(std::size_t face) const { return starts_[face]; }
  [[nodiscard]] std::span<const std::uint32_t> corners() const { return corners_; }

  /// Adds a corner to the face under construction, which `close_face` ends.
  void push_corner(std::uint32_t point) { corners_.push_back(point); }
  void close_face() { starts_.push_back(static_cast<std::uint32_t>(corners_.size())); }
  void push_face(std::span<const std::uint32_t> points) {
    corners_.insert(corners_.end(), points.begin(), points.end());
    close_face();
  }
  /// Replaces every point number p by to[p].
  void renumber(std::span<const std::uint32_t> to) {
    for (auto& corner : corners_) {
      corner = to[corner];
    }
  }

 private:
  std::vector<std::uint32_t> starts_{0};
  std::vector<std::uint32_t> corners_;
};

struct Mesh {
  std::vector<Point> points;
  Faces faces;
  std::vector<Edge> lines;           ///< segments that the file lists by themselves (OBJ `l`, PLY `edge`)
  std::vector<std::string> remarks;  ///< what was left out, welded, or changed on the way; one sentence each
};

/// Lists of facets, CGAL's maps and, in MEDIT and VTK, solids are no meshes here, and are refused; `import` reads them
/// otherwise.
enum class Format { automatic, off, obj, ply, stl, facets, map, medit, vtk };

/// By its extension, that of `mesh.off` and of `mesh.off.gz`; automatic when that tells nothing.
[[nodiscard]] Format format_of_extension(std::string_view name);
/// By what it begins with; automatic when that tells nothing.
[[nodiscard]] Format format_of_content(std::string_view bytes);

struct ReadOptions {
  Format format = Format::automatic;  ///< automatic: by the extension, else by the content
  /// Points within this distance of an earlier point become that point. Without a value only STL, which has no other
  /// connectivity, is welded, and only where coordinates are equal.
  std::optional<double> weld;
};

/// Reads a mesh file, gzip or not, or standard input when the path is "-". The whole file is held in memory.
///
/// Ensures  every corner is the number of a point; coordinates are finite.
/// Errors   io: the file cannot be read; bad_input: `FILE:LINE: what, and what would be right`, for binary files with
///          `byte N` in the place of the line. Memory stays proportional to the size of the file, whatever it claims.
[[nodiscard]] Result<Mesh> read_mesh(const std::string& path, const ReadOptions& options = {});

/// The same for bytes in memory; `name` stands in messages and, by its extension, may tell the format.
[[nodiscard]] Result<Mesh> parse_mesh(std::string_view bytes, std::string_view name, const ReadOptions& options = {});

}  // namespace sesame::tools
