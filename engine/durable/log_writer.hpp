/// \file
/// Writing a log: each step before it is acknowledged, and on the disk as soon as the policy says.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "engine/durable/disk.hpp"
#include "engine/durable/log_format.hpp"
#include "engine/durable/step_log.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"

namespace sesame::engine {

/// When what is written is put where a power cut leaves it. A process that is killed loses nothing in any case.
struct SyncPolicy {
  /// As soon as so many bytes, or, while others are being written, a step that is so old, are not there yet. A step
  /// that makes it so many waits for it; what is due by its age is done beside the steps.
  std::uint64_t most_bytes = std::uint64_t{1} << 22;
  std::chrono::milliseconds longest = std::chrono::seconds{1};

  [[nodiscard]] static SyncPolicy always() { return {0, {}}; }
  [[nodiscard]] static SyncPolicy batch() { return {}; }
  /// The system does it when it likes to, and `close` at the end.
  [[nodiscard]] static SyncPolicy never() { return {UINT64_MAX, std::chrono::milliseconds::zero()}; }
  /// None is due by its age.
  [[nodiscard]] bool has_clock() const { return longest.count() > 0; }
};

/// Appends records to a file.
///
/// After an error the file ends with a whole record, or will before another is written: half a line is cut off as soon
/// as the disk lets it be. What may not have reached the disk when syncing it failed is written once more and synced
/// before the next step is taken: a second fsync alone would succeed for what the system has dropped. (With the policy
/// `never` there is no copy of it, and no further step is taken.) The error says up to which step the log is safe.
/// Until then each further step is refused, with an error.
///
/// Its functions may be called from any thread, one at a time.
class LogWriter final : public StepLog {
 public:
  /// The file has been opened for writing, and locked if it is to be. `name`: for messages.
  LogWriter(std::unique_ptr<File> file, std::string name, const SyncPolicy& policy);
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;
  ~LogWriter() override;  ///< closes; errors are lost

  /// Writes the header of a new log, into an empty file, and waits until it is on the disk, whatever the policy is.
  /// Errors: io.
  Status begin(const ops::Header& header);
  /// Goes on behind a place, of an older log; what comes behind it is cut off. Errors: io.
  Status go_on(const LogPosition& place);

  Status append(const ops::Operation& operation) override;
  void confirm() noexcept override { before_.reset(); }
  Status take_back() override;
  [[nodiscard]] bool can_be_read_back() const override { return file_->is_readable(); }
  /// Reads the file.
  Status read_back(const std::function<Status(ops::Operation)>& accept) override;
  /// Writes a line that binds the steps until here, unless there is one behind the last of them. After an error that
  /// was told, nothing is written unless it `syncs`.
  Status bind(std::uint64_t state, bool syncs) override;
  /// Puts everything on the disk, and takes no more. Errors: io.
  Status close();
  /// For a program that is about to end where no exception can pass: takes the operation out of the file that was
  /// appended last, if it has not been confirmed. Wants neither memory nor a lock.
  void end_suddenly() noexcept;

  /// Behind the last record.
  [[nodiscard]] LogPosition position() const;
  /// The last step that is known to be on the disk.
  [[nodiscard]] std::uint64_t synced_steps() const;
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] File& file() { return *file_; }

 private:
  using Lock = std::unique_lock<std::mutex>;

  Status write(Lock& lock, std::string_view line, const LogPosition& behind);
  void drop_last();
  [[nodiscard]] bool keeps_unsynced() const { return policy_.most_bytes != UINT64_MAX; }
  void wait_for_clock(Lock& lock) {
    wakes_writer_.wait(lock, [this] { return !is_syncing_; });
  }
  Status sync(Lock& lock);
  Status mend(Lock& lock);
  [[nodiscard]] Error failed(int error) const;
  void sync_by_the_clock();

  std::unique_ptr<File> file_;
  const std::string name_;
  const SyncPolicy policy_;

  mutable std::mutex mutex_;
  std::condition_variable wakes_clock_, wakes_writer_;
  LogPosition written_;                ///< behind the last whole record
  LogPosition synced_;                 ///< on the disk, for sure
  std::optional<LogPosition> before_;  ///< the record appended last, while it can be taken back; the clock's thread
                                       ///< does not look at it
  std::string unsynced_;               ///< the bytes between, unless they are never synced
  std::chrono::steady_clock::time_point oldest_unsynced_;
  std::uint64_t generation_ = 0;  ///< how often something was taken back: what is synced meanwhile does not count
  bool is_syncing_ = false;       ///< the clock's thread
  bool has_half_a_line_ = false;  ///< behind what is written
  bool has_lost_sync_ = false;    ///< it failed: what is unsynced may be gone
  int error_ = 0;                 ///< met by the clock's thread, and not yet told
  bool is_closed_ = false;
  std::thread clock_;
};

}  // namespace sesame::engine
