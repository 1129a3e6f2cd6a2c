/// \file
/// Boundary matrices of an object in the formats of other programs.
#pragma once

#include <ostream>

#include "replay/export/object_cells.hpp"

namespace sesame::replay {

/// The boundary matrix over Z/2 as PHAT reads it, in text or in 64-bit words: a column for each cell, by dimension and
/// age.
void write_phat(const ObjectCells& cells, std::ostream& out);
void write_phat_binary(const ObjectCells& cells, std::ostream& out);

/// The boundary from the chains of a dimension, 1 at least, to those of the one below, with integer entries in the
/// format of Matrix Market. Comments name the cells of rows and columns.
void write_matrix_market(const ObjectCells& cells, std::size_t dimension, std::ostream& out);

}  // namespace sesame::replay
