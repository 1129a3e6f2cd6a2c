/// \file
/// The facets of an object that is a simplicial complex.
#pragma once

#include <ostream>

#include "replay/export/object_cells.hpp"

namespace sesame::replay {

/// The list of facets, in brackets, one a line: see FacetParser. Vertices are called by their labels where all of them
/// were inserted with integers that fit into 64 bits, and else counted from 0, with their names in comments at the end.
///
/// Errors, refused: a cell is no simplex, or has a vertex more than once, or has the vertices of another; there are no
/// cells. Nothing is written then.
[[nodiscard]] Status write_facets(const ObjectCells& cells, std::ostream& out);

}  // namespace sesame::replay
