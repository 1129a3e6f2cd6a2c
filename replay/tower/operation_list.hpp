/// \file
/// The operations of a tower as they were read, to be shown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "replay/tower/tower_reader.hpp"

namespace sesame::replay {

/// Grows with the tower: some 40 bytes for an operation, and 8 for each of its labels.
class OperationList {
 public:
  /// Adds what happened next. `line`: where it stands in the input; see TowerReader::line. Faces that were added have
  /// the line of what they were added for.
  void add(const TowerOperation& operation, std::uint64_t line);

  [[nodiscard]] std::size_t size() const { return lines_.size(); }
  [[nodiscard]] std::uint64_t line(std::size_t operation) const { return lines_[operation]; }
  /// That of the simplex, or column, which is included; -1 for a contraction.
  [[nodiscard]] int dimension(std::size_t operation) const { return dimensions_[operation]; }
  /// Of a contraction u and v, of a column its rows.
  [[nodiscard]] std::span<const std::uint64_t> labels(std::size_t operation) const;
  [[nodiscard]] engine::Time time(std::size_t operation) const { return times_[operation]; }
  /// "i 4 7", "c 4 7"; for a column "column 12: 4 7".
  [[nodiscard]] std::string text(std::size_t operation) const;

 private:
  std::vector<std::uint64_t> labels_, first_{0};  ///< where the labels of each begin; one more at the end
  std::vector<std::uint64_t> lines_;
  std::vector<engine::Time> times_;
  std::vector<int> dimensions_;
  bool has_columns_ = false;
};

}  // namespace sesame::replay
