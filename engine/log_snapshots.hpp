/// \file
/// Snapshots beside a log, so that it is opened again without doing all its steps again.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "engine/durable/log_reader.hpp"
#include "engine/durable/log_writer.hpp"
#include "engine/snapshot.hpp"
#include "sparse/result.hpp"

namespace sesame::engine {

/// Keeps `LOG.snapshot` beside a log that is being written. A snapshot is disposable: without one, or with one that
/// does not fit, opening takes longer, and that is all. So nothing here is an error. (An equivalence that is begun
/// afresh, as that of a snapshot is, has other representatives and another big complex, as after a rebase.)
///
/// It is written by a child process, which has the object as it was when it began, while steps go on here; and which
/// may run out of memory without any harm.
class LogSnapshots {
 public:
  LogSnapshots(std::shared_ptr<LogWriter> log, const ObjectTerms& terms) : log_{std::move(log)}, terms_{terms} {}
  LogSnapshots(const LogSnapshots&) = delete;
  LogSnapshots& operator=(const LogSnapshots&) = delete;
  ~LogSnapshots();  ///< waits for a child that is still writing

  /// The name of that of a log.
  [[nodiscard]] static std::string path_of(const std::string& log) { return log + ".snapshot"; }

  /// After a step, now and then: begins one when the last is old, as its cost goes, and there is memory for it.
  void now_and_then(const LiveObject& object);
  /// At the end of a session: writes one if reading it will save something.
  void at_end(const LiveObject& object);
  /// The steps that are in the snapshot that there is.
  void begin_with(std::uint64_t steps) { last_steps_ = steps; }

 private:
  using Clock = std::chrono::steady_clock;
  void begin(const LiveObject& object);
  void reap(bool waits);
  Status write(const LiveObject& object, const LogPosition& position) const;

  static constexpr std::uint64_t least_steps = 10'000;  ///< from one to the next
  static constexpr std::chrono::seconds least_time{5};

  std::shared_ptr<LogWriter> log_;
  ObjectTerms terms_;
  std::uint64_t last_steps_ = 0;           ///< of the last one
  Clock::time_point last_ = Clock::now();  ///< when it was begun
  Clock::duration took_ = {};              ///< to write it
  pid_t child_ = 0;                        ///< that is writing, or 0
  std::uint64_t steps_of_child_ = 0;
};

/// The object of the snapshot beside a log, with the reader behind the steps that it has; null when there is none, or
/// none that fits: then the reader is as it was. Requires: the header has been read.
/// Errors    those of the reader, when the log is damaged before the place of the snapshot.
Result<std::unique_ptr<LiveObject>> read_log_snapshot(const std::string& log, LogReader& reader,
                                                      const ObjectTerms& terms, const RebasePolicy& rebases);

}  // namespace sesame::engine
