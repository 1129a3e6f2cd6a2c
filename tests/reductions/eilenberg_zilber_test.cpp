#include "reductions/eilenberg_zilber.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "reductions/tensor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/complexes.hpp"
#include "tests/support/laws.hpp"

using namespace sesame;
using namespace sesame::tests;
using reductions::alexander_whitney;
using reductions::GradedMap;
using reductions::Reduction;
using reductions::shih;
using reductions::shuffles;
using reductions::SignedPair;
using reductions::TensorBasis;
using reductions::Vertices;

namespace {

/// A simplex of a product.
struct VertexPair {
  Vertices x;
  Vertices y;
  friend bool operator==(const VertexPair&, const VertexPair&) = default;
  /// Lexicographic. Not left to vectors of bytes: g++ 12 then warns of the size of its own memcmp.
  friend bool operator<(const VertexPair& a, const VertexPair& b) {
    const auto less = [](const Vertices& v, const Vertices& w) {
      return std::lexicographical_compare(v.begin(), v.end(), w.begin(), w.end(), [](int i, int j) { return i < j; });
    };
    return a.x == b.x ? less(a.y, b.y) : less(a.x, b.x);
  }
};

bool is_degenerate(const VertexPair& simplex) {
  for (std::size_t step = 0; step + 1 < simplex.x.size(); ++step) {
    if (simplex.x[step] == simplex.x[step + 1] && simplex.y[step] == simplex.y[step + 1]) {
      return true;
    }
  }
  return false;
}
bool is_degenerate(const Vertices& x) { return std::adjacent_find(x.begin(), x.end()) != x.end(); }

/// x theta: the simplex whose vertex i is the vertex theta(i) of x.
Vertices along(const Vertices& x, const Vertices& theta) {
  Vertices values;
  for (const std::uint8_t v : theta) {
    values.push_back(x.at(v));
  }
  return values;
}

VertexPair along(const VertexPair& simplex, const SignedPair& term) {
  return {along(simplex.x, term.first), along(simplex.y, term.second)};
}

/// The identity of [n], and the map [n + 1] -> [n] that takes the value i twice.
Vertices identity(int n) {
  Vertices values;
  for (int v = 0; v <= n; ++v) {
    values.push_back(static_cast<std::uint8_t>(v));
  }
  return values;
}
Vertices degeneracy(int n, int i) {
  Vertices values = identity(n);
  values.insert(values.begin() + i, static_cast<std::uint8_t>(i));
  return values;
}

/// The simplices of Delta^a x Delta^b that are not degenerate. Delta^a alone is the case b = 0.
class Simplices {
 public:
  Simplices(int a, int b) {
    std::vector<VertexPair> vertices;
    for (const std::uint8_t v : identity(a)) {
      for (const std::uint8_t w : identity(b)) {
        vertices.push_back({{v}, {w}});
      }
    }
    for (std::vector<VertexPair> next = vertices; !next.empty(); next = extended(of_degree_.back(), vertices)) {
      for (const VertexPair& simplex : next) {
        numbers_.emplace(simplex, static_cast<Index>(numbers_.size() - total_));
      }
      total_ += next.size();
      of_degree_.push_back(std::move(next));
    }
  }

  [[nodiscard]] int top() const { return static_cast<int>(of_degree_.size()) - 1; }
  [[nodiscard]] const std::vector<VertexPair>& of_degree(int p) const {
    return of_degree_.at(static_cast<std::size_t>(p));
  }
  /// The index within its degree. Requires: not degenerate.
  [[nodiscard]] Index number(const VertexPair& simplex) const { return numbers_.at(simplex); }
  [[nodiscard]] Index number(const Vertices& x) const { return number({x, Vertices(x.size(), 0)}); }

  [[nodiscard]] ChainComplex<Integers> chains() const {
    Sizes sizes;
    std::vector<std::vector<std::vector<Entry>>> boundaries;
    for (int p = 0; p <= top(); ++p) {
      sizes.push_back(static_cast<Index>(of_degree(p).size()));
      if (p > 0) {
        auto& columns = boundaries.emplace_back();
        for (const VertexPair& simplex : of_degree(p)) {
          columns.push_back(boundary(simplex));
        }
      }
    }
    return complex_of(Integers{}, sizes, boundaries);
  }

 private:
  static std::vector<VertexPair> extended(const std::vector<VertexPair>& simplices,
                                          const std::vector<VertexPair>& vertices) {
    std::vector<VertexPair> result;
    for (const auto& [x, y] : simplices) {
      for (const auto& [v, w] : vertices) {
        if (x.back() <= v[0] && y.back() <= w[0] && (x.back() < v[0] || y.back() < w[0])) {
          VertexPair& longer = result.emplace_back(VertexPair{x, y});
          longer.x.push_back(v[0]);
          longer.y.push_back(w[0]);
        }
      }
    }
    return result;
  }

