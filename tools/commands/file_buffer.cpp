#include "tools/commands/file_buffer.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace sesame::tools {
namespace {

constexpr std::size_t capacity = std::size_t{1} << 16;

struct stat status_of(int descriptor) {
  struct stat status {};
  fstat(descriptor, &status);
  return status;
}

}  // namespace

FileBuffer::FileBuffer(int descriptor)
    : descriptor_{descriptor}, flushed_{status_of(descriptor).st_size}, room_(capacity) {
  drop();
}

FileBuffer::~FileBuffer() { ::close(descriptor_); }

Status FileBuffer::settle() {
  if (sync() == 0 && fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) {  // which are for what is no file
    error_ = errno;
  }
  return error_ == 0 ? Status{Done{}} : Error{Errc::io, std::strerror(error_)};
}

bool FileBuffer::write_pending() {
  const char* at = pbase();
  while (error_ == 0 && at < pptr()) {
    const ssize_t written = ::write(descriptor_, at, static_cast<std::size_t>(pptr() - at));
    if (written >= 0) {
      at += written;
    } else if (errno != EINTR) {
      error_ = errno;
      (void)!ftruncate(descriptor_, flushed_);  // what is no file has nothing to take back
    }
  }
  drop();
  return error_ == 0;
}

FileBuffer::int_type FileBuffer::overflow(int_type c) {
  if (!write_pending()) {
    return traits_type::eof();
  }
  if (!traits_type::eq_int_type(c, traits_type::eof())) {
    sputc(traits_type::to_char_type(c));
  }
  return traits_type::not_eof(c);
}

int FileBuffer::sync() {
  if (!write_pending()) {
    return -1;
  }
  flushed_ = status_of(descriptor_).st_size;
  return 0;
}

}  // namespace sesame::tools
