#include "replay/page/graph_layout.hpp"

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace sesame::replay {
namespace {

using ops::Point;
using Places = Eigen::Matrix<double, Eigen::Dynamic, 3>;
constexpr std::size_t most_pivots = 50;
constexpr std::size_t most_for_stress = 600;
constexpr int rounds_of_stress = 80;
constexpr double far = std::numeric_limits<double>::infinity();

struct Neighbour {
  std::uint32_t vertex;
  double length;
};
using Neighbours = std::vector<std::vector<Neighbour>>;

Neighbours neighbours_of(std::size_t vertices, const std::vector<LayoutEdge>& edges) {
  Neighbours all(vertices);
  for (const LayoutEdge& edge : edges) {
    if (edge.a != edge.b) {
      all[edge.a].push_back({edge.b, edge.length});
      all[edge.b].push_back({edge.a, edge.length});
    }
  }
  return all;
}

/// Each ascending, in the order of their first vertices.
std::vector<std::vector<std::uint32_t>> components_of(const Neighbours& neighbours) {
  std::vector<std::vector<std::uint32_t>> components;
  std::vector<bool> is_known(neighbours.size(), false);
  for (std::uint32_t start = 0; start < neighbours.size(); ++start) {
    if (is_known[start]) {
      continue;
    }
    std::vector<std::uint32_t> found{start};
    is_known[start] = true;
    for (std::size_t k = 0; k < found.size(); ++k) {
      for (const auto& [next, length] : neighbours[found[k]]) {
        if (!is_known[next]) {
          is_known[next] = true;
          found.push_back(next);
        }
      }
    }
    std::sort(found.begin(), found.end());
    components.push_back(std::move(found));
  }
  return components;
}

/// The lengths of shortest paths from a vertex, by the position in the component.
Eigen::VectorXd distances_from(std::uint32_t start, const Neighbours& neighbours,
                               const std::vector<std::uint32_t>& position, std::size_t size) {
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(size), far);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> pending;
  distance[position[start]] = 0;
  pending.emplace(0, start);
  while (!pending.empty()) {
    const auto [so_far, vertex] = pending.top();
    pending.pop();
    if (so_far > distance[position[vertex]]) {
      continue;
    }
    for (const auto& [next, length] : neighbours[vertex]) {
      double& known = distance[position[next]];
      if (so_far + length < known) {
        known = so_far + length;
        pending.emplace(known, next);
      }
    }
  }
  return distance;
}

/// The largest entry of each column is positive, so that the result does not depend on the signs of eigenvectors.
void fix_signs(Places& places) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    Eigen::Index largest = 0;
    places.col(axis).cwiseAbs().maxCoeff(&largest);
    if (places.rows() > 0 && places(largest, axis) < 0) {
      places.col(axis) = -places.col(axis);
    }
  }
}

/// Columns are distances from pivots; places whose distances are like them.
Places principal_axes(const Eigen::MatrixXd& distances) {
  Eigen::MatrixXd centred = -0.5 * distances.cwiseAbs2();
  const Eigen::VectorXd of_rows = centred.rowwise().mean();
  const Eigen::RowVectorXd of_columns = centred.colwise().mean();
  const double of_all = centred.mean();
  centred.colwise() -= of_rows;
  centred.rowwise() -= of_columns;
  centred.array() += of_all;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(centred.transpose() * centred);
  Places places = Places::Zero(distances.rows(), 3);
  const double largest = solver.eigenvalues().tail(1)[0];
  for (Eigen::Index axis = 0; axis < std::min<Eigen::Index>(3, distances.cols()); ++axis) {
    const Eigen::Index column = distances.cols() - 1 - axis;
    const double value = solver.eigenvalues()[column];
    if (value > 1e-9 * largest) {  // the square of a singular value
      places.col(axis) = centred * solver.eigenvectors().col(column) / std::pow(value, 0.25);
    }
  }
  fix_signs(places);
  return places;
}

