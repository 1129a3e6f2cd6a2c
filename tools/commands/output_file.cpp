#include "tools/commands/output_file.hpp"

#include <fcntl.h>
#include <spdlog/logger.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <optional>

#include "engine/durable/disk.hpp"
#include "tools/commands/interrupt.hpp"
#include "tools/commands/program_log.hpp"

namespace sesame::tools {
namespace {

namespace fs = std::filesystem;
using FileStatus = struct stat;

constexpr const char* another_name = "; give the output another name";

std::optional<FileStatus> status_of(const fs::path& path) {
  FileStatus status{};
  return stat(path.c_str(), &status) == 0 ? std::optional{status} : std::nullopt;
}

std::optional<FileStatus> status_of(int descriptor) {
  FileStatus status{};
  return fstat(descriptor, &status) == 0 ? std::optional{status} : std::nullopt;
}

bool is_same(const FileStatus& one, const std::optional<FileStatus>& other) {
  return other && one.st_dev == other->st_dev && one.st_ino == other->st_ino;
}

/// Which part a file plays already, for which it must not be written; or nothing.
std::optional<std::string> role_of(const FileStatus& file, const std::vector<std::string>& inputs) {
  struct Stream {
    int descriptor;
    const char* role;
  };
  constexpr std::array<Stream, 3> streams{{{STDIN_FILENO, "is the input, where standard input comes from"},
                                           {STDOUT_FILENO, "is where standard output goes"},
                                           {STDERR_FILENO, "is where standard error goes"}}};
  for (const std::string& input : inputs) {
    if (is_same(file, status_of(fs::path{input}))) {
      return "is the input";
    }
  }
  for (const Stream& stream : streams) {
    if (is_same(file, status_of(stream.descriptor))) {
      return stream.role;
    }
  }
  return std::nullopt;
}

}  // namespace

// ------------------------------------------------------------------------------------------------------------- places

bool is_standard_output(const std::string& path) { return path == "-" || path == "/dev/stdout"; }

void settle_folder_of(const fs::path& file) {
  if (const int error = engine::real_disk().sync_folder_of(file); error != 0) {
    tools_log().warn("{} is written, but a power cut may still take its name away: its folder cannot be synced: {}",
                     file.string(), std::strerror(error));
  }
}

Error cannot_write(const std::string& path, const std::string& reason) {
  return {Errc::io, "cannot write " + path + ": " + (reason.empty() ? std::strerror(errno) : reason)};
}

Result<OutputPlace> find_place(const std::string& path, const std::vector<std::string>& inputs) {
  OutputPlace place;
  place.path = path;
  std::error_code failed;
  if (const std::optional<FileStatus> found = status_of(fs::path{path})) {
    if (S_ISDIR(found->st_mode)) {
      return cannot_write(path, "it is a folder");
    }
    place.kind = S_ISREG(found->st_mode)   ? OutputPlace::Kind::regular
                 : S_ISCHR(found->st_mode) ? OutputPlace::Kind::device
                                           : OutputPlace::Kind::other;
    place.identity = {found->st_dev, found->st_ino, ""};
    place.target = fs::canonical(path, failed);
    if (const auto role = role_of(*found, inputs); role && place.kind == OutputPlace::Kind::regular) {
      return Error{Errc::io, path + " " + *role + another_name};
    }
    if (access(path.c_str(), W_OK) != 0) {
      return cannot_write(path);
    }
    return place;
  }
  if (fs::is_symlink(path, failed)) {
    return cannot_write(path, "it is a link to nothing");
  }
  const fs::path absolute = fs::absolute(path, failed);
  const std::optional<FileStatus> folder = status_of(absolute.parent_path());
  if (!folder) {
    return cannot_write(path);
  }
  place.target = fs::canonical(absolute.parent_path(), failed) / absolute.filename();
  place.identity = {folder->st_dev, folder->st_ino, absolute.filename().string()};
  return place;
}

// ---------------------------------------------------------------------------------------------------------- part files

Result<std::unique_ptr<PartFile>> PartFile::make(const OutputPlace& place, const std::vector<fs::path>& reserved) {
  for (int k = 1;; ++k) {
    fs::path path = place.target;
    path += k == 1 ? ".part" : "." + std::to_string(k) + ".part";
    if (std::find(reserved.begin(), reserved.end(), path) != reserved.end()) {
      continue;
    }
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      tools_log().debug("{} is {} until it is whole", place.path, path.string());
      return std::make_unique<PartFile>(place, std::move(path), descriptor);
    }
    if (errno != EEXIST) {
      return cannot_write(place.path);
    }
  }
}

