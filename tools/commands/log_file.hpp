/// \file
/// The file that keeps the steps of a replay as they happen.
#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "tools/commands/output_file.hpp"

namespace sesame::tools {

/// A log. Every step stands in it as soon as it has happened: a flush of the stream ends a line, and a line that cannot
/// be written whole is taken back.
///
/// A new log has its name from the first step on. One that is to replace an older one is a part file until the replay
/// has come to its end: when an error, a signal or a power cut comes first, both are there.
class LogFile {
 public:
  /// What becomes of a log that is there already.
  enum class Old { is_refused, goes_on, is_replaced };

  /// "-" is standard output. Errors, io: those of find_place; there is a log, and it is refused; another replay goes on
  /// with it.
  static Result<std::unique_ptr<LogFile>> open(const std::string& path, Old old,
                                               const std::vector<std::string>& inputs);
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;
  ~LogFile();  ///< removes what it has made when nothing was written

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Whether there is an older log to go on from: its steps come first, and its header is the one that counts.
  [[nodiscard]] bool goes_on() const { return goes_on_; }
  /// To be called at the end; `is_whole`: the replay has come to its end, so that an older log is replaced.
  /// Errors, io: not everything could be written; an older log is as it was.
  Status close(bool is_whole);
  /// The name of the new log when it has not replaced the older one, or nothing.
  [[nodiscard]] std::string part() const;

 private:
  explicit LogFile(OutputPlace place) : place_{std::move(place)}, stream_{nullptr} {}
  Status open_file(Old old);
  Status go_on();
  Status write_at_once(int descriptor);
  [[nodiscard]] FileBuffer* buffer() const { return part_ != nullptr ? &part_->buffer() : at_once_.get(); }

  OutputPlace place_;
  std::unique_ptr<PartFile> part_;
  std::unique_ptr<FileBuffer> at_once_;
  bool goes_on_ = false;
  std::ostream stream_;
};

}  // namespace sesame::tools
