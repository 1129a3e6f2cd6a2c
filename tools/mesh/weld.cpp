#include "tools/mesh/weld.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <unordered_map>

#include "sparse/contract.hpp"

namespace sesame::tools {

namespace {

constexpr std::uint32_t none = 0xffffffff;

struct PointHash {
  std::size_t operator()(const Point& point) const {
    std::uint64_t hash = 0;
    for (const double x : point) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

/// The kept points, in the cubes of a grid of side `tolerance`; those of one cube form a linked list.
class Grid {
 public:
  Grid(double tolerance, std::size_t points) : tolerance_{tolerance} { first_.reserve(points); }

  /// The lowest number of a kept point within the tolerance, or `none`.
  [[nodiscard]] std::uint32_t find(const Point& point, const std::vector<Point>& kept) const {
    const int reach = tolerance_ > 0 ? 1 : 0;
    const Point centre = cube(point);
    std::uint32_t best = none;
    for (int dx = -reach; dx <= reach; ++dx) {
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dz = -reach; dz <= reach; ++dz) {
          best = std::min(best, find_in({centre[0] + dx, centre[1] + dy, centre[2] + dz}, point, kept));
        }
      }
    }
    return best;
  }

  void insert(const Point& point, std::uint32_t number) {
    const auto [place, is_new] = first_.try_emplace(cube(point), number);
    next_.push_back(is_new ? none : place->second);
    place->second = number;
  }

 private:
  /// Adding 0.0 turns -0.0 into 0.0, so that both hash alike.
  [[nodiscard]] Point cube(const Point& point) const {
    if (tolerance_ == 0) {
      return {point[0] + 0.0, point[1] + 0.0, point[2] + 0.0};
    }
    return {std::floor(point[0] / tolerance_) + 0.0, std::floor(point[1] / tolerance_) + 0.0,
            std::floor(point[2] / tolerance_) + 0.0};
  }

  [[nodiscard]] std::uint32_t find_in(const Point& cell, const Point& point, const std::vector<Point>& kept) const {
    std::uint32_t best = none;
    const auto place = first_.find(cell);
    for (auto at = place == first_.end() ? none : place->second; at != none; at = next_[at]) {
      const auto& other = kept[at];
      const bool near = std::abs(other[0] - point[0]) <= tolerance_ && std::abs(other[1] - point[1]) <= tolerance_ &&
                        std::abs(other[2] - point[2]) <= tolerance_;
      if (near) {
        best = std::min(best, at);
      }
    }
    return best;
  }

  double tolerance_;
  std::unordered_map<Point, std::uint32_t, PointHash> first_;
  std::vector<std::uint32_t> next_;
};

}  // namespace

void weld(Mesh& mesh, double tolerance) {
  sparse::expects(std::isfinite(tolerance) && tolerance >= 0, "a welding tolerance is finite and not negative");
  const std::size_t before = mesh.points.size();
  Grid grid{tolerance, before};
  std::vector<Point> kept;
  std::vector<std::uint32_t> to(before);
  for (std::size_t p = 0; p < before; ++p) {
    to[p] = grid.find(mesh.points[p], kept);
    if (to[p] != none) {
      continue;
    }
    to[p] = static_cast<std::uint32_t>(kept.size());
    grid.insert(mesh.points[p], to[p]);
    kept.push_back(mesh.points[p]);
  }
  mesh.faces.renumber(to);
  for (auto& [from, end] : mesh.lines) {
    from = to[from];
    end = to[end];
  }
  mesh.points = std::move(kept);
  if (mesh.points.size() < before) {
    mesh.remarks.push_back(
        fmt::format("welded {} points that {} into {}", before,
                    tolerance > 0 ? fmt::format("lie within {} of each other", tolerance) : std::string{"coincide"},
                    mesh.points.size()));
  }
}

}  // namespace sesame::tools
