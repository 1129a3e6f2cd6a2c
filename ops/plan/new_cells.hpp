/// \file
/// How new cells are written into a plan: the name at the end of Plan::names, the faces one by one, then the cell.
#pragma once

#include <cstddef>
#include <set>

#include "ops/cells/structure.hpp"

namespace sesame::ops {

void add_face(Incidence face, Plan& plan);
/// Adds the cell whose faces were added since there were `first_face` of them, and ends its name.
void add_cell(TypeId type, std::size_t first_face, Plan& plan);
/// The new cells join some bodies, which become one. Requires: there is one.
void join_bodies(const std::set<BodyId>& bodies, Plan& plan);

}  // namespace sesame::ops
