#include "tools/mesh/mesh_items.hpp"

#include <algorithm>
#include <deque>
#include <numeric>
#include <utility>

namespace sesame::tools {

MeshItems::MeshItems(Mesh mesh) : mesh_{std::move(mesh)}, incidence_{incidence_of(mesh_)} {
  items_at_begin_.assign(mesh_.points.size() + 1, 0);
  const auto count = static_cast<std::uint32_t>(size());
  for (std::uint32_t item = 0; item < count; ++item) {
    const auto simplex = (*this)[item];
    for (const auto v : simplex.all_vertices()) {
      ++items_at_begin_[v + 1];
    }
  }
  for (std::size_t v = 0; v < mesh_.points.size(); ++v) {
    items_at_begin_[v + 1] += items_at_begin_[v];
  }
  items_at_.resize(items_at_begin_.back());
  auto next = items_at_begin_;
  for (std::uint32_t item = 0; item < count; ++item) {
    const auto simplex = (*this)[item];
    for (const auto v : simplex.all_vertices()) {
      items_at_[next[v]++] = item;
    }
  }
}

MeshSimplex MeshItems::operator[](std::uint32_t item) const {
  if (is_line(item)) {
    const auto edge = incidence_.edge_of_line[item - mesh_.faces.size()];
    return {{incidence_.edges[edge][0], incidence_.edges[edge][1], no_item}, {edge, no_item, no_item}, 1};
  }
  const auto face = mesh_.faces[item];
  MeshSimplex simplex{{face[0], face[1], face[2]}, {no_item, no_item, no_item}, 2};
  std::sort(simplex.vertices.begin(), simplex.vertices.end());
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto edge = incidence_.edge_of_corner[mesh_.faces.start(item) + i];
    const auto [low, high] = incidence_.edges[edge];
    const std::size_t omitted = low == simplex.vertices[1] ? 0 : high == simplex.vertices[2] ? 1 : 2;
    simplex.edges[omitted] = edge;
  }
  return simplex;
}

namespace {

/// Breadth first over shared edges. When those are used up, an item at an early vertex of what is built is next, so
/// that sheets that touch in a point and lines follow; when there is no_item, the first item of another component.
class BreadthFirst {
 public:
  explicit BreadthFirst(const MeshItems& items)
      : items_{items}, placed_(items.size(), false), seen_(items.mesh().points.size(), false) {}

  std::vector<std::uint32_t> run() {
    for (std::uint32_t seed = 0; seed < items_.size(); ++seed) {
      if (placed_[seed]) {
        continue;
      }
      place(seed);
      grow();
    }
    return std::move(order_);
  }

 private:
  void grow() {
    while (next_ < order_.size() || !frontier_.empty()) {
      if (next_ < order_.size()) {
        place_neighbours(order_[next_++]);
        continue;
      }
      const auto here = items_.items_at(frontier_.front());
      const auto free = std::find_if(here.begin(), here.end(), [this](std::uint32_t item) { return !placed_[item]; });
      if (free == here.end()) {
        frontier_.pop_front();
      } else {
        place(*free);
      }
    }
  }

  void place_neighbours(std::uint32_t item) {
    const auto simplex = items_[item];
    for (const auto edge : simplex.all_edges()) {
      for (const auto side : items_.incidence().sides_of(edge)) {
        const auto face = items_.incidence().face_of_corner[side];
        if (!placed_[face]) {
          place(face);
        }
      }
    }
  }

  void place(std::uint32_t item) {
    placed_[item] = true;
    order_.push_back(item);
    const auto simplex = items_[item];
    for (const auto v : simplex.all_vertices()) {
      if (!seen_[v]) {
        frontier_.push_back(v);
      }
      seen_[v] = true;
    }
  }

  const MeshItems& items_;
  std::vector<bool> placed_;
  std::vector<bool> seen_;
  std::vector<std::uint32_t> order_;
  std::size_t next_ = 0;  ///< items of order_ before this one have had their neighbours placed
  std::deque<std::uint32_t> frontier_;
};

}  // namespace

std::vector<std::uint32_t> build_order(const MeshItems& items, BuildOrder order) {
  if (order == BuildOrder::breadth_first) {
    return BreadthFirst{items}.run();
  }
  std::vector<std::uint32_t> given(items.size());
  std::iota(given.begin(), given.end(), 0U);
  return given;
}

}  // namespace sesame::tools
