/// \file
/// Short loops of edges that are a basis of the first homology of a mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sparse/chain.hpp"
#include "sparse/ring.hpp"
#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// The edges of a mesh as ways out of each point, with their Euclidean lengths.
class EdgeGraph {
 public:
  struct Way {
    std::uint32_t to;
    std::uint32_t edge;
    double length;
  };

  /// Each edge has its lower point first. Cost O(points + edges).
  EdgeGraph(std::span<const Point> points, std::span<const Edge> edges);

  [[nodiscard]] std::size_t points() const { return begin_.size() - 1; }
  [[nodiscard]] std::size_t edges() const { return ways_.size() / 2; }
  [[nodiscard]] std::span<const Way> ways(std::uint32_t point) const {
    return std::span{ways_}.subspan(begin_[point], begin_[point + 1] - begin_[point]);
  }
  /// The way between two points. Requires: there is one.
  [[nodiscard]] const Way& way(std::uint32_t from, std::uint32_t to) const;

 private:
  std::vector<std::uint32_t> begin_;
  std::vector<Way> ways_;
};

/// A simple closed walk: every point once, and back from the last to the first. The lowest point comes first, the lower
/// of its two neighbours next.
struct Loop {
  std::vector<std::uint32_t> points;
  double length = 0;
};

/// A vector for every edge, run from its lower to its higher point, such that the sum along a cycle is the class of the
/// cycle in a group R^rank. Integers in [0, p) stand for Z/p.
/// Source: O. Busaryev, S. Cabello, C. Chen, T. Dey, Y. Wang, "Annotating simplices with a homology basis and its
/// applications" (2012).
struct Annotation {
  sparse::Index rank = 0;
  std::vector<sparse::Terms<sparse::Integers>> of_edge;
};

/// The sum along a loop, over Z.
[[nodiscard]] sparse::Terms<sparse::Integers> class_of(const EdgeGraph& graph, const Annotation& annotation,
                                                       const Loop& loop);

struct LoopSearch {
  sparse::AnyRing ring;
  const Annotation* wanted = nullptr;  ///< whose R^rank the loops are to be a basis of
  const Annotation* zero = nullptr;    ///< over Z; if there is one, only loops that it sends to zero count
  std::uint64_t effort = 20'000'000;   ///< about how many ways to walk, once each component has been looked at
};

struct LoopBasis {
  std::vector<Loop> loops;  ///< shortest first
  /// What the loops lack to be a basis; as a rule nothing.
  std::vector<sparse::Terms<sparse::Integers>> completion;
  std::uint64_t tried = 0;  ///< loops that were compared
};

/// Finds short loops whose classes are a basis of R^rank.
///
/// From a root, shortest paths make a tree, and each edge outside it a loop; cut where its two paths part it is simple.
/// Of the loops from all roots the shortest are taken that can still be completed to a basis. Roots are one point per
/// component, some spread over it, and then points on the loops that were taken, each with half of its loop as reach.
/// With every point as a root this would, over a field, be the basis of least total length (J. Erickson and
/// K. Whittlesey, "Greedy optimal homotopy and homology generators", 2005); with some it is short, but perhaps not
/// least.
///
/// Loops are told apart by a linear fingerprint of their class; only those taken into account have their class
/// computed. Deterministic. Cost: the effort, times a logarithm, plus the linear algebra on the loops compared.
[[nodiscard]] LoopBasis short_loops(const EdgeGraph& graph, const LoopSearch& search);

}  // namespace sesame::tools
