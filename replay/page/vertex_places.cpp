#include "replay/page/vertex_places.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <variant>

#include "replay/export/positions.hpp"

namespace sesame::replay {
namespace {

using ops::Point;

constexpr double length_of_gluing = 0.35;  ///< beside 1, that of an edge: pieces are seen apart before they are glued
constexpr double step_aside = 0.15;        ///< of the way to its neighbours that a copy is beside the original

/// The vertices of a regular simplex with edges of length 1 in as many dimensions as it has, up to three; of a larger
/// one, points around a sphere.
std::vector<Point> simplex_shape(int dimension) {
  switch (dimension) {
    case 1:
      return {{0, 0, 0}, {1, 0, 0}};
    case 2:
      return {{0, 0, 0}, {1, 0, 0}, {0.5, 0.8660, 0}};
    case 3:
      return {{0, 0, 0}, {1, 0, 0}, {0.5, 0.8660, 0}, {0.5, 0.2887, 0.8165}};
    default:
      break;
  }
  std::vector<Point> points;
  for (int k = 0; k <= dimension; ++k) {
    const double z = 1 - (2.0 * k + 1) / (dimension + 1);
    const double radius = std::sqrt(1 - z * z);
    points.push_back({radius * std::cos(2.4 * k), radius * std::sin(2.4 * k), z});
  }
  return points;
}

/// The place of a point of a component among all directions, drawn in three: what is beyond the third goes aslant.
Point drawn(const Point& point, int first_direction, int directions) {
  static constexpr std::array<Point, 6> axes{Point{1, 0, 0},    {0, 1, 0},         {0, 0, 1},
                                             {0.45, 0.35, 0.3}, {-0.3, 0.45, 0.4}, {0.4, -0.35, 0.45}};
  Point sum{};
  for (int axis = 0; axis < std::min(directions, 3); ++axis) {
    const Point& to = axes[static_cast<std::size_t>(first_direction + axis) % axes.size()];
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k] += point[static_cast<std::size_t>(axis)] * to[k];
    }
  }
  return sum;
}

Point added(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

/// The vertices of a standard cell, in lexicographic order.
std::vector<Point> standard_shape(const ops::CellType& type) {
  std::vector<Point> all{Point{}};
  int direction = 0;
  for (const int part : type) {
    std::vector<Point> next;
    const std::vector<Point> of_part = simplex_shape(part);
    for (const Point& so_far : all) {
      for (const Point& point : of_part) {
        next.push_back(added(so_far, drawn(point, direction, part)));
      }
    }
    all = std::move(next);
    direction += part;
  }
  return all;
}

/// With sides of length 1.
std::vector<Point> regular_polygon(int sides) {
  std::vector<Point> corners;
  const double turn = 2 * std::numbers::pi / sides;
  const double radius = sides > 1 ? 0.5 / std::sin(turn / 2) : 0.5;
  for (int k = 0; k < sides; ++k) {
    corners.push_back({radius * std::cos(k * turn), radius * std::sin(k * turn), 0});
  }
  return corners;
}

}  // namespace

void VertexPlaces::add_vertex(std::uint32_t cell) {
  index_.emplace(cell, static_cast<std::uint32_t>(known_.size()));
  known_.push_back({cell, std::nullopt});
}

std::uint32_t VertexPlaces::index(std::uint32_t cell) const {
  const auto found = index_.find(cell);
  return found == index_.end() ? std::uint32_t{ops::none} : found->second;
}

void VertexPlaces::put_at_sum(std::uint32_t cell, std::uint32_t left, std::uint32_t right, std::uint32_t family) {
  Known& vertex = known(cell);
  if (left != ops::none && right != ops::none) {
    vertex.from = {left, right};
    vertex.family = family;
  }
}

void VertexPlaces::put_beside(std::uint32_t cell, std::uint32_t source) {
  if (source != ops::none) {
    known(cell).source = source;
  }
}

void VertexPlaces::take(const ops::Operation& operation, const engine::StepReport& report,
                        const ops::Structure& structure, const std::function<std::uint32_t(ops::CellId)>& number_of) {
  for (const auto& [node, point] : given_positions(operation, report, structure)) {
    const std::uint32_t cell = number_of(node);
    if (const std::uint32_t found = cell == ops::none ? cell : index(cell); found != ops::none) {
      known_[found].given = point;
    }
  }
  if (const auto* simplex = std::get_if<ops::MakeSimplex>(&operation); simplex != nullptr && simplex->at.empty()) {
    shape(standard_shape(simplex->dimension > 0 ? ops::CellType{simplex->dimension} : ops::CellType{}), report,
          number_of);
  } else if (const auto* simploid = std::get_if<ops::MakeSimploid>(&operation);
             simploid != nullptr && simploid->at.empty()) {
    shape(standard_shape(simploid->type), report, number_of);
  } else if (const auto* polygon = std::get_if<ops::MakePolygon>(&operation);
             polygon != nullptr && polygon->at.empty()) {
    shape(regular_polygon(polygon->sides), report, number_of);
  }
}

void VertexPlaces::shape(const std::vector<Point>& corners, const engine::StepReport& report,
                         const std::function<std::uint32_t(ops::CellId)>& number_of) {
  ++groups_;
  ops::CellId node = report.before.created;
  for (const Point& point : corners) {
    const std::uint32_t cell = number_of(node++);
    if (const std::uint32_t found = cell == ops::none ? cell : index(cell); found != ops::none) {
      known_[found].group = groups_;
      known_[found].shape = point;
    }
  }
}

