/// \file
/// Many times, in 8 bytes each as long as they are doubles.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/towers/time.hpp"
#include "sparse/growing_array.hpp"

namespace sesame::engine {

/// A vector of times. The first whole number beyond 2^53 makes it twice as large.
class TimeList {
 public:
  void push_back(Time time) {
    if (are_doubles_ && !time.is_large()) [[likely]] {
      doubles_.push_back(time.nearest());
    } else {
      push_back_exact(time);
    }
  }
  [[nodiscard]] Time operator[](std::size_t at) const { return are_doubles_ ? Time{doubles_[at]} : exact_[at]; }
  [[nodiscard]] Time back() const { return operator[](size() - 1); }
  [[nodiscard]] std::size_t size() const { return are_doubles_ ? doubles_.size() : exact_.size(); }

  /// The last place from `at` on with the same time. Requires: times do not decrease from there on. Cost: the logarithm
  /// of the number of times.
  [[nodiscard]] std::size_t last_equal(std::size_t at) const {
    std::size_t last = at, beyond = size();
    while (beyond - last > 1) {
      const std::size_t middle = last + (beyond - last) / 2;
      ((*this)[middle] == (*this)[at] ? last : beyond) = middle;
    }
    return last;
  }

  /// Puts the time at one place at another too.
  void copy(std::size_t from, std::size_t to) {
    if (are_doubles_) {
      doubles_[to] = doubles_[from];
    } else {
      exact_[to] = exact_[from];
    }
  }
  /// Keeps the first ones. Requires: there are as many.
  void truncate(std::size_t size) {
    if (are_doubles_) {
      doubles_.resize(size);
    } else {
      exact_.resize(size);
    }
  }

 private:
  void push_back_exact(Time time);

  bool are_doubles_ = true;  ///< whether all are in the first of these, or in the second
  sparse::GrowingArray<double> doubles_;
  std::vector<Time> exact_;
};

}  // namespace sesame::engine
