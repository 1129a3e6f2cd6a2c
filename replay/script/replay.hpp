/// \file
/// Replaying a script: reader, engine, reports, verification, in one loop.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <ostream>

#include "engine/durable/log_reader.hpp"
#include "engine/durable/log_writer.hpp"
#include "engine/engine.hpp"
#include "ops/plan/planner.hpp"
#include "replay/script/progress.hpp"
#include "replay/script/reporter.hpp"
#include "replay/script/script.hpp"
#include "replay/script/shared_replay.hpp"

namespace sesame::replay {

/// How a replay ended; the values are the exit statuses of the program.
enum class Outcome : int {
  done = 0,
  wrong_usage = 1,
  wrong_script = 2,
  expectation_failed = 3,
  law_failed = 4,
  limit_reached = 5,
  interrupted = 130,
};

/// How an error ends a command.
[[nodiscard]] Outcome outcome_of(Errc code);

/// That of a tower has maps forwards only, that of a zigzag also backwards, as splits and removals are.
enum class NeededBarcode { none, of_tower, of_zigzag };

/// Threads: one at a time, for queries too.
struct ReplayOptions {
  std::optional<sparse::AnyRing> ring;          ///< instead of the one that the header names
  std::optional<std::uint64_t> until;           ///< stop after that many operations
  std::uint64_t every = 1;                      ///< report every so many steps; 0: none but answers to `class`
  std::optional<std::uint64_t> report_at_most;  ///< then report as with every = 0
  bool verify = false;
  std::optional<GeneratorOptions> generators;  ///< those to be written at the end
  /// A step that is refused, or an `expect` that fails, is reported, and the replay goes on behind it.
  bool keep_going = false;
  /// A step without which there would be a barcode is an error of the script; see Engine::barcode.
  NeededBarcode needs_barcode = NeededBarcode::none;
  bool partial = false;  ///< after an error of the script or a failed `expect`, summarise what was before it
  const std::atomic<bool>* stop = nullptr;  ///< set from outside: finish the current step, then summarise
  ops::Limits limits;                       ///< of what a step may make
  engine::Resources resources;              ///< that the session may take; beyond them a step is refused
  std::optional<std::chrono::duration<double>> most_time;  ///< then no further step is taken: limit_reached
  std::uint64_t undoable = UINT64_MAX;                     ///< so many steps can be undone; with `needs_barcode`, all
  bool forgets_cells = false;                              ///< that are gone and cannot come back: see HistoryPolicy
  /// Where the engine is put instead of being destroyed, which takes a tenth of the time: for a program that ends then.
  std::unique_ptr<engine::Engine>* engine = nullptr;
  /// Where the steps are written, before they happen. When that fails the replay ends with wrong_usage.
  std::shared_ptr<engine::LogWriter> log;
  /// The log as it is so far, to be gone on from, when it is not empty: its steps come first, neither reported nor
  /// verified, counted by `until` or written again, and its header is that of both. It has to be over the ring of the
  /// replay. What is torn off at its end is cut off, as a line in `notes` says.
  engine::LogReader* older_steps = nullptr;
  bool has_snapshots = false;     ///< beside the log, which is a file with that name
  engine::Observer observer;      ///< of the engine, if any
  ops::Header* header = nullptr;  ///< where that of the script goes, as soon as it has been read
  /// Where others take part, until somebody sets `stop`: the end of the script is not the end of the replay then. Their
  /// steps are counted, reported and written to the log as those of the script; what is refused is told them, and
  /// nobody else. Not with `verify`.
  SharedReplay* shared = nullptr;
  std::ostream* notes = nullptr;  ///< what is worth to know and no error, one line each
};

/// Replays a script into a fresh engine. Reports go to `reporter` (null: none), errors to `errors` (one line each),
/// progress to `progress` (null: none).
///
/// Over another ring than the header's, the Betti numbers and torsion of an `expect`, which are those over the
/// header's, are not checked, as a line in `notes` says; cells and Euler characteristic are.
Outcome replay(ScriptReader& script, const ReplayOptions& options, Reporter* reporter, std::ostream& errors,
               Progress* progress);

}  // namespace sesame::replay
