/// \file
/// The homology groups of a tower over Z, torsion and all, each time they change.
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/engine.hpp"
#include "replay/script/reporter.hpp"
#include "replay/text/text_buffer.hpp"
#include "replay/tower/tower_replay.hpp"

namespace sesame::replay {

/// Collects or prints the groups each time they change. All operations at one time count as one: the groups of a time
/// are those after the last of them.
class GroupSequence {
 public:
  /// With `lines`, a line for each change is written there once its time is over, and nothing is kept. Groups above the
  /// last of `dimensions` are left out.
  explicit GroupSequence(std::ostream* lines, engine::Dimensions dimensions = engine::all_dimensions)
      : lines_{lines}, dimensions_{dimensions} {}

  void add(engine::Time time, const engine::Homology& homology, const sparse::AnyRing& ring);
  /// After the last operation.
  void finish();
  /// [[time,[{"rank":1,"torsion":[]},...]],...]: the groups from a time on, one per dimension, those that are 0 at the
  /// end left out.
  void add_json(TextBuffer& text) const;

 private:
  struct Change {
    engine::Time time;
    std::vector<std::uint64_t> ranks;
    std::vector<std::vector<sparse::Integer>> torsion;
  };
  std::ostream* lines_;
  engine::Dimensions dimensions_;
  std::vector<Change> changes_;
  std::optional<Change> present_;  ///< of the time that may not be over
  std::string line_;               ///< for it
};

/// A tower of simplices in an engine, for what needs more than a field. Requires operations on simplices, not columns.
class EngineTower {
 public:
  explicit EngineTower(const sparse::AnyRing& ring) : engine_{ring} {}

  /// Applies the next operation, or leaves everything as it was. Errors, without the place: as those of a TowerReplay.
  Status apply(const TowerOperation& operation);
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

}  // namespace sesame::replay
