/// \file
/// What an operation would do: the predicate of every construction step.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ops/operation.hpp"
#include "ops/structure.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// How much one step, and a whole workspace, may create: beyond it a step is refused with a sentence.
struct Limits {
  std::int64_t cells_of_standard = std::int64_t{1} << 20;  ///< of one simplex or simploid with its faces
  std::int64_t cells_per_step = 50'000'000;
  std::int64_t cells = 1'000'000'000;  ///< ids of cells and of removals share 32 bits in the big complex
};

/// Works out plans; changes nothing. Keeps scratch memory between calls.
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
  Status plan(const MakeCone& operation, Plan& plan);
  Status plan(const Identify& operation, Plan& plan);

  /// The current cell that a name denotes, or unknown_name with what would be right.
  Result<CellId> resolve(const std::string& name) const;

 private:
  Status check_new_name(const std::string& name) const;
  Status check_room(std::int64_t new_cells) const;
  Status check_standard(const CellType& type) const;
  Status plan_standard(const std::string& name, TypeId type, Plan& plan);
  /// The current cells that a cone is taken over, by dimension and then in the order of creation.
  Result<std::vector<CellId>> coned_cells(const MakeCone& operation) const;
  void place_in_bodies(const MakeCone& operation, const std::vector<CellId>& coned, Plan& plan) const;
  CellId overlay_find(CellId c);
  std::vector<Merge> merges_of_overlay();

  const Structure& structure_;
  Limits limits_;
  std::unordered_map<CellId, CellId> overlay_;  // union-find over the current cells that an identification touches
  std::vector<CellId> touched_;                 // its keys in the order in which they came
};

}  // namespace sesame::ops
