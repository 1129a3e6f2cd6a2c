/// \file
/// Snapshots in memory, for the tests of what writes and reads them.
#pragma once

#include <algorithm>
#include <cstring>
#include <span>
#include <vector>

#include "sparse/archive.hpp"
#include "sparse/result.hpp"

namespace sesame::tests {

using Bytes = std::vector<char>;

/// Appends what is written.
inline sparse::ArchiveWriter::Sink sink_into(Bytes& bytes) {
  return [&bytes](std::span<const char> block) -> Status {
    bytes.insert(bytes.end(), block.begin(), block.end());
    return Done{};
  };
}

/// Gives the bytes, as far as they go.
inline sparse::ArchiveReader::Source source_of(const Bytes& bytes) {
  return [&bytes, at = std::size_t{0}](std::span<char> to) mutable -> Result<std::size_t> {
    const std::size_t taken = std::min(to.size(), bytes.size() - at);
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), taken, to.begin());
    at += taken;
    return taken;
  };
}

/// Makes the checksum at the end that of the bytes before it.
inline void seal(Bytes& bytes) {
  const std::size_t size = bytes.size() - sizeof(std::uint64_t);
  sparse::RunningHash hash;
  hash.add(std::span{bytes}.first(size));
  const std::uint64_t value = hash.value();
  std::memcpy(bytes.data() + size, &value, sizeof value);
}

}  // namespace sesame::tests
