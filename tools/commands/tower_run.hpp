/// \file
/// One run of `sesame tower` or `sesame zigzag`: what barcodes over fields, groups over Z, scripts and zigzags have in
/// common.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "engine/towers/class_space.hpp"
#include "replay/page/tower_page.hpp"
#include "replay/picture/barcode_drawing.hpp"
#include "replay/script/replay.hpp"
#include "replay/tower/group_sequence.hpp"
#include "replay/tower/tower_reader.hpp"
#include "replay/tower/tower_replay.hpp"
#include "replay/tower/tower_report.hpp"
#include "tools/commands/interrupt.hpp"
#include "tools/commands/output_file.hpp"
#include "tools/commands/tower_arguments.hpp"

namespace sesame::tools {

/// Opens the input and the outputs, reads operations one by one, and writes what there is to write. What is done with
/// an operation is the matter of the loops (tower_loops.hpp). What goes wrong is said on standard error.
class TowerRun {
 public:
  /// Streams to what is wanted; null for what is not.
  struct Outputs {
    std::ostream *pers = nullptr, *csv = nullptr, *svg = nullptr, *html = nullptr;

    [[nodiscard]] bool need_barcode() const { return csv != nullptr || svg != nullptr || html != nullptr; }
  };

  /// `arguments` must outlive it.
  explicit TowerRun(const TowerArguments& arguments)
      : arguments_{arguments}, files_{{arguments.file, arguments.points}} {}

  /// Before the loop; when something is wrong, says it and returns another outcome than `done`.
  replay::Outcome open();
  /// After the loop: outputs take their places when there is something to report. Returns the outcome of it all.
  replay::Outcome finish(replay::Outcome outcome);

  [[nodiscard]] const TowerArguments& arguments() const { return arguments_; }
  [[nodiscard]] const std::vector<sparse::AnyRing>& rings() const { return rings_; }
  [[nodiscard]] const Outputs& outputs() const { return outputs_; }
  [[nodiscard]] bool is_integral() const { return std::holds_alternative<sparse::Integers>(rings_[0]); }
  [[nodiscard]] bool is_script() const { return format() == replay::TowerFormat::script; }
  [[nodiscard]] bool is_matrix() const {
    return format() == replay::TowerFormat::phat || format() == replay::TowerFormat::phat_binary;
  }
  /// Those that are asked for.
  [[nodiscard]] engine::Dimensions dimensions() const;
  /// Whether the table and the states of `--every` are printed: not into an output that standard output has become.
  [[nodiscard]] bool prints() const { return !arguments_.json && !arguments_.quiet && !fills_standard_output(); }
  /// Whether there is something to report after the loop.
  [[nodiscard]] bool is_reported(replay::Outcome outcome) const {
    return outcome == replay::Outcome::done || outcome == replay::Outcome::interrupted || arguments_.partial;
  }
  [[nodiscard]] replay::Provenance provenance(const sparse::AnyRing& ring, std::uint64_t operations) const;
  /// For bars over the first ring, when they are to be written.
  [[nodiscard]] std::optional<replay::PersWriter> pers_writer() const;

  /// Reads to the end, until --until, Ctrl-C or an error, which it says. apply(operation) -> Status, after(operation).
  template <class Apply, class After>
  replay::Outcome read_all(Apply&& apply, After&& after);
  /// The operations of the input that were carried out; added faces are none.
  [[nodiscard]] std::uint64_t operations() const { return operations_; }
  [[nodiscard]] replay::FaceAdder& faces() { return faces_; }
  /// Where the last operation stands: see TowerReader::line.
  [[nodiscard]] std::uint64_t line() const { return reader_->line(); }
  /// Where the vertices are, or null.
  [[nodiscard]] const replay::PointList* points() const { return points_ ? &*points_ : nullptr; }
  /// The input, when it is a script; from then on it is not read by read_all.
  [[nodiscard]] replay::ScriptReader take_script() { return reader_->take_script(); }
  /// What shows how far the work has come, or null.
  [[nodiscard]] replay::Progress* progress() { return progress_ ? &*progress_ : nullptr; }
  void end_progress() { progress_.reset(); }

  /// Facts of a drawing, or a page, that only the loop knows.
  struct Drawn {
    bool has_contractions = false;
    std::optional<int> top_dimension;                   ///< of the cells of a tower
    const replay::TowerClasses* classes = nullptr;      ///< of its bars, or null when they are not known
    const replay::OperationList* operations = nullptr;  ///< or null when they were too many
    std::string note;                                   ///< what else a page says
  };
  /// Writes a result for each ring, into files, as JSON or as tables.
  void write(std::span<const replay::TowerResult> results, const replay::ClassReport* classes,
             const Drawn& drawn) const;
  void write_groups(replay::GroupSequence& groups, std::uint64_t operations) const;
  /// With --every: whether cells and Betti numbers are to be said after so many operations.
  [[nodiscard]] bool reports_state(std::uint64_t operations) const {
    return arguments_.every != 0 && operations % arguments_.every == 0 && (prints() || arguments_.json);
  }
  void write_state(std::uint64_t operations, engine::Time time, std::span<const std::uint64_t> cells,
                   const sparse::AnyRing& ring, std::span<const std::uint64_t> betti) const;

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] replay::TowerFormat format() const { return reader_->format(); }
  [[nodiscard]] bool fills_standard_output() const;
  Status read_rings();
  [[nodiscard]] Status check_arguments() const;
  Status open_outputs();
  Status read_points();
  void say_format();
  [[nodiscard]] replay::Outcome wrong_usage(const Error& error) const;
  replay::Outcome fail(const Error& error);
  [[nodiscard]] replay::DrawingOptions drawing(const Drawn& drawn) const;

  const TowerArguments& arguments_;
  std::vector<sparse::AnyRing> rings_;
  std::unique_ptr<replay::TowerReader> reader_;
  replay::FaceAdder faces_;
  std::string source_;  ///< what outputs and messages call the input
  OutputFiles files_;
  Outputs outputs_;
  std::uint64_t operations_ = 0;
  std::optional<replay::PointList> points_;
  std::optional<replay::Progress> progress_;
  Clock::time_point start_;
};

template <class Apply, class After>
replay::Outcome TowerRun::read_all(Apply&& apply, After&& after) {
  replay::TowerOperation operation;
  while (!stop_requested().load() && (arguments_.until == 0 || operations_ < arguments_.until)) {
    const Result<bool> got = reader_->next(operation);
    if (!got) {
      return fail(got.error());
    }
    if (!*got) {
      break;
    }
    const Status status = apply(operation);
    if (!status) {
      const bool lacks_face = status.error().code == Errc::unknown_name;
      return fail({Errc::bad_input, reader_->place() + status.error().what +
                                        (lacks_face ? ", or let --add-faces add them at that time" : "")});
    }
    ++operations_;
    after(operation);
    if (progress_ && operations_ % 1024 == 0) {
      progress_->update(operations_);
    }
  }
  progress_.reset();
  return stop_requested().load() ? replay::Outcome::interrupted : replay::Outcome::done;
}

}  // namespace sesame::tools
