/// \file
/// Snapshots in memory, for the tests of what writes and reads them.
#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "sparse/archive_memory.hpp"

namespace sesame::tests {

using Bytes = std::vector<char>;

using sparse::sink_into;
using sparse::source_of;

/// Makes the checksum at the end that of the bytes before it.
inline void seal(Bytes& bytes) {
  const std::size_t size = bytes.size() - sizeof(std::uint64_t);
  sparse::RunningHash hash;
  hash.add(std::span{bytes}.first(size));
  const std::uint64_t value = hash.value();
  std::memcpy(bytes.data() + size, &value, sizeof value);
}

}  // namespace sesame::tests
