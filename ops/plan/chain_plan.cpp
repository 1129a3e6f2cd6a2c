// Chains of maps by their cells, or by the simplices of their simplicial analogue.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ops/cells/map_cells.hpp"
#include "ops/plan/analogue_writer.hpp"
#include "ops/plan/layers_writer.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"

namespace sesame::ops {
namespace {

Result<ChainOfMaps> chain_of(const MakeChainOfMaps& operation) {
  const auto wrong = [&](const std::string& what) {
    return Error{Errc::bad_input, fmt::format("\"{}\" is no chain of maps: {}", operation.name, what)};
  };
  if (operation.levels.size() > static_cast<std::size_t>(largest_map_dimension)) {
    return wrong(fmt::format("it has {} levels above level 0, at most {} are possible", operation.levels.size(),
                             largest_map_dimension));
  }
  std::vector<GMap> levels{GMap::points(operation.points)};
  std::vector<std::vector<Dart>> sigma;
  for (const auto& [alpha, images] : operation.levels) {
    Result<GMap> level = GMap::make(alpha);
    if (!level) {
      return wrong(fmt::format("level {}: {}", levels.size(), level.error().what));
    }
    levels.push_back(std::move(*level));
    sigma.push_back(images);
  }
  Result<ChainOfMaps> chain = ChainOfMaps::make(std::move(levels), std::move(sigma));
  return chain ? chain : wrong(chain.error().what);
}

/// A dart of level 0 is a vertex: either none has a position, or each.
Status check_points(const MakeChainOfMaps& operation) {
  return operation.at.empty() || operation.at.size() == operation.points
             ? Status{Done{}}
             : Error{Errc::bad_input, fmt::format("\"{}\" has {} vertices, but {} points in \"at\": it should have one "
                                                  "for each dart of level 0",
                                                  operation.name, operation.points, operation.at.size())};
}

/// Are the names of all cells free, from whichever dart?
Status check_names(const std::string& name, const ChainOfMaps& chain, const Structure& structure) {
  if (Status s = check_new_name(name, structure); !s) {
    return s;
  }
  std::string full = name + ".";
  const std::size_t base = full.size();
  std::size_t darts = 0;
  for (int i = 0; i <= chain.dimension(); ++i) {
    darts += chain.level(i).size();
  }
  if (is_free_beginning(full, structure, darts)) {
    return Done{};
  }
  for (int i = 0; i <= chain.dimension(); ++i) {
    for (Dart d = 0; d < chain.level(i).size(); ++d) {
      full.replace(base, std::string::npos, fmt::format("{}:{}", i, d));
      if (structure.is_name_taken(full)) {
        return Error{Errc::bad_input,
                     fmt::format("the name \"{}\" is in use, so \"{}\" cannot name a new chain of maps: choose another",
                                 full, name)};
      }
    }
  }
  return Done{};
}

Status plan_by_simplices(const MakeChainOfMaps& operation, const ChainOfMaps& chain, const Structure& structure,
                         const Limits& limits, Plan& plan) {
  AnalogueWriter writer(
      operation.name,
      {chain.dimension(), [&](IndexSet set) { return orbits_numbered(chain, set); },
       [&](Dart d, int from, int to) { return chain.lowered(d, from, to); }, [](Dart d) { return std::to_string(d); }},
      structure, plan);
  return writer.write(limits);
}

Status plan_by_cells(const MakeChainOfMaps& operation, const ChainOfMaps& chain, const Structure& structure,
                     const Limits& limits, Plan& plan) {
  const auto layers = cells_of_chain(chain, cells_seen_from_least_darts(), structure.types());
  if (!layers) {
    return Error{layers.error().code,
                 fmt::format("{}: make \"{}\" \"as\":\"simplices\"", layers.error().what, operation.name)};
  }
  auto cells = write_layers(
      operation.name, *layers, [](Dart d) { return std::to_string(d); }, structure, limits, plan);
  if (!cells) {
    return cells.error();
  }
  plan.map = {{}, std::move(*cells)};
  return Done{};
}

}  // namespace

Status plan_map(const MakeChainOfMaps& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  const Result<ChainOfMaps> chain = chain_of(operation);
  if (!chain) {
    return chain.error();
  }
  if (operation.points == 0) {
    return Error{Errc::bad_input,
                 fmt::format("\"{}\" has no darts: a chain of maps needs one at least on level 0", operation.name)};
  }
  if (Status s = check_points(operation); !s) {
    return s;
  }
  if (Status s = check_names(operation.name, *chain, structure); !s) {
    return s;
  }
  plan.new_body = operation.name;
  return operation.as_simplices ? plan_by_simplices(operation, *chain, structure, limits, plan)
                                : plan_by_cells(operation, *chain, structure, limits, plan);
}

}  // namespace sesame::ops
