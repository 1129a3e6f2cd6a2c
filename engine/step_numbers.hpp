/// \file
/// The numbers of the steps that can be undone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

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
