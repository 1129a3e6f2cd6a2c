#include "sparse/block_memory.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#ifdef __linux__
#include <sys/mman.h>
#endif

// What malloc, realloc and mmap give is owned by who asks here.
// NOLINTBEGIN(cppcoreguidelines-no-malloc, cppcoreguidelines-owning-memory)
namespace sesame::sparse {

#ifdef __linux__

namespace {

bool has_pages(std::size_t bytes) { return bytes >= least_bytes_of_pages; }

void* allocate(std::size_t bytes) {
  if (!has_pages(bytes)) {
    return std::malloc(bytes);
  }
  void* const pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return pages == MAP_FAILED ? nullptr : pages;
}

}  // namespace

void* resize_block(void* block, std::size_t bytes, std::size_t wanted) noexcept {
  if (block != nullptr && has_pages(bytes) && has_pages(wanted)) {
    void* const moved = mremap(block, bytes, wanted, MREMAP_MAYMOVE);
    return moved == MAP_FAILED ? nullptr : moved;
  }
  if (!has_pages(bytes) && !has_pages(wanted)) {
    return std::realloc(block, wanted);
  }
  void* const other = allocate(wanted);
  if (other != nullptr && block != nullptr) {
    std::memcpy(other, block, std::min(bytes, wanted));
    release_block(block, bytes);
  }
  return other;
}

void release_block(void* block, std::size_t bytes) noexcept {
  if (block != nullptr && has_pages(bytes)) {
    munmap(block, bytes);
  } else {
    std::free(block);
  }
}

#else

void* resize_block(void* block, std::size_t /*bytes*/, std::size_t wanted) noexcept {
  return std::realloc(block, wanted);
}

void release_block(void* block, std::size_t /*bytes*/) noexcept { std::free(block); }

#endif

}  // namespace sesame::sparse
// NOLINTEND(cppcoreguidelines-no-malloc, cppcoreguidelines-owning-memory)
