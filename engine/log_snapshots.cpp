#include "engine/log_snapshots.hpp"

#include <fcntl.h>
#include <spdlog/logger.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>

#include "engine/log.hpp"
#include "engine/resources.hpp"

namespace sesame::engine {

LogSnapshots::~LogSnapshots() { reap(true); }

void LogSnapshots::reap(bool waits) {
  int status = 0;
  if (child_ == 0) {
    return;
  }
  pid_t ended = 0;
  do {
    ended = waitpid(child_, &status, waits ? 0 : WNOHANG);
  } while (ended < 0 && errno == EINTR);
  if (ended == 0) {
    return;
  }
  child_ = 0;
  took_ = Clock::now() - last_;
  if (ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    last_steps_ = steps_of_child_;
    step_log().info("a snapshot beside {} has the object after step {}", log_->name(), last_steps_);
  }
}

void LogSnapshots::now_and_then(const LiveObject& object) {
  constexpr int share = 10;  ///< of the time goes into snapshots, at most
  reap(false);
  const auto since = Clock::now() - last_;
  if (child_ == 0 && object.applied() >= last_steps_ + least_steps && since >= least_time && since >= share * took_) {
    begin(object);
  }
}

void LogSnapshots::at_end(const LiveObject& object) {
  reap(true);
  if (object.applied() >= last_steps_ + least_steps) {
    begin(object);
    reap(true);
  }
}

void LogSnapshots::begin(const LiveObject& object) {
  last_ = Clock::now();
  if (memory_available() < memory_in_use()) {
    return;  // the child has what is changed meanwhile a second time
  }
  const LogPosition position = log_->position();  // here: a lock that another thread has stays locked in the child
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGINT, SIG_IGN);  // which is meant for the session
    close_range(3, ~0U, 0);        // the log's lock among them
    if (const int nowhere = ::open("/dev/null", O_WRONLY); nowhere >= 0) {
      dup2(nowhere, STDERR_FILENO);
    }
    int status = 1;
    try {
      status = write(object, position) ? 0 : 1;
    } catch (...) {
    }
    _exit(status);
  }
  if (child > 0) {
    child_ = child;
    steps_of_child_ = object.applied();
  }
}

/// Into a file of its own, which takes the place of the older one when it is on the disk.
Status LogSnapshots::write(const LiveObject& object, const LogPosition& position) const {
  const std::string path = path_of(log_->name());
  const std::string part = path + ".part." + std::to_string(getpid());
  const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    return cannot_write_file(part, errno);
  }
  const std::unique_ptr<File> file = file_of(descriptor, true);
  Status written = write_snapshot(
      object, terms_, {object.applied(), position.bytes, position.chain}, [&](std::span<const char> bytes) -> Status {
        const Transfer went = file->append(bytes);
        return went.bytes == bytes.size() ? Status{Done{}} : cannot_write_file(part, went.error);
      });
  if (written) {
    if (const int error = file->sync(); error != 0) {
      written = cannot_write_file(part, error);
    }
  }
  if (written && std::rename(part.c_str(), path.c_str()) != 0) {
    written = cannot_write_file(path, errno);
  }
  if (!written) {
    std::remove(part.c_str());
  }
  return written;
}

Result<std::unique_ptr<LiveObject>> read_log_snapshot(const std::string& log, LogReader& reader,
                                                      const ObjectTerms& terms, const RebasePolicy& rebases) {
  const auto none = [&](const std::string& why) {
    step_log().info("{} is not used: {}", LogSnapshots::path_of(log), why);
    return std::unique_ptr<LiveObject>{};
  };
  int error = 0;
  const std::unique_ptr<File> file = real_disk().open(LogSnapshots::path_of(log), Disk::Mode::read, error);
  std::uint64_t size = 0;
  if (file == nullptr || file->size(size) != 0) {
    return std::unique_ptr<LiveObject>{};
  }
  Result<Snapshot> snapshot = read_snapshot(bytes_of(*file, LogSnapshots::path_of(log)), size, terms, rebases);
  if (!snapshot) {
    return none(snapshot.error().what);
  }
  const SnapshotMark& mark = snapshot->mark;
  const Result<bool> is_there = reader.skip_to(mark.log_bytes, mark.hash_of_bytes, mark.operations);
  if (!is_there) {
    return is_there.error();
  }
  if (!*is_there) {
    return none("it is of another log, or of this one when it was longer");
  }
  return std::move(snapshot->object);
}

}  // namespace sesame::engine
