/// \file
/// What is said of the classes of the bars of a zigzag.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "engine/history_zigzag.hpp"
#include "replay/script/generators.hpp"
#include "replay/tower/named_chains.hpp"
#include "replay/tower/tower_report.hpp"

namespace sesame::replay {

/// A cycle of a bar from one time on until another: that of all objects in between.
template <class Chain>
struct PieceOf {
  engine::Time from, until;
  Chain cycle;
};
/// By labels of vertices.
using NamedPiece = PieceOf<NamedChain>;
/// By names of cells.
using ScriptPiece = PieceOf<engine::NameChain>;

/// The cycles of a bar of a script. `characteristic`: of the field, whose elements are written as residues of least
/// size.
[[nodiscard]] std::vector<ScriptPiece> pieces_of(const engine::Bar& bar, std::vector<engine::NamedCycle> cycles,
                                                 std::uint32_t characteristic);

/// Takes the cycles of bars when these end, and writes them when all have. Until then they are kept as text, which is
/// shorter than chains.
class ZigzagCycles final : public ClassReport {
 public:
  enum class Form { table, json };
  /// Bars that `selection` or `options` do not have, or above `dimensions`, are left out, as are those of length 0.
  ZigzagCycles(Form form, engine::Dimensions dimensions, BarSelection selection, GeneratorOptions options)
      : form_{form}, dimensions_{dimensions}, selection_{selection}, options_{std::move(options)} {}

  /// Whether there may be something to say of bars of a dimension.
  [[nodiscard]] bool wants(int dimension) const {
    return dimensions_.have(static_cast<std::size_t>(dimension)) && options_.wants(dimension);
  }
  /// Whether there is something to say of a bar.
  [[nodiscard]] bool wants(const engine::Bar& bar) const {
    return bar.birth != bar.death && selection_.has(bar) && wants(bar.dimension);
  }
  /// Requires: the bar is wanted.
  template <class Chain>
  void add(const engine::Bar& bar, const std::vector<PieceOf<Chain>>& pieces);

  /// Bars by dimension, birth and death, with a line for each piece.
  void write_table(std::ostream& out) const override;
  /// Objects {"dim","birth","death","pieces":[{"from","until","cycle"},...]}; chains as in CycleReport, with names
  /// instead of labels where cells have them.
  void add_json(TextBuffer& text) const override;

 private:
  struct Said {
    engine::Bar bar;
    std::string text;
  };

  [[nodiscard]] std::vector<const Said*> sorted() const;
  template <class Chain>
  [[nodiscard]] std::string table(const engine::Bar& bar, const std::vector<PieceOf<Chain>>& pieces) const;
  template <class Chain>
  [[nodiscard]] std::string json(const engine::Bar& bar, const std::vector<PieceOf<Chain>>& pieces) const;

  Form form_;
  engine::Dimensions dimensions_;
  BarSelection selection_;
  GeneratorOptions options_;
  std::vector<Said> said_;
};

}  // namespace sesame::replay
