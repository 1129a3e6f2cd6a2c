#include "ops/cells/family_counts.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace sesame::ops {
namespace {

/// Exact for n up to 62.
std::uint64_t binomial(std::size_t n, std::size_t k) {
  std::uint64_t result = 1;
  k = std::min(k, n - k);
  for (std::size_t j = 1; j <= k; ++j) {
    const std::uint64_t common = std::gcd(result, j);  // divided first: the product need not fit
    result = result / common * ((n - k + j) / (j / common));
  }
  return result;
}

/// Adds left * right * places * choices, or more than `largest_count` where that is beyond 64 bits.
void add_product(std::uint64_t& count, std::uint64_t left, std::uint64_t right, std::uint64_t places,
                 std::uint64_t choices) {
  std::uint64_t cells = 0;
  if (__builtin_mul_overflow(left, right, &cells) || __builtin_mul_overflow(cells, places, &cells) ||
      __builtin_mul_overflow(cells, choices, &cells) || __builtin_add_overflow(count, cells, &count)) {
    count = largest_count + 1;
  }
}

}  // namespace

std::vector<std::uint64_t> cells_of_product(CellCounts lefts, CellCounts rights, bool simplicial) {
  std::vector<std::uint64_t> counts(std::max<std::size_t>(lefts.size() + rights.size(), 1) - 1, 0);
  for (std::size_t p = 0; p < lefts.size(); ++p) {
    for (std::size_t q = 0; q < rights.size(); ++q) {
      if (!simplicial) {
        add_product(counts[p + q], lefts[p], rights[q], 1, 1);
        continue;
      }
      for (std::size_t n = std::max(p, q); n <= p + q; ++n) {  // n! / ((n - p)! (n - q)! (p + q - n)!) pairs
        add_product(counts[n], lefts[p], rights[q], binomial(n, p), binomial(p, p + q - n));
      }
    }
  }
  while (!counts.empty() && counts.back() == 0) {
    counts.pop_back();
  }
  return counts;
}

void add_cells_of_cone(CellCounts base, std::vector<std::uint64_t>& cone) {
  cone.resize(std::max(cone.size(), base.size() + 1), 0);
  for (std::size_t p = 0; p < base.size(); ++p) {
    cone[p] += base[p];
    cone[p + 1] += base[p];
  }
}

}  // namespace sesame::ops
