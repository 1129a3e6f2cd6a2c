/// \file
/// What an operation would do: the predicate of every construction step.
#pragma once

#include <string>
#include <vector>

#include "ops/cells/structure.hpp"
#include "ops/plan/congruence.hpp"
#include "ops/plan/deidentification.hpp"
#include "ops/plan/limits.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// Works out plans; changes nothing. Keeps scratch memory between calls. Threads: one at a time, for queries too.
class Planner {
 public:
  explicit Planner(const Structure& structure, Limits limits = {}) : structure_{structure}, limits_{limits} {}

  /// The effect of a construction operation on the present state, written into `plan` (cleared first).
  ///
  /// Errors    unknown_name; bad_input (names, types, face laws); refused (cells of different types, too many cells).
  ///           On an error the plan is unspecified, and nothing else has changed.
  /// Cost      Proportional to the cells that the step makes or touches, times their dimension.
  Status plan(const MakeSimplex& operation, Plan& plan);
  Status plan(const MakeSimploid& operation, Plan& plan);
  Status plan(const MakeComplex& operation, Plan& plan);
  Status plan(const MakeGMap& operation, Plan& plan);
  Status plan(const MakePolygon& operation, Plan& plan);
  Status plan(const MakeMap& operation, Plan& plan);
  Status plan(const MakeIncidence& operation, Plan& plan);
  Status plan(const MakeChainOfMaps& operation, Plan& plan);
  /// Cost: the darts of the cells that are replaced, times the dimension, and their cofaces.
  Status plan(const RemoveCell& operation, Plan& plan);
  Status plan(const ContractCell& operation, Plan& plan);
  Status plan(const InsertCell& operation, Plan& plan);
  Status plan(const SplitCell& operation, Plan& plan);
  Status plan(const Sew& operation, Plan& plan);
  Status plan(const Unsew& operation, Plan& plan);
  Status plan(const Extend& operation, Plan& plan);
  Status plan(const MakeCone& operation, Plan& plan);
  Status plan(const MakeSuspension& operation, Plan& plan);
  Status plan(const MakeProduct& operation, Plan& plan);
  Status plan(const Identify& operation, Plan& plan);
  Status plan(const Degenerate& operation, Plan& plan);
  Status plan(const Deidentify& operation, Plan& plan);
  Status plan(const Insert& operation, Plan& plan);
  /// Cost: the smaller of the two stars, times the square of the dimension.
  Status plan(const Collapse& operation, Plan& plan);
  /// Cost: the cells that go, and their cofaces.
  Status plan(const Remove& operation, Plan& plan);
  /// Cost: the cells of the star that goes, each with all its faces, and their cofaces; of a contraction that of the
  /// collapse, and to check the links the smaller of the two stars, times the square of the dimension.
  Status plan(const Replace& operation, Plan& plan);

  [[nodiscard]] const Limits& limits() const { return limits_; }
  /// What a name denotes, of a cell of the object, in normal form: its vertices in the order in which the name stands
  /// for them. Or unknown_name, with what would be right.
  [[nodiscard]] Result<Value> resolve(const std::string& name) const;

 private:
  /// Makes values equal, with all that this entails.
  Status plan_equations(Result<std::vector<Equation>> equations, Plan& plan);

  const Structure& structure_;
  Limits limits_;
  Congruence congruence_{structure_};
  SplitPlanner splits_{structure_};
};

}  // namespace sesame::ops
