/// \file
/// What is said of a tower: tables for people, JSON for programs.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "engine/towers/barcode.hpp"
#include "engine/towers/barcode_tracker.hpp"
#include "replay/barcode/barcode_files.hpp"
#include "replay/barcode/bars.hpp"
#include "replay/script/generators.hpp"
#include "replay/tower/tower_history.hpp"

namespace sesame::replay {

/// Counts of bars, and the longest ones: what a table needs, in memory that does not grow with their number.
class BarStatistics {
 public:
  struct Row {
    std::uint64_t bars = 0, open = 0;
    engine::Time longest = 0;  ///< of those that have ended
  };
  /// Adds a bar that will not change any more.
  void add(const engine::Bar& bar);
  /// Per dimension.
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  /// The longest bars that have ended, longest first.
  [[nodiscard]] std::vector<engine::Bar> longest() const;

 private:
  static constexpr std::size_t most_shown = 10;
  std::vector<Row> rows_;
  std::vector<engine::Bar> longest_;  ///< a heap, the shortest on top
};

/// What there is to say of the barcode over one ring. Without `barcode`, its bars have not been kept.
struct TowerResult {
  Provenance provenance;
  std::uint64_t hidden = 0;
  BarSelection selection;               ///< of the statistics and the lists of bars
  std::uint64_t shorter = 0, open = 0;  ///< how many bars are left out for that
  BarStatistics statistics;
  std::optional<engine::Barcode> barcode;  ///< all of them: Betti numbers and differences are those of all bars
};

/// The table of a result: bars per dimension, the longest ones.
void write_tower_table(std::ostream& out, const TowerResult& result);

/// The table of the bars that do not occur equally often over all rings: torsion, seen in persistence.
/// Requires: results that keep their barcodes.
void write_differences(std::ostream& out, std::span<const TowerResult> results);

/// What is said of the classes of bars.
class ClassReport {
 public:
  virtual ~ClassReport() = default;
  virtual void write_table(std::ostream& out) const = 0;
  /// A JSON array with an object for each bar.
  virtual void add_json(TextBuffer& text) const = 0;
};

/// Writes a cycle for each bar, the chain that it bounds from its death on, or for one that is open what it is now.
/// Bars that `selection` has not are left out.
class CycleReport final : public ClassReport {
 public:
  /// `stop`, set from outside: no more bars after the one at hand. Requires: the tracker keeps cycles.
  CycleReport(engine::BarcodeTracker& tracker, const TowerHistory& history, std::uint64_t operations,
              BarSelection selection, GeneratorOptions options, const std::atomic<bool>* stop)
      : tracker_{tracker},
        history_{history},
        operations_{operations},
        selection_{selection},
        options_{std::move(options)},
        stop_{stop} {}

  void write_table(std::ostream& out) const override;
  /// A JSON array of {"dim","birth","death","cycle","bounds"}, or "now" instead of "bounds"; a chain is a list of
  /// [coefficient,[labels]]; of one that is too long there is the length, "cycle_terms" and so on.
  void add_json(TextBuffer& text) const override;

 private:
  template <class Visit>
  void for_each_bar(Visit&& visit) const;

  engine::BarcodeTracker& tracker_;
  const TowerHistory& history_;
  std::uint64_t operations_;
  BarSelection selection_;
  GeneratorOptions options_;
  const std::atomic<bool>* stop_;
};

/// One object on one line. For one ring, the fields of its barcode; for several, a list "rings" of such objects and
/// "differences". With "generators" when there are classes (which are for one ring), and with the seconds since
/// `start`. Requires: results that keep their barcodes.
void write_tower_json(std::ostream& out, std::span<const TowerResult> results, const ClassReport* classes,
                      std::chrono::steady_clock::time_point start);

}  // namespace sesame::replay
