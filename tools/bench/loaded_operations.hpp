/// \file
/// The operations of a filtration, tower or zigzag, in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "replay/tower/tower_reader.hpp"
#include "tools/bench/scenarios.hpp"

namespace sesame::tools {

/// Operations that are all in memory, in one list of numbers each after the other, as a reader of a binary file has
/// them: so a tracker can look ahead as it does there.
class LoadedOperations {
 public:
  /// Those of a scenario, at a size. Requires: it is no construction.
  LoadedOperations(const Scenario& scenario, std::uint64_t size);

  [[nodiscard]] std::size_t size() const { return heads_.size(); }
  [[nodiscard]] replay::TowerOperation operator[](std::size_t k) const;

 private:
  using Kind = replay::TowerOperation::Kind;
  struct Head {
    Kind kind;
    int dimension;
    std::size_t at;  ///< where in words_ the number of labels stands
  };
  void load(const Filtration& filtration);
  void load(replay::TowerReader& reader);
  void begin(Kind kind, int dimension);

  bool are_columns_ = false;
  std::vector<Head> heads_;
  std::vector<std::uint64_t> words_;
};

}  // namespace sesame::tools
