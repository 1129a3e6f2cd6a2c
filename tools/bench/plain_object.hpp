/// \file
/// An object under construction without its homology: what methods that keep that by themselves build on.
#pragma once

#include <cstdint>
#include <vector>

#include "ops/cells/structure.hpp"
#include "ops/plan/planner.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"

namespace sesame::tools {

/// A structure, its planner, and undo. Cones are always written out; products are lazy families, as everywhere.
class PlainObject {
 public:
  PlainObject();

  /// Works out what a construction step would do. A note does nothing.
  /// Errors: those of the planner; refused for a question (`expect`, `class`) and for an undo.
  Status plan(const ops::Operation& operation);
  /// What the last `plan` found.
  [[nodiscard]] const ops::Plan& planned() const { return plan_; }
  /// Does what is planned. Requires: nothing has happened since it was planned.
  void carry_out();
  /// Takes back the last steps. Errors: refused when there are fewer.
  Status take_back(std::uint64_t steps);

  [[nodiscard]] const ops::Structure& structure() const { return structure_; }
  /// The number of steps that can be taken back.
  [[nodiscard]] std::uint64_t steps() const { return history_.size(); }

 private:
  ops::Structure structure_;
  ops::Planner planner_;
  ops::Plan plan_;
  std::vector<ops::StructureMark> history_;
};

}  // namespace sesame::tools
