#include "tools/commands/log_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <iostream>

namespace sesame::tools {
namespace {

using Kind = OutputPlace::Kind;
using Mode = engine::Disk::Mode;

/// Standard output, of which others write too.
class StandardOutput final : public engine::File {
 public:
  engine::Transfer append(std::span<const char> bytes) override {
    std::cout << std::flush;  // what others wrote comes first
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t went = ::write(STDOUT_FILENO, bytes.data() + done, bytes.size() - done);
      if (went < 0 && errno != EINTR) {
        return {done, errno};
      }
      done += went > 0 ? static_cast<std::size_t>(went) : 0;
    }
    return {done, 0};
  }
  engine::Transfer read(std::uint64_t /*from*/, std::span<char> /*to*/) override { return {0, ESPIPE}; }
  int sync() override { return 0; }
  int truncate(std::uint64_t /*size*/) override { return ESPIPE; }
  int rewrite(std::uint64_t /*from*/, std::span<const char> /*bytes*/) override { return ESPIPE; }
  bool is_at(const std::string& /*path*/) override { return true; }
  [[nodiscard]] bool is_readable() const override { return false; }
  int size(std::uint64_t& bytes) override {
    bytes = 0;
    return 0;
  }
  bool lock() override { return true; }
  std::int64_t holder() override { return 0; }
};

/// The one whose last step the program has not done when it ends all of a sudden.
std::atomic<engine::LogWriter*> log_of_sudden_end = nullptr;

}  // namespace

void settle_log_at_sudden_end() noexcept {
  if (engine::LogWriter* log = log_of_sudden_end) {
    log->end_suddenly();
  }
}

Result<std::unique_ptr<LogFile>> LogFile::open(const std::string& path, Old old, const engine::SyncPolicy& sync,
                                               const std::vector<std::string>& inputs, std::size_t longest_line) {
  if (is_standard_output(path)) {
    std::unique_ptr<LogFile> log(new LogFile({}));
    log->writer_ = std::make_shared<engine::LogWriter>(std::make_unique<StandardOutput>(), "standard output",
                                                       engine::SyncPolicy::never());
    return log;
  }
  Result<OutputPlace> place = find_place(path, inputs);
  if (!place) {
    return place.error();
  }
  std::unique_ptr<LogFile> log(new LogFile(std::move(*place)));
  if (Status opened = log->open_file(old, sync, longest_line); !opened) {
    return opened.error();
  }
  return log;
}

Status LogFile::open_file(Old old, const engine::SyncPolicy& sync, std::size_t longest_line) {
  int error = 0;
  if (place_.kind == Kind::absent) {
    std::unique_ptr<engine::File> file = engine::real_disk().open(place_.target, Mode::create, error);
    Status opened = write_to(std::move(file), error, sync);
    if (opened) {
      settle_folder_of(place_.target);
    }
    return opened;
  }
  if (place_.kind != Kind::regular) {
    const int descriptor = ::open(place_.path.c_str(), O_WRONLY | O_CLOEXEC);
    error = errno;
    return write_to(descriptor < 0 ? nullptr : engine::file_of(descriptor, true), error, sync);
  }
  if (old == Old::is_refused) {
    return Error{Errc::io, place_.path + " is there already; --append goes on from it, --overwrite replaces it"};
  }
  std::unique_ptr<engine::File> file = engine::real_disk().open(place_.target, Mode::write, error);
  if (old == Old::goes_on) {
    Status opened = write_to(std::move(file), error, sync);
    return opened ? go_on(longest_line) : opened;
  }
  if (file != nullptr) {
    replaced_ = std::move(file);
    if (Status locked = engine::lock_log(*replaced_, place_.path); !locked) {
      return locked;
    }
  }
  Result<std::unique_ptr<PartFile>> part = PartFile::make(place_, {});
  if (!part) {
    return part.error();
  }
  part_ = std::move(*part);
  return write_to(engine::file_of(part_->buffer().descriptor(), false), 0, sync);
}

Status LogFile::write_to(std::unique_ptr<engine::File> file, int error, const engine::SyncPolicy& sync) {
  if (file == nullptr) {
    return cannot_write(place_.path, std::strerror(error));
  }
  if (place_.kind == Kind::absent || (place_.kind == Kind::regular && part_ == nullptr)) {
    if (Status locked = engine::lock_log(*file, place_.path); !locked) {
      return locked;
    }
  }
  writer_ = std::make_shared<engine::LogWriter>(std::move(file), place_.path, sync);
  log_of_sudden_end = writer_.get();
  return Done{};
}

Status LogFile::go_on(std::size_t longest_line) {
  std::array<char, 2> first{};
  if (writer_->file().read(0, first).bytes == first.size() && first[0] == '\x1F' && first[1] == '\x8B') {
    return cannot_write(place_.path, "it is packed by gzip; a log that is gone on from is plain text");
  }
  older_.emplace(place_.path, writer_->file(), longest_line);
  return Done{};
}

Status LogFile::close(bool is_whole) {
  log_of_sudden_end = nullptr;
  if (const Status closed = writer_->close(); !closed) {
    if (part_ != nullptr) {
      part_->remove();
    }
    return closed;
  }
  if (part_ == nullptr || !is_whole) {
    return Done{};
  }
  Status replaced = part_->replace();
  if (replaced) {
    writer_.reset();
    part_.reset();
  }
  return replaced;
}

std::uint64_t LogFile::size() const {
  std::uint64_t bytes = 0;
  return writer_ != nullptr && writer_->file().size(bytes) == 0 ? bytes : 0;
}

std::string LogFile::part() const { return part_ != nullptr && size() > 0 ? part_->path().string() : ""; }

LogFile::~LogFile() {
  log_of_sudden_end = nullptr;
  if (writer_ != nullptr) {
    (void)writer_->close();
  }
  if (part_ != nullptr && part().empty()) {
    part_->remove();
  }
  if (place_.kind == Kind::absent && writer_ != nullptr && size() == 0) {
    unlink(place_.target.c_str());
  }
}

}  // namespace sesame::tools
