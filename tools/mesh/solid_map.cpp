// Solids as one 3-G-map, and its script.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <ostream>
#include <utility>

#include "ops/cells/map_cells.hpp"
#include "ops/maps/orbits.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/contract.hpp"
#include "tools/mesh/solids.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {
namespace {

using ops::Dart;
using Corners = std::vector<std::uint32_t>;

class SolidSewer {
 public:
  SolidSewer(const Solids& solids, std::string_view name) : solids_{solids}, name_{name} {}

  Result<ops::GMap> run() {
    if (solids_.size() == 0) {
      return Error{Errc::bad_input, fmt::format("{}: there are no solids: a map of them needs some", name_)};
    }
    if (solids_.faces.corners().size() >= ops::no_dart / 2) {
      return Error{Errc::bad_input, fmt::format("{}: the solids have too many faces for one map", name_)};
    }
    add_faces();
    for (std::size_t s = 0; s < solids_.size(); ++s) {
      if (Status status = sew_faces_of(s); !status) {
        return status.error();
      }
    }
    if (Status status = sew_solids(); !status) {
      return status.error();
    }
    Result<ops::GMap> map = ops::GMap::make(std::move(alpha_));
    sparse::expects(map.has_value(), "solids make a map");
    return map;
  }

 private:
  [[nodiscard]] Error error(std::size_t solid, std::string_view what) const {
    return {Errc::bad_input, fmt::format("{}:{}: {}", name_, solids_.lines[solid], what)};
  }
  [[nodiscard]] Dart first_dart(std::size_t face) const { return 2 * solids_.faces.start(face); }
  [[nodiscard]] std::string corners_of(std::size_t face) const {
    return fmt::format("({})", fmt::join(solids_.faces[face], ", "));
  }

  void add_faces() {
    for (std::size_t s = 0; s < solids_.size(); ++s) {
      for (std::uint32_t face = solids_.first_face[s]; face < solids_.first_face[s + 1]; ++face) {
        solid_of_.push_back(static_cast<std::uint32_t>(s));
        const Dart first = first_dart(face);
        const auto size = static_cast<Dart>(2 * solids_.faces[face].size());
        for (Dart d = 0; d < size; ++d) {
          alpha_[0].push_back(first + (d ^ 1U));
          alpha_[1].push_back(first + (d % 2 == 0 ? d + size - 1 : d + 1) % size);
          alpha_[2].push_back(first + d);
          alpha_[3].push_back(first + d);
        }
      }
    }
  }

  /// The dart at one corner of a side, and its image under alpha_0 at the other.
  using Side = std::pair<std::array<std::uint32_t, 2>, Dart>;

  /// The sides of a face, each from its lesser corner.
  void add_sides(std::uint32_t face, std::vector<Side>& sides) const {
    const auto corners = solids_.faces[face];
    for (std::uint32_t k = 0; k < corners.size(); ++k) {
      const std::uint32_t here = corners[k], next = corners[(k + 1) % corners.size()];
      const Dart dart = first_dart(face) + 2 * k;
      sides.emplace_back(std::array{std::min(here, next), std::max(here, next)}, here < next ? dart : dart + 1);
    }
  }

  void sew(int i, Dart a, Dart b) {
    auto& alpha = alpha_[static_cast<std::size_t>(i)];
    for (const auto& [one, other] : {std::pair{a, b}, std::pair{alpha_[0][a], alpha_[0][b]}}) {
      alpha[one] = other;
      alpha[other] = one;
    }
  }