/// Moves one after the other to where the distances to all others are best, those to near ones counting most.
void lessen_stress(const Eigen::MatrixXd& distances, Places& places) {
  const Eigen::Index size = places.rows();
  for (Eigen::Index k = 0; k < size; ++k) {  // off a plane or line, on which they would have to stay
    places(k, 1) += 1e-3 * std::sin(1.7 * static_cast<double>(k));
    places(k, 2) += 1e-3 * std::cos(2.3 * static_cast<double>(k));
  }
  for (int round = 0; round < rounds_of_stress; ++round) {
    for (Eigen::Index k = 0; k < size; ++k) {
      Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
      double weights = 0;
      for (Eigen::Index other = 0; other < size; ++other) {
        if (other == k) {
          continue;
        }
        const Eigen::RowVector3d away = places.row(k) - places.row(other);
        const double now = std::max(away.norm(), 1e-9);
        const double weight = 1 / (distances(k, other) * distances(k, other));
        sum += weight * (places.row(other) + away * (distances(k, other) / now));
        weights += weight;
      }
      if (weights > 0) {
        places.row(k) = sum / weights;
      }
    }
  }
}

/// Turned so that it is widest along the first axis, and flattest along the last one.
void turn_to_principal_axes(Places& places) {
  places.rowwise() -= places.colwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(places.transpose() * places);
  places = (places * solver.eigenvectors().rowwise().reverse()).eval();
  fix_signs(places);
}

Places by_distances(const std::vector<std::uint32_t>& component, const Neighbours& neighbours,
                    std::vector<std::uint32_t>& position) {
  for (std::uint32_t k = 0; k < component.size(); ++k) {
    position[component[k]] = k;
  }
  const bool is_small = component.size() <= most_for_stress;
  const auto size = static_cast<Eigen::Index>(component.size());
  const Eigen::Index pivots = is_small ? size : static_cast<Eigen::Index>(most_pivots);
  Eigen::MatrixXd distances(size, pivots);
  Eigen::VectorXd nearest = Eigen::VectorXd::Constant(size, far);
  Eigen::Index pivot = 0;
  for (Eigen::Index k = 0; k < pivots; ++k) {
    pivot = is_small ? k : pivot;
    distances.col(k) =
        distances_from(component[static_cast<std::size_t>(pivot)], neighbours, position, component.size());
    nearest = nearest.cwiseMin(distances.col(k));
    nearest.maxCoeff(&pivot);  // the next one is as far from all others as can be
  }
  Places places = principal_axes(distances);
  if (is_small && size > 1) {
    lessen_stress(distances, places);
  }
  turn_to_principal_axes(places);
  return places;
}

bool is_one_standard_cell(const std::vector<std::uint32_t>& component, const std::vector<LayoutVertex>& vertices) {
  const std::uint32_t group = vertices[component.front()].group;
  return group != 0 && std::all_of(component.begin(), component.end(),
                                   [&](std::uint32_t vertex) { return vertices[vertex].group == group; });
}

/// The weighted mean of the neighbours, for all that have no place; weights are 1 / length.
void relax(const std::vector<std::uint32_t>& free, const Neighbours& neighbours, std::vector<std::uint32_t>& position,
           const std::vector<LayoutVertex>& vertices, std::vector<Point>& places) {
  for (std::uint32_t k = 0; k < free.size(); ++k) {
    position[free[k]] = k;
  }
  const auto size = static_cast<Eigen::Index>(free.size());
  std::vector<Eigen::Triplet<double>> entries;
  Places right = Places::Zero(size, 3);
  for (Eigen::Index k = 0; k < size; ++k) {
    double sum = 0;
    for (const auto& [other, length] : neighbours[free[static_cast<std::size_t>(k)]]) {
      sum += 1 / length;
      if (vertices[other].fixed) {
        right.row(k) += Eigen::Map<const Eigen::RowVector3d>(vertices[other].fixed->data()) / length;
      } else {
        entries.emplace_back(k, position[other], -1 / length);
      }
    }
    entries.emplace_back(k, k, sum);
  }
  Eigen::SparseMatrix<double> laplacian(size, size);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(laplacian);
  solver.setMaxIterations(1000);
  solver.setTolerance(1e-8);
  const Places solved = solver.solve(right);
  for (Eigen::Index k = 0; k < size; ++k) {
    places[free[static_cast<std::size_t>(k)]] = {solved(k, 0), solved(k, 1), solved(k, 2)};
  }
}

