/// \file
/// Something for each node, those that steps made and those that were only asked for.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "ops/ids.hpp"
#include "sparse/growing_array.hpp"

namespace sesame::ops {

/// Two lists, one for either kind of node. Whoever adds a node adds its entry, whoever takes it back removes it.
/// Cost of everything: O(1), without a branch.
template <class T>
class PerNode {
 public:
  [[nodiscard]] const T& operator[](CellId node) const { return of_[kind(node)][number_of(node)]; }
  [[nodiscard]] T& operator[](CellId node) { return of_[kind(node)][number_of(node)]; }
  /// The id of the next node that steps make, that is asked for.
  [[nodiscard]] CellId made() const { return static_cast<CellId>(of_[0].size()); }
  [[nodiscard]] CellId asked() const { return asked_node(static_cast<std::uint32_t>(of_[1].size())); }

  /// The entry of the next node of the kind that `node` is.
  void push_back(CellId node, T entry) { of_[kind(node)].push_back(std::move(entry)); }
  void pop_back(CellId node) { of_[kind(node)].pop_back(); }
  /// Whether there is an entry.
  [[nodiscard]] bool contains(CellId node) const { return number_of(node) < of_[kind(node)].size(); }
  /// All entries of nodes that steps made, and of those that were asked for.
  [[nodiscard]] const std::array<sparse::GrowingArray<T>, 2>& lists() const { return of_; }
  [[nodiscard]] std::array<sparse::GrowingArray<T>, 2>& lists() { return of_; }

 private:
  [[nodiscard]] static std::size_t kind(CellId node) { return std::uint32_t{node} >> 31U; }

  std::array<sparse::GrowingArray<T>, 2> of_;
};

}  // namespace sesame::ops
