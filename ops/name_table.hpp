/// \file
/// Names of cells and bodies: an append-only list with an index by text.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace sesame::ops {

/// Not empty, UTF-8, without white space or control characters.
[[nodiscard]] bool is_name(std::string_view text);

/// What names denote, in the order in which they were given. The last names can be taken back.
///
/// The index is one open table of (hash, number) pairs: a lookup that fails, as each new name's does, reads one cache
/// line and no text. It took a fifth of the time of a replay as a std::unordered_map.
class NameTable {
 public:
  struct Name {
    std::string text;
    std::uint32_t cell;  ///< or ops::none
    std::uint32_t body;  ///< or ops::none
  };

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(names_.size()); }
  [[nodiscard]] const Name& operator[](std::uint32_t number) const { return names_[number]; }
  /// The name of a text, or null. Cost O(1).
  [[nodiscard]] const Name* find(std::string_view text) const { return find(text, hash_of(text)); }
  /// Requires: the text is not in the table.
  void add(std::string_view text, std::uint32_t cell, std::uint32_t body);
  void pop_back();

 private:
  struct Slot {
    std::uint32_t hash;
    std::uint32_t number;
  };
  [[nodiscard]] const Name* find(std::string_view text, std::uint32_t hash) const;
  static std::uint32_t hash_of(std::string_view text);
  void grow();
  void insert(Slot slot);

  std::deque<Name> names_;
  std::vector<Slot> slots_;  // a power of two of them, at most half in use
};

}  // namespace sesame::ops
