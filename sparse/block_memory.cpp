#include "sparse/block_memory.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>

#include "sparse/block_statistics.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

// What malloc, realloc and mmap give is owned by who asks here.
// NOLINTBEGIN(cppcoreguidelines-no-malloc, cppcoreguidelines-owning-memory)
namespace sesame::sparse {

#ifdef __linux__

namespace {

std::atomic<std::size_t> all_pages{0};  // bytes; a statistic, which orders nothing

bool has_pages(std::size_t bytes) { return bytes >= least_bytes_of_pages; }

// Pages of 2 MB, where the system has them, for blocks so large that a part of one left over does not matter. The first
// touch of a page costs microseconds on a virtual machine, and a look at one of many small pages another walk through
// the tables of pages.
void ask_for_large_pages(void* pages, std::size_t bytes) {
  if (bytes >= std::size_t{8} << 20) {
    madvise(pages, bytes, MADV_HUGEPAGE);  // refused, all is as it was
  }
}

void* allocate(std::size_t bytes) {
  if (!has_pages(bytes)) {
    return std::malloc(bytes);
  }
  void* const pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) {
    return nullptr;
  }
  ask_for_large_pages(pages, bytes);
  all_pages.fetch_add(bytes, std::memory_order_relaxed);
  return pages;
}

}  // namespace

void* resize_block(void* block, std::size_t bytes, std::size_t wanted) noexcept {
  if (block != nullptr && has_pages(bytes) && has_pages(wanted)) {
    void* const moved = mremap(block, bytes, wanted, MREMAP_MAYMOVE);
    if (moved == MAP_FAILED) {
      return nullptr;
    }
    ask_for_large_pages(moved, wanted);
    all_pages.fetch_add(wanted - bytes, std::memory_order_relaxed);  // modulo 2^64: it may become smaller
    return moved;
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
    all_pages.fetch_sub(bytes, std::memory_order_relaxed);
  } else {
    std::free(block);
  }
}

std::size_t bytes_of_pages() noexcept { return all_pages.load(std::memory_order_relaxed); }

#else

void* resize_block(void* block, std::size_t /*bytes*/, std::size_t wanted) noexcept {
  return std::realloc(block, wanted);
}

void release_block(void* block, std::size_t /*bytes*/) noexcept { std::free(block); }

std::size_t bytes_of_pages() noexcept { return 0; }

#endif

}  // namespace sesame::sparse
// NOLINTEND(cppcoreguidelines-no-malloc, cppcoreguidelines-owning-memory)
