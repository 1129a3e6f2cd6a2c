#include "tools/mesh/cut_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <set>
#include <utility>

#include "sparse/contract.hpp"
#include "tools/mesh/geometry.hpp"
#include "tools/mesh/path_tree.hpp"
#include "tools/mesh/space_triangles.hpp"

namespace sesame::tools {

namespace {

using sparse::Index;
using sparse::Integers;
using sparse::RawTerms;
using sparse::Terms;

constexpr std::uint32_t none = SpaceTriangle::none;

Point mean(std::span<const Point> points, std::span<const std::uint32_t> corners) {
  Point sum{};
  for (const std::uint32_t corner : corners) {
    for (std::size_t i = 0; i < 3; ++i) {
      sum[i] += points[corner][i] / static_cast<double>(corners.size());
    }
  }
  return sum;
}

double distance(const Point& p, const Point& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

}  // namespace

/// Kept from part to part, so that a mesh of many parts costs no more than one of as many faces.
struct SurfaceCutter::Scratch {
  struct Face {
    bool is_seen = false;
    bool is_turned = false;  ///< the surface runs through it in the other order than the file
    bool is_settled = false;
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t before = none;  ///< the face towards the root of the tree, and the edge between them
    std::uint32_t edge = none;
    std::uint32_t depth = 0;
  };

  Scratch(const Mesh& mesh, const Incidence& incidence, const EdgeGraph& graph)
      : tree{graph}, faces(mesh.faces.size()), in_tree(incidence.edges.size(), false) {}

  PathTree tree;
  std::vector<Face> faces;
  std::vector<bool> in_tree;
};

/// One part on its way to a cut system.
class SurfaceCutter::Part {
 public:
  Part(SurfaceCutter& cutter, std::span<const std::uint32_t> edges)
      : c_{cutter}, edges_{edges}, tree_{cutter.scratch_->tree}, faces_of_mesh_{cutter.scratch_->faces} {}

  std::optional<CutSystem> run(std::string& why_not) {
    why_not = obstacle();
    if (!why_not.empty()) {
      return std::nullopt;
    }
    grow_trees();
    find_loops();
    set_outflows();
    return std::move(system_);
  }

 private:
  using Face = Scratch::Face;

  std::string obstacle() {
    if (!orient()) {
      return "it is no closed orientable surface";
    }
    for (const std::uint32_t face : faces_) {
      const auto corners = c_.mesh_.faces[face];
      if (std::set<std::uint32_t>(corners.begin(), corners.end()).size() != corners.size()) {
        return "one of its faces meets a point twice";
      }
    }
    cut_faces();
    const int volume = volume_sign();
    if (volume == 0) {
      return "it encloses no volume";
    }
    if (volume < 0) {
      turn_inside_out();
    }
    return {};
  }

  [[nodiscard]] std::array<std::uint32_t, 2> sides(std::uint32_t edge) const {
    const auto corners = c_.incidence_.sides_of(edge);
    return {corners[0], corners[1]};
  }
  [[nodiscard]] std::uint32_t face_of(std::uint32_t corner) const { return c_.incidence_.face_of_corner[corner]; }
  /// Whether the surface has the side of a corner, in the face of the corner, from the lower to the higher point.
  [[nodiscard]] bool runs_upwards(std::uint32_t corner) const {
    return tools::runs_upwards(c_.mesh_, c_.incidence_, corner) != faces_of_mesh_[face_of(corner)].is_turned;
  }

  /// Walks over the faces and turns those that do not agree. Returns whether all of them do in the end.
  bool orient() {
    for (const std::uint32_t edge : edges_) {
      if (c_.incidence_.sides_of(edge).size() != 2) {
        return false;
      }
    }
    faces_.push_back(face_of(sides(edges_.front())[0]));
    faces_of_mesh_[faces_.front()].is_seen = true;
    for (std::size_t next = 0; next < faces_.size(); ++next) {
      const std::uint32_t face = faces_[next];
      for (auto corner = c_.mesh_.faces.start(face); corner < c_.mesh_.faces.start(face + 1); ++corner) {
        const auto [one, two] = sides(c_.incidence_.edge_of_corner[corner]);
        const std::uint32_t opposite = one == corner ? two : one;
        Face& other = faces_of_mesh_[face_of(opposite)];
        if (!other.is_seen) {
          other.is_seen = true;
          other.is_turned = runs_upwards(opposite) == runs_upwards(corner);
          faces_.push_back(face_of(opposite));
        }
      }
    }
    return std::all_of(edges_.begin(), edges_.end(), [this](std::uint32_t edge) {
      const auto [one, two] = sides(edge);
      return faces_of_mesh_[face_of(one)].is_seen && runs_upwards(one) != runs_upwards(two);
    });
  }

