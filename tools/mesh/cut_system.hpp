/// \file
/// Dual bases of the first homology of a closed surface: loops along its edges, and loops across them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sparse/chain.hpp"
#include "tools/mesh/exact_signs.hpp"
#include "tools/mesh/incidence.hpp"
#include "tools/mesh/short_loops.hpp"

namespace sesame::tools {

/// A triangle of an oriented surface, part of one of its faces.
struct SpaceTriangle {
  std::array<std::uint32_t, 3> points;  ///< in the order of the surface
  /// The edge of the mesh from each point to the next; `none` where the triangle meets another one of its face.
  std::array<std::uint32_t, 3> edges;
  /// How much of each loop across the surface leaves the triangle there.
  std::array<sparse::Terms<sparse::Integers>, 3> outflow;

  static constexpr std::uint32_t none = 0xffffffff;
};

/// An edge, run from its lower to its higher point (1) or back (-1).
struct DirectedEdge {
  std::uint32_t edge;
  int direction;
};

/// Bases x_i and y_j of H_1 of a closed oriented surface S, the sides of which are called inside and outside: the x_i
/// are loops along edges, the y_j loops that cross edges, and x_i . y_j is 1 for i = j and else 0. Here the crossing of
/// an edge counts 1 when y goes from the face that has the edge on its boundary as x runs to the other one.
///
/// So `crossings`, per edge how often each y_j crosses it when it is run upwards, is a cocycle, and summed along any
/// cycle of edges it is the coordinates of the class of the cycle in the basis x.
struct CutSystem {
  sparse::Index rank = 0;                                                            ///< of H_1: twice the genus
  std::vector<std::vector<DirectedEdge>> loops;                                      ///< x_i
  std::vector<std::pair<std::uint32_t, sparse::Terms<sparse::Integers>>> crossings;  ///< by edge, where there are any
  std::vector<SpaceTriangle> triangles;  ///< of the whole surface, from outside counterclockwise
};

/// Cuts connected parts of a mesh, one after the other.
///
/// A tree of shortest paths among the points, a tree of paths among the faces across edges that are not in the first:
/// twice the genus of edges are in neither, and each closes a loop of both kinds. Source: D. Eppstein, "Dynamic
/// generators of topologically embedded graphs" (2003).
class SurfaceCutter {
 public:
  /// All must outlive it. `points` are those of the mesh, scaled to within 1; `graph` is of its edges.
  SurfaceCutter(const Mesh& mesh, const Incidence& incidence, const EdgeGraph& graph, const ExactSigns& signs,
                std::span<const Point> points);
  SurfaceCutter(const SurfaceCutter&) = delete;
  SurfaceCutter& operator=(const SurfaceCutter&) = delete;
  ~SurfaceCutter();

  /// Cuts the part whose edges are given. Nothing when it is no closed surface, or its faces cannot be oriented so that
  /// they enclose a positive volume, or one of them meets a point twice; `why_not` says which.
  /// Cost O(n log n) for n edges, plus the loops.
  [[nodiscard]] std::optional<CutSystem> cut(std::span<const std::uint32_t> edges, std::string& why_not);

 private:
  class Part;
  struct Scratch;
  const Mesh& mesh_;
  const Incidence& incidence_;
  const EdgeGraph& graph_;
  const ExactSigns& signs_;
  std::span<const Point> points_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace sesame::tools