  [[nodiscard]] std::vector<Entry> boundary(const VertexPair& simplex) const {
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < simplex.x.size(); ++i) {
      VertexPair face = simplex;
      face.x.erase(face.x.begin() + static_cast<std::ptrdiff_t>(i));
      face.y.erase(face.y.begin() + static_cast<std::ptrdiff_t>(i));
      entries.emplace_back(number(face), i % 2 == 0 ? 1 : -1);
    }
    return entries;
  }

  std::vector<std::vector<VertexPair>> of_degree_;
  std::map<VertexPair, Index> numbers_;
  std::size_t total_ = 0;
};

/// C(Delta^a x Delta^b) => C(Delta^a) (x) C(Delta^b) by the formulas under test.
class UniversalReduction {
 public:
  UniversalReduction(int a, int b)
      : product_(a, b),
        first_(a, 0),
        second_(b, 0),
        big_{product_.chains()},
        small_{tensor(first_.chains(), second_.chains())},
        basis_(first_.chains().sizes(), second_.chains().sizes()) {}

  [[nodiscard]] Reduction<Integers> get() const {
    std::vector<Matrix<Integers>> f;
    std::vector<Matrix<Integers>> g;
    std::vector<Matrix<Integers>> h;
    for (int n = 0; n <= big_.top(); ++n) {
      const std::vector<SignedPair> terms_of_h = shih(n);
      std::vector<std::vector<Entry>> columns_of_f;
      std::vector<std::vector<Entry>> columns_of_h;
      for (const VertexPair& simplex : product_.of_degree(n)) {
        columns_of_f.push_back(image_in_tensor(simplex));
        columns_of_h.push_back(image(simplex, terms_of_h));
      }
      f.push_back(matrix_of(Integers{}, small_.size(n), columns_of_f));
      g.push_back(matrix_of(Integers{}, big_.size(n), columns_of_g(n)));
      h.push_back(matrix_of(Integers{}, big_.size(n + 1), columns_of_h));
    }
    const Sizes& big = big_.sizes();
    const Sizes& small = small_.sizes();
    return {big_, small_, GradedMap<Integers>(Integers{}, 0, big, small, std::move(f)),
            GradedMap<Integers>(Integers{}, 0, small, big, std::move(g)),
            GradedMap<Integers>(Integers{}, 1, big, big, std::move(h))};
  }

 private:
  [[nodiscard]] std::vector<Entry> image_in_tensor(const VertexPair& simplex) const {
    std::vector<Entry> entries;
    for (const auto& [front, back] : alexander_whitney(static_cast<int>(simplex.x.size()) - 1)) {
      const Vertices x = along(simplex.x, front);
      const Vertices y = along(simplex.y, back);
      if (!is_degenerate(x) && !is_degenerate(y)) {
        const int p = static_cast<int>(x.size()) - 1;
        const int q = static_cast<int>(y.size()) - 1;
        entries.emplace_back(basis_.index(p, first_.number(x), q, second_.number(y)), 1);
      }
    }
    return entries;
  }

  [[nodiscard]] std::vector<Entry> image(const VertexPair& simplex, const std::vector<SignedPair>& terms) const {
    std::vector<Entry> entries;
    for (const SignedPair& term : terms) {
      const VertexPair target = along(simplex, term);
      if (!is_degenerate(target)) {
        entries.emplace_back(product_.number(target), term.sign);
      }
    }
    return entries;
  }

  [[nodiscard]] std::vector<std::vector<Entry>> columns_of_g(int n) const {
    std::vector<std::vector<Entry>> columns(small_.size(n));
    for (int p = std::max(0, n - second_.top()); p <= std::min(n, first_.top()); ++p) {
      const std::vector<SignedPair> terms = shuffles(p, n - p);
      for (const VertexPair& x : first_.of_degree(p)) {
        for (const VertexPair& y : second_.of_degree(n - p)) {
          columns.at(basis_.index(p, first_.number(x), n - p, second_.number(y))) = image({x.x, y.x}, terms);
        }
      }
    }
    return columns;
  }

  Simplices product_;
  Simplices first_;
  Simplices second_;
  ChainComplex<Integers> big_;
  ChainComplex<Integers> small_;
  TensorBasis basis_;
};

std::size_t binomial(int n, int k) {
  std::size_t value = 1;
  for (int i = 1; i <= k; ++i) {
    value = value * static_cast<std::size_t>(n - k + i) / static_cast<std::size_t>(i);
  }
  return value;
}

}  // namespace

TEST_CASE("Alexander-Whitney, the shuffles and Shih's homotopy obey the laws of a reduction", "[reductions][law]") {
  const int n = GENERATE(range(0, 5));
  CAPTURE(n);
  CHECK(defect_of(UniversalReduction(n, n).get()) == "");
}

TEST_CASE("the Eilenberg-Zilber laws hold for factors of different dimensions", "[reductions][law]") {
  CHECK(defect_of(UniversalReduction(1, 4).get()) == "");
  CHECK(defect_of(UniversalReduction(4, 2).get()) == "");
}