  void cut_faces() {
    for (const std::uint32_t face : faces_) {
      const auto corners = c_.mesh_.faces[face];
      const auto count = static_cast<std::uint32_t>(corners.size());
      for (const CornerTriple& places : cut_in_space(c_.points_, corners)) {
        SpaceTriangle triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t from = places[k];
          const std::uint32_t to = places[(k + 1) % 3];
          triangle.points[k] = corners[from];
          triangle.edges[k] =
              to == (from + 1) % count ? c_.incidence_.edge_of_corner[c_.mesh_.faces.start(face) + from] : none;
        }
        if (faces_of_mesh_[face].is_turned) {
          std::swap(triangle.points[1], triangle.points[2]);
          std::swap(triangle.edges[0], triangle.edges[2]);
        }
        system_.triangles.push_back(std::move(triangle));
        face_of_triangle_.push_back(face);
      }
    }
  }

  [[nodiscard]] int volume_sign() const {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangles.reserve(system_.triangles.size());
    for (const SpaceTriangle& triangle : system_.triangles) {
      triangles.push_back(triangle.points);
    }
    return c_.signs_.volume(triangles);
  }

  void turn_inside_out() {
    for (const std::uint32_t face : faces_) {
      faces_of_mesh_[face].is_turned = !faces_of_mesh_[face].is_turned;
    }
    for (SpaceTriangle& triangle : system_.triangles) {
      std::swap(triangle.points[1], triangle.points[2]);
      std::swap(triangle.edges[0], triangle.edges[2]);
    }
  }

  void grow_trees() {
    tree_.grow(c_.incidence_.edges[edges_.front()][0], PathTree::infinite);
    for (const std::uint32_t point : tree_.settled()) {
      if (const auto edge = tree_.step(point).edge; edge != PathTree::none) {
        c_.scratch_->in_tree[edge] = true;
      }
    }
    using Reached = std::pair<double, std::uint32_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
    faces_of_mesh_[faces_.front()].distance = 0;
    queue.emplace(0, faces_.front());
    while (!queue.empty()) {
      const std::uint32_t here = queue.top().second;
      queue.pop();
      if (std::exchange(faces_of_mesh_[here].is_settled, true)) {
        continue;
      }
      for (auto corner = c_.mesh_.faces.start(here); corner < c_.mesh_.faces.start(here + 1); ++corner) {
        const std::uint32_t edge = c_.incidence_.edge_of_corner[corner];
        const auto [one, two] = sides(edge);
        const std::uint32_t there = face_of(one == corner ? two : one);
        const double length = faces_of_mesh_[here].distance + way_across(here, edge, there);
        if (Face& face = faces_of_mesh_[there]; !c_.scratch_->in_tree[edge] && length < face.distance) {
          face.distance = length;
          face.before = here;
          face.edge = edge;
          face.depth = faces_of_mesh_[here].depth + 1;
          queue.emplace(length, there);
        }
      }
    }
  }

  /// Faces without area come last, so that loops do not run across them where they need not.
  [[nodiscard]] double way_across(std::uint32_t from, std::uint32_t edge, std::uint32_t to) const {
    const auto [low, high] = c_.incidence_.edges[edge];
    const Point middle = mean(c_.points_, std::array{low, high});
    return distance(mean(c_.points_, c_.mesh_.faces[from]), middle) +
           distance(middle, mean(c_.points_, c_.mesh_.faces[to])) + (is_flat(from) || is_flat(to) ? 1e6 : 0);
  }
  [[nodiscard]] bool is_flat(std::uint32_t face) const {
    const auto corners = c_.mesh_.faces[face];
    if (corners.size() != 3) {
      return false;
    }
    const Point u = minus(c_.points_[corners[1]], c_.points_[corners[0]]);
    const Point v = minus(c_.points_[corners[2]], c_.points_[corners[0]]);
    const Point normal = cross(u, v);
    return dot(normal, normal) <= 1e-24 * dot(u, u) * dot(v, v);
  }

  void find_loops() {
    for (const std::uint32_t edge : edges_) {
      const auto [one, two] = sides(edge);
      const bool is_crossed = faces_of_mesh_[face_of(one)].edge == edge || faces_of_mesh_[face_of(two)].edge == edge;
      if (!c_.scratch_->in_tree[edge] && !is_crossed) {
        add_loop_along(edge);
        add_loop_across(edge);
        ++system_.rank;
      }
    }
    std::stable_sort(crossed_.begin(), crossed_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t begin = 0; begin < crossed_.size();) {
      RawTerms<Integers> sum;
      std::size_t end = begin;
      for (; end < crossed_.size() && crossed_[end].first == crossed_[begin].first; ++end) {
        sum.push_back(crossed_[end].second);
      }
      system_.crossings.emplace_back(crossed_[begin].first, std::move(sum).normal(Integers{}));
      begin = end;
    }
  }

