#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "sparse/contract.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/draws.hpp"

namespace sesame::tools {
namespace {

using Simplex = std::vector<std::string>;

/// Adds all matchings of the vertices that are left to one that is begun; one vertex may stay alone when `may_leave`.
void add_matchings(std::vector<std::uint32_t> left, const Simplex& begun, bool may_leave, ops::NameLists& all) {
  if (left.empty()) {
    all.push_back(begun);
    return;
  }
  const std::uint32_t a = left.front();
  left.erase(left.begin());
  for (std::size_t k = 0; k < left.size(); ++k) {
    std::vector<std::uint32_t> rest = left;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
    Simplex more = begun;
    more.push_back(std::to_string(a) + "-" + std::to_string(left[k]));
    add_matchings(std::move(rest), more, may_leave, all);
  }
  if (may_leave) {
    add_matchings(std::move(left), begun, false, all);
  }
}

/// The rank modulo a prime of boundaries of triangles, one after the other.
class RankOfTriangles {
 public:
  explicit RankOfTriangles(std::uint32_t vertices)
      : vertices_{vertices}, rows_(std::size_t{vertices} * vertices), vector_(rows_.size()) {}

  /// Whether the boundary of a triangle is independent of those that were.
  bool raises(const std::array<std::uint32_t, 3>& t) {
    std::fill(vector_.begin(), vector_.end(), 0);
    at(t[1], t[2]) = 1;
    at(t[0], t[2]) = prime - 1;
    at(t[0], t[1]) = 1;
    for (std::size_t k = 0; k < vector_.size(); ++k) {
      if (vector_[k] == 0) {
        continue;
      }
      if (rows_[k].empty()) {
        keep(k);
        return true;
      }
      const std::uint64_t factor = prime - vector_[k];
      for (const auto& [j, entry] : rows_[k]) {
        vector_[j] = (vector_[j] + factor * entry) % prime;
      }
    }
    return false;
  }

 private:
  static constexpr std::uint64_t prime = 2147483629;

  std::uint64_t& at(std::uint32_t i, std::uint32_t j) { return vector_[std::size_t{i} * vertices_ + j]; }
  /// The vector becomes the row of its first entry, which is made 1.
  void keep(std::size_t first) {
    std::uint64_t inverse = 1;
    for (std::uint64_t base = vector_[first], e = prime - 2; e > 0; e /= 2, base = base * base % prime) {
      inverse = e % 2 == 1 ? inverse * base % prime : inverse;
    }
    for (std::size_t j = first; j < vector_.size(); ++j) {
      if (vector_[j] != 0) {
        rows_[first].emplace_back(static_cast<std::uint32_t>(j), vector_[j] * inverse % prime);
      }
    }
  }

  std::uint32_t vertices_;
  std::vector<std::vector<std::pair<std::uint32_t, std::uint64_t>>> rows_;
  std::vector<std::uint64_t> vector_;
};

}  // namespace

Operations matching_complex(std::uint32_t n) {
  std::vector<std::uint32_t> vertices(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    vertices[k] = k;
  }
  ops::Insert insert{{}, true};
  add_matchings(std::move(vertices), {}, n % 2 == 1, insert.simplices);
  return {insert};
}

Operations chessboard_complex(std::uint32_t n) {
  std::vector<std::uint32_t> column(n);
  std::iota(column.begin(), column.end(), 0U);
  ops::Insert insert{{}, true};
  do {
    insert.simplices.begin_list();
    for (std::uint32_t row = 0; row < n; ++row) {
      insert.simplices.add(std::to_string(row) + "-" + std::to_string(column[row]));
    }
  } while (std::next_permutation(column.begin(), column.end()));
  return {insert};
}

Operations random_gluings(std::uint32_t tetrahedra, std::uint64_t seed) {
  static constexpr std::array faces{".1-2-3", ".0-2-3", ".0-1-3", ".0-1-2"};
  Operations operations;
  std::vector<std::string> sides;
  for (std::uint32_t k = 0; k < tetrahedra; ++k) {
    const std::string name = "t" + std::to_string(k);
    operations.emplace_back(ops::MakeSimplex{name, 3, {}});
    for (const char* face : faces) {
      sides.push_back(name + face);
    }
  }
  Draws(seed).shuffle_to_front(sides, sides.size());
  for (std::size_t k = 0; k + 1 < sides.size(); k += 2) {
    operations.emplace_back(ops::Identify{{{sides[k], sides[k + 1]}}});
  }
  return operations;
}

Operations acyclic_triangles(std::uint32_t vertices, std::uint64_t seed) {
  sparse::expects(vertices >= 3, "there is no triangle on fewer than three vertices");
  ops::Insert edges{{}, false};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < vertices; ++i) {
    for (std::uint32_t j = i + 1; j < vertices; ++j) {
      edges.simplices.push_back({std::to_string(i), std::to_string(j)});
      for (std::uint32_t k = j + 1; k < vertices; ++k) {
        triangles.push_back({i, j, k});
      }
    }
  }
  Draws(seed).shuffle_to_front(triangles, triangles.size());
  Operations operations{edges};
  RankOfTriangles rank(vertices);
  for (const auto& t : triangles) {
    if (rank.raises(t)) {
      operations.emplace_back(ops::Insert{{{std::to_string(t[0]), std::to_string(t[1]), std::to_string(t[2])}}});
    }
  }
  return operations;
}

}  // namespace sesame::tools
