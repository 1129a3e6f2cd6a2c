/// \file
/// Engines under limits that suit a fuzzer, and what has to hold of them whatever they are told.
#pragma once

#include <numeric>
#include <string>
#include <utility>

#include "engine/engine.hpp"
#include "ops/vocabulary/operation.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/groups.hpp"

namespace sesame::tests {

/// Cones over whole bodies are lazy from 12 cells on, so that both kinds occur.
inline constexpr ops::Limits small_limits{
    .cells_of_standard = 512, .cells_per_step = 1000, .cells_of_explicit_cone = 12, .cells = 20'000};
inline constexpr engine::Resources few_cells{.most_cells = 400, .most_bytes = UINT64_MAX};

inline std::uint64_t number_of_cells(const Engine& engine) {
  return std::accumulate(engine.cells().begin(), engine.cells().end(), std::uint64_t{0});
}

/// What a step that is refused leaves as it was, and an undo gives back.
inline std::string state_of(Engine& engine) {
  const engine::Homology homology = engine.homology();
  std::string text;
  for (std::size_t p = 0; p < engine.cells().size(); ++p) {
    text += "dimension " + std::to_string(p) + ": " + std::to_string(engine.cells()[p]) + " cells, rank " +
            std::to_string(homology.betti[p]);
    for (const sparse::Integer& t : homology.torsion[p]) {
      text += " " + t.to_string();
    }
    text += "\n";
  }
  return text + "euler " + std::to_string(engine.euler_characteristic()) + ", undoable " +
         std::to_string(engine.undoable()) + "\n";
}

/// The Euler characteristic by cells and by ranks; every law; the groups from scratch. Cost: cubic in the cells.
inline void demand_laws(Engine& engine) {
  const std::optional<std::string> defect = engine.first_defect();
  demand(!defect, "a law: " + defect.value_or(""));
  const auto groups = live_groups(engine);
  std::visit(
      [&](const auto& ring) {
        demand(groups == groups_from_scratch(engine.structure(), ring), "the groups are those of the cells");
      },
      engine.ring());
}

/// Cheap laws: what the numbers have to do with one another.
inline void demand_euler(Engine& engine) {
  const engine::Homology homology = engine.homology();
  demand(homology.betti.size() == engine.cells().size(), "a rank for each dimension that has cells");
  std::int64_t by_ranks = 0, by_cells = 0;
  for (std::size_t p = 0; p < homology.betti.size(); ++p) {
    const std::int64_t sign = p % 2 == 0 ? 1 : -1;
    by_ranks += sign * homology.betti[p];
    by_cells += sign * static_cast<std::int64_t>(engine.cells()[p]);
  }
  demand(by_ranks == by_cells && by_cells == engine.euler_characteristic(),
         "the Euler characteristic by ranks is that by cells");
}

/// Applies an operation, and sees to it that nothing happens when it is refused. Returns whether it was applied.
inline bool attempt(Engine& engine, const ops::Operation& operation) {
  const std::string before = state_of(engine);
  const std::size_t logged = engine.log().size();
  const Result<engine::StepReport> report = engine.apply(operation);
  if (went_well(report)) {
    demand(engine.log().size() == logged + 1, "the log has each step that was applied");
    demand_equal(ops::to_text(engine.log().back()), ops::to_text(operation), "the log has the step as it was given");
    demand_euler(engine);
    return true;
  }
  demand(engine.log().size() == logged, "the log has no step that was refused");
  demand_equal(before, state_of(engine), "a step that is refused changes nothing");
  return false;
}

}  // namespace sesame::tests
