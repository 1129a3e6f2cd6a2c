/// \file
/// Random construction operations that suit the present state of a structure. Same seed, same operations.
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "ops/operation.hpp"
#include "ops/structure.hpp"
#include "tests/support/random_complexes.hpp"

namespace sesame::tests {

/// What a stream of random operations should look like.
struct StreamShape {
  std::size_t most_cells = 60;  ///< from there on cells are only identified
  bool simploids = true;
  bool cones = true;
};

/// The current cells of a structure, by increasing id.
inline std::vector<ops::CellId> current_cells(const ops::Structure& structure) {
  std::vector<ops::CellId> cells;
  for (ops::CellId c = 0; c < structure.created(); ++c) {
    if (structure.is_current(c)) {
      cells.push_back(c);
    }
  }
  return cells;
}

/// One vertex, one loop "e1", and triangles that say e_k = k e1; with `closed`, a disc that says e_n = 0, so that
/// H_1 = Z/n: a Moore space. Over Z the torsion hides behind units until the last cell.
inline ops::MakeComplex multiples_of_a_loop(const std::string& name, int n, bool closed) {
  ops::MakeComplex complex{name, {{"v", {}, {}, {}}, {"e1", {}, {"v", "v"}, {}}}};
  for (int k = 2; k <= n; ++k) {
    const std::string before = "e" + std::to_string(k - 1);
    const std::string loop = "e" + std::to_string(k);
    complex.cells.push_back({loop, {}, {"v", "v"}, {}});
    complex.cells.push_back({"t" + std::to_string(k), {}, {"e1", loop, before}, {}});
  }
  if (closed) {
    complex.cells.push_back({"c", {}, {"v", "v"}, {}});
    complex.cells.push_back({"d", {}, {"c", "c", "c"}, {}});
    complex.cells.push_back({"w", {}, {"c", "e" + std::to_string(n), "c"}, {}});
  }
  return complex;
}

/// One vertex, loops, and triangles on loops drawn at random: d_0 - d_1 + d_2 = 0 for any three, so H_1 is a random
/// group, and its torsion does not lie on the surface.
inline ops::MakeComplex random_relations(const std::string& name, Random& random) {
  ops::MakeComplex complex{name, {{"v", {}, {}, {}}}};
  const int loops = random.in(1, 4);
  for (int k = 1; k <= loops; ++k) {
    complex.cells.push_back({"e" + std::to_string(k), {}, {"v", "v"}, {}});
  }
  const auto loop = [&] { return "e" + std::to_string(random.in(1, loops)); };
  for (int k = random.in(1, 6); k > 0; --k) {
    complex.cells.push_back({"t" + std::to_string(k), {}, {loop(), loop(), loop()}, {}});
  }
  return complex;
}

/// Draws operations one after the other. Each is legal in the state for which it was drawn.
class RandomSteps {
 public:
  explicit RandomSteps(unsigned seed, StreamShape shape = {}) : random_{seed}, shape_{shape} {}

  Random& random() { return random_; }

  ops::Operation next(const ops::Structure& structure) {
    const std::vector<ops::CellId> cells = current_cells(structure);
    const bool is_large = cells.size() >= shape_.most_cells;
    if (cells.empty() || (!is_large && !random_.one_in(cells.size() < shape_.most_cells / 2 ? 4 : 2))) {
      return growth(structure, cells);
    }
    return identification(structure, cells);
  }

  /// Pairs of current cells of equal types, at random.
  ops::Operation identification(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    ops::Identify identify;
    for (int pairs = random_.one_in(3) ? random_.in(2, 3) : 1; pairs > 0; --pairs) {
      const ops::CellId a = pick(cells);
      std::vector<ops::CellId> like_a;
      for (const ops::CellId b : cells) {
        if (structure.type_id(b) == structure.type_id(a) && (b != a || random_.one_in(6))) {
          like_a.push_back(b);
        }
      }
      if (!like_a.empty()) {
        identify.pairs.emplace_back(structure.name(a), structure.name(pick(like_a)));
      }
    }
    return identify;
  }

 private:
  ops::CellId pick(const std::vector<ops::CellId>& cells) {
    return cells[static_cast<std::size_t>(random_.in(0, static_cast<int>(cells.size()) - 1))];
  }

  std::string fresh_name() { return "n" + std::to_string(++names_); }

  ops::Operation growth(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    const int kind = random_.in(1, 10);
    if (kind <= 2 && shape_.simploids) {
      const std::vector<ops::CellType> types{{1, 1}, {2, 1}, {1, 2}, {1, 1, 1}, {1}, {}};
      return ops::MakeSimploid{fresh_name(), types[static_cast<std::size_t>(random_.in(0, 5))], {}};
    }
    if (kind == 3) {
      return random_relations(fresh_name(), random_);
    }
    if (kind <= 5) {
      return multiples_of_a_loop(fresh_name(), random_.in(1, 6), random_.one_in(2));
    }
    if (kind <= 7 && shape_.cones) {
      return cone(structure, cells);
    }
    return ops::MakeSimplex{fresh_name(), random_.in(0, 3), {}};
  }

  ops::Operation cone(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    std::vector<std::string> over;
    for (int wanted = cells.empty() ? 0 : random_.in(0, 3); wanted > 0; --wanted) {
      if (const ops::CellId c = pick(cells); ops::is_simplex(structure.type(c).type) && structure.dimension(c) <= 2) {
        over.emplace_back(structure.name(c));
      }
    }
    return ops::MakeCone{fresh_name(), over, {}};
  }

  Random random_;
  StreamShape shape_;
  int names_ = 0;
};

}  // namespace sesame::tests
