/// \file
/// A stream buffer in front of a file descriptor: what std::filebuf is, with the reason of a failure and fsync.
#pragma once

#include <sys/types.h>

#include <streambuf>
#include <vector>

#include "sparse/result.hpp"

namespace sesame::tools {

/// Writes to a descriptor, which it owns; it takes nothing more after a failure. Bytes after the last flush are then
/// taken back, so that a regular file ends where a flush ended.
class FileBuffer final : public std::streambuf {
 public:
  explicit FileBuffer(int descriptor);
  FileBuffer(const FileBuffer&) = delete;
  FileBuffer& operator=(const FileBuffer&) = delete;
  ~FileBuffer() override;  ///< closes; what was not flushed is lost

  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// Forgets what was not flushed and has not been written.
  void drop() { setp(room_.data(), room_.data() + room_.size()); }
  /// Flushes, and waits until a regular file is where a power cut leaves it. Errors, io: why writing failed, now or
  /// earlier.
  Status settle();

 protected:
  int_type overflow(int_type c) override;
  int sync() override;

 private:
  bool write_pending();

  int descriptor_;
  off_t flushed_;  ///< the size at the last flush
  int error_ = 0;  ///< the errno of the first failure
  std::vector<char> room_;
};

}  // namespace sesame::tools
