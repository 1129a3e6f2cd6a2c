/// \file
/// What is said of the classes of the bars of a zigzag.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "replay/script/generators.hpp"
#include "replay/tower/tower_report.hpp"
#include "replay/zigzag/zigzag_history.hpp"

namespace sesame::replay {

/// Takes the cycles of bars when these end, and writes them when all have. Until then they are kept as text, which is
/// shorter than chains.
class ZigzagCycles final : public ClassReport {
 public:
  enum class Form { table, json };
  /// Bars that `selection` or `options` do not have, or above `dimensions`, are left out, as are those of length 0.
  ZigzagCycles(const ZigzagHistory& history, Form form, engine::Dimensions dimensions, BarSelection selection,
               GeneratorOptions options)
      : history_{history}, form_{form}, dimensions_{dimensions}, selection_{selection}, options_{std::move(options)} {}

  /// Whether there may be something to say of bars of a dimension.
  [[nodiscard]] bool wants(int dimension) const {
    return dimensions_.have(static_cast<std::size_t>(dimension)) && options_.wants(dimension);
  }
  void add(const engine::MomentBar& moments, const engine::ZigzagBarcode::Pieces& pieces);

  /// Bars by dimension, birth and death, with a line for each piece.
  void write_table(std::ostream& out) const override;
  /// Objects {"dim","birth","death","pieces":[{"from","until","cycle"},...]}; chains as in CycleReport.
  void add_json(TextBuffer& text) const override;

 private:
  struct Said {
    engine::Bar bar;
    std::string text;
  };

  [[nodiscard]] std::vector<const Said*> sorted() const;
  [[nodiscard]] std::string table(const engine::Bar& bar, const std::vector<NamedPiece>& pieces) const;
  [[nodiscard]] std::string json(const engine::Bar& bar, const std::vector<NamedPiece>& pieces) const;

  const ZigzagHistory& history_;
  Form form_;
  engine::Dimensions dimensions_;
  BarSelection selection_;
  GeneratorOptions options_;
  std::vector<Said> said_;
};

}  // namespace sesame::replay
