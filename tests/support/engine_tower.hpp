/// \file
/// Towers in an engine, with cells, names and undo: the slow twin of the trackers that know the present only.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/engine.hpp"
#include "ops/simplicial/tower_rules.hpp"
#include "replay/tower/tower_reader.hpp"

namespace sesame::tests {

/// A tower of simplices in an engine, the slow twin of what tracks one. Requires operations on simplices, not columns.
class EngineTower {
 public:
  explicit EngineTower(const sparse::AnyRing& ring) : engine_{ring} {}

  /// Applies the next operation, or leaves everything as it was. Errors, without the place: as those of a TowerReplay.
  Status apply(const replay::TowerOperation& operation);
  /// What is there, by labels, and what is wrong with an operation. Not longer than the tower.
  [[nodiscard]] ops::TowerRules rules() const;
  [[nodiscard]] engine::Engine& engine() { return engine_; }

 private:
  /// What the engine calls the vertex that a label names, or named last. Requires: it has named one.
  [[nodiscard]] std::string name(std::uint64_t label) const;
  /// The vertex that a label names, or none.
  [[nodiscard]] ops::VertexId vertex(std::uint64_t label) const;

  engine::Engine engine_;
  /// How often a label has named a new vertex: the engine wants another name each time.
  std::unordered_map<std::uint64_t, std::uint64_t> uses_;
};

inline std::string EngineTower::name(std::uint64_t label) const {
  const std::uint64_t uses = uses_.at(label);
  return uses == 1 ? std::to_string(label) : fmt::format("{}#{}", label, uses);
}

inline ops::VertexId EngineTower::vertex(std::uint64_t label) const {
  if (!uses_.contains(label)) {
    return ops::none;
  }
  const ops::AbstractComplex& complex = engine_.structure().abstract();
  const ops::LabelId known = complex.label(name(label));
  return known == ops::none || complex.is_contracted(known) ? ops::none : complex.vertex(known);
}

inline ops::TowerRules EngineTower::rules() const {
  return {engine_.structure().abstract().simplices(), [this](std::uint64_t label) { return vertex(label); }};
}

inline Status EngineTower::apply(const replay::TowerOperation& operation) {
  const bool is_inclusion = operation.kind == replay::TowerOperation::Kind::insert;
  if (const Status status = is_inclusion ? rules().check_inclusion(operation.labels)
                                         : rules().check_contraction(operation.labels[0], operation.labels[1]);
      !status) {
    return status.error();
  }
  ops::Operation step;
  if (is_inclusion) {
    if (operation.dimension == 0) {
      ++uses_[operation.labels[0]];
    }
    std::vector<std::string> simplex;
    for (const std::uint64_t label : operation.labels) {
      simplex.push_back(name(label));
    }
    step = ops::Insert{{std::move(simplex)}};
  } else {
    step = ops::Collapse{name(operation.labels[0]), name(operation.labels[1])};
  }
  const Result<engine::StepReport> report = engine_.apply(std::move(step));
  return report ? Status{Done{}} : Status{report.error()};
}

}  // namespace sesame::tests
