#include <algorithm>
#include <array>

#include "sparse/contract.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/tilings.hpp"

namespace sesame::tools {
namespace {

std::uint32_t power(std::uint32_t base, int exponent) {
  std::uint32_t result = 1;
  for (; exponent > 0; --exponent) {
    result *= base;
  }
  return result;
}

/// Whether no level of the sponge takes this cube away: at none is it in the middle along two axes or three.
bool is_in_sponge(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  for (; x + y + z > 0; x /= 3, y /= 3, z /= 3) {
    if ((x % 3 == 1) + (y % 3 == 1) + (z % 3 == 1) >= 2) {
      return false;
    }
  }
  return true;
}

}  // namespace

Operations menger_sponge(int level, Assembly assembly) {
  sparse::expects(level >= 0 && level <= 4, "a sponge to measure with has level 0 to 4");
  const std::uint32_t n = power(3, level);
  const auto side = [n](std::uint32_t axis, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return ((std::uint64_t{axis} * (n + 1) + x) * (n + 1) + y) * (n + 1) + z;
  };
  Tiling tiling{{1, 1, 1}, {}};
  for (std::uint32_t x = 0; x < n; ++x) {
    for (std::uint32_t y = 0; y < n; ++y) {
      for (std::uint32_t z = 0; z < n; ++z) {
        if (is_in_sponge(x, y, z)) {
          tiling.sides.push_back({side(0, x + 1, y, z), side(0, x, y, z), side(1, x, y + 1, z), side(1, x, y, z),
                                  side(2, x, y, z + 1), side(2, x, y, z)});
        }
      }
    }
  }
  return assembled(tiling, assembly);
}

std::int64_t menger_tunnels(int level) {
  return (21 * std::int64_t{power(20, level)} + 38 * std::int64_t{power(8, level)} - 59) / 133;
}

Operations freudenthal_torus(std::uint32_t n, Assembly assembly) {
  sparse::expects(n >= 1, "a 3-torus has a cube at least");
  // A simplex goes up from its lowest vertex in steps, each along one axis or several, as bits.
  const auto triangle = [n](std::array<std::uint32_t, 3> at, std::uint32_t step, std::uint32_t next) {
    return (((std::uint64_t{at[0] % n} * n + at[1] % n) * n + at[2] % n) * 8 + step) * 8 + next;
  };
  Tiling tiling{{3}, {}};
  for (std::uint32_t cube = 0; cube < n * n * n; ++cube) {
    const std::array<std::uint32_t, 3> lowest{cube / (n * n), cube / n % n, cube % n};
    std::array<std::uint32_t, 3> axes{0, 1, 2};
    do {
      const std::uint32_t a = 1U << axes[0], b = 1U << axes[1], c = 1U << axes[2];
      std::array<std::uint32_t, 3> second = lowest;
      ++second[axes[0]];
      tiling.sides.push_back(
          {triangle(second, b, c), triangle(lowest, a | b, c), triangle(lowest, a, b | c), triangle(lowest, a, b)});
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  return assembled(tiling, assembly);
}

}  // namespace sesame::tools
