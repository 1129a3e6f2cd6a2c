#include "tools/mesh/incidence.hpp"

#include <algorithm>
#include <utility>

namespace sesame::tools {

namespace {

Edge ordered(std::uint32_t a, std::uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

}  // namespace

Incidence incidence_of(const Mesh& mesh) {
  const auto corners = mesh.faces.corners();
  Incidence result;
  result.face_of_corner.resize(corners.size());

  // Sides of faces first, then lines, so that a stable number tells them apart; sorting brings equal ones together.
  std::vector<std::pair<Edge, std::uint32_t>> sides;
  sides.reserve(corners.size() + mesh.lines.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto begin = mesh.faces.start(f);
    const auto end = mesh.faces.start(f + 1);
    for (auto c = begin; c < end; ++c) {
      result.face_of_corner[c] = static_cast<std::uint32_t>(f);
      sides.emplace_back(ordered(corners[c], corners[c + 1 < end ? c + 1 : begin]), c);
    }
  }
  for (const auto& [from, to] : mesh.lines) {
    sides.emplace_back(ordered(from, to), static_cast<std::uint32_t>(sides.size()));
  }
  std::sort(sides.begin(), sides.end());

  result.edge_of_corner.resize(corners.size());
  result.edge_of_line.resize(mesh.lines.size());
  result.sides.reserve(corners.size());
  for (const auto& [edge, side] : sides) {
    if (result.edges.empty() || result.edges.back() != edge) {
      result.edges.push_back(edge);
      result.sides_begin.push_back(static_cast<std::uint32_t>(result.sides.size()));
    }
    const auto number = static_cast<std::uint32_t>(result.edges.size() - 1);
    if (side < corners.size()) {
      result.edge_of_corner[side] = number;
      result.sides.push_back(side);
    } else {
      result.edge_of_line[side - corners.size()] = number;
    }
  }
  result.sides_begin.push_back(static_cast<std::uint32_t>(result.sides.size()));
  return result;
}

}  // namespace sesame::tools
