#include "engine/zigzag/filtration_pairs.hpp"

namespace sesame::engine {
namespace {

using Place = ZigzagFiltration::Place;

/// The numbers of some cells, by their places.
class Numbers {
 public:
  static constexpr std::uint32_t none = UINT32_MAX;

  Numbers(std::size_t places, std::span<const Place> cells) : numbers_(places, none) {
    for (std::uint32_t number = 0; number < cells.size(); ++number) {
      numbers_[cells[number]] = number;
    }
  }
  [[nodiscard]] std::uint32_t operator[](Place place) const { return numbers_[place]; }

 private:
  std::vector<std::uint32_t> numbers_;
};

}  // namespace

FiltrationMatrix FiltrationMatrix::boundaries(const ZigzagFiltration& filtration, std::span<const Place> columns,
                                              std::span<const Place> rows) {
  FiltrationMatrix matrix;
  matrix.columns_.assign(columns.begin(), columns.end());
  matrix.rows_.assign(rows.begin(), rows.end());
  const Numbers numbers(filtration.size(), rows);
  matrix.first_.push_back(0);
  for (const Place column : columns) {
    filtration.for_each_in_boundary(column, [&](Place place, bool is_negative) {
      if (numbers[place] != Numbers::none) {
        matrix.entries_.emplace_back(numbers[place], is_negative);
      }
    });
    matrix.first_.push_back(matrix.entries_.size());
  }
  return matrix;
}

FiltrationMatrix FiltrationMatrix::coboundaries(const ZigzagFiltration& filtration, std::span<const Place> columns,
                                                std::span<const Place> rows) {
  FiltrationMatrix matrix;
  matrix.columns_.assign(columns.rbegin(), columns.rend());
  matrix.rows_.assign(rows.rbegin(), rows.rend());
  const Numbers numbers(filtration.size(), matrix.columns_);
  const auto for_each_entry = [&](auto&& visit) {
    for (std::uint32_t row = 0; row < matrix.rows_.size(); ++row) {
      filtration.for_each_in_boundary(matrix.rows_[row], [&](Place place, bool is_negative) {
        if (numbers[place] != Numbers::none) {
          visit(numbers[place], SignedRow{row, is_negative});
        }
      });
    }
  };
  matrix.first_.assign(columns.size() + 1, 0);
  for_each_entry([&](std::uint32_t column, SignedRow) { ++matrix.first_[column + 1]; });
  for (std::size_t column = 0; column < columns.size(); ++column) {
    matrix.first_[column + 1] += matrix.first_[column];
  }
  std::vector<std::uint64_t> next(matrix.first_.begin(), matrix.first_.end() - 1);
  matrix.entries_.resize(matrix.first_.back());
  for_each_entry([&](std::uint32_t column, SignedRow entry) { matrix.entries_[next[column]++] = entry; });
  return matrix;
}

}  // namespace sesame::engine
