// A library to be preloaded, which makes calls fail as the environment says: for tests.
//   FAIL_FILE            the file of which the rest is about
//   FAIL_READ_AT         reads of it end with EIO at this byte
//   FAIL_ALLOCATION      of the allocations after the first read of it, the one with this number (from 1) gets no
//   memory
//   FAIL_ALLOCATIONS_FROM  of these, the one with this number and all that follow get none
//   FAIL_SYNC            when it is set, no fsync of it succeeds
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>

// The C library's own, under names that are not the ones replaced below.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_realloc(void* memory, std::size_t size);
extern "C" ssize_t __read(int file, void* to, std::size_t size);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace {

bool has_begun = false;
long allocations = 0;

long number_of(const char* variable) {
  const char* const text = getenv(variable);
  return text == nullptr ? -1 : std::strtol(text, nullptr, 10);
}

bool is_the_file(int file) {
  const char* const path = getenv("FAIL_FILE");
  struct stat one {};
  struct stat other {};
  return path != nullptr && stat(path, &one) == 0 && fstat(file, &other) == 0 && one.st_dev == other.st_dev &&
         one.st_ino == other.st_ino;
}

bool fails_now() {
  static const long only = number_of("FAIL_ALLOCATION");
  static const long first = number_of("FAIL_ALLOCATIONS_FROM");
  return has_begun && (++allocations == only || (first > 0 && allocations >= first));
}

}  // namespace

// NOLINTBEGIN(readability-inconsistent-declaration-parameter-name): the headers have reserved names
extern "C" {

ssize_t read(int file, void* to, std::size_t size) {
  if (!is_the_file(file)) {
    return __read(file, to, size);
  }
  has_begun = true;
  const long limit = number_of("FAIL_READ_AT");
  const long position = lseek(file, 0, SEEK_CUR);
  if (limit < 0) {
    return __read(file, to, size);
  }
  if (position >= limit) {
    errno = EIO;
    return -1;
  }
  const auto left = static_cast<std::size_t>(limit - position);
  return __read(file, to, size < left ? size : left);
}

int fsync(int file) {
  if (getenv("FAIL_SYNC") == nullptr || !is_the_file(file)) {
    return static_cast<int>(syscall(SYS_fsync, file));
  }
  errno = EIO;
  return -1;
}

void* malloc(std::size_t size) {
  if (!fails_now()) {
    return __libc_malloc(size);
  }
  errno = ENOMEM;
  return nullptr;
}

void* realloc(void* memory, std::size_t size) {
  if (!fails_now()) {
    return __libc_realloc(memory, size);
  }
  errno = ENOMEM;
  return nullptr;
}

}  // extern "C"
// NOLINTEND(readability-inconsistent-declaration-parameter-name)
