#include "tools/commands/log_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <iostream>

namespace sesame::tools {
namespace {

using Kind = OutputPlace::Kind;

off_t size_of(int descriptor) {
  struct stat status {};
  fstat(descriptor, &status);
  return status.st_size;
}

}  // namespace

Result<std::unique_ptr<LogFile>> LogFile::open(const std::string& path, Old old,
                                               const std::vector<std::string>& inputs) {
  if (is_standard_output(path)) {
    std::unique_ptr<LogFile> log(new LogFile({}));
    log->stream_.rdbuf(std::cout.rdbuf());
    return log;
  }
  Result<OutputPlace> place = find_place(path, inputs);
  if (!place) {
    return place.error();
  }
  std::unique_ptr<LogFile> log(new LogFile(std::move(*place)));
  if (Status opened = log->open_file(old); !opened) {
    return opened.error();
  }
  log->stream_.rdbuf(log->buffer());
  return log;
}

Status LogFile::open_file(Old old) {
  if (place_.kind == Kind::absent) {
    return write_at_once(::open(place_.target.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666));
  }
  if (place_.kind != Kind::regular) {
    return write_at_once(::open(place_.path.c_str(), O_WRONLY | O_CLOEXEC));
  }
  if (old == Old::is_refused) {
    return Error{Errc::io, place_.path + " is there already; --append goes on from it, --overwrite replaces it"};
  }
  if (old == Old::goes_on) {
    return go_on();
  }
  Result<std::unique_ptr<PartFile>> part = PartFile::make(place_, {});
  if (!part) {
    return part.error();
  }
  part_ = std::move(*part);
  return Done{};
}

Status LogFile::write_at_once(int descriptor) {
  if (descriptor < 0) {
    return cannot_write(place_.path);
  }
  at_once_ = std::make_unique<FileBuffer>(descriptor);
  return Done{};
}

Status LogFile::go_on() {
  const int descriptor = ::open(place_.target.c_str(), O_RDWR | O_APPEND | O_CLOEXEC);
  if (Status opened = write_at_once(descriptor); !opened) {
    return opened;
  }
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {  // until it is closed
    return cannot_write(place_.path, "another replay goes on with it");
  }
  char first[2] = {};
  if (pread(descriptor, first, sizeof first, 0) == sizeof first && first[0] == '\x1F' && first[1] == '\x8B') {
    return cannot_write(place_.path, "it is packed by gzip; a log that is gone on from is plain text");
  }
  const off_t size = size_of(descriptor);
  goes_on_ = size > 0;
  char last = '\n';
  if (goes_on_ && pread(descriptor, &last, 1, size - 1) == 1 && last != '\n') {
    at_once_->sputc('\n');
  }
  return Done{};
}

Status LogFile::close(bool is_whole) {
  Status settled = Done{};
  if (buffer() != nullptr) {
    buffer()->drop();  // no line: a flush ends one
    settled = buffer()->settle();
  }
  if (!settled) {
    if (part_ != nullptr) {
      part_->remove();
    }
    return cannot_write(place_.path, settled.error().what);
  }
  if (part_ == nullptr || !is_whole) {
    return Done{};
  }
  Status replaced = part_->replace();
  if (replaced) {
    stream_.rdbuf(nullptr);
    part_.reset();
  }
  return replaced;
}

std::string LogFile::part() const {
  return part_ != nullptr && size_of(part_->buffer().descriptor()) > 0 ? part_->path().string() : "";
}

LogFile::~LogFile() {
  if (part_ != nullptr && part().empty()) {
    part_->remove();
  }
  if (place_.kind == Kind::absent && at_once_ != nullptr && size_of(at_once_->descriptor()) == 0) {
    unlink(place_.target.c_str());
  }
}

}  // namespace sesame::tools
