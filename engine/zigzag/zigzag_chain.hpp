/// \file
/// Chains of cells that come and go: how they are held, and how they are added up.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "sparse/contract.hpp"
#include "sparse/ring.hpp"

namespace sesame::engine {

/// A cell of one dimension: how many were included before it, and its slot. So the younger cell has the larger key, and
/// a key says where the cell is.
class CellKey {
 public:
  static constexpr unsigned slot_bits = 26;
  static constexpr std::uint64_t most_slots = std::uint64_t{1} << slot_bits;
  static constexpr std::uint64_t most_ages = std::uint64_t{1} << (64 - slot_bits);

  constexpr CellKey() = default;
  constexpr CellKey(std::uint64_t age, std::uint32_t slot) : word_{age << slot_bits | slot} {}
  [[nodiscard]] constexpr std::uint32_t slot() const { return static_cast<std::uint32_t>(word_ % most_slots); }
  [[nodiscard]] constexpr std::uint64_t age() const { return word_ / most_slots; }
  friend constexpr bool operator==(CellKey, CellKey) = default;
  friend constexpr auto operator<=>(CellKey, CellKey) = default;

 private:
  std::uint64_t word_ = 0;
};

/// A term of a chain. Over Z/2 the coefficient is 1.
template <sparse::Ring R>
struct CellTerm {
  CellKey cell;
  typename R::Element coefficient;
};
template <>
struct CellTerm<sparse::Z2> {
  CellKey cell;
};

/// Terms from the youngest cell to the oldest, without zeros.
template <sparse::Ring R>
using CellChain = std::vector<CellTerm<R>>;

template <sparse::Ring R>
[[nodiscard]] typename R::Element coefficient(const R& ring, const CellTerm<R>& term) {
  if constexpr (std::is_same_v<R, sparse::Z2>) {
    return ring.one();
  } else {
    return term.coefficient;
  }
}

template <sparse::Ring R>
[[nodiscard]] CellTerm<R> cell_term(CellKey cell, [[maybe_unused]] const typename R::Element& coefficient) {
  if constexpr (std::is_same_v<R, sparse::Z2>) {
    return {cell};
  } else {
    return {cell, coefficient};
  }
}

/// The term of a cell, or null. Cost: the logarithm of the length.
template <sparse::Ring R>
[[nodiscard]] const CellTerm<R>* find_term(const CellChain<R>& chain, CellKey cell) {
  const auto at = std::ranges::lower_bound(chain, cell, std::ranges::greater{}, &CellTerm<R>::cell);
  return at != chain.end() && at->cell == cell ? &*at : nullptr;
}

/// The coefficient of a cell that the chain has.
template <sparse::Ring R>
[[nodiscard]] typename R::Element coefficient_at(const R& ring, [[maybe_unused]] const CellChain<R>& chain,
                                                 [[maybe_unused]] CellKey cell) {
  if constexpr (std::is_same_v<R, sparse::Z2>) {
    return ring.one();
  } else {
    return find_term<R>(chain, cell)->coefficient;
  }
}

/// The chain times a factor that is not 0.
template <sparse::Ring R>
[[nodiscard]] CellChain<R> scaled([[maybe_unused]] const R& ring, CellChain<R> chain,
                                  [[maybe_unused]] const typename R::Element& factor) {
  if constexpr (!std::is_same_v<R, sparse::Z2>) {
    for (CellTerm<R>& term : chain) {
      term.coefficient = ring.multiply(term.coefficient, factor);
    }
  }
  return chain;
}

/// A sum of chains that is taken apart from its youngest cell down, while more is added. A value for each slot, and the
/// cells that may have one as a heap.
template <sparse::Ring R>
class CellSum {
 public:
  using Element = typename R::Element;

  explicit CellSum(R ring) : ring_{ring} {}

