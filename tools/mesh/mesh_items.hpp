/// \file
/// A triangulated mesh as a list of triangles and lines, and the order in which they are put together.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/mesh/incidence.hpp"
#include "tools/mesh/mesh.hpp"
#include "tools/mesh/script.hpp"

namespace sesame::tools {

/// No vertex, edge or item.
inline constexpr std::uint32_t no_item = 0xffffffff;

/// A triangle or a line, its vertices in increasing order. The edge at place k of a triangle is the face that omits
/// vertex k; a line has its one edge at place 0.
struct MeshSimplex {
  std::array<std::uint32_t, 3> vertices;
  std::array<std::uint32_t, 3> edges;
  std::size_t dimension;

  [[nodiscard]] std::span<const std::uint32_t> all_vertices() const& {
    return std::span{vertices}.first(dimension + 1);
  }
  [[nodiscard]] std::span<const std::uint32_t> all_edges() const& {
    return std::span{edges}.first(dimension == 2 ? 3 : 1);
  }
  // Loops over the cells of a temporary would dangle.
  void all_vertices() const&& = delete;
  void all_edges() const&& = delete;
};

/// A triangulated mesh as a list of items: its triangles, then its lines.
class MeshItems {
 public:
  explicit MeshItems(Mesh mesh);

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const Incidence& incidence() const { return incidence_; }
  [[nodiscard]] std::size_t size() const { return mesh_.faces.size() + mesh_.lines.size(); }
  [[nodiscard]] bool is_line(std::uint32_t item) const { return item >= mesh_.faces.size(); }

  /// The number of an item among its kind.
  [[nodiscard]] std::size_t number(std::uint32_t item) const {
    return is_line(item) ? item - mesh_.faces.size() : item;
  }

  [[nodiscard]] std::span<const std::uint32_t> items_at(std::uint32_t vertex) const {
    return std::span{items_at_}.subspan(items_at_begin_[vertex], items_at_begin_[vertex + 1] - items_at_begin_[vertex]);
  }

  [[nodiscard]] MeshSimplex operator[](std::uint32_t item) const;

 private:
  Mesh mesh_;
  Incidence incidence_;
  std::vector<std::uint32_t> items_at_begin_;
  std::vector<std::uint32_t> items_at_;
};

/// The items in the order in which a script is to add them.
[[nodiscard]] std::vector<std::uint32_t> build_order(const MeshItems& items, BuildOrder order);

}  // namespace sesame::tools