/// Moves an apex over a flat base out of the plane, to one side and the other in turn.
void lift(std::uint32_t vertex, const std::vector<Neighbour>& neighbours, int turn, std::vector<Point>& places) {
  Places around(static_cast<Eigen::Index>(neighbours.size()), 3);
  for (Eigen::Index k = 0; k < around.rows(); ++k) {
    around.row(k) = Eigen::Map<const Eigen::RowVector3d>(places[neighbours[static_cast<std::size_t>(k)].vertex].data());
  }
  around.rowwise() -= around.colwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(around.transpose() * around);
  const double widest = solver.eigenvalues()[2];
  if (widest <= 0 || solver.eigenvalues()[0] > 0.02 * widest) {
    return;
  }
  Eigen::Vector3d normal = solver.eigenvectors().col(0);
  Eigen::Index largest = 0;
  normal.cwiseAbs().maxCoeff(&largest);
  normal *= normal[largest] < 0 ? -1 : 1;
  const double height = std::sqrt(widest / static_cast<double>(around.rows())) * (turn % 2 == 0 ? 1 : -1);
  for (int axis = 0; axis < 3; ++axis) {
    places[vertex][static_cast<std::size_t>(axis)] += height * normal[axis];
  }
}

/// Components that have no place are set side by side, in rows behind what has one.
class Shelf {
 public:
  Shelf(const std::vector<LayoutVertex>& vertices, std::size_t components)
      : in_a_row_{static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(components))))} {
    for (const LayoutVertex& vertex : vertices) {
      if (vertex.fixed) {
        start_ = std::max(start_, (*vertex.fixed)[0] + gap);
      }
    }
    x_ = start_;
  }

  void put(const std::vector<std::uint32_t>& component, const Places& places, std::vector<Point>& all) {
    if (placed_ > 0 && placed_ % in_a_row_ == 0) {
      x_ = start_;
      y_ -= deepest_ + gap;
      deepest_ = 0;
    }
    const Eigen::RowVector3d low = places.colwise().minCoeff();
    const Eigen::RowVector3d size = places.colwise().maxCoeff() - low;
    for (Eigen::Index k = 0; k < places.rows(); ++k) {
      all[component[static_cast<std::size_t>(k)]] = {x_ + places(k, 0) - low[0], y_ - size[1] + places(k, 1) - low[1],
                                                     places(k, 2) - low[2] - size[2] / 2};
    }
    x_ += size[0] + gap;
    deepest_ = std::max(deepest_, size[1]);
    ++placed_;
  }

 private:
  static constexpr double gap = 0.8;
  std::size_t in_a_row_, placed_ = 0;
  double start_ = 0, x_ = 0, y_ = 0, deepest_ = 0;
};

}  // namespace

std::vector<Point> lay_out(const std::vector<LayoutVertex>& vertices, const std::vector<LayoutEdge>& edges) {
  const Neighbours neighbours = neighbours_of(vertices.size(), edges);
  std::vector<Point> places(vertices.size());
  std::vector<std::uint32_t> position(vertices.size(), 0);
  const auto components = components_of(neighbours);
  Shelf shelf(vertices, components.size());
  int lifted = 0;
  for (const auto& component : components) {
    std::vector<std::uint32_t> free;
    for (const std::uint32_t vertex : component) {
      if (vertices[vertex].fixed) {
        places[vertex] = *vertices[vertex].fixed;
      } else {
        free.push_back(vertex);
      }
    }
    if (free.size() < component.size()) {
      relax(free, neighbours, position, vertices, places);
      for (const std::uint32_t vertex : free) {
        const auto& around = neighbours[vertex];
        if (std::all_of(around.begin(), around.end(), [&](const auto& n) { return vertices[n.vertex].fixed; })) {
          lift(vertex, around, lifted++, places);
        }
      }
    } else if (is_one_standard_cell(component, vertices)) {
      Places shape(static_cast<Eigen::Index>(component.size()), 3);
      for (Eigen::Index k = 0; k < shape.rows(); ++k) {
        shape.row(k) =
            Eigen::Map<const Eigen::RowVector3d>(vertices[component[static_cast<std::size_t>(k)]].shape.data());
      }
      shelf.put(component, shape, places);
    } else {
      shelf.put(component, by_distances(component, neighbours, position), places);
    }
  }
  return places;
}

}  // namespace sesame::replay