  void add(CellKey cell, const Element& factor) {
    const std::uint32_t slot = cell.slot();
    if (slot >= cells_.size()) [[unlikely]] {
      cells_.resize(std::max<std::size_t>(slot + std::size_t{1}, 2 * cells_.size()), Cell{ring_.zero(), false});
    }
    Cell& at = cells_[slot];
    at.value = ring_.add(at.value, factor);
    if (!at.is_listed) {
      at.is_listed = true;
      heap_.push_back(cell);
      std::push_heap(heap_.begin(), heap_.end());
    }
  }
  void add(std::span<const CellTerm<R>> chain, const Element& factor) {
    for (const CellTerm<R>& term : chain) {
      add(term.cell, ring_.multiply(factor, coefficient(ring_, term)));
    }
  }
  /// Takes the youngest cell out, with its coefficient. False when the sum is 0.
  bool take(CellKey& cell, Element& value) {
    while (!heap_.empty()) {
      cell = heap_.front();
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
      Cell& at = cells_[cell.slot()];
      value = at.value;
      at = {ring_.zero(), false};
      if (!ring_.is_zero(value)) {
        return true;
      }
    }
    return false;
  }
  /// All that there is, times a factor; it stays there.
  [[nodiscard]] CellChain<R> terms(const Element& factor) const {
    CellChain<R> chain;
    for (const CellKey cell : heap_) {
      if (const Element& value = cells_[cell.slot()].value; !ring_.is_zero(value)) {
        chain.push_back(cell_term<R>(cell, ring_.multiply(factor, value)));
      }
    }
    std::ranges::sort(chain, std::ranges::greater{}, &CellTerm<R>::cell);
    return chain;
  }
  void clear() {
    for (const CellKey cell : heap_) {
      cells_[cell.slot()] = {ring_.zero(), false};
    }
    heap_.clear();
  }

 private:
  struct Cell {
    Element value;
    bool is_listed;
  };

  R ring_;
  std::vector<Cell> cells_;  ///< per slot
  std::vector<CellKey> heap_;
};

/// x += factor y. Calls toggle(cell) for each cell that x gains or loses. `scratch` is memory, and is never smaller
/// afterwards.
template <sparse::Ring R, class Toggle>
void add_chain(const R& ring, CellChain<R>& x, std::type_identity_t<std::span<const CellTerm<R>>> y,
               [[maybe_unused]] const typename R::Element& factor, CellChain<R>& scratch, Toggle&& toggle) {
  if (scratch.size() < x.size() + y.size()) {
    scratch.resize(2 * (x.size() + y.size()));
  }
  const CellTerm<R>*at = x.data(), *const end = at + x.size();
  const CellTerm<R>*other = y.data(), *const other_end = other + y.size();
  CellTerm<R>* into = scratch.data();
  if constexpr (std::is_same_v<R, sparse::Z2>) {
    while (at != end && other != other_end) {  // without jumps that nobody can foresee
      const CellTerm<R> own = *at, its = *other;
      *into = own.cell > its.cell ? own : its;
      into += own.cell != its.cell ? 1 : 0;
      at += own.cell >= its.cell ? 1 : 0;
      other += its.cell >= own.cell ? 1 : 0;
    }
    into = std::copy(other, other_end, into);
    std::ranges::for_each(y, [&](const CellTerm<R>& term) { toggle(term.cell); });
  } else {
    for (; other != other_end; ++other) {
      while (at != end && at->cell > other->cell) {
        *into++ = *at++;
      }
      const typename R::Element product = ring.multiply(factor, other->coefficient);
      if (at == end || at->cell != other->cell) {
        *into++ = {other->cell, product};
        toggle(other->cell);
        continue;
      }
      const typename R::Element value = ring.add(at->coefficient, product);
      if (ring.is_zero(value)) {
        toggle(at->cell);
      } else {
        *into++ = {at->cell, value};
      }
      ++at;
    }
  }
  into = std::copy(at, end, into);
  x.assign(scratch.data(), into);
}

}  // namespace sesame::engine
