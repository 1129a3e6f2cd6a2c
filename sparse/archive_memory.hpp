/// \file
/// Archives in memory: where an ArchiveWriter writes to and an ArchiveReader reads from when there is no file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "sparse/archive.hpp"

namespace sesame::sparse {

/// Appends what is written to bytes that outlive it.
[[nodiscard]] inline ArchiveWriter::Sink sink_into(std::vector<char>& bytes) {
  return [&bytes](std::span<const char> block) -> Status {
    bytes.insert(bytes.end(), block.begin(), block.end());
    return Done{};
  };
}

/// Gives bytes that outlive it, as far as they go.
[[nodiscard]] inline ArchiveReader::Source source_of(std::span<const char> bytes) {
  return [bytes](std::span<char> to) mutable -> Result<std::size_t> {
    const std::size_t taken = std::min(to.size(), bytes.size());
    std::copy_n(bytes.data(), taken, to.data());
    bytes = bytes.subspan(taken);
    return taken;
  };
}

}  // namespace sesame::sparse
