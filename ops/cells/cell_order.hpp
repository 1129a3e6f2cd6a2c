/// \file
/// The order in which cells are listed: one that no query changes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "ops/cells/structure.hpp"

namespace sesame::ops {

/// Different current cells by dimension, those of one by the age of their oldest members. Cost: that of a sort, times
/// that of `LazyCells::is_older`; linear when there are no lazy families and not many more nodes.
void sort_by_dimension_and_age(const Structure& structure, std::vector<CellId>& cells);

/// What `cell_of` says the current cells of, by the age of their oldest members.
/// Cost: likewise; linear, and without memory, when they are in order.
template <class T, class CellOf>
void sort_by_age(const Structure& structure, std::vector<T>& all, CellOf cell_of) {
  const auto oldest = [&](const T& each) { return structure.forest().oldest(cell_of(each)); };
  const auto is_before = [&](CellId a, CellId b) { return structure.lazy().is_older(a, b); };
  CellId last = none;
  const bool is_sorted = std::all_of(all.begin(), all.end(), [&](const T& each) {
    const CellId before = std::exchange(last, oldest(each));
    return before == none || !is_before(last, before);
  });
  if (is_sorted) {
    return;
  }
  using Aged = std::pair<CellId, std::size_t>;  // the oldest member, place
  std::vector<Aged> order;
  order.reserve(all.size());
  for (const T& each : all) {
    order.emplace_back(oldest(each), order.size());
  }
  std::sort(order.begin(), order.end(), [&](const Aged& a, const Aged& b) { return is_before(a.first, b.first); });
  std::vector<T> sorted;
  sorted.reserve(all.size());
  for (const auto& [age, place] : order) {
    sorted.push_back(std::move(all[place]));
  }
  all = std::move(sorted);
}

}  // namespace sesame::ops
