#include "tools/mesh/loop_sorting.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "sparse/smith.hpp"
#include "tools/mesh/geometry.hpp"
#include "tools/mesh/graph.hpp"
#include "tools/mesh/measure.hpp"

namespace sesame::tools {

namespace {

using sparse::Index;
using sparse::Integer;
using sparse::Integers;
using sparse::Matrix;
using sparse::RawTerms;
using sparse::Terms;

/// A basis of the rows that a projection P has, and the coordinates of x P in it for unit vectors x.
struct Image {
  std::vector<Terms<Integers>> basis;
  std::vector<Terms<Integers>> of_unit;
};

/// P = A D B with D = diag(1, ..., 1, 0, ..., 0), so x P is the sum of (x A)_k times row k of B for the first few k.
/// Nothing when another entry of D is not 0 or 1, as for a projection none is.
std::optional<Image> image_of(const Matrix<Integers>& projection) {
  const auto smith = sparse::smith_form(projection);
  const auto rank = static_cast<Index>(smith.factors.size());
  if (!std::all_of(smith.factors.begin(), smith.factors.end(), [](const Integer& d) { return d == 1; })) {
    return std::nullopt;
  }
  Image image{std::vector<Terms<Integers>>(rank), std::vector<Terms<Integers>>(projection.rows())};
  for (Index k = 0; k < rank; ++k) {
    for (const auto& [i, coefficient] : smith.left_inverse.column(k)) {
      image.of_unit[i].push_back({k, coefficient});
    }
  }
  for (Index j = 0; j < projection.columns(); ++j) {
    for (const auto& [k, coefficient] : smith.right_inverse.column(j)) {
      if (k < rank) {
        image.basis[k].push_back({j, coefficient});
      }
    }
  }
  return image;
}

/// P, or 1 - P.
Matrix<Integers> matrix_of(const LinkingForm& form, bool is_rest) {
  Matrix<Integers> matrix{Integers{}, form.rank, 0};
  for (Index j = 0; j < form.rank; ++j) {
    Terms<Integers> column;
    for (Index i = 0; i < form.rank; ++i) {
      const std::int64_t entry = is_rest ? (i == j ? 1 : 0) - form(i, j) : form(i, j);
      if (entry != 0) {
        column.push_back({i, entry});
      }
    }
    matrix.append_column(column);
  }
  return matrix;
}

bool is_projection(const LinkingForm& form, const Matrix<Integers>& matrix) {
  Integer trace;
  for (Index j = 0; j < form.rank; ++j) {
    trace += form(j, j);
    if (matrix.apply(matrix.column(j)) != matrix.column(j)) {
      return false;
    }
  }
  return trace + trace == Integer{static_cast<std::int64_t>(form.rank)};
}

class Sorting {
 public:
  Sorting(const Mesh& mesh, const KnownOfMesh& known)
      : mesh_{mesh},
        validity_{known.validity},
        meetings_{known.meetings},
        incidence_{incidence_of(mesh)},
        points_{within_one(mesh.points)} {}

  LoopSorting run() {
    const Parts parts = connected_parts(mesh_.points.size(), incidence_.edges);
    std::vector<std::vector<std::uint32_t>> edges(parts.count);
    for (std::uint32_t e = 0; e < incidence_.edges.size(); ++e) {
      edges[parts.of[incidence_.edges[e][0]]].push_back(e);
    }
    found_.parts.resize(parts.count);
    for (HalfOfLoops* half : {&found_.handles, &found_.tunnels}) {
      half->coordinates.of_edge.resize(incidence_.edges.size());
    }
    const std::vector<std::string> crossings = crossings_of(parts);
    const ExactSigns signs(points_);
    const EdgeGraph graph(points_, incidence_.edges);
    SurfaceCutter cutter(mesh_, incidence_, graph, signs, points_);
    for (std::uint32_t part = 0; part < parts.count; ++part) {
      const Component& component = validity_.components[part];
      const auto genus = component.genus();
      std::string& why_not = found_.parts[part].why_not;
      if (!component.is_closed() || !genus) {
        why_not = !component.is_manifold     ? "it is not a surface, so it has no inside"
                  : !component.is_orientable ? "it is not orientable, so it has no inside"
                                             : "it has a boundary, so it has no inside";
      } else if (*genus > 0 && !crossings[part].empty()) {
        why_not = crossings[part];
      } else if (*genus > most_handles) {
        why_not = "it has more than " + std::to_string(most_handles) + " handles";
      } else if (*genus > 0) {
        if (const auto system = cutter.cut(edges[part], why_not)) {
          LinkingForm form = linking_form(*system, incidence_.edges, signs);
          if (!form.obstacle.empty()) {
            form = form_of_moved(*system, edges[part], part);
          }
          found_.parts[part].is_sorted = sort(*system, form, why_not);
        }
      }
    }
    return std::move(found_);
  }