  /// Up the edge, and back through the tree.
  void add_loop_along(std::uint32_t edge) {
    const auto [low, high] = c_.incidence_.edges[edge];
    std::vector<DirectedEdge> loop{{edge, 1}};
    std::uint32_t from = high;
    std::uint32_t to = low;
    while (from != to) {
      const bool is_from = tree_.step(from).depth >= tree_.step(to).depth;
      std::uint32_t& lower = is_from ? from : to;
      const auto& step = tree_.step(lower);
      const bool goes_up = is_from == (lower < step.before);
      loop.push_back({step.edge, goes_up ? 1 : -1});
      lower = step.before;
    }
    system_.loops.push_back(std::move(loop));
  }

  /// From the face that the edge runs upwards in, across it, and back through the tree of faces.
  void add_loop_across(std::uint32_t edge) {
    const auto [one, two] = sides(edge);
    const bool is_from_one = runs_upwards(one);
    std::uint32_t from = face_of(is_from_one ? two : one);
    std::uint32_t to = face_of(is_from_one ? one : two);
    crossed_.push_back({edge, {system_.rank, 1}});
    while (from != to) {
      const bool is_from = faces_of_mesh_[from].depth >= faces_of_mesh_[to].depth;
      std::uint32_t& lower = is_from ? from : to;
      const Face& face = faces_of_mesh_[lower];
      // Towards the root on one half of the way, away from it on the other.
      const bool leaves_upwards = leaves_across(lower, face.edge) == is_from;
      crossed_.push_back({face.edge, {system_.rank, leaves_upwards ? 1 : -1}});
      lower = face.before;
    }
  }
  /// Whether an edge runs upwards in a face, so that who leaves the face there crosses it with sign 1.
  [[nodiscard]] bool leaves_across(std::uint32_t face, std::uint32_t edge) const {
    const auto [one, two] = sides(edge);
    return runs_upwards(face_of(one) == face ? one : two);
  }

  /// Through edges as the crossings say; between the triangles of one face, what remains.
  void set_outflows() {
    for (std::size_t t = 0; t < system_.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        system_.triangles[t].outflow[k] = outflow(system_.triangles[t], face_of_triangle_[t], k);
      }
    }
  }
  [[nodiscard]] Terms<Integers> outflow(const SpaceTriangle& triangle, std::uint32_t face, std::size_t side) const {
    if (triangle.edges[side] != none) {
      return through(face, triangle.edges[side]);
    }
    // What leaves across the diagonal comes in through the sides of the face that are on this side of it.
    const auto corners = c_.mesh_.faces[face];
    const auto begin = c_.mesh_.faces.start(face);
    const auto place = [&](std::uint32_t point) {
      return static_cast<std::uint32_t>(std::find(corners.begin(), corners.end(), point) - corners.begin());
    };
    // The triangle is to the left of the diagonal, which is followed by the rest of the boundary of its part.
    std::uint32_t from = place(triangle.points[(side + 1) % 3]);
    std::uint32_t to = place(triangle.points[side]);
    if (faces_of_mesh_[face].is_turned) {
      std::swap(from, to);
    }
    Terms<Integers> sum;
    const auto count = static_cast<std::uint32_t>(corners.size());
    for (std::uint32_t corner = from; corner != to; corner = (corner + 1) % count) {
      sparse::add_multiple<Integers>(Integers{}, sum, -1, through(face, c_.incidence_.edge_of_corner[begin + corner]));
    }
    return sum;
  }
  /// What leaves a face through one of its edges.
  [[nodiscard]] Terms<Integers> through(std::uint32_t face, std::uint32_t edge) const {
    const auto at = std::lower_bound(system_.crossings.begin(), system_.crossings.end(), edge,
                                     [](const auto& crossing, std::uint32_t e) { return crossing.first < e; });
    if (at == system_.crossings.end() || at->first != edge) {
      return {};
    }
    Terms<Integers> flow = at->second;
    if (!leaves_across(face, edge)) {
      for (auto& term : flow) {
        term.coefficient = -term.coefficient;
      }
    }
    return flow;
  }

  SurfaceCutter& c_;
  std::span<const std::uint32_t> edges_;
  PathTree& tree_;
  std::vector<Face>& faces_of_mesh_;
  std::vector<std::uint32_t> faces_;
  std::vector<std::uint32_t> face_of_triangle_;
  std::vector<std::pair<std::uint32_t, sparse::Term<Integers>>> crossed_;
  CutSystem system_;
};

SurfaceCutter::SurfaceCutter(const Mesh& mesh, const Incidence& incidence, const EdgeGraph& graph,
                             const ExactSigns& signs, std::span<const Point> points)
    : mesh_{mesh},
      incidence_{incidence},
      graph_{graph},
      signs_{signs},
      points_{points},
      scratch_{std::make_unique<Scratch>(mesh, incidence, graph)} {}

SurfaceCutter::~SurfaceCutter() = default;

std::optional<CutSystem> SurfaceCutter::cut(std::span<const std::uint32_t> edges, std::string& why_not) {
  sparse::expects(!edges.empty(), "a surface has edges");
  return Part{*this, edges}.run(why_not);
}

}  // namespace sesame::tools
