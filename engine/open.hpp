/// \file
/// An engine that goes on from a durable log: every step that was acknowledged, and nothing else.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "engine/durable/disk.hpp"
#include "engine/durable/log_reader.hpp"
#include "engine/durable/log_writer.hpp"
#include "engine/engine.hpp"
#include "engine/log_snapshots.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"

namespace sesame::engine {

struct OpenOptions {
  ops::Header header;  ///< of a log that is not there yet, or empty; another one has its own
  SyncPolicy sync = SyncPolicy::batch();
  ops::Limits limits = {};
  RebasePolicy rebases = {};
  HistoryPolicy history = {UINT64_MAX, false};  ///< the operations are in the file
  Resources resources = {};
  Disk* disk = &real_disk();
  bool has_snapshots = true;  ///< if the disk is the real one: see LogSnapshots
};

/// Threads: one at a time, for queries too.
struct OpenedLog {
  std::unique_ptr<Engine> engine;  ///< which writes to the log
  std::shared_ptr<LogWriter> log;
  ops::Header header;
  std::uint64_t steps = 0;  ///< that were in it
  std::uint64_t torn = 0;   ///< bytes at its end that were no whole record, and are cut off
};

/// Whether the answers of an engine are those that a line binds. Errors: law_broken.
Status check_binding(Engine& engine, const Binding& binding);

/// Has an engine on which no step has been applied go on with what the snapshot beside a log says, if there is one that
/// fits; the reader is behind its steps then. Returns the snapshots to be kept beside the log.
/// Requires: the header has been read. Errors: those of the reader.
Result<std::unique_ptr<LogSnapshots>> resume_from_snapshot(Engine& engine, LogReader& reader,
                                                           std::shared_ptr<LogWriter> log, const ObjectTerms& terms,
                                                           const RebasePolicy& rebases);

/// Applies the steps of a log from where its reader is, and checks the answers that it is bound to. `goes_on` is called
/// after each; when it says no, the rest is left.
/// Errors    io; bad_input when there is damage; law_broken when an answer differs; those of the steps.
Status take_steps(Engine& engine, LogReader& reader, const std::function<bool()>& goes_on);

}  // namespace sesame::engine