  Status sew_faces_of(std::size_t solid) {
    std::vector<Side> sides;
    for (std::uint32_t face = solids_.first_face[solid]; face < solids_.first_face[solid + 1]; ++face) {
      Corners sorted(solids_.faces[face].begin(), solids_.faces[face].end());
      std::ranges::sort(sorted);
      if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end()) {
        return error(solid, fmt::format("a face of this solid has the corners {}, which should be different points",
                                        corners_of(face)));
      }
      add_sides(face, sides);
    }
    std::ranges::stable_sort(sides, {}, &Side::first);
    for (std::size_t k = 0; k < sides.size(); k += 2) {
      std::size_t end = k + 1;
      while (end < sides.size() && sides[end].first == sides[k].first) {
        ++end;
      }
      if (end - k != 2) {
        return error(solid, fmt::format("the edge from {} to {} of this solid is on {} of its faces, and should be on "
                                        "2, as faces close a solid",
                                        sides[k].first[0], sides[k].first[1], end - k));
      }
      sew(2, sides[k].second, sides[k + 1].second);
    }
    return Done{};
  }

  /// The faces by their sorted corners.
  Status sew_solids() {
    std::vector<Corners> sorted(solid_of_.size());
    std::vector<std::uint32_t> order(solid_of_.size());
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t face = 0; face < sorted.size(); ++face) {
      sorted[face].assign(solids_.faces[face].begin(), solids_.faces[face].end());
      std::ranges::sort(sorted[face]);
    }
    std::ranges::stable_sort(order, {}, [&](std::uint32_t face) -> const Corners& { return sorted[face]; });
    std::vector<std::uint32_t> free;
    for (std::size_t k = 0; k < order.size();) {
      std::size_t end = k + 1;
      while (end < order.size() && sorted[order[end]] == sorted[order[k]]) {
        ++end;
      }
      if (end - k > 2) {
        return error(solid_of_[order[k + 2]],
                     fmt::format("the face {} of this solid is one of those in lines {} and {}, too: a map has at most "
                                 "two solids at a face",
                                 corners_of(order[k]), line_of(order[k]), line_of(order[k + 1])));
      }
      if (end - k == 1) {
        free.push_back(order[k]);
      } else if (Status status = sew_faces(order[k], order[k + 1]); !status) {
        return status;
      }
      k = end;
    }
    return check_free(free);
  }

  [[nodiscard]] std::size_t line_of(std::uint32_t face) const { return solids_.lines[solid_of_[face]]; }

  Status sew_faces(std::uint32_t one, std::uint32_t other) {
    if (solid_of_[one] == solid_of_[other]) {
      return error(solid_of_[one], fmt::format("this solid has the face {} twice", corners_of(one)));
    }
    std::vector<Side> sides;
    add_sides(one, sides);
    add_sides(other, sides);
    std::ranges::stable_sort(sides, {}, &Side::first);
    for (std::size_t k = 0; k < sides.size(); k += 2) {
      if (k + 1 == sides.size() || sides[k].first != sides[k + 1].first) {
        return error(solid_of_[other],
                     fmt::format("the face {} of this solid has the corners of {}, one of that in line {}, in another "
                                 "order: faces that meet should have their neighbours in common",
                                 corners_of(other), corners_of(one), line_of(one)));
      }
      sew(3, sides[k].second, sides[k + 1].second);
    }
    return Done{};
  }

  /// A triangle that cuts off a corner of a larger face: these solids would only look as if they met.
  Status check_free(const std::vector<std::uint32_t>& free) const {
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> corner_of;
    const auto sorted = [](std::array<std::uint32_t, 3> corners) {
      std::ranges::sort(corners);
      return corners;
    };
    for (const std::uint32_t face : free) {
      const auto corners = solids_.faces[face];
      const std::size_t size = corners.size();
      for (std::size_t k = 0; size > 3 && k < size; ++k) {
        corner_of.emplace(sorted({corners[k], corners[(k + 1) % size], corners[(k + 2) % size]}), face);
      }
    }
    for (const std::uint32_t face : free) {
      const auto corners = solids_.faces[face];
      const auto larger =
          corners.size() == 3 ? corner_of.find(sorted({corners[0], corners[1], corners[2]})) : corner_of.end();
      if (larger != corner_of.end() && solid_of_[larger->second] != solid_of_[face]) {
        return error(solid_of_[face],
                     fmt::format("the face {} of this solid lies against a part of {}, a face of that in line {}: "
                                 "solids that meet should have a whole face in common",
                                 corners_of(face), corners_of(larger->second), line_of(larger->second)));
      }
    }
    return Done{};
  }

  const Solids& solids_;
  std::string_view name_;
  std::vector<std::vector<Dart>> alpha_{4};
  std::vector<std::uint32_t> solid_of_;  // per face
};

