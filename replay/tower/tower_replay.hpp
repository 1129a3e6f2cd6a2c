/// \file
/// Replaying a tower: the complex, and whatever tracks its homology, one operation after the other.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/towers/tower_tracker.hpp"
#include "ops/simplicial/column_complex.hpp"
#include "ops/simplicial/tower_complex.hpp"
#include "replay/tower/tower_history.hpp"
#include "replay/tower/tower_reader.hpp"

namespace sesame::replay {

/// Adds what simplices lack, before a TowerReplay or an EngineTower takes them.
struct FaceAdder {
  /// Applies an operation. When `adds_faces` is set, the faces that a simplex lacks are included before it at its time,
  /// and a simplex that is there already is counted, and left out.
  template <class Tower>
  Status apply(Tower& tower, const TowerOperation& operation);

  bool adds_faces = false;
  std::uint64_t added = 0;    ///< faces
  std::uint64_t already = 0;  ///< simplices that were there
};

/// The same error, after the log has been told that an operation did not happen.
Error told(const Error& error);

/// A tower under way. Threads: one at a time, for queries too.
class TowerReplay {
 public:
  /// Trackers, and a history, are told of every operation; they have to outlive this object. The history may be null.
  explicit TowerReplay(std::vector<engine::TowerTracker*> trackers, TowerHistory* history = nullptr)
      : trackers_{std::move(trackers)}, history_{history} {}

  /// Applies the next operation, or leaves everything as it was. Errors, without the place: unknown_name when a face of
  /// a simplex is missing; bad_input.
  Status apply(const TowerOperation& operation);

  /// The history is told of nothing any more.
  void end_history() { history_ = nullptr; }

  /// What is there, by labels, and what is wrong with an operation.
  [[nodiscard]] ops::TowerRules rules() const { return complex_.rules(); }
  [[nodiscard]] std::uint64_t operations() const { return operations_; }
  /// The number of cells of each dimension, up to the largest that has one.
  [[nodiscard]] std::span<const std::uint64_t> cells() const {
    return columns_.counts().empty() ? complex_.counts() : columns_.counts();
  }

 private:
  void include(int dimension, ops::TowerComplex::Slot slot, std::span<const ops::TowerComplex::Slot> facets,
               engine::Time time);
  void prefetch(const TowerOperation& operation) const;

  std::vector<engine::TowerTracker*> trackers_;
  TowerHistory* history_;
  ops::TowerComplex complex_;
  ops::ColumnComplex columns_;
  std::uint64_t operations_ = 0;
};

template <class Tower>
Status FaceAdder::apply(Tower& tower, const TowerOperation& operation) {
  if (!adds_faces || operation.kind != TowerOperation::Kind::insert) {
    return tower.apply(operation);
  }
  if (tower.rules().contains(operation.labels)) {
    ++already;
    return Done{};
  }
  const Result<std::vector<std::vector<ops::Label>>> faces = tower.rules().missing_faces(operation.labels);
  if (!faces) {
    return faces.error();
  }
  for (const std::vector<ops::Label>& face : *faces) {
    Status status =
        tower.apply({TowerOperation::Kind::insert, operation.time, static_cast<int>(face.size()) - 1, face});
    if (!status) {
      return status;
    }
  }
  added += faces->size();
  return tower.apply(operation);
}

}  // namespace sesame::replay
