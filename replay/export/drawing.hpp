/// \file
/// An object with positions and generators of its homology, in the formats in which programs draw.
#pragma once

#include <atomic>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "engine/engine.hpp"
#include "replay/export/object_cells.hpp"
#include "replay/script/generators.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

struct NamedGenerator {
  std::string name;  ///< "H1_0": of H_1 the first, in the order of `replay --generators`
  engine::Generator generator;
};

/// Threads: one at a time, for queries too.
struct Drawing {
  const ObjectCells& cells;
  std::vector<ops::Point> points;  ///< of the vertices
  std::vector<NamedGenerator> generators;
};

/// The generators of the degrees that are wanted and at most `highest`, in that order, until `stop` is set.
/// Errors, refused: a format that has a number of each generator for each of `cells_drawn` cells would have more than
/// 10^8.
[[nodiscard]] Result<std::vector<NamedGenerator>> named_generators(engine::Engine& engine,
                                                                   const GeneratorOptions& options, int highest,
                                                                   std::uint64_t cells_drawn,
                                                                   const std::atomic<bool>* stop);

/// The coefficients of a generator for each cell of its degree.
class CoefficientColumn {
 public:
  CoefficientColumn(const ObjectCells& cells, const engine::Generator& generator);
  [[nodiscard]] int degree() const { return degree_; }
  /// Whether all are integers of 32 bits.
  [[nodiscard]] bool is_integral() const { return is_integral_; }
  /// By the number of the cell. The nearest double, where it is no integer of 32 bits.
  [[nodiscard]] double operator[](std::size_t number) const { return coefficients_[number]; }

 private:
  int degree_;
  bool is_integral_ = true;
  std::vector<double> coefficients_;
};

/// What a drawing does not show, a sentence each.
using Remarks = std::vector<std::string>;

/// As VTK reads it: an unstructured grid of the cells of dimensions 0 to 3, in text (legacy) or as XML. Data of cells
/// are the dimension, and for each generator its coefficients. Hexahedra and wedges may have corners that are one
/// point.
[[nodiscard]] Remarks write_vtk(const Drawing& drawing, std::ostream& out);
[[nodiscard]] Remarks write_vtu(const Drawing& drawing, std::ostream& out);

/// The vertices, edges and faces of an object. Of corners in a row that are one point a face has the first only; a face
/// that is left with fewer than three is not shown. Of generators those of H_1: in OBJ a group of edges for each,
/// turned round where the coefficient is negative; in PLY a property of edges for each.
[[nodiscard]] Remarks write_obj(const Drawing& drawing, std::ostream& out);
[[nodiscard]] Remarks write_ply(const Drawing& drawing, std::ostream& out);

}  // namespace sesame::replay
