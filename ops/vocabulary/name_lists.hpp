/// \file
/// Lists of names, many of them in little room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace sesame::ops {

/// Goes through a list that makes its elements when they are asked for by number.
template <class List>
class IteratorByNumber {
 public:
  IteratorByNumber(const List& list, std::size_t k) : list_{&list}, k_{k} {}
  auto operator*() const { return (*list_)[k_]; }
  IteratorByNumber& operator++() {
    ++k_;
    return *this;
  }
  bool operator==(const IteratorByNumber&) const = default;

 private:
  const List* list_;
  std::size_t k_;
};

/// A list of lists of names, such as the simplices of an insertion. The names stand one after the other in a few texts:
/// a name takes one byte more than it is long (two from 128 bytes on), a list eight. A list may be empty.
class NameLists {
 public:
  /// One of the lists. Valid until names are added.
  class List {
   public:
    class Iterator {
     public:
      using iterator_category = std::input_iterator_tag;  // names are made on the way; else a forward iterator
      using iterator_concept = std::forward_iterator_tag;
      using value_type = std::string_view;
      using difference_type = std::ptrdiff_t;
      using pointer = const std::string_view*;
      using reference = std::string_view;

      Iterator() = default;
      explicit Iterator(const char* at) : at_{at} {}
      std::string_view operator*() const;
      Iterator& operator++();
      Iterator operator++(int) {
        const Iterator before = *this;
        ++*this;
        return before;
      }
      bool operator==(const Iterator&) const = default;

     private:
      const char* at_ = nullptr;  ///< where the length of the next name stands
    };

    explicit List(std::string_view text) : text_{text} {}
    [[nodiscard]] Iterator begin() const { return Iterator{text_.data()}; }
    [[nodiscard]] Iterator end() const { return Iterator{text_.data() + text_.size()}; }
    [[nodiscard]] bool empty() const { return text_.empty(); }
    /// Cost: as many steps.
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(std::distance(begin(), end())); }
    /// Requires: not empty.
    [[nodiscard]] std::string_view front() const { return *begin(); }
    [[nodiscard]] List without_first() const;

   private:
    std::string_view text_;  ///< of each name its length, then it
  };

  NameLists() = default;
  NameLists(std::initializer_list<std::vector<std::string>> lists) {
    for (const std::vector<std::string>& names : lists) {
      push_back(names);
    }
  }

  /// A new list at the end, empty. `add` adds to it.
  void begin_list();
  /// Requires: there is a list.
  void add(std::string_view name);
  template <class Names = std::vector<std::string>>
  void push_back(const Names& names) {
    begin_list();
    for (const std::string_view name : names) {
      add(name);
    }
  }

  [[nodiscard]] std::size_t size() const { return begins_.size(); }
  [[nodiscard]] bool empty() const { return begins_.empty(); }
  [[nodiscard]] List operator[](std::size_t k) const;
  void clear();

  using Iterator = IteratorByNumber<NameLists>;
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size()}; }

 private:
  /// Where a list begins.
  struct Place {
    std::uint32_t page, offset;
  };

  std::vector<Place> begins_;
  std::vector<std::string> pages_;  ///< each list in one of them
};

inline std::string_view NameLists::List::Iterator::operator*() const {
  const char* at = at_;
  std::size_t length = 0;
  int shift = 0;
  for (; (static_cast<unsigned char>(*at) & 0x80U) != 0; ++at, shift += 7) {
    length |= static_cast<std::size_t>(static_cast<unsigned char>(*at) & 0x7fU) << shift;
  }
  length |= static_cast<std::size_t>(static_cast<unsigned char>(*at)) << shift;
  return {at + 1, length};
}

inline NameLists::List::Iterator& NameLists::List::Iterator::operator++() {
  const std::string_view name = **this;
  at_ = name.data() + name.size();
  return *this;
}

inline NameLists::List NameLists::List::without_first() const {
  const std::string_view first = front();
  return List{text_.substr(static_cast<std::size_t>(first.data() - text_.data()) + first.size())};
}

inline NameLists::List NameLists::operator[](std::size_t k) const {
  const Place begin = begins_[k];
  const std::string& page = pages_[begin.page];
  const bool is_last = k + 1 == begins_.size() || begins_[k + 1].page != begin.page;
  const std::size_t end = is_last ? page.size() : begins_[k + 1].offset;
  return List{std::string_view{page}.substr(begin.offset, end - begin.offset)};
}

}  // namespace sesame::ops
