/// \file
/// The homology groups of a tower over Z, torsion and all, each time they change.
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <span>
#include <vector>

#include "engine/homology_tracker.hpp"
#include "engine/towers/barcode_tracker.hpp"
#include "replay/script/reporter.hpp"
#include "replay/text/text_buffer.hpp"

namespace sesame::replay {

/// Collects or prints the groups each time they change. All operations at one time count as one: the groups of a time
/// are those after the last of them.
class GroupSequence {
 public:
  /// With `lines`, a line for each change is written there once its time is over, and nothing is kept. Groups above the
  /// last of `dimensions` are left out.
  explicit GroupSequence(std::ostream* lines, engine::Dimensions dimensions = engine::all_dimensions)
      : lines_{lines}, dimensions_{dimensions} {}

  /// Cost: the number of dimensions, and the torsion; while that stays what it was nothing is allocated.
  void add(engine::Time time, const engine::Homology& homology, const sparse::AnyRing& ring);
  /// After the last operation.
  void finish();
  /// [[time,[{"rank":1,"torsion":[]},...]],...]: the groups from a time on, one per dimension, those that are 0 at the
  /// end left out.
  void add_json(TextBuffer& text) const;

 private:
  /// Groups from a time on. The torsion of many is that of the one before, and is held once.
  struct Change {
    engine::Time time;
    std::size_t first_rank;  ///< in ranks_; up to that of the next
    std::size_t torsion;     ///< in torsions_
  };
  using Torsion = std::vector<std::vector<sparse::Integer>>;

  [[nodiscard]] std::span<const std::int64_t> ranks_of(std::size_t change) const;

  std::ostream* lines_;
  engine::Dimensions dimensions_;
  std::vector<Change> changes_;  ///< with lines, the last only
  std::vector<std::int64_t> ranks_;
  std::vector<Torsion> torsions_;
  std::optional<engine::Time> time_;  ///< that may not be over
  engine::Homology present_;          ///< at it
  sparse::AnyRing ring_;
};

}  // namespace sesame::replay