PartFile::PartFile(OutputPlace place, fs::path path, int descriptor)
    : place_{std::move(place)}, path_{std::move(path)}, buffer_{descriptor} {
  if (const std::optional<FileStatus> old = status_of(place_.target)) {
    (void)!fchown(descriptor, old->st_uid, old->st_gid);  // only the superuser can give files away
    fchmod(descriptor, old->st_mode & 07777);
  }
}

Status PartFile::replace() {
  if (rename(path_.c_str(), place_.target.c_str()) != 0) {
    return cannot_write(place_.path);
  }
  settle_folder_of(place_.target);
  tools_log().info("{} is written", place_.path);
  return Done{};
}

void PartFile::remove() {
  std::error_code ignored;  // there is nobody to tell
  fs::remove(path_, ignored);
}

// ------------------------------------------------------------------------------------------------------------- outputs

/// An output with its stream: a part file, or what is written at once.
class OutputFiles::File {
 public:
  File(OutputPlace place, std::unique_ptr<PartFile> part)
      : place_{std::move(place)}, part_{std::move(part)}, removed_{part_->path().string()}, stream_{&part_->buffer()} {}
  File(OutputPlace place, int descriptor)
      : place_{std::move(place)}, direct_{std::make_unique<FileBuffer>(descriptor)}, stream_{direct_.get()} {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (part_ != nullptr) {
      part_->remove();
    }
  }

  [[nodiscard]] const OutputPlace& place() const { return place_; }
  [[nodiscard]] std::ostream& stream() { return stream_; }
  [[nodiscard]] bool is(const OutputPlace& other) const {
    if (other.kind == OutputPlace::Kind::device) {
      return false;
    }
    const std::optional<FileStatus> own = part_ == nullptr ? std::nullopt : status_of(part_->buffer().descriptor());
    const bool is_part = own && other.identity == std::tuple{own->st_dev, own->st_ino, std::string{}};
    return is_part || other.identity == place_.identity;
  }

  Status settle() {
    const Status settled = (part_ != nullptr ? part_->buffer() : *direct_).settle();
    return settled ? settled : cannot_write(place_.path, settled.error().what);
  }
  Status replace() {
    if (part_ == nullptr) {
      return Done{};
    }
    Status replaced = part_->replace();
    if (replaced) {
      removed_.reset();
      stream_.rdbuf(nullptr);
      part_.reset();
    }
    return replaced;
  }

 private:
  OutputPlace place_;
  std::unique_ptr<PartFile> part_;
  std::unique_ptr<FileBuffer> direct_;
  std::optional<RemovedBySignals> removed_;
  std::ostream stream_;
};

OutputFiles::OutputFiles(std::vector<std::string> inputs) : inputs_{std::move(inputs)} {}

OutputFiles::~OutputFiles() = default;

bool OutputFiles::is_open_already(const OutputPlace& place) const {
  return std::any_of(files_.begin(), files_.end(), [&](const auto& file) { return file->is(place); });
}

Result<std::ostream*> OutputFiles::open(const std::string& path) {
  const Error twice{Errc::io, "two outputs are one file, " + path + "; give each a name of its own"};
  if (path.empty()) {
    return nullptr;
  }
  if (is_standard_output(path)) {
    if (std::exchange(has_standard_output_, true)) {
      return twice;
    }
    return &std::cout;
  }
  const Result<OutputPlace> place = find_place(path, inputs_);
  if (!place) {
    return place.error();
  }
  if (is_open_already(*place)) {
    return twice;
  }
  if (place->kind == OutputPlace::Kind::absent || place->kind == OutputPlace::Kind::regular) {
    std::vector<fs::path> reserved;
    for (const auto& file : files_) {
      reserved.push_back(file->place().target);
    }
    const HeldSignals held;  // until the file is one of those that a signal removes
    Result<std::unique_ptr<PartFile>> part = PartFile::make(*place, reserved);
    if (!part) {
      return part.error();
    }
    files_.push_back(std::make_unique<File>(*place, std::move(*part)));
  } else {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) {
      return cannot_write(path);
    }
    files_.push_back(std::make_unique<File>(*place, descriptor));
  }
  return &files_.back()->stream();
}

Status OutputFiles::commit() {
  for (const auto& file : files_) {
    if (Status settled = file->settle(); !settled) {
      return settled;
    }
  }
  for (const auto& file : files_) {
    if (Status replaced = file->replace(); !replaced) {
      return replaced;
    }
  }
  return Done{};
}

}  // namespace sesame::tools
