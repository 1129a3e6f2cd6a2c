/// \file
/// Names of cells and bodies: an append-only list with an index by text.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ops/ids.hpp"
#include "sparse/archive.hpp"
#include "sparse/hash_index.hpp"

namespace sesame::ops {

/// Not empty, UTF-8, without white space or control characters.
[[nodiscard]] bool is_name(std::string_view text);

/// The hash of a text, one character after the other, as NameTable has it.
class TextHash {
 public:
  void add(char c) { word_ = word_ * multiplier + static_cast<unsigned char>(c) + 1; }
  void add(std::string_view text) {
    for (const char c : text) {
      add(c);
    }
  }
  /// A polynomial in the multiplier, modulo 2^64.
  [[nodiscard]] std::uint64_t word() const { return word_; }
  [[nodiscard]] std::uint32_t value() const { return value_of(word_); }

  static constexpr std::uint64_t multiplier = 0x9e37'79b9'7f4a'7c15U;
  /// Its low bits depend on low bits of the characters only: the table takes high ones of a product.
  static std::uint32_t value_of(std::uint64_t word) {
    return static_cast<std::uint32_t>((word ^ word >> 32U) * 0xbf58'476d'1ce4'e5b9U >> 32U);
  }

 private:
  std::uint64_t word_ = 0;
};

/// The hashes of all parts of a text. Cost: once the length of the text, then O(1) each.
///
/// Source: R. Karp and M. Rabin, "Efficient randomized pattern-matching algorithms" (1987).
class PartHashes {
 public:
  explicit PartHashes(std::string_view text);
  [[nodiscard]] std::uint32_t value(std::size_t begin, std::size_t end) const {
    return TextHash::value_of(words_[end] - words_[begin] * powers_[end - begin]);
  }

 private:
  std::vector<std::uint64_t> words_;   // of the first k characters
  std::vector<std::uint64_t> powers_;  // of the multiplier
};

/// What names denote, in the order in which they were given. The last names can be taken back. A text that is given
/// again denotes the latest, until that is taken back.
///
/// A lookup that fails, as each new name's does, reads one cache line of the index and no text. It took a fifth of the
/// time of a replay as a std::unordered_map.
///
/// Threads: one at a time, as queries keep what they find.
class NameTable {
 public:
  struct Name {
    std::string text;
    CellId cell;  ///< or none
    BodyId body;  ///< or none
    /// Of the standard simplex or simploid that this is, with its faces made before it and named after it; or none.
    TypeId standard;
  };

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(names_.size()); }
  [[nodiscard]] const Name& operator[](std::uint32_t number) const { return names_[number]; }
  /// The name of a text, or null. Cost: the length of the text.
  [[nodiscard]] const Name* find(std::string_view text) const { return find(text, hash_of(text)); }
  /// The same with its hash, TextHash::value. Cost O(1) when there is none.
  [[nodiscard]] const Name* find(std::string_view text, std::uint32_t hash) const {
    const std::uint32_t number = number_of(text, hash);
    return number == none ? nullptr : &names_[number];
  }
  /// Its number, or none.
  [[nodiscard]] std::uint32_t number_of(std::string_view text) const { return number_of(text, hash_of(text)); }
  /// How often something has been looked up. Only grows.
  [[nodiscard]] std::uint64_t looked_up() const { return looked_up_; }
  /// Requires: the text is not in the table, or what it denotes is no more; a body that it denotes it goes on denoting.
  void add(std::string_view text, CellId cell, BodyId body, TypeId standard = none);
  void pop_back();

  // ---- to an archive, and into a new table from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  /// Without a look at what the names denote.
  void load(sparse::ArchiveReader& from);

 private:
  static std::uint32_t hash_of(std::string_view text);
  void index_last();
  [[nodiscard]] std::uint32_t number_of(std::string_view text, std::uint32_t hash) const;
  /// As the index takes it, which goes by the upper half.
  static std::uint64_t key(std::uint32_t hash) { return std::uint64_t{hash} << 32U; }

  std::deque<Name> names_;
  std::unordered_map<std::uint32_t, std::uint32_t> shadowed_;  ///< by number: that of the same text before
  mutable std::uint64_t looked_up_ = 0;
  sparse::HashIndex index_;
};

}  // namespace sesame::ops
