/// \file
/// The columns of a matrix while it is reduced: those that have been, and the sum that becomes the next one.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sparse/descending_sum.hpp"
#include "sparse/growing_array.hpp"
#include "sparse/ring.hpp"

namespace sesame::engine {

/// An entry 1 or -1 of a matrix.
class SignedRow {
 public:
  SignedRow() = default;
  SignedRow(std::uint32_t row, bool is_negative) : word_{2 * row + (is_negative ? 1U : 0U)} {}
  [[nodiscard]] std::uint32_t row() const { return word_ / 2; }
  [[nodiscard]] bool is_negative() const { return word_ % 2 == 1; }

 private:
  std::uint32_t word_;
};

/// Columns by their numbers, and a sum. What leads is the largest row. Over a field.
template <sparse::Ring R>
class ReducedColumns {
 public:
  using Row = std::uint32_t;
  static constexpr Row no_row = UINT32_MAX;

  ReducedColumns(R ring, std::size_t /*rows*/, std::size_t columns) : ring_{ring}, sum_{ring}, stored_(columns) {}

  /// The sum becomes a column of the matrix. Requires: it is empty.
  void begin(std::span<const SignedRow> column) { add_all(column, ring_.one(), no_row); }
  /// The row that leads the sum, or no_row: then it is empty.
  [[nodiscard]] Row lead() {
    if (!lead_) {
      lead_ = sum_.take();
    }
    return lead_ ? static_cast<Row>(lead_->index) : no_row;
  }
  /// Adds the multiple of a column with the same lead after which this row does not lead any more.
  void eliminate(std::span<const SignedRow> column) {
    const auto at = std::ranges::find(column, lead(), &SignedRow::row);
    add_all(column, at->is_negative() ? lead_->coefficient : ring_.negate(lead_->coefficient), lead());
    lead_.reset();
  }
  /// The same with one that has been stored.
  void eliminate(std::size_t column) {
    const std::span<const Entry> entries{pool_.data() + stored_[column].first, stored_[column].size};
    const Element factor = ring_.negate(ring_.quotient(lead_->coefficient, entries[0].coefficient));
    for (const Entry& entry : entries.subspan(1)) {
      sum_.add_product(entry.row, factor, entry.coefficient);
    }
    touched_ += entries.size();
    lead_.reset();
  }
  /// The sum is a column now, and empty. Requires: something leads it.
  void store(std::size_t column) {
    stored_[column].first = pool_.size();
    pool_.push_back({lead(), lead_->coefficient});
    while (const auto next = sum_.take()) {
      pool_.push_back({static_cast<Row>(next->index), next->coefficient});
    }
    stored_[column].size = static_cast<std::uint32_t>(pool_.size() - stored_[column].first);
    lead_.reset();
  }
  [[nodiscard]] bool has(std::size_t column) const { return stored_[column].size > 0; }
  /// Entries read so far, and those that are held.
  [[nodiscard]] std::uint64_t touched() const { return touched_; }
  [[nodiscard]] std::uint64_t held() const { return pool_.size(); }

 private:
  using Element = typename R::Element;
  struct Entry {
    Row row;
    Element coefficient;
  };
  struct Stored {
    std::uint64_t first = 0;
    std::uint32_t size = 0;
  };

  void add_all(std::span<const SignedRow> column, const Element& factor, Row but_for) {
    const Element minus = ring_.negate(factor);
    for (const SignedRow entry : column) {
      if (entry.row() != but_for) {
        sum_.add_product(entry.row(), entry.is_negative() ? minus : factor, ring_.one());
      }
    }
    touched_ += column.size();
  }

  R ring_;
  sparse::DescendingSum<R> sum_;
  std::optional<sparse::Term<R>> lead_;  ///< has been taken out of the sum
  std::vector<Stored> stored_;
  std::vector<Entry> pool_;
  std::uint64_t touched_ = 0;
};

/// Over Z/2 a bit for each row. Above them are two levels of bits that say where there may be some, which are only set
/// while columns are added: so nothing has to be decided for an entry. A column is kept as a list of rows, or as one of
/// words of 64 rows where that is shorter; long columns of coboundaries are.
/// Source: the columns of U. Bauer, M. Kerber, J. Reininghaus and H. Wagner, "PHAT" (2017).
template <>
class ReducedColumns<sparse::Z2> {
 public:
  using Row = std::uint32_t;
  static constexpr Row no_row = UINT32_MAX;