/// What is given, and sums of that. In a product in which two vertices would fall together none has its place so.
std::vector<std::optional<Point>> VertexPlaces::sums() const {
  std::vector<std::optional<Point>> fixed(known_.size());
  std::map<std::pair<std::uint32_t, Point>, int> at_a_place;
  std::unordered_map<std::uint32_t, bool> fall_together;
  const auto place_of = [&](std::uint32_t cell) {
    const std::uint32_t found = cell == ops::none ? cell : index(cell);
    return found == ops::none ? std::nullopt : fixed[found];
  };
  for (std::size_t k = 0; k < known_.size(); ++k) {
    const Known& vertex = known_[k];
    fixed[k] = vertex.given;
    const std::optional<Point> left = place_of(vertex.from[0]);
    const bool is_sum = vertex.from[1] != ops::none;
    const std::optional<Point> right = is_sum ? place_of(vertex.from[1]) : Point{};
    if (!fixed[k] && left && right) {
      fixed[k] = added(*left, *right);
      if (is_sum && ++at_a_place[{vertex.family, *fixed[k]}] > 1) {
        fall_together[vertex.family] = true;
      }
    }
  }
  for (std::size_t k = 0; k < known_.size() && !fall_together.empty(); ++k) {
    const Known& vertex = known_[k];
    if (vertex.from[1] != ops::none && !vertex.given && fall_together.count(vertex.family) > 0) {
      fixed[k] = std::nullopt;
    }
  }
  return fixed;
}

/// The vertex whose place a cell has in the layout: a copy that of its original. Or none.
std::uint32_t VertexPlaces::in_layout(std::uint32_t cell) const {
  std::uint32_t found = index(cell);
  while (found != ops::none && known_[found].source != ops::none) {
    found = index(known_[found].source);
  }
  return found;
}

VertexPlaces::Pairs VertexPlaces::all_edges(const PageCells& cells) const {
  Pairs all = joined_;
  for (std::uint32_t cell = 0; cell < cells.size(); ++cell) {
    if (cells.first_face[cell + 1] - cells.first_face[cell] == 2 && cells.dimension(cell) == 1) {
      const PageRef head = cells.faces[cells.first_face[cell]];
      const PageRef tail = cells.faces[cells.first_face[cell] + 1];
      if (head >= 0 && tail >= 0) {
        all.emplace_back(static_cast<std::uint32_t>(tail / 2), static_cast<std::uint32_t>(head / 2));
      }
    }
  }
  return all;
}

std::vector<LayoutEdge> VertexPlaces::edges(const PageCells& cells) const {
  std::vector<LayoutEdge> edges;
  const auto add = [&](const Pairs& pairs, double length) {
    for (const auto& [a, b] : pairs) {
      const std::uint32_t from = in_layout(a);
      const std::uint32_t to = in_layout(b);
      if (from != ops::none && to != ops::none && from != to) {
        edges.push_back({from, to, length});
      }
    }
  };
  add(all_edges(cells), 1);
  add(glued_, length_of_gluing);
  return edges;
}

std::vector<VertexPlace> VertexPlaces::places(const PageCells& cells) const {
  const std::vector<std::optional<Point>> fixed = sums();
  std::vector<LayoutVertex> vertices(known_.size());
  for (std::size_t k = 0; k < known_.size(); ++k) {
    vertices[k] = {fixed[k], known_[k].group, known_[k].shape};
  }
  const std::vector<Point> points = lay_out(vertices, edges(cells));
  std::vector<VertexPlace> places;
  for (std::size_t k = 0; k < known_.size(); ++k) {
    const Known& vertex = known_[k];
    const PlaceKind kind = vertex.given                              ? PlaceKind::given
                           : vertex.source != ops::none              ? PlaceKind::beside
                           : fixed[k] && vertex.from[1] != ops::none ? PlaceKind::sum
                           : fixed[k]                                ? PlaceKind::given
                                                                     : PlaceKind::computed;
    places.push_back({vertex.cell, kind, points[k]});
  }
  put_copies_beside(cells, places);
  return places;
}

/// A copy goes a little towards the neighbours that went with it, so that one sees what was split.
void VertexPlaces::put_copies_beside(const PageCells& cells, std::vector<VertexPlace>& places) const {
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> around;
  for (const auto& [a, b] : all_edges(cells)) {
    const std::uint32_t from = index(a);
    const std::uint32_t to = index(b);
    if (from != ops::none && to != ops::none && from != to) {
      around[from].push_back(to);
      around[to].push_back(from);
    }
  }
  for (std::uint32_t k = 0; k < places.size(); ++k) {
    const std::uint32_t source = known_[k].source == ops::none ? std::uint32_t{ops::none} : index(known_[k].source);
    if (source == ops::none || places[k].kind != PlaceKind::beside) {
      continue;
    }
    const Point& base = places[source].point;
    places[k].point = base;
    for (const std::uint32_t neighbour : around[k]) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        places[k].point[axis] +=
            step_aside * (places[neighbour].point[axis] - base[axis]) / static_cast<double>(around[k].size());
      }
    }
  }
}

}  // namespace sesame::replay
