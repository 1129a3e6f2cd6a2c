/// \file
/// What the simplices of a zigzag are called, and were.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/zigzag/zigzag_tracker.hpp"
#include "replay/tower/named_chains.hpp"
#include "replay/tower/tower_reader.hpp"
#include "replay/zigzag/zigzag_cycles.hpp"

namespace sesame::replay {

/// The vertices of every simplex that there ever was, and the labels of these, which contractions change. Grows with
/// the zigzag: for cycles, whose simplices may be long gone when they are written.
class ZigzagHistory final : public engine::ZigzagTracker {
 public:
  /// `characteristic`: of the field, whose elements are written as residues of least size.
  explicit ZigzagHistory(std::uint32_t characteristic) : characteristic_{characteristic} {}

  void include(int dimension, Slot slot, std::span<const Slot> facets, engine::Moment moment) override;
  void exclude(int dimension, Slot slot, engine::Moment moment) override;
  /// An operation is over, after all that it includes and excludes.
  void end_operation(const TowerOperation& operation);

  /// The cycles of a bar by labels. At one time the last operation counts, so a piece that no time has is left out; a
  /// piece in which vertices change their labels is several. Neighbours differ. Cost: the terms, times those changes.
  [[nodiscard]] std::vector<NamedPiece> named(const engine::MomentBar& bar,
                                              std::span<const engine::CyclePiece> pieces) const;

 private:
  using Label = ops::Label;
  using Vertex = std::uint32_t;  ///< from its inclusion on
  /// Simplices of one dimension, in the order of their inclusions.
  struct Layer {
    std::vector<Vertex> vertices;         ///< of simplex after simplex, as they orient it
    std::vector<std::uint64_t> at_slots;  ///< per slot: the simplex last included
  };
  using Names = std::vector<std::pair<engine::Time, Label>>;  ///< since when

  [[nodiscard]] std::span<const Vertex> vertices(int dimension, std::uint64_t simplex) const;
  [[nodiscard]] Label label_at(Vertex vertex, engine::Time time) const;
  [[nodiscard]] std::vector<engine::Time> changes(const engine::ZigzagChain& chain, engine::Time after,
                                                  engine::Time before) const;
  [[nodiscard]] NamedChain named_at(const engine::ZigzagChain& chain, engine::Time time) const;

  std::uint32_t characteristic_;
  std::vector<Layer> layers_;  ///< per dimension
  std::vector<Names> names_;   ///< per vertex
  std::unordered_map<Label, Vertex> called_;
  Vertex last_excluded_ = 0;
};

}  // namespace sesame::replay
