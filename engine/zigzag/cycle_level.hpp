/// \file
/// The cycles of one dimension along a zigzag: a basis of them, and who has which cell.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/zigzag/cell_holders.hpp"
#include "engine/zigzag/zigzag_chain.hpp"
#include "engine/zigzag/zigzag_tracker.hpp"

namespace sesame::engine {

/// A basis of the cycles of one dimension. Each has another youngest cell, with coefficient 1.
///
/// Those that are *open* are a basis of the homology; the others are boundaries, and each has its *filling*, a chain
/// of one dimension more. Fillings of one dimension and cycles of the same are a basis of all chains.
template <sparse::Ring R>
class CycleLevel {
 public:
  using Chain = CellChain<R>;
  using Number = std::uint32_t;  ///< of a cycle; used again
  static constexpr Number nobody = UINT32_MAX;

  struct Cycle {
    Chain terms, filling;
    std::int64_t rank = 0;  ///< of an open one: among those that are alive, see OnlineZigzag
    Moment birth{};
    bool is_open = false;
  };

  /// Who may have a cell: an open cycle of this level, or the filling of a cycle of the level below.
  struct Holder {
    Number number;
    bool is_filling;
  };

  /// A cycle of the basis, and how often the boundary of a new cell has it.
  struct Used {
    Number number;
    typename R::Element times;
  };

  // ---- cells
  /// A cell is there, the youngest of all.
  CellKey add_cell(std::uint32_t slot) {
    sparse::expects(slot < CellKey::most_slots && ages_ < CellKey::most_ages,
                    "fewer than 2^26 cells of a dimension at once, and fewer than 2^38 in turn");
    if (slot >= cells_.size()) {
      cells_.resize(slot + std::size_t{1});
    }
    Cell& cell = cells_[slot];
    cell.key = CellKey{ages_++, slot};
    cell.owner = nobody;
    return cell.key;
  }
  [[nodiscard]] CellKey key(std::uint32_t slot) const { return cells_[slot].key; }
  /// The cycle whose youngest cell this is, or nobody.
  [[nodiscard]] Number& owner(CellKey cell) { return cells_[cell.slot()].owner; }
  [[nodiscard]] Number& owner(const Chain& cycle) { return owner(cycle.front().cell); }

  // ---- holders
  /// A chain gains a cell or loses it. Open cycles of this level and fillings of the level below are told of.
  void toggle(CellKey cell, Holder holder) { holders_.toggle(cell.slot(), 2 * holder.number + holder.is_filling); }
  /// Makes room for holders with numbers below this.
  void reserve_holders(std::size_t numbers) { holders_.reserve(cells_.size(), 2 * numbers); }
  /// The chains that have a cell, by their numbers.
  void collect(CellKey cell, std::vector<Number>& cycles, std::vector<Number>& fillings) {
    found_.clear();
    holders_.collect(cell.slot(), found_);
    for (const Number each : found_) {
      (each % 2 == 1 ? fillings : cycles).push_back(each / 2);
    }
  }

  // ---- cycles
  [[nodiscard]] Cycle& operator[](Number number) { return cycles_[number]; }
  [[nodiscard]] const Cycle& operator[](Number number) const { return cycles_[number]; }
  Number add() {
    if (free_.empty()) {
      cycles_.emplace_back();
      return static_cast<Number>(cycles_.size() - 1);
    }
    const Number number = free_.back();
    free_.pop_back();
    return number;
  }
  void remove(Number number) {
    cycles_[number] = Cycle{};
    free_.push_back(number);
  }
  [[nodiscard]] std::size_t numbers() const { return cycles_.size(); }
  [[nodiscard]] const std::vector<Cycle>& cycles() const { return cycles_; }
  [[nodiscard]] std::uint64_t open() const { return open_; }
  /// The open ones, by the operations of their births.
  [[nodiscard]] std::vector<Number> open_by_birth() const {
    std::vector<Number> found;
    for (Number number = 0; number < cycles_.size(); ++number) {
      if (cycles_[number].is_open) {
        found.push_back(number);
      }
    }
    std::ranges::sort(found, {}, [&](Number number) { return cycles_[number].birth.operation; });
    return found;
  }
  void open(Number number, std::int64_t rank, Moment birth) {
    Cycle& cycle = cycles_[number];
    cycle.rank = rank;
    cycle.birth = birth;
    cycle.is_open = true;
    ++open_;
  }
  void close(Number number) {
    cycles_[number].is_open = false;
    --open_;
  }

 private:
  struct Cell {
    CellKey key;
    Number owner = nobody;
  };

  std::vector<Cell> cells_;  ///< per slot
  std::vector<Cycle> cycles_;
  std::vector<Number> free_, found_;
  CellHolders holders_;
  std::uint64_t ages_ = 0, open_ = 0;
};

}  // namespace sesame::engine
