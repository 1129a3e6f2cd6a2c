/// \file
/// A hash table from keys that are kept elsewhere to 32-bit numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sesame::sparse {

/// Spreads the bits of a number over all 64. Source: the finaliser of SplitMix64 (Steele, Lea, Flood 2014).
[[nodiscard]] constexpr std::uint64_t spread_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// Numbers below 2^32 - 1, each under a 64-bit hash. Two numbers may have one hash: the caller compares the keys.
/// Open addressing with linear probing; one word an entry, and no marks of what was erased.
/// Cost of every operation: O(1) expected, for hashes whose upper halves are spread (nobody chose the keys for theirs
/// not to be).
class HashIndex {
 public:
  static constexpr std::uint32_t nothing = UINT32_MAX;

  [[nodiscard]] std::size_t size() const { return size_; }

  /// The number under a hash for which is_it(number) holds, or `nothing`.
  template <class IsIt>
  [[nodiscard]] std::uint32_t find(std::uint64_t hash, IsIt&& is_it) const {
    if (entries_.empty()) {
      return nothing;
    }
    const std::uint64_t tag = hash & tag_mask;
    for (std::size_t at = home(hash);; at = (at + 1) & mask_) {
      const std::uint64_t entry = entries_[at];
      if (entry == empty) {
        return nothing;
      }
      if ((entry & tag_mask) == tag && is_it(static_cast<std::uint32_t>(entry))) {
        return static_cast<std::uint32_t>(entry);
      }
    }
  }

  /// Requires: the number is not there under this hash.
  void insert(std::uint64_t hash, std::uint32_t number) {
    if (2 * (size_ + 1) > entries_.size()) {
      grow();
    }
    place((hash & tag_mask) | number);
    ++size_;
  }

  /// Requires: the number is there under this hash.
  void erase(std::uint64_t hash, std::uint32_t number) {
    const std::uint64_t wanted = (hash & tag_mask) | number;
    std::size_t hole = home(hash);
    while (entries_[hole] != wanted) {
      hole = (hole + 1) & mask_;
    }
    // Entries after the hole move into it unless that would put them before their home.
    for (std::size_t at = (hole + 1) & mask_; entries_[at] != empty; at = (at + 1) & mask_) {
      if (((at - home(entries_[at])) & mask_) >= ((at - hole) & mask_)) {
        entries_[hole] = entries_[at];
        hole = at;
      }
    }
    entries_[hole] = empty;
    --size_;
  }

 private:
  static constexpr std::uint64_t tag_mask = 0xffffffff00000000U;
  static constexpr std::uint64_t empty = UINT64_MAX;

  [[nodiscard]] std::size_t home(std::uint64_t hash) const { return (hash >> 32) & mask_; }

  void place(std::uint64_t entry) {
    std::size_t at = home(entry);
    while (entries_[at] != empty) {
      at = (at + 1) & mask_;
    }
    entries_[at] = entry;
  }

  void grow() {
    std::vector<std::uint64_t> old(entries_.empty() ? 16 : 2 * entries_.size(), empty);
    old.swap(entries_);
    mask_ = entries_.size() - 1;
    for (const std::uint64_t entry : old) {
      if (entry != empty) {
        place(entry);
      }
    }
  }

  std::vector<std::uint64_t> entries_;  ///< upper half of the hash, number
  std::size_t mask_ = 0;
  std::size_t size_ = 0;
};

}  // namespace sesame::sparse
