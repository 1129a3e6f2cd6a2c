/// \file
/// The file that keeps the steps of a replay: where it is, and what becomes of one that is there.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/durable/log_reader.hpp"
#include "engine/durable/log_writer.hpp"
#include "tools/commands/output_file.hpp"

namespace sesame::tools {

/// A log. Every step stands in it before it happens: see LogWriter.
///
/// A new log has its name from the first step on. One that is to replace an older one is a part file until the replay
/// has come to its end: when an error, a signal or a power cut comes first, both are there. A log has one writer.
class LogFile {
 public:
  /// What becomes of a log that is there already.
  enum class Old { is_refused, goes_on, is_replaced };

  /// "-" is standard output. Errors, io: those of find_place; there is a log, and it is refused; another process writes
  /// it.
  static Result<std::unique_ptr<LogFile>> open(const std::string& path, Old old, const engine::SyncPolicy& sync,
                                               const std::vector<std::string>& inputs, std::size_t longest_line);
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;
  ~LogFile();  ///< removes what it has made when nothing was written

  [[nodiscard]] const std::shared_ptr<engine::LogWriter>& writer() const { return writer_; }
  /// The older log to go on from, or null.
  [[nodiscard]] engine::LogReader* older() { return older_ ? &*older_ : nullptr; }
  /// Whether it has its name already, and is a file, so that snapshots may lie beside it.
  [[nodiscard]] bool has_place() const {
    return part_ == nullptr &&
           (place_.kind == OutputPlace::Kind::absent || place_.kind == OutputPlace::Kind::regular) &&
           !place_.path.empty();
  }
  /// To be called at the end; `is_whole`: the replay has come to its end, so that an older log is replaced.
  /// Errors, io: not everything could be written; an older log is as it was.
  Status close(bool is_whole);
  /// The name of the new log when it has not replaced the older one, or nothing.
  [[nodiscard]] std::string part() const;

 private:
  explicit LogFile(OutputPlace place) : place_{std::move(place)} {}
  Status open_file(Old old, const engine::SyncPolicy& sync, std::size_t longest_line);
  Status write_to(std::unique_ptr<engine::File> file, int error, const engine::SyncPolicy& sync);
  Status go_on(std::size_t longest_line);
  [[nodiscard]] std::uint64_t size() const;

  OutputPlace place_;
  std::unique_ptr<engine::File> replaced_;  ///< the older log, locked
  std::unique_ptr<PartFile> part_;
  std::shared_ptr<engine::LogWriter> writer_;
  std::optional<engine::LogReader> older_;
};

/// For a program that is about to end where no exception can pass: takes a step that has not been done out of the log
/// that is open, if there is one. Wants no memory.
void settle_log_at_sudden_end() noexcept;

}  // namespace sesame::tools
