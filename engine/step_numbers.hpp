/// \file
/// The numbers of the steps that can be undone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

#include "sparse/archive.hpp"

namespace sesame::engine {

/// Numbers that ascend, most of them by one, as a list of runs. Cost of every change: O(1), amortised.
class StepNumbers {
 public:
  /// Requires: larger than those before.
  void push_back(std::uint64_t number) {
    if (!runs_.empty() && number == runs_.back().first + runs_.back().count) {
      ++runs_.back().count;
    } else {
      runs_.push_back({number, 1});
    }
  }
  /// Removes the last ones. Requires: there are so many.
  void pop_back(std::uint64_t count) {
    while (count > 0) {
      const std::uint64_t part = std::min(count, runs_.back().count);
      runs_.back().count -= part;
      count -= part;
      if (runs_.back().count == 0) {
        runs_.pop_back();
      }
    }
  }
  /// Requires: there is one.
  void pop_front() {
    ++runs_.front().first;
    if (--runs_.front().count == 0) {
      runs_.pop_front();
    }
  }
  [[nodiscard]] std::uint64_t size() const {
    std::uint64_t numbers = 0;
    for (const Run& run : runs_) {
      numbers += run.count;
    }
    return numbers;
  }
  void save(sparse::ArchiveWriter& to) const { to.put_list(runs_); }
  /// Instead of those that are there. Fails what is no list of numbers from 1 to `last`.
  void load(sparse::ArchiveReader& from, std::uint64_t last) {
    const auto runs = from.get_list<std::vector<Run>>();
    std::uint64_t before = 0;
    for (const Run& run : runs) {
      if (!from.check(run.first > before && run.count > 0 && run.first <= last && run.count <= last - run.first + 1,
                      "the numbers of steps ascend")) {
        return;
      }
      before = run.first + run.count - 1;
    }
    runs_.assign(runs.begin(), runs.end());
  }
  [[nodiscard]] std::vector<std::uint64_t> all() const {
    std::vector<std::uint64_t> numbers;
    for (const Run& run : runs_) {
      for (std::uint64_t k = 0; k < run.count; ++k) {
        numbers.push_back(run.first + k);
      }
    }
    return numbers;
  }

 private:
  struct Run {
    std::uint64_t first, count;
  };
  std::deque<Run> runs_;
};

}  // namespace sesame::engine
