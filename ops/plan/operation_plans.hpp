/// \file
/// The plans of the operations that make cells, copy them or collapse a vertex, one function each. For what they share
/// see Planner, which is what a caller uses; each here asks for no more than it needs. Requires: an empty plan.
#pragma once

#include "ops/cells/structure.hpp"
#include "ops/plan/limits.hpp"
#include "ops/vocabulary/operation.hpp"

namespace sesame::ops {

// standard_cells.cpp
Status plan_simplex(const MakeSimplex& operation, const Structure& structure, const Limits& limits, Plan& plan);
Status plan_simploid(const MakeSimploid& operation, const Structure& structure, const Limits& limits, Plan& plan);
/// The standard cell of a type, named so. Comes after the last look at a name, which may make lazy cells: the plan
/// counts on ids.
void write_standard(const std::string& name, TypeId type, const Structure& structure, Plan& plan);
// complex.cpp
Status plan_complex(const MakeComplex& operation, const Structure& structure, const Limits& limits, Plan& plan);
// cone.cpp
Status plan_cone(const MakeCone& operation, const Structure& structure, const Limits& limits, Plan& plan);
Status plan_suspension(const MakeSuspension& operation, const Structure& structure, const Limits& limits, Plan& plan);
// product.cpp
Status plan_product(const MakeProduct& operation, const Structure& structure, const Limits& limits, Plan& plan);
// map_product_plan.cpp: of bodies with cells of maps. Looks at these, and adds the darts, if the factors have some.
Status plan_map_product(const NewFamily& family, const Structure& structure, const Limits& limits, Plan& plan);
// map_plans.cpp
Status plan_map(const MakeGMap& operation, const Structure& structure, const Limits& limits, Plan& plan);
Status plan_map(const MakeMap& operation, const Structure& structure, const Limits& limits, Plan& plan);
Status plan_polygon(const MakePolygon& operation, const Structure& structure, const Limits& limits, Plan& plan);
// incidence_plan.cpp
Status plan_incidence(const MakeIncidence& operation, const Structure& structure, const Limits& limits, Plan& plan);
// chain_plan.cpp
Status plan_map(const MakeChainOfMaps& operation, const Structure& structure, const Limits& limits, Plan& plan);
// cell_surgery.cpp
Status plan_surgery(const RemoveCell& operation, const Structure& structure, const Limits& limits, Plan& plan);
Status plan_surgery(const ContractCell& operation, const Structure& structure, const Limits& limits, Plan& plan);
Status plan_surgery(const InsertCell& operation, const Structure& structure, const Limits& limits, Plan& plan);
Status plan_surgery(const SplitCell& operation, const Structure& structure, const Limits& limits, Plan& plan);
// unsewing.cpp
Status plan_unsewing(const Unsew& operation, const Structure& structure, const Limits& limits, Plan& plan);
// extension.cpp
Status plan_extension(const Extend& operation, const Structure& structure, const Limits& limits, Plan& plan);
// insertion.cpp
Status plan_insertion(const Insert& operation, const Structure& structure, const Limits& limits, Plan& plan);
// collapse.cpp
Status plan_collapse(const Collapse& operation, const Structure& structure, Plan& plan);

// removal.cpp
Status plan_removal(const Remove& operation, const Structure& structure, const Limits& limits, Plan& plan);
// replacement.cpp
Status plan_replacement(const Replace& operation, const Structure& structure, const Limits& limits, Plan& plan);

}  // namespace sesame::ops
