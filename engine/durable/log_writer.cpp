#include "engine/durable/log_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "engine/durable/log_reader.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {

LogWriter::LogWriter(std::unique_ptr<File> file, std::string name, const SyncPolicy& policy)
    : file_{std::move(file)}, name_{std::move(name)}, policy_{policy} {
  if (policy_.has_clock()) {
    try {
      clock_ = std::thread([this] { sync_by_the_clock(); });
    } catch (const std::system_error&) {  // no more threads: then a step waits for what is due by its age
    }
  }
}

LogWriter::~LogWriter() {
  (void)close();
  if (clock_.joinable()) {
    clock_.join();
  }
}

LogPosition LogWriter::position() const {
  const Lock lock(mutex_);
  return written_;
}

std::uint64_t LogWriter::synced_steps() const {
  const Lock lock(mutex_);
  return synced_.steps();
}

Error LogWriter::failed(int error) const {
  const std::uint64_t safe = synced_.steps();
  const std::uint64_t written = written_.steps();
  Error cannot = cannot_write_file(name_, error);
  cannot.what +=
      safe == written || has_lost_sync_
          ? fmt::format("; the last step that is safe in it is step {}", safe)
          : fmt::format("; it has all steps up to step {}, those up to step {} safe from a power cut", written, safe);
  return cannot;
}

// --------------------------------------------------------------------------------------------------- what is written

Status LogWriter::begin(const ops::Header& header) {
  Lock lock(mutex_);
  LogPosition behind = written_;
  const std::string line = record_line(ops::to_text(header), 0, behind);
  Status begun = write(lock, line, behind);
  if (begun) {
    begun = sync(lock);
  }
  return begun;
}

Status LogWriter::go_on(const LogPosition& place) {
  Lock lock(mutex_);
  std::uint64_t size = 0;
  int error = file_->size(size);
  if (error == 0 && size > place.bytes) {
    error = file_->truncate(place.bytes);
  }
  written_ = synced_ = place;
  if (error == 0 && size + 1 == place.bytes) {  // a script whose last line has no end
    error = file_->append(std::string_view{"\n"}).error;
  }
  if (error == 0) {
    error = file_->sync();  // of all that comes before, records say from now on that the disk has it
  }
  return error == 0 ? Status{Done{}} : cannot_write_file(name_, error);
}

Status LogWriter::append(const ops::Operation& operation) {
  Lock lock(mutex_);
  before_.reset();  // nothing is to be taken back if this is cut off
  sparse::expects(!is_closed_, "a log that is closed takes no more steps");
  if (const int error = std::exchange(error_, 0); error != 0) {
    return failed(error);
  }
  if (Status mended = mend(lock); !mended) {
    return mended;
  }
  LogPosition behind = written_;
  const std::string line = record_line(ops::to_text(operation), synced_.steps(), behind);
  const LogPosition before = written_;
  Status written = write(lock, line, behind);
  if (!written) {
    return written;
  }
  before_ = before;
  const bool is_due_by_age = policy_.has_clock() && !clock_.joinable() &&
                             std::chrono::steady_clock::now() - oldest_unsynced_ >= policy_.longest;
  if (written_.bytes - synced_.bytes > policy_.most_bytes || is_due_by_age) {
    written = sync(lock);
    if (!written) {  // so the step does not happen, and must not stand there
      drop_last();
      has_half_a_line_ = file_->truncate(written_.bytes) != 0;
    }
  }
  return written;
}

/// Forgets the record that was appended last.
void LogWriter::drop_last() {
  ++generation_;
  const std::uint64_t size = written_.bytes - before_->bytes;
  unsynced_.resize(unsynced_.size() - std::min<std::size_t>(unsynced_.size(), size));
  written_ = *before_;
  before_.reset();
}

/// A line with its end; `behind` is where the log goes on then.
Status LogWriter::write(Lock& /*lock*/, std::string_view line, const LogPosition& behind) {
  const bool is_kept = keeps_unsynced();
  if (is_kept) {
    unsynced_.append(line);  // before anything is written, as memory may run out
  }
  const Transfer went = file_->append(line);
  if (went.bytes < line.size()) {
    if (is_kept) {
      unsynced_.resize(unsynced_.size() - line.size());
    }
    has_half_a_line_ = went.bytes > 0 && file_->truncate(written_.bytes) != 0;
    return failed(went.error);
  }
  if (written_.bytes == synced_.bytes) {
    oldest_unsynced_ = std::chrono::steady_clock::now();
    wakes_clock_.notify_one();
  }
  written_ = behind;
  return Done{};
}

