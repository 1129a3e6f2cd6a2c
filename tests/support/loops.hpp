/// \file
/// Complexes of one vertex, loops and triangles with a prescribed first homology group.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "ops/vocabulary/operation.hpp"
#include "tests/support/cell_lists.hpp"

namespace sesame::tests {

/// One vertex, loops, and triangles: x - y + z = 0 for loops x, y, z says that y = x + z. Any finitely presented
/// abelian group is the H_1 of such a complex, and every coefficient of its relations hides behind units.
class Loops {
 public:
  explicit Loops(std::string name) : complex_{std::move(name), {{"v", {}, {}, {}}}} {
    add_loop("c");  // c = 0 by the triangle d
    add_triangle("d", "c", "c", "c");
  }

  void add_loop(const std::string& loop) { complex_.cells.push_back({loop, {}, {"v", "v"}, {}}); }
  /// x - y + z = 0.
  void add_triangle(const std::string& id, const std::string& x, const std::string& y, const std::string& z) {
    complex_.cells.push_back({id, {}, {x, y, z}, {}});
  }
  /// A new loop that is `factor` times `loop`: its name.
  std::string multiple(const std::string& loop, int factor) {
    std::string last = loop;
    for (int k = 2; k <= factor; ++k) {
      const std::string next = loop + "'" + std::to_string(++count_);
      add_loop(next);
      add_triangle("t" + next, loop, next, last);
      last = next;
    }
    return last;
  }
  /// A loop that is factor^levels times `loop`.
  std::string tower(std::string loop, int factor, int levels) {
    for (; levels > 0; --levels) {
      std::string next = "b" + std::to_string(++count_);
      add_loop(next);
      add_triangle("s" + next, "c", next, multiple(loop, factor));  // c = 0: next = the multiple
      loop = std::move(next);
    }
    return loop;
  }
  std::string negative(const std::string& loop) {
    std::string opposite = "n" + std::to_string(++count_);
    add_loop(opposite);
    add_triangle("s" + opposite, loop, "c", opposite);
    return opposite;
  }
  std::string sum(const std::string& x, const std::string& z) {
    std::string total = "p" + std::to_string(++count_);
    add_loop(total);
    add_triangle("s" + total, x, total, z);
    return total;
  }
  /// sum of factor_k times loop_k, for loops "a1", "a2", ..., is 0 from now on.
  void relate(const std::vector<int>& factors) {
    std::string total = "c";
    for (std::size_t k = 0; k < factors.size(); ++k) {
      if (factors[k] != 0) {
        const std::string part = multiple("a" + std::to_string(k + 1), std::abs(factors[k]));
        total = sum(total, factors[k] > 0 ? part : negative(part));
      }
    }
    kill(total);
  }
  void kill(const std::string& loop) { add_triangle("k" + std::to_string(++count_), "c", loop, "c"); }

  ops::MakeComplex take() { return complex_; }
  ops::MakeComplex reversed() const { return {complex_.name, tests::reversed(complex_.cells)}; }

 private:
  ops::MakeComplex complex_;
  int count_ = 0;
};

}  // namespace sesame::tests
