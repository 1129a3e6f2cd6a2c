/// \file
/// What the program takes from the heap. A program that links this file has its own operator new, which counts while it
/// is asked to. Memory that C code takes (GMP for numbers of more than 64 bits) is not seen.
#pragma once

#include <cstdint>

namespace sesame::tools {

struct HeapUse {
  std::uint64_t allocations = 0;
  std::uint64_t peak_bytes = 0;  ///< the most that was in use at a time, beyond what there was at the beginning
};

/// Begins to count, from zero. One thread only.
void begin_heap_count();
/// Ends it, and tells what was counted.
HeapUse end_heap_count();

}  // namespace sesame::tools