TEST_CASE("the law checks see a wrong sign of Shih's homotopy", "[reductions]") {
  Reduction<Integers> reduction = UniversalReduction(1, 1).get();
  reduction.h = -reduction.h;
  CHECK(defect_of(reduction).starts_with("g f + d h + h d = 1 fails"));
}

TEST_CASE("the formulas send degenerate chains to degenerate chains", "[reductions][law]") {
  for (int n = 0; n <= 5; ++n) {
    for (int i = 0; i <= n; ++i) {
      CAPTURE(n, i);
      const Vertices s = degeneracy(n, i);
      for (const auto& [front, back] : alexander_whitney(n + 1)) {
        REQUIRE((is_degenerate(along(s, front)) || is_degenerate(along(s, back))));
      }
      for (const SignedPair& term : shih(n + 1)) {
        REQUIRE(is_degenerate(along({s, s}, term)));
      }
      for (int q = 0; q <= 3; ++q) {
        for (const SignedPair& term : shuffles(n + 1, q)) {
          REQUIRE(is_degenerate(along({s, identity(q)}, term)));
        }
        for (const SignedPair& term : shuffles(q, n + 1)) {
          REQUIRE(is_degenerate(along({identity(q), s}, term)));
        }
      }
    }
  }
}

TEST_CASE("a triangulated square has 4 vertices, 5 edges and 2 triangles", "[reductions]") {
  const Reduction<Integers> square = UniversalReduction(1, 1).get();
  CHECK(square.big.sizes() == Sizes{4, 5, 2});
  CHECK(square.small.sizes() == Sizes{4, 4, 1});
  CHECK(shuffles(1, 1) == std::vector<SignedPair>{{1, {0, 1, 1}, {0, 0, 1}}, {-1, {0, 0, 1}, {0, 1, 1}}});
  CHECK(shih(1) == std::vector<SignedPair>{{-1, {0, 0, 1}, {0, 1, 1}}});
}

TEST_CASE("the product of simplices of dimensions p and q has binomial(p + q, p) simplices on top", "[reductions]") {
  for (int p = 0; p <= 5; ++p) {
    for (int q = 0; q <= 5; ++q) {
      CAPTURE(p, q);
      CHECK(shuffles(p, q).size() == binomial(p + q, p));
    }
  }
  const Simplices product(2, 3);
  REQUIRE(product.top() == 5);
  std::set<VertexPair> tops;
  for (const SignedPair& term : shuffles(2, 3)) {
    tops.insert({term.first, term.second});
  }
  CHECK(tops == std::set<VertexPair>(product.of_degree(5).begin(), product.of_degree(5).end()));
}

TEST_CASE("Shih's homotopy has 2^(n+1) - n - 2 terms, all different, none always degenerate", "[reductions]") {
  for (int n = 0; n <= 10; ++n) {
    CAPTURE(n);
    std::set<VertexPair> seen;
    for (const SignedPair& term : shih(n)) {
      const VertexPair pair{term.first, term.second};
      REQUIRE(pair.x.size() == static_cast<std::size_t>(n) + 2);
      REQUIRE_FALSE(is_degenerate(pair));
      REQUIRE(seen.insert(pair).second);
    }
    CHECK(seen.size() == (std::size_t{2} << n) - static_cast<std::size_t>(n) - 2);
  }
}

TEST_CASE("the Eilenberg-Zilber formulas reach the largest simplices that can be named, and refuse larger ones",
          "[reductions]") {
  CHECK(alexander_whitney(255).back().back == Vertices{255});
  CHECK(shuffles(0, 255).front().second.back() == 255);
  CHECK_THROWS_AS(alexander_whitney(-1), sparse::ContractViolation);
  CHECK_THROWS_AS(alexander_whitney(256), sparse::ContractViolation);
  CHECK_THROWS_AS(shuffles(-1, 1), sparse::ContractViolation);
  CHECK_THROWS_AS(shuffles(128, 128), sparse::ContractViolation);
  CHECK_THROWS_AS(shih(-1), sparse::ContractViolation);
  CHECK_THROWS_AS(shih(255), sparse::ContractViolation);
}

TEST_CASE("remembered Eilenberg-Zilber terms are those of the functions, and stay where they are", "[reductions]") {
  reductions::EilenbergZilberTerms terms;
  const std::vector<SignedPair>& homotopy = terms.shih(2);
  const std::vector<SignedPair>& of_square = terms.shuffles(1, 1);
  for (int n = 0; n <= 5; ++n) {
    CAPTURE(n);
    CHECK(terms.shih(n) == shih(n));
    CHECK(terms.shuffles(n, 2) == shuffles(n, 2));
    CHECK(terms.shuffles(2, n) == shuffles(2, n));
  }
  CHECK(&terms.shih(2) == &homotopy);
  CHECK(&terms.shuffles(1, 1) == &of_square);
}