Status LogWriter::take_back() {
  Lock lock(mutex_);
  if (!before_) {
    return Done{};
  }
  wait_for_clock(lock);
  const bool was_synced = synced_.bytes > before_->bytes;
  drop_last();
  if (was_synced) {
    synced_ = written_;
  }
  int error = file_->truncate(written_.bytes);
  if (error == 0 && was_synced) {
    error = file_->sync();
    has_lost_sync_ = has_lost_sync_ || error != 0;  // a power cut could bring it back
  }
  has_half_a_line_ = error != 0;
  return error == 0 ? Status{Done{}} : failed(error);
}

Status LogWriter::bind(std::uint64_t state, bool syncs) {
  Lock lock(mutex_);
  if (syncs) {
    error_ = 0;
    if (Status mended = mend(lock); !mended) {
      return mended;
    }
    if (Status synced = sync(lock); !synced) {
      return synced;
    }
  }
  const bool is_wrong = error_ != 0 || has_half_a_line_ || has_lost_sync_;  // which is told where a step is
  if (is_wrong || written_.is_bound) {
    return Done{};
  }
  LogPosition behind = written_;
  const std::string line = binding_line({written_.steps(), synced_.steps(), state}, behind);
  before_.reset();
  return write(lock, line, behind);
}

Status LogWriter::read_back(const std::function<Status(ops::Operation)>& accept) {
  return read_steps(*file_, name_, position().steps(), accept);
}

// ---------------------------------------------------------------------------------------------- what is on the disk

/// All that is written, now.
Status LogWriter::sync(Lock& lock) {
  wait_for_clock(lock);
  if (has_lost_sync_) {  // by the clock, while this waited: it would succeed now, and mean nothing
    return failed(error_ != 0 ? std::exchange(error_, 0) : EIO);
  }
  if (synced_.bytes == written_.bytes) {
    return Done{};
  }
  if (const int error = file_->sync(); error != 0) {
    has_lost_sync_ = true;
    return failed(error);
  }
  synced_ = written_;
  unsynced_.clear();
  return Done{};
}

/// After an error: the file is made what it should be.
Status LogWriter::mend(Lock& lock) {
  wait_for_clock(lock);
  if (!has_half_a_line_ && !has_lost_sync_) {
    return Done{};
  }
  ++generation_;
  if (has_lost_sync_ && !keeps_unsynced()) {
    return failed(EIO);
  }
  if (has_half_a_line_) {
    if (const int error = file_->truncate(written_.bytes); error != 0) {
      return failed(error);
    }
  }
  has_half_a_line_ = false;
  if (has_lost_sync_) {
    int error = file_->rewrite(synced_.bytes, unsynced_);
    error = error != 0 ? error : file_->sync();
    if (error != 0) {
      return failed(error);
    }
    synced_ = written_;
    unsynced_.clear();
    has_lost_sync_ = false;
  }
  return Done{};
}

void LogWriter::sync_by_the_clock() {
  Lock lock(mutex_);
  while (!is_closed_) {
    const bool is_owed = synced_.bytes < written_.bytes && !has_lost_sync_;
    if (!is_owed) {
      wakes_clock_.wait(lock);
      continue;
    }
    if (const auto due = oldest_unsynced_ + policy_.longest; std::chrono::steady_clock::now() < due) {
      wakes_clock_.wait_until(lock, due);
      continue;
    }
    const LogPosition until = written_;
    const std::uint64_t generation = generation_;
    const auto start = std::chrono::steady_clock::now();
    is_syncing_ = true;
    lock.unlock();
    const int error = file_->sync();
    lock.lock();
    is_syncing_ = false;
    wakes_writer_.notify_all();
    if (error != 0) {
      has_lost_sync_ = true;
      error_ = error;
    } else if (generation == generation_) {
      unsynced_.erase(0, until.bytes - synced_.bytes);
      synced_ = until;
      oldest_unsynced_ = start;
    }
  }
}

void LogWriter::end_suddenly() noexcept {
  if (before_) {
    (void)file_->truncate(before_->bytes);
  }
}

Status LogWriter::close() {
  Lock lock(mutex_);
  if (is_closed_) {
    return Done{};
  }
  before_.reset();
  wait_for_clock(lock);
  error_ = 0;
  Status closed = mend(lock);
  if (closed) {
    closed = sync(lock);
  }
  is_closed_ = true;
  wakes_clock_.notify_one();
  return closed;
}

}  // namespace sesame::engine
