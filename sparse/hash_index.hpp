/// \file
/// A hash table from keys that are kept elsewhere to 32-bit numbers.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
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
/// Open addressing with linear probing; one word an entry, and no marks of what was erased. From many numbers on there
/// are many tables, of which one grows at a time: no insertion waits for all of them to be moved.
/// Cost of every operation: O(1) expected, for hashes whose upper halves are spread (nobody chose the keys for theirs
/// not to be).
class HashIndex {
 public:
  static constexpr std::uint32_t nothing = UINT32_MAX;

  [[nodiscard]] std::size_t size() const { return size_; }

  /// The number under a hash for which is_it(number) holds, or `nothing`.
  template <class IsIt>
  [[nodiscard]] std::uint32_t find(std::uint64_t hash, IsIt&& is_it) const {
    const Table& table = table_of(hash);
    if (table.entries.empty()) {
      return nothing;
    }
    const std::uint64_t tag = hash & tag_mask;
    for (std::size_t at = table.home(hash);; at = (at + 1) & table.mask) {
      const std::uint64_t entry = table.entries[at];
      if (entry == empty) {
        return nothing;
      }
      if ((entry & tag_mask) == tag && is_it(static_cast<std::uint32_t>(entry))) {
        return static_cast<std::uint32_t>(entry);
      }
    }
  }

  /// Makes room for so many numbers, so that none of them has a table grow, unless there are many.
  void reserve(std::size_t numbers) {
    if (tables_.empty() && numbers > only_.size) {
      only_.rebuild(room_for(std::min(numbers, most_in_one_table)));
    }
  }

  /// Requires: the number is not there under this hash.
  void insert(std::uint64_t hash, std::uint32_t number) {
    make_room_for_one();
    table_of(hash).insert((hash & tag_mask) | number);
    ++size_;
  }

  /// The same, unless is_it(other) holds for a number that is there under this hash. Returns whether it was inserted.
  template <class IsIt>
  bool insert_new(std::uint64_t hash, std::uint32_t number, IsIt&& is_it) {
    make_room_for_one();
    Table& table = table_of(hash);
    table.make_room_for_one();
    const std::uint64_t tag = hash & tag_mask;
    for (std::size_t at = table.home(hash);; at = (at + 1) & table.mask) {
      std::uint64_t& entry = table.entries[at];
      if (entry == empty) {
        entry = tag | number;
        ++table.size;
        ++size_;
        return true;
      }
      if ((entry & tag_mask) == tag && is_it(static_cast<std::uint32_t>(entry))) {
        return false;
      }
    }
  }

  /// Requires: the number is there under this hash.
  void erase(std::uint64_t hash, std::uint32_t number) {
    Table& table = table_of(hash);
    std::vector<std::uint64_t>& entries = table.entries;
    const std::uint64_t wanted = (hash & tag_mask) | number;
    std::size_t hole = table.home(hash);
    while (entries[hole] != wanted) {
      hole = (hole + 1) & table.mask;
    }
    // Entries after the hole move into it unless that would put them before their home.
    for (std::size_t at = (hole + 1) & table.mask; entries[at] != empty; at = (at + 1) & table.mask) {
      if (((at - table.home(entries[at])) & table.mask) >= ((at - hole) & table.mask)) {
        entries[hole] = entries[at];
        hole = at;
      }
    }
    entries[hole] = empty;
    --table.size;
    --size_;
  }

 private:
  static constexpr std::uint64_t tag_mask = 0xffffffff00000000U;
  static constexpr std::uint64_t empty = UINT64_MAX;
  static constexpr std::size_t least_entries = 16;
  static constexpr unsigned table_bits = 8;
  static constexpr std::size_t most_in_one_table = std::size_t{1} << 16;

  struct Table {
    std::vector<std::uint64_t> entries;  ///< upper half of the hash, number
    std::size_t mask = 0;
    std::size_t size = 0;

    [[nodiscard]] std::size_t home(std::uint64_t hash) const { return (hash >> 32) & mask; }
    void place(std::uint64_t entry) {
      std::size_t at = home(entry);
      while (entries[at] != empty) {
        at = (at + 1) & mask;
      }
      entries[at] = entry;
    }
    void make_room_for_one() {
      if (2 * (size + 1) > entries.size()) {
        rebuild(std::max(least_entries, 2 * entries.size()));
      }
    }
    void insert(std::uint64_t entry) {
      make_room_for_one();
      place(entry);
      ++size;
    }
    /// Requires: a power of two, and room for all.
    void rebuild(std::size_t slots) {
      std::vector<std::uint64_t> old(slots, empty);
      old.swap(entries);
      mask = slots - 1;
      for (const std::uint64_t entry : old) {
        if (entry != empty) {
          place(entry);
        }
      }
    }
  };

  void make_room_for_one() {
    if (tables_.empty() && size_ == most_in_one_table) {
      divide();
    }
  }
  [[nodiscard]] static std::size_t room_for(std::size_t numbers) {
    return std::max(least_entries, std::bit_ceil(2 * numbers));
  }
  [[nodiscard]] const Table& table_of(std::uint64_t hash) const {
    return tables_.empty() ? only_ : tables_[hash >> (64U - table_bits)];
  }
  [[nodiscard]] Table& table_of(std::uint64_t hash) { return const_cast<Table&>(std::as_const(*this).table_of(hash)); }

  /// From one table to many.
  void divide() {
    tables_.resize(std::size_t{1} << table_bits);
    for (const Table all = std::exchange(only_, {}); const std::uint64_t entry : all.entries) {
      if (entry != empty) {
        table_of(entry).insert(entry);
      }
    }
  }

  Table only_;                 ///< as long as there are no others
  std::vector<Table> tables_;  ///< by the highest bits of the hash
  std::size_t size_ = 0;
};

}  // namespace sesame::sparse
