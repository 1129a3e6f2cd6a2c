/// \file
/// Random towers to measure with: insertions of simplices and contractions of vertices, written as they are made up.
#pragma once

#include <cstdint>
#include <ostream>

namespace sesame::tools {

struct TowerOptions {
  std::uint64_t operations;
  std::uint32_t most_vertices;  ///< alive at any time; fewer than 2^31
  int largest_dimension;        ///< of an inserted simplex; 0 to 3
  double contraction_probability;
  bool along_edges;  ///< contract edges only, else any two vertices
  std::uint64_t seed;
};

/// Writes one operation a line: `i v0 ... vd` includes a simplex whose faces are there, `c u v` sends vertex u to v.
///
/// An operation is a contraction with the given probability, else an insertion of a random dimension: a vertex while
/// there is room for one, or a random simplex that is extended by a random vertex for which all other faces are there;
/// where a few attempts find none, one dimension lower. When nothing can be inserted, a contraction; when nothing can
/// be contracted either, the tower ends. Labels are never used again, so dead vertices need not be remembered.
/// Cost  memory for the live complex, whatever the number of operations.
void write_random_tower(std::ostream& out, const TowerOptions& options);

}  // namespace sesame::tools