std::size_t different_edges(const Solids& solids) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (std::size_t face = 0; face < solids.faces.size(); ++face) {
    const auto corners = solids.faces[face];
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::uint32_t here = corners[k], next = corners[(k + 1) % corners.size()];
      edges.push_back({std::min(here, next), std::max(here, next)});
    }
  }
  std::ranges::sort(edges);
  return static_cast<std::size_t>(std::unique(edges.begin(), edges.end()) - edges.begin());
}

void add_remarks(const Solids& solids, const std::vector<std::size_t>& cells, std::vector<std::string>& remarks) {
  std::vector<bool> is_used(solids.points.size(), false);
  for (const std::uint32_t corner : solids.faces.corners()) {
    is_used[corner] = true;
  }
  const auto used = static_cast<std::size_t>(std::ranges::count(is_used, true));
  if (used < solids.points.size()) {
    remarks.push_back(fmt::format("{} of no solid left out", counted(solids.points.size() - used, "point", "points")));
  }
  if (const std::size_t edges = different_edges(solids); cells[0] > used || cells[1] > edges) {
    remarks.push_back(
        fmt::format("points and edges around which the solids do not all meet face to face are several: "
                    "{} and {} more",
                    counted(cells[0] - used, "vertex", "vertices"), counted(cells[1] - edges, "edge", "edges")));
  }
}

}  // namespace

Result<ops::GMap> map_of_solids(const Solids& solids, std::string_view name) { return SolidSewer(solids, name).run(); }

Result<SolidSummary> write_solid_script(const Solids& solids, std::ostream& out, const ScriptOptions& options) {
  Result<ops::GMap> map = map_of_solids(solids, options.source);
  if (!map) {
    return map.error();
  }
  ops::TypeTable types;
  if (const Result<std::vector<ops::CellsOfMap>> balls =
          solids.has_polyhedra ? ops::cells_of_map(*map, types) : std::vector<ops::CellsOfMap>{};
      !balls) {
    return Error{balls.error().code,
                 fmt::format("{}: with darts counted from 0, {}", options.source, balls.error().what)};
  }
  SolidSummary summary{{}, solids.remarks};
  ops::Expect expect;
  expect.cells.emplace();
  for (int i = 0; i <= 3; ++i) {
    summary.cells.push_back(ops::cells(*map, i).count());
    expect.cells->emplace_back(static_cast<std::int64_t>(summary.cells.back()));
  }
  add_remarks(solids, summary.cells, summary.remarks);
  ops::MakeGMap made{name_of_source(options.source), map->involutions(), false, {}};
  std::vector<std::uint32_t> point_of_dart;
  for (std::size_t face = 0; face < solids.faces.size(); ++face) {
    const auto of_face = solids.faces[face];
    for (std::size_t k = 0; k < of_face.size(); ++k) {
      point_of_dart.push_back(of_face[k]);
      point_of_dart.push_back(of_face[(k + 1) % of_face.size()]);
    }
  }
  for (const Dart first : ops::cells(*map, 0).first) {
    made.at.push_back(solids.points[point_of_dart[first]]);
  }
  ops::Header header;
  header.ring = options.ring;
  header.title = made.name;
  out << ops::to_text(header) << '\n';
  for (const std::string& remark : summary.remarks) {
    out << "# " << printable(remark) << '\n';
  }
  out << ops::to_text(ops::Operation{std::move(made)}) << '\n';
  if (options.expect) {  // counted on the map, so this holds of any engine that works
    out << ops::to_text(ops::Operation{std::move(expect)}) << '\n';
  }
  return summary;
}

}  // namespace sesame::tools
