/// \file
/// How much one step, and a whole workspace, may create: beyond it a step is refused with a sentence.
#pragma once

#include <cstdint>

#include "ops/cells/family_counts.hpp"
#include "ops/cells/structure.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

struct Limits {
  std::int64_t cells_of_standard = std::int64_t{1} << 20;  ///< of one simplex or simploid with its faces
  std::int64_t cells_per_step = 50'000'000;
  std::int64_t cells_of_explicit_cone = 4096;  ///< a cone over whole bodies of more cells is a lazy family
  std::int64_t cells = 1'000'000'000;          ///< ids of cells and of removals share 32 bits in the big complex
};

/// True for what is no type at all. The text form cannot say one, but a program can.
[[nodiscard]] bool has_bad_entry(const CellType& type);

/// Is there room for so many new cells? Errors: refused.
Status check_room(std::int64_t new_cells, const Structure& structure, const Limits& limits);
/// Is one cell of a type, with its faces, within the limits? Errors: refused; bad_input when it is no type.
Status check_size(const CellType& type, const Limits& limits);
/// The same, and there is room for all of it.
Status check_standard(const CellType& type, const Structure& structure, const Limits& limits);
/// A family of lazy cells: its dimension, the depth of the names of its cells, the cells that there would be in all.
/// Errors: refused.
Status check_family(const NewFamily& family, const Structure& structure);

}  // namespace sesame::ops