 private:
  // Coordinates of edges that are crossed are long vectors then, and Smith forms large.
  static constexpr long long most_handles = 500;

  /// Of each part that is a surface, what it crosses; empty when nothing.
  [[nodiscard]] std::vector<std::string> crossings_of(const Parts& parts) const {
    std::vector<std::string> crossings(parts.count);
    const auto is_surface = [this](std::uint32_t part) {
      return validity_.components[part].is_closed() && validity_.components[part].genus();
    };
    for (const FaceMeeting& meeting : meetings_.meetings) {
      const std::uint32_t one = parts.of[mesh_.faces[meeting.faces[0]][0]];
      const std::uint32_t other = parts.of[mesh_.faces[meeting.faces[1]][0]];
      if (!meeting.crosses || !is_surface(one) || !is_surface(other)) {
        continue;
      }
      if (one == other) {
        crossings[one] = "the surface meets itself: some of its faces cross";
      }
      for (const auto& [part, by] : {std::pair{one, other}, std::pair{other, one}}) {
        if (crossings[part].empty()) {
          crossings[part] = "the surface meets that of component " + std::to_string(by);
        }
      }
    }
    return crossings;
  }

  /// That of the surface with its points moved a little, each by some part of the shortest edge at it.
  LinkingForm form_of_moved(const CutSystem& system, const std::vector<std::uint32_t>& edges, std::uint32_t part) {
    std::map<std::uint32_t, double> shortest;
    double longest = 0;
    for (const std::uint32_t e : edges) {
      const Point along = minus(points_[incidence_.edges[e][1]], points_[incidence_.edges[e][0]]);
      const double length = std::sqrt(dot(along, along));
      longest = std::max(longest, length);
      for (const std::uint32_t end : incidence_.edges[e]) {
        const auto at = shortest.emplace(end, length).first;
        at->second = length > 0 ? std::min(at->second > 0 ? at->second : length, length) : at->second;
      }
    }
    std::vector<Point> moved = points_;
    std::mt19937_64 random{part};  // NOLINT(cert-msc51-cpp): the same input, the same answer
    for (const auto& [point, length] : shortest) {
      for (double& x : moved[point]) {
        const double step = static_cast<double>(random() >> 11U) * 0x1p-53 - 0.5;
        x = std::clamp(x + 1e-6 * step * (length > 0 ? length : longest), -1.0, 1.0);
      }
    }
    LinkingForm form = linking_form(system, incidence_.edges, ExactSigns(moved));
    if (form.obstacle.empty()) {
      found_.remarks.push_back("component " + std::to_string(part) +
                               " touches itself, or has triangles without area: its loops were sorted with its points "
                               "moved by up to a millionth of their edges");
    }
    return form;
  }

  bool sort(const CutSystem& system, const LinkingForm& form, std::string& why_not) {
    if (!form.obstacle.empty()) {
      why_not = form.obstacle;
      return false;
    }
    const Matrix<Integers> onto_tunnels = matrix_of(form, false);
    if (!is_projection(form, onto_tunnels)) {
      why_not = "the surface meets itself: its linking numbers are not those of one with two sides";
      return false;
    }
    const auto tunnels = image_of(onto_tunnels);
    const auto handles = image_of(matrix_of(form, true));
    sparse::expects(tunnels && handles, "a projection has no factors but 1");
    add(*handles, system, found_.handles);
    add(*tunnels, system, found_.tunnels);
    return true;
  }

  static void add(const Image& image, const CutSystem& system, HalfOfLoops& half) {
    const Index first = half.coordinates.rank;
    for (const auto& [edge, crossings] : system.crossings) {
      RawTerms<Integers> sum;
      for (const auto& [i, times] : crossings) {
        for (const auto& [k, coefficient] : image.of_unit[i]) {
          sum.push_back({first + k, times * coefficient});
        }
      }
      half.coordinates.of_edge[edge] = std::move(sum).normal(Integers{});
    }
    for (const Terms<Integers>& vector : image.basis) {
      RawTerms<Integers> sum;
      for (const auto& [i, coefficient] : vector) {
        for (const auto& [edge, direction] : system.loops[i]) {
          sum.push_back({edge, coefficient * Integer{direction}});
        }
      }
      half.cycles.push_back(std::move(sum).normal(Integers{}));
    }
    half.coordinates.rank += static_cast<Index>(image.basis.size());
  }

  const Mesh& mesh_;
  const Validity& validity_;
  const SelfIntersections& meetings_;
  Incidence incidence_;
  std::vector<Point> points_;
  LoopSorting found_;
};

}  // namespace

LoopSorting sort_loops(const Mesh& mesh, const KnownOfMesh& known) { return Sorting{mesh, known}.run(); }

}  // namespace sesame::tools
