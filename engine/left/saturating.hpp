/// \file
/// Sums and products of counts that may be beyond 64 bits: then they are the largest number there is.
#pragma once

#include <cstdint>
#include <limits>

namespace sesame::engine {

inline constexpr std::uint64_t uncountable = std::numeric_limits<std::uint64_t>::max();

[[nodiscard]] inline std::uint64_t saturating_sum(std::uint64_t a, std::uint64_t b) {
  std::uint64_t sum = 0;
  return __builtin_add_overflow(a, b, &sum) ? uncountable : sum;
}

[[nodiscard]] inline std::uint64_t saturating_product(std::uint64_t a, std::uint64_t b) {
  std::uint64_t product = 0;
  return __builtin_mul_overflow(a, b, &product) ? uncountable : product;
}

}  // namespace sesame::engine
