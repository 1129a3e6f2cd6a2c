#include "engine/durable/disk.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace sesame::engine {
namespace {

using FileStatus = struct stat;

FileStatus status_of(int descriptor) {
  FileStatus status{};
  fstat(descriptor, &status);
  return status;
}

class RealFile final : public File {
 public:
  RealFile(int descriptor, bool is_owned)
      : descriptor_{descriptor}, is_owned_{is_owned}, is_regular_{S_ISREG(status_of(descriptor).st_mode)} {
    end_ = is_regular_ ? status_of(descriptor).st_size : 0;
  }
  RealFile(const RealFile&) = delete;
  RealFile& operator=(const RealFile&) = delete;
  ~RealFile() override {
    if (is_owned_) {
      ::close(descriptor_);
    }
  }

  Transfer append(std::span<const char> bytes) override {
    const Transfer went = transfer(bytes.size(), [&](std::size_t done) {
      const char* const from = bytes.data() + done;
      const std::size_t left = bytes.size() - done;
      return is_regular_ ? ::pwrite(descriptor_, from, left, end_ + static_cast<off_t>(done))
                         : ::write(descriptor_, from, left);
    });
    end_ += static_cast<off_t>(went.bytes);
    return went;
  }
  Transfer read(std::uint64_t from, std::span<char> to) override {
    return transfer(to.size(), [&](std::size_t done) {
      return ::pread(descriptor_, to.data() + done, to.size() - done, static_cast<off_t>(from + done));
    });
  }
  int sync() override {
    while (is_regular_ && fdatasync(descriptor_) != 0) {  // which writes the size too
      if (errno != EINTR) {
        return errno;
      }
    }
    return 0;
  }
  int truncate(std::uint64_t size) override {
    if (!is_regular_) {
      return ESPIPE;
    }
    while (ftruncate(descriptor_, static_cast<off_t>(size)) != 0) {
      if (errno != EINTR) {
        return errno;
      }
    }
    end_ = static_cast<off_t>(size);
    return 0;
  }
  int rewrite(std::uint64_t from, std::span<const char> bytes) override {
    const Transfer went = transfer(bytes.size(), [&](std::size_t done) {
      return ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(from + done));
    });
    return went.error;
  }
  bool is_at(const std::string& path) override {
    FileStatus named{};
    const FileStatus own = status_of(descriptor_);
    return stat(path.c_str(), &named) == 0 && named.st_dev == own.st_dev && named.st_ino == own.st_ino;
  }
  [[nodiscard]] bool is_readable() const override {
    const int flags = fcntl(descriptor_, F_GETFL);
    return is_regular_ && flags >= 0 && (flags & O_ACCMODE) != O_WRONLY;
  }
  int size(std::uint64_t& bytes) override {
    FileStatus status{};
    if (fstat(descriptor_, &status) != 0) {
      return errno;
    }
    bytes = static_cast<std::uint64_t>(status.st_size);
    return 0;
  }
  bool lock() override { return flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }
  std::int64_t holder() override;

 private:
  /// Goes on until all is done, nothing more comes, or an error.
  template <class Step>
  static Transfer transfer(std::size_t bytes, Step&& step) {
    Transfer done;
    while (done.bytes < bytes && done.error == 0) {
      const ssize_t went = step(done.bytes);
      if (went > 0) {
        done.bytes += static_cast<std::size_t>(went);
      } else if (went == 0) {
        break;
      } else if (errno != EINTR) {
        done.error = errno;
      }
    }
    return done;
  }

  int descriptor_;
  bool is_owned_, is_regular_;
  off_t end_ = 0;  ///< where a regular file ends, which nobody else appends to
};

/// Linux lists locks: `1: FLOCK  ADVISORY  WRITE 3323 fe:00:10954116 0 EOF`.
std::int64_t RealFile::holder() {
  const ino_t inode = status_of(descriptor_).st_ino;
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, mode, access, device;
    std::int64_t process = 0;
    if (words >> number >> kind >> mode >> access >> process >> device && kind == "FLOCK" &&
        device.ends_with(":" + std::to_string(inode))) {
      return process;
    }
  }
  return 0;
}

class RealDisk final : public Disk {
 public:
  std::unique_ptr<File> open(const std::string& path, Mode mode, int& error) override {
    const int flags = mode == Mode::read ? O_RDONLY : mode == Mode::write ? O_RDWR : O_RDWR | O_CREAT | O_EXCL;
    const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
    error = descriptor < 0 ? errno : 0;
    return descriptor < 0 ? nullptr : std::make_unique<RealFile>(descriptor, true);
  }
  int rename(const std::string& from, const std::string& to) override {
    return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
  }
  int remove(const std::string& path) override { return std::remove(path.c_str()) == 0 ? 0 : errno; }
  int sync_folder_of(const std::string& path) override {
    const std::filesystem::path folder = std::filesystem::path{path}.parent_path();
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) {
      return errno;
    }
    const int error = fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;  // which is for folders that need none
    ::close(descriptor);
    return error;
  }
};

}  // namespace

Disk& real_disk() {
  static RealDisk disk;
  return disk;
}

std::unique_ptr<File> file_of(int descriptor, bool is_owned) {
  return std::make_unique<RealFile>(descriptor, is_owned);
}

Status lock_log(File& file, const std::string& path) {
  if (!file.lock()) {
    const std::int64_t holder = file.holder();
    return Error{Errc::io, "cannot write " + path + ": another process" +
                               (holder > 0 ? ", " + std::to_string(holder) + "," : "") + " is writing this log"};
  }
  if (!file.is_at(path)) {
    return Error{Errc::io, "cannot write " + path + ": another process has just put another log in its place"};
  }
  return Done{};
}

Error cannot_write_file(const std::string& path, int error) {
  return {Errc::io, "cannot write " + path + ": " + std::strerror(error)};
}

Error cannot_read_file(const std::string& path, int error) {
  return {Errc::io, "cannot read " + path + ": " + std::strerror(error)};
}

}  // namespace sesame::engine
