#include "tools/bench/heap_count.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {

struct Counters {
  bool is_on = false;
  std::uint64_t allocations = 0;
  std::int64_t bytes = 0, peak_bytes = 0;  // bytes: below zero when memory from before is given back
};
// Of each thread, as other threads of a program that links this may allocate too.
constinit thread_local Counters counters;

void* allocated(std::size_t size) noexcept {
  void* const memory = std::malloc(std::max(size, std::size_t{1}));
  if (counters.is_on && memory != nullptr) {
    ++counters.allocations;
    counters.bytes += static_cast<std::int64_t>(malloc_usable_size(memory));
    counters.peak_bytes = std::max(counters.peak_bytes, counters.bytes);
  }
  return memory;
}

void release(void* memory) noexcept {
  if (counters.is_on && memory != nullptr) {
    counters.bytes -= static_cast<std::int64_t>(malloc_usable_size(memory));
  }
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  if (void* const memory = allocated(size)) {
    return memory;
  }
  throw std::bad_alloc{};
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocated(size); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }

namespace sesame::tools {

void begin_heap_count() {
  counters = {};
  counters.is_on = true;
}

HeapUse end_heap_count() {
  counters.is_on = false;
  return {counters.allocations, static_cast<std::uint64_t>(counters.peak_bytes)};
}

}  // namespace sesame::tools
