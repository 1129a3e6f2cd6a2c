#include "tools/bench/soak.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <optional>

#include "engine/engine.hpp"
#include "engine/resources.hpp"
#include "ops/plan/step_sequence.hpp"
#include "reductions/homology.hpp"
#include "sparse/block_statistics.hpp"

namespace sesame::tools {
namespace {

/// The groups by a Smith form of the boundaries of the cells as they are, which knows nothing of the engine.
template <sparse::Ring R>
std::vector<reductions::AbelianGroup> groups_from_scratch(const ops::Structure& structure, const R& ring) {
  structure.lazy().make_all();
  const ops::Moment now = ops::now(structure);
  return reductions::homology_groups(ops::chain_complex(structure, ops::cells_at(structure, now), now, ring));
}

std::optional<std::string> first_wrong_group(engine::Engine& engine) {
  const engine::Homology live = engine.homology();
  const auto groups =
      std::visit([&](const auto& ring) { return groups_from_scratch(engine.structure(), ring); }, engine.ring());
  for (std::size_t p = 0; p < std::max(groups.size(), live.betti.size()); ++p) {
    const std::int64_t rank = p < live.betti.size() ? live.betti[p] : 0;
    const std::vector<sparse::Integer> torsion =
        p < live.torsion.size() ? live.torsion[p] : std::vector<sparse::Integer>{};
    const bool agrees =
        p < groups.size() ? groups[p].rank == rank && groups[p].torsion == torsion : rank == 0 && torsion.empty();
    if (!agrees) {
      return fmt::format("H{} is another group than from scratch", p);
    }
  }
  return std::nullopt;
}

}  // namespace

std::uint64_t heap_in_use() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd + sparse::bytes_of_pages();
}

Result<SoakOutcome> soak(const SoakPlan& plan, const std::function<void(const SoakTenth&)>& visit) {
  engine::Engine engine(plan.ring, {}, {}, {plan.undo_limit, false, plan.forgets_cells});
  SoakSteps steps(engine, plan.cells, plan.seed);
  SoakOutcome outcome;
  const auto check = [&]() -> std::optional<std::string> {
    if (auto defect = steps.defect()) {
      return defect;
    }
    auto defect = engine.first_defect();
    return defect ? defect : first_wrong_group(engine);
  };
  std::uint64_t checks = 0;
  for (std::uint64_t tenth = 1; tenth <= 10; ++tenth) {
    SoakTenth row;
    const double start = processor_seconds();
    const double engine_before = steps.engine_seconds();
    while (steps.accepted() < plan.steps * tenth / 10) {
      (void)steps.step();
      if (steps.accepted() >= (checks + 1) * plan.steps / std::max<std::uint64_t>(plan.samples, 1) &&
          checks < plan.samples) {
        const double begin = processor_seconds();
        ++checks;
        ++row.checks;
        if (const auto defect = check()) {
          return Error{Errc::law_broken, fmt::format("after {} steps: {}", steps.accepted(), *defect)};
        }
        row.check_seconds += processor_seconds() - begin;
      }
    }
    row.seconds = processor_seconds() - start - row.check_seconds;
    row.engine_seconds = steps.engine_seconds() - engine_before;
    row.steps = steps.accepted();
    row.cells = sum_of(engine.cells());
    row.nodes = engine.structure().cells().size();
    row.renewals = steps.renewals();
    row.rebases = engine.rebases();
    row.betti = engine.homology().betti;
    (void)malloc_trim(0);  // what checks have given back
    row.resident_bytes = engine::memory_in_use();
    row.heap_bytes = heap_in_use();
    visit(row);
    outcome.tenths.push_back(std::move(row));
  }
  outcome.counts = steps.counts();
  return outcome;
}

}  // namespace sesame::tools
