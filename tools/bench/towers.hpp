/// \file
/// Random towers and zigzags to measure with: insertions and deletions of simplices and contractions of vertices,
/// written as they are made up.
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
  double deletion_probability = 0;
  std::uint64_t half_wave = 0;  ///< after so many operations insertions and deletions exchange their probabilities
};

/// Writes one operation a line: `i v0 ... vd` includes a simplex whose faces are there, `d v0 ... vd` deletes one that
/// is no face of another, `c u v` sends vertex u to v.
///
/// An operation is a contraction or a deletion with the given probabilities; what is deleted is a random simplex, or
/// one over it. Else it is an insertion of a random dimension: a vertex while
/// there is room for one, or a random simplex that is extended by a random vertex for which all other faces are there;
/// where a few attempts find none, one dimension lower. When nothing can be inserted, it is one of the others that are
/// wanted; when these cannot be done either, the tower ends. Labels are never used again, so dead vertices need not be
/// remembered. Cost  memory for the live complex, whatever the number of operations.
void write_random_tower(std::ostream& out, const TowerOptions& options);

}  // namespace sesame::tools
