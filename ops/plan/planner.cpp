#include "ops/plan/planner.hpp"

#include "ops/plan/equations.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/sewing.hpp"
#include "ops/plan/step_names.hpp"

namespace sesame::ops {
namespace {

Plan& cleared(Plan& plan) {
  plan.clear();
  return plan;
}

}  // namespace

Result<Value> Planner::resolve(const std::string& name) const { return resolve_cell(name, structure_); }

Status Planner::plan(const MakeSimplex& operation, Plan& plan) {
  return plan_simplex(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const MakeSimploid& operation, Plan& plan) {
  return plan_simploid(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const MakeComplex& operation, Plan& plan) {
  return plan_complex(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const MakeGMap& operation, Plan& plan) {
  return plan_map(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const MakePolygon& operation, Plan& plan) {
  return plan_polygon(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const MakeMap& operation, Plan& plan) {
  return plan_map(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const MakeIncidence& operation, Plan& plan) {
  return plan_incidence(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const MakeChainOfMaps& operation, Plan& plan) {
  return plan_map(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const RemoveCell& operation, Plan& plan) {
  return plan_surgery(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const ContractCell& operation, Plan& plan) {
  return plan_surgery(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const InsertCell& operation, Plan& plan) {
  return plan_surgery(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const SplitCell& operation, Plan& plan) {
  return plan_surgery(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const Unsew& operation, Plan& plan) {
  return plan_unsewing(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const Extend& operation, Plan& plan) {
  return plan_extension(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const Sew& operation, Plan& plan) {
  Result<std::vector<Equation>> equations = equations_of(operation, structure_, cleared(plan));
  return plan_equations(std::move(equations), plan);
}

Status Planner::plan(const MakeCone& operation, Plan& plan) {
  return plan_cone(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const MakeSuspension& operation, Plan& plan) {
  return plan_suspension(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const MakeProduct& operation, Plan& plan) {
  return plan_product(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const Identify& operation, Plan& plan) {
  return plan_equations(equations_of(operation, structure_), cleared(plan));
}

Status Planner::plan(const Degenerate& operation, Plan& plan) {
  return plan_equations(equations_of(operation, structure_), cleared(plan));
}

Status Planner::plan(const Deidentify& operation, Plan& plan) {
  return splits_.plan(operation, limits_, cleared(plan));
}

Status Planner::plan(const Insert& operation, Plan& plan) {
  return plan_insertion(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const Collapse& operation, Plan& plan) {
  return plan_collapse(operation, structure_, cleared(plan));
}

Status Planner::plan(const Remove& operation, Plan& plan) {
  return plan_removal(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan(const Replace& operation, Plan& plan) {
  return plan_replacement(operation, structure_, limits_, cleared(plan));
}

Status Planner::plan_equations(Result<std::vector<Equation>> equations, Plan& plan) {
  if (!equations) {
    return equations.error();
  }
  Result<std::vector<Merge>> merges = congruence_.close(*equations);
  if (!merges) {
    return merges.error();
  }
  plan.merges = std::move(*merges);
  return Done{};
}

}  // namespace sesame::ops
