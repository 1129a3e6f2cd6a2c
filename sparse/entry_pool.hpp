/// \file
/// `EntryPool`: room for the entries of a sparse matrix, in blocks that never move.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "sparse/contract.hpp"

namespace sesame::sparse {

/// A stack of runs of entries. A run is contiguous and stays where it is until it is released.
///
/// A position is a block number (upper 20 bits) and an offset (lower 12 bits). The first blocks are smaller than 4096
/// entries, so that a small matrix stays small; a run longer than that gets consecutive block numbers of its own.
template <class Entry>
class EntryPool {
 public:
  using Position = std::uint32_t;

  [[nodiscard]] const Entry* at(Position position) const {
    return bases_[position >> offset_bits] + (position & (block_size - 1));
  }
  [[nodiscard]] Entry* at(Position position) { return bases_[position >> offset_bits] + (position & (block_size - 1)); }

  /// Room for `count` > 0 entries, to be assigned to. Cost O(1) amortised; at most one allocation per 4096 entries.
  Position allocate(std::uint32_t count) {
    if (blocks_.empty() || blocks_.back().capacity - blocks_.back().used < count) [[unlikely]] {
      add_block(count);
    }
    Block& top = blocks_.back();
    const Position position = top.start + top.used;
    top.used += count;
    return position;
  }

  /// The next block has room for so many entries, if that is no more than blocks have.
  void reserve(std::size_t entries) {
    least_block_ = static_cast<std::uint32_t>(std::clamp<std::size_t>(entries, least_block_, block_size));
  }

  /// Gives a run back. The room of the youngest run is free at once; that of others counts as `wasted` until the pool
  /// is dropped. Cost O(count) for elements that own memory, otherwise O(1).
  void release(Position position, std::uint32_t count) {
    if constexpr (!std::is_trivially_destructible_v<Entry>) {
      std::fill_n(at(position), count, Entry{});
    }
    if (blocks_.back().start + blocks_.back().used != position + count) {
      wasted_ += count;
      return;
    }
    blocks_.back().used -= count;
    while (!blocks_.empty() && blocks_.back().used == 0) {
      bases_.resize(blocks_.back().start >> offset_bits);
      blocks_.pop_back();
    }
  }

  /// Entries that were released but whose room cannot be used.
  [[nodiscard]] std::size_t wasted() const { return wasted_; }
  void swap(EntryPool& other) noexcept {
    bases_.swap(other.bases_);
    blocks_.swap(other.blocks_);
    std::swap(wasted_, other.wasted_);
    std::swap(least_block_, other.least_block_);
  }

 private:
  static constexpr std::uint32_t offset_bits = 12;
  static constexpr std::uint32_t block_size = 1u << offset_bits;
  static constexpr std::uint32_t first_block_size = 16;
  static constexpr std::size_t max_blocks = std::size_t{1} << (32 - offset_bits);

  struct Block {
    std::unique_ptr<Entry[]> entries;
    Position start;
    std::uint32_t used;
    std::uint32_t capacity;
  };

  void add_block(std::uint32_t count) {
    const std::uint32_t grown = blocks_.empty() ? least_block_ : std::min(block_size, 2 * blocks_.back().capacity);
    const std::uint32_t capacity = std::max(grown, count);
    const std::size_t numbers = (std::size_t{capacity} + block_size - 1) / block_size;
    expects(bases_.size() + numbers <= max_blocks, "EntryPool: a matrix holds fewer than 2^32 entries");
    // Not make_unique: elements that own nothing are left uninitialised, as they are assigned to before they are read.
    std::unique_ptr<Entry[]> entries{new Entry[capacity]};
    const auto start = static_cast<Position>(bases_.size() << offset_bits);
    for (std::size_t i = 0; i < numbers; ++i) {
      bases_.push_back(entries.get() + i * block_size);
    }
    blocks_.push_back({std::move(entries), start, 0, capacity});
  }

  std::vector<Entry*> bases_;  ///< per block number
  std::vector<Block> blocks_;
  std::size_t wasted_ = 0;
  std::uint32_t least_block_ = first_block_size;
};

}  // namespace sesame::sparse
