/// \file
/// Random numbers that are the same on every machine: the standard says what the engine yields, but not what the
/// distributions make of it.
#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "sparse/contract.hpp"

namespace sesame::tools {

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : engine_{seed} {}

  /// A whole number in [0, n), 0 < n < 2^32. Some are more likely than others, by less than one in 2^32 / n.
  std::uint32_t below(std::uint64_t n) {
    sparse::expects(n > 0 && n >> 32 == 0, "a draw is from one possibility at least and fewer than 2^32");
    return static_cast<std::uint32_t>(((engine_() >> 32) * n) >> 32);
  }
  /// A number in [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// Moves `count` random elements to the front, in random order.
  template <class T>
  void shuffle_to_front(std::vector<T>& elements, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      std::swap(elements[i], elements[i + below(elements.size() - i)]);
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace sesame::tools