  ReducedColumns(sparse::Z2 /*ring*/, std::size_t rows, std::size_t columns) : stored_(columns) {
    std::size_t size = rows;
    for (std::vector<std::uint64_t>& level : levels_) {
      size = size / 64 + 1;
      level.resize(size, 0);
    }
  }

  void begin(std::span<const SignedRow> column) { eliminate(column); }
  [[nodiscard]] Row lead() {
    while (top_ > 0) {
      const std::size_t high = top_ - 1;
      while (levels_[2][high] != 0) {
        const std::size_t middle = highest(2, high);
        while (levels_[1][middle] != 0) {
          const std::size_t low = highest(1, middle);
          if (levels_[0][low] != 0) {
            return static_cast<Row>(highest(0, low));
          }
          clear(1, low);
        }
        clear(2, middle);
      }
      --top_;
    }
    return no_row;
  }
  void eliminate(std::span<const SignedRow> column) {
    for (const SignedRow entry : column) {
      add(entry.row() / 64, std::uint64_t{1} << (entry.row() % 64));
    }
    touched_ += column.size();
  }
  void eliminate(std::size_t column) {
    const Stored& stored = stored_[column];
    const std::uint32_t *at = pool_.data() + stored.first, *const end = at + stored.size;
    if (stored.is_of_words) {
      for (; at != end; at += words_of_entry) {
        add(at[0], std::uint64_t{at[2]} << 32 | at[1]);
      }
      touched_ += stored.size / words_of_entry;
    } else {
      for (; at != end; ++at) {
        add(*at / 64, std::uint64_t{1} << (*at % 64));
      }
      touched_ += stored.size;
    }
  }
  void store(std::size_t column) {
    words_.clear();
    std::size_t rows = 0;
    while (lead() != no_row) {
      const std::size_t low = lead() / 64;
      const std::uint64_t word = levels_[0][low];
      words_.push_back({static_cast<std::uint32_t>(low), word});
      rows += static_cast<std::size_t>(std::popcount(word));
      levels_[0][low] = 0;
    }
    Stored& stored = stored_[column];
    stored.first = pool_.size();
    stored.is_of_words = words_of_entry * words_.size() < rows;
    for (auto [low, word] : words_) {
      if (stored.is_of_words) {
        for (const std::uint64_t part : {std::uint64_t{low}, word, word >> 32}) {
          pool_.push_back(static_cast<std::uint32_t>(part));
        }
        continue;
      }
      while (word != 0) {
        const unsigned bit = 63 - static_cast<unsigned>(std::countl_zero(word));
        pool_.push_back(64 * low + bit);
        word ^= std::uint64_t{1} << bit;
      }
    }
    stored.size = static_cast<std::uint32_t>(pool_.size() - stored.first);
  }
  [[nodiscard]] bool has(std::size_t column) const { return stored_[column].size > 0; }
  [[nodiscard]] std::uint64_t touched() const { return touched_; }
  [[nodiscard]] std::uint64_t held() const { return pool_.size(); }

 private:
  static constexpr std::size_t words_of_entry = 3;
  struct Stored {
    std::uint64_t first = 0;
    std::uint32_t size = 0;
    bool is_of_words = false;
  };
  struct Word {
    std::uint32_t place;
    std::uint64_t bits;
  };

  void add(std::size_t low, std::uint64_t bits) {
    levels_[0][low] ^= bits;
    std::uint64_t& above = levels_[1][low / 64];
    const bool was_empty = above == 0;
    above |= std::uint64_t{1} << (low % 64);
    if (was_empty) {
      const std::size_t middle = low / 64, high = middle / 64;
      levels_[2][high] |= std::uint64_t{1} << (middle % 64);
      top_ = std::max(top_, high + 1);
    }
  }
  /// The highest bit of a word of a level.
  [[nodiscard]] std::size_t highest(std::size_t level, std::size_t word) const {
    return 64 * word + 63 - static_cast<std::size_t>(std::countl_zero(levels_[level][word]));
  }
  void clear(std::size_t level, std::size_t bit) { levels_[level][bit / 64] &= ~(std::uint64_t{1} << (bit % 64)); }

  std::array<std::vector<std::uint64_t>, 3> levels_;
  std::size_t top_ = 0;  ///< no word of the uppermost level from here on has a bit
  std::vector<Stored> stored_;
  sparse::GrowingArray<std::uint32_t> pool_;
  std::vector<Word> words_;  ///< memory
  std::uint64_t touched_ = 0;
};

}  // namespace sesame::engine
