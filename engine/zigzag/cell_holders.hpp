/// \file
/// Which of many chains have a cell.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sesame::engine {

/// For each cell of one dimension, the numbers of the chains that have it. Whoever changes a chain says so, once for
/// each cell that it gains or loses.
///
/// As long as there are few, a matrix of bits, where a change is one word; then lists, in which who is named an even
/// number of times is not there, and which are tidied when they have become twice as long. Memory: 64 MB at most for
/// the matrix.
class CellHolders {
 public:
  using Number = std::uint32_t;

  /// A chain gains a cell or loses it.
  void toggle(std::uint32_t slot, Number number) {
    if (are_lists_) {
      List& list = lists_[slot];
      if (list.numbers.size() >= list.most) {
        tidy(list);
      }
      list.numbers.push_back(number);
      return;
    }
    bits_[slot * stride_ + number / 64] ^= std::uint64_t{1} << (number % 64);
  }
  /// Makes room for slots and numbers below these.
  void reserve(std::size_t slots, std::size_t numbers) {
    if (are_lists_) {
      if (slots > lists_.size()) {
        lists_.resize(slots);
      }
    } else if (slots > slots_ || numbers > 64 * stride_) {
      grow(std::max(slots, slots > slots_ ? 2 * slots_ : slots_),
           numbers > 64 * stride_ ? std::max<std::size_t>(1, std::bit_ceil((numbers + 63) / 64)) : stride_);
    }
  }
  /// Appends the numbers of the chains that have a cell, ascending.
  void collect(std::uint32_t slot, std::vector<Number>& into) {
    if (are_lists_) {
      tidy(lists_[slot]);
      into.insert(into.end(), lists_[slot].numbers.begin(), lists_[slot].numbers.end());
      return;
    }
    for_each_bit(slot, [&](Number number) { into.push_back(number); });
  }

 private:
  static constexpr std::size_t most_bytes = std::size_t{1} << 26;
  static constexpr std::uint32_t least = 8;

  struct List {
    std::vector<Number> numbers;
    std::uint32_t most = least;  ///< more are looked through
  };

  static void tidy(List& list) {
    std::vector<Number>& numbers = list.numbers;
    std::sort(numbers.begin(), numbers.end());
    std::size_t kept = 0;
    for (std::size_t k = 0; k < numbers.size();) {
      const bool is_pair = k + 1 < numbers.size() && numbers[k] == numbers[k + 1];
      if (!is_pair) {
        numbers[kept++] = numbers[k];
      }
      k += is_pair ? 2 : 1;
    }
    numbers.resize(kept);
    list.most = std::max(least, 2 * static_cast<std::uint32_t>(kept));
  }
  template <class Visit>
  void for_each_bit(std::size_t slot, Visit&& visit) const {
    for (std::size_t word = 0; word < stride_; ++word) {
      for (std::uint64_t rest = bits_[slot * stride_ + word]; rest != 0; rest &= rest - 1) {
        visit(static_cast<Number>(64 * word + static_cast<std::size_t>(std::countr_zero(rest))));
      }
    }
  }
  void grow(std::size_t slots, std::size_t stride) {
    if (slots * stride * sizeof(std::uint64_t) > most_bytes) {
      lists_.resize(slots);
      for (std::size_t slot = 0; slot < slots_; ++slot) {
        for_each_bit(slot, [&](Number number) { lists_[slot].numbers.push_back(number); });
      }
      are_lists_ = true;
      bits_ = {};
      return;
    }
    std::vector<std::uint64_t> bits(slots * stride, 0);
    for (std::size_t slot = 0; slot < slots_; ++slot) {
      std::copy_n(bits_.begin() + static_cast<std::ptrdiff_t>(slot * stride_), stride_,
                  bits.begin() + static_cast<std::ptrdiff_t>(slot * stride));
    }
    bits_ = std::move(bits);
    slots_ = slots;
    stride_ = stride;
  }

  bool are_lists_ = false;
  std::size_t slots_ = 0, stride_ = 0;  ///< of the matrix: its rows, and the words of a row
  std::vector<std::uint64_t> bits_;
  std::vector<List> lists_;  ///< per slot
};

}  // namespace sesame::engine
