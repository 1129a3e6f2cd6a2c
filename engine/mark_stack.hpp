/// \file
/// Moments to which undo can go back, in few bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "sparse/contract.hpp"

namespace sesame::engine {

/// A stack of marks, each a list of `size` numbers, which can also be taken from below. It is made for numbers that
/// mostly are, or come soon after, what they were in the mark before: kept are the differences that are not 0, seven
/// bits a byte, behind a word that says which these are. Other numbers only take more bytes.
/// Cost of everything: the bytes of a mark.
template <std::size_t size>
class MarkStack {
 public:
  static_assert(size <= 16);
  using Mark = std::array<std::uint64_t, size>;

  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  /// What all marks take.
  [[nodiscard]] std::size_t bytes() const { return bytes_.size(); }

  void push(const Mark& mark) {
    const std::size_t before = bytes_.size();
    std::uint32_t changed = 0;
    for (std::size_t k = 0; k < size; ++k) {
      changed |= std::uint32_t{mark[k] != last_[k]} << k;
    }
    bytes_.push_back(static_cast<std::uint8_t>(changed & 0xffU));
    bytes_.push_back(static_cast<std::uint8_t>(changed >> 8U));
    for (std::size_t k = 0; k < size; ++k) {
      if (std::uint64_t difference = mark[k] - last_[k]; difference != 0) {  // modulo 2^64
        for (; difference >= 0x80; difference >>= 7U) {
          bytes_.push_back(static_cast<std::uint8_t>(difference | 0x80U));
        }
        bytes_.push_back(static_cast<std::uint8_t>(difference));
      }
    }
    bytes_.push_back(static_cast<std::uint8_t>(bytes_.size() - before));  // at most 2 + 10 * 16
    last_ = mark;
  }
  /// The last mark, which goes. Requires: there is one.
  Mark pop() {
    sparse::expects(!empty(), "only what is remembered can be undone");
    const Mark mark = last_;
    const std::size_t begin = bytes_.size() - 1 - bytes_.back();
    (void)take_in(begin, last_, true);
    bytes_.erase(bytes_.begin() + static_cast<std::ptrdiff_t>(begin), bytes_.end());
    return mark;
  }
  /// The last one. Requires: there is one.
  [[nodiscard]] const Mark& last() const { return last_; }
  /// Calls visit(mark) for all of them, the first one first.
  template <class Visit>
  void for_each(Visit&& visit) const {
    Mark mark = before_first_;
    for (std::size_t at = 0; at < bytes_.size(); ++at) {  // behind each there is a byte with its length
      at = take_in(at, mark, false);
      visit(mark);
    }
  }
  /// The first one. Requires: there is one.
  [[nodiscard]] Mark oldest() const {
    Mark mark = before_first_;
    (void)take_in(0, mark, false);
    return mark;
  }
  /// The first one goes. Requires: there is one.
  void forget_oldest() {
    sparse::expects(!empty(), "only what is remembered can be forgotten");
    const std::size_t end = take_in(0, before_first_, false) + 1;
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(end));
  }

 private:
  /// Adds the differences that begin at a byte, or takes them off. Returns where they end.
  std::size_t take_in(std::size_t at, Mark& mark, bool is_taken_off) const {
    const std::uint32_t changed = bytes_[at] | std::uint32_t{bytes_[at + 1]} << 8U;
    at += 2;
    for (std::size_t k = 0; k < size; ++k) {
      if ((changed >> k & 1U) == 0) {
        continue;
      }
      std::uint64_t difference = 0;
      for (unsigned shift = 0;; shift += 7) {
        const std::uint8_t byte = bytes_[at++];
        difference |= std::uint64_t{byte & 0x7fU} << shift;
        if (byte < 0x80) {
          break;
        }
      }
      mark[k] += is_taken_off ? -difference : difference;
    }
    return at;
  }

  std::deque<std::uint8_t> bytes_;
  Mark last_{};          ///< zeros when there is none
  Mark before_first_{};  ///< what the first differs from
};

}  // namespace sesame::engine
