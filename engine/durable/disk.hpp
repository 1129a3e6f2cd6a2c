/// \file
/// What a log needs of the file system, and nothing more: so that tests can put a disk under it that fails.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "sparse/result.hpp"

namespace sesame::engine {

/// How far a read or a write came. `error`: an errno, or 0.
struct Transfer {
  std::size_t bytes = 0;
  int error = 0;
};

/// An open file. It is closed, and its lock given up, when this is destroyed.
class File {
 public:
  File() = default;
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  virtual ~File() = default;

  /// Writes at the end; short only on an error.
  virtual Transfer append(std::span<const char> bytes) = 0;
  /// Reads from a byte on, as much as there is room for; short at the end of the file.
  virtual Transfer read(std::uint64_t from, std::span<char> to) = 0;
  /// Waits until all that was appended is where a power cut leaves it. 0, or an errno.
  virtual int sync() = 0;
  /// Writes bytes that it has once more, from a byte on, in place. 0, or an errno.
  virtual int rewrite(std::uint64_t from, std::span<const char> bytes) = 0;
  /// Cuts all bytes behind the first `size` ones off. 0, or an errno.
  virtual int truncate(std::uint64_t size) = 0;
  /// The number of bytes. 0, or an errno.
  virtual int size(std::uint64_t& bytes) = 0;
  /// Whether this file could be locked against other writers; not when another one has it. Errors of the file system
  /// count as a lock: there are some that have none.
  virtual bool lock() = 0;
  /// Whether this is the file that has a name now.
  virtual bool is_at(const std::string& path) = 0;
  /// Whether what was appended can be read.
  [[nodiscard]] virtual bool is_readable() const = 0;
  /// The process that has the lock, or 0 when that cannot be found out.
  virtual std::int64_t holder() = 0;
};

/// A file system.
class Disk {
 public:
  enum class Mode {
    read,    ///< what is there
    write,   ///< what is there, to be read and appended to
    create,  ///< a new file, to be read and appended to; an error when there is one of that name
  };

  Disk() = default;
  Disk(const Disk&) = delete;
  Disk& operator=(const Disk&) = delete;
  virtual ~Disk() = default;

  /// Null, with an errno, when it cannot be opened.
  virtual std::unique_ptr<File> open(const std::string& path, Mode mode, int& error) = 0;
  /// Each: 0, or an errno.
  virtual int rename(const std::string& from, const std::string& to) = 0;
  virtual int remove(const std::string& path) = 0;
  /// The names that a folder has are written to the disk with it. `path`: of a file in it.
  virtual int sync_folder_of(const std::string& path) = 0;
};

/// That of the machine. Calls that a signal interrupts go on.
[[nodiscard]] Disk& real_disk();

/// A file that is open already, as the real disk has it; the descriptor is closed with it if it is `owned`. What is no
/// regular file can be neither truncated, which is an error, nor synced, which is none.
[[nodiscard]] std::unique_ptr<File> file_of(int descriptor, bool is_owned);

/// Takes the lock of a log, so that it has one writer. Errors, io: another process has it, or has just put another log
/// in the place of this one.
Status lock_log(File& file, const std::string& path);

/// "cannot write PATH: REASON", io.
[[nodiscard]] Error cannot_write_file(const std::string& path, int error);
[[nodiscard]] Error cannot_read_file(const std::string& path, int error);

}  // namespace sesame::engine
