/// \file
/// Random complexes, reductions, equivalences and exact sequences, lawful by construction. Same seed, same object.
#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "reductions/direct_sum.hpp"
#include "reductions/elimination.hpp"
#include "reductions/exact_sequence.hpp"
#include "tests/support/complexes.hpp"

namespace sesame::tests {

using reductions::Equivalence;
using reductions::ExactSequence;
using reductions::GradedMap;
using reductions::Reduction;

/// A generator of numbers that gives the same ones with every standard library.
class Random {
 public:
  explicit Random(unsigned seed) : engine_{seed} {}
  /// A number in [low, high].
  int in(int low, int high) { return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1)); }
  bool one_in(int n) { return in(1, n) == 1; }

 private:
  std::mt19937 engine_;
};

template <Ring R>
Matrix<R> random_matrix(const R& ring, Random& random, Index rows, Index columns) {
  Matrix<R> matrix(ring, rows, columns);
  for (Index j = 0; j < columns; ++j) {
    std::vector<Entry> column;
    for (Index i = 0; i < rows; ++i) {
      if (random.one_in(3)) {
        column.emplace_back(i, random.in(-2, 2));
      }
    }
    matrix.set_column(j, terms_of(ring, column));
  }
  return matrix;
}

template <Ring R>
GradedMap<R> random_map(const R& ring, Random& random, int degree, const Sizes& source, const Sizes& target) {
  GradedMap<R> map = GradedMap<R>::zero(ring, degree, source, target);
  for (int p = 0; p < static_cast<int>(map.source().size()); ++p) {
    map.set(p, random_matrix(ring, random, map.at(p).rows(), map.at(p).columns()));
  }
  return map;
}

/// u and its inverse v.
template <Ring R>
struct Automorphism {
  GradedMap<R> u;
  GradedMap<R> v;
};

/// A product of elementary matrices and sign changes in every degree.
template <Ring R>
Automorphism<R> random_automorphism(const R& ring, Random& random, const Sizes& sizes) {
  Automorphism<R> result{GradedMap<R>::identity(ring, sizes), GradedMap<R>::identity(ring, sizes)};
  for (int p = 0; p < static_cast<int>(result.u.source().size()); ++p) {
    const Index n = reductions::size_at(sizes, p);
    Matrix<R> u = result.u.at(p);
    Matrix<R> v = result.v.at(p);
    for (Index step = 0; step < 2 * n; ++step) {
      const auto i = static_cast<Index>(random.in(0, static_cast<int>(n) - 1));
      const auto j = static_cast<Index>(random.in(0, static_cast<int>(n) - 1));
      const int factor = random.in(-1, 1);
      Matrix<R> elementary = Matrix<R>::identity(ring, n);
      Matrix<R> inverse = Matrix<R>::identity(ring, n);
      if (i == j) {
        elementary.set_column(i, terms_of(ring, {{i, -1}}));
        inverse = elementary;
      } else {
        elementary.set_column(j, terms_of(ring, {{i, factor}, {j, 1}}));
        inverse.set_column(j, terms_of(ring, {{i, -factor}, {j, 1}}));
      }
      u = elementary * u;
      v = v * inverse;
    }
    result.u.set(p, std::move(u));
    result.v.set(p, std::move(v));
  }
  return result;
}

/// C -> C' for a random change of basis of C.
template <Ring R>
Reduction<R> random_isomorphism(Random& random, const ChainComplex<R>& complex) {
  Automorphism<R> automorphism = random_automorphism(complex.ring(), random, complex.sizes());
  return reductions::isomorphism(complex, std::move(automorphism.u), std::move(automorphism.v));
}

/// The isomorphism the other way.
template <Ring R>
Reduction<R> inverted(const Reduction<R>& isomorphism) {
  return {isomorphism.small, isomorphism.big, isomorphism.g, isomorphism.f,
          GradedMap<R>::zero(isomorphism.h.ring(), 1, isomorphism.small.sizes(), isomorphism.small.sizes())};
}

/// A complex in a random basis, and its homology.
template <Ring R>
struct Sample {
  ChainComplex<R> complex;
  std::vector<AbelianGroup> groups;
};

/// What a random complex is made of, per degree: at most `free` generators without boundary, and at most `pairs` pairs
/// d b = t a with t among `orders`.
struct Parts {
  int free = 2;
  int pairs = 2;
  std::vector<int> orders = {1, 1, 1, 2, 3, 4, 5, 6};
};

/// A sum of elementary complexes in its standard basis.
template <Ring R>
Sample<R> random_elementary_complex(const R& ring, Random& random, int top, const Parts& parts) {
  const auto degrees = static_cast<std::size_t>(top) + 1;
  Sizes sizes(degrees, 0);
  std::vector<std::vector<std::vector<Entry>>> columns(degrees);
  std::vector<std::vector<Integer>> cyclic(degrees);
  for (std::size_t p = 0; p < degrees; ++p) {
    for (int k = random.in(0, parts.free); k > 0; --k) {
      ++sizes[p];
      columns[p].emplace_back();
      cyclic[p].emplace_back(0);
    }
    for (int k = p + 1 < degrees ? random.in(0, parts.pairs) : 0; k > 0; --k) {
      const int t = parts.orders[static_cast<std::size_t>(random.in(0, static_cast<int>(parts.orders.size()) - 1))];
      const bool vanishes = ring.is_zero(ring.from(std::int64_t{t}));
      columns[p + 1].push_back({{sizes[p], t}});
      columns[p].emplace_back();
      ++sizes[p];
      ++sizes[p + 1];
      cyclic[p].emplace_back(vanishes ? 0 : R::is_field ? 1 : t);
      if (vanishes) {
        cyclic[p + 1].emplace_back(0);
      }
    }
  }
  columns.erase(columns.begin());
  Sample<R> sample{complex_of(ring, sizes, columns), {}};
  cyclic.resize(static_cast<std::size_t>(sample.complex.top() + 1));
  for (const std::vector<Integer>& summands : cyclic) {
    sample.groups.push_back(reductions::group_of(summands));
  }
  return sample;
}

template <Ring R>
Sample<R> random_complex(const R& ring, Random& random, int top = 3, const Parts& parts = {}) {
  Sample<R> sample = random_elementary_complex(ring, random, top, parts);
  sample.complex = random_isomorphism(random, sample.complex).small;
  return sample;
}

/// big => some smaller complex: a change of basis, eliminations, another change of basis.
template <Ring R>
Reduction<R> random_reduction(Random& random, const ChainComplex<R>& big) {
  const Reduction<R> start = random_isomorphism(random, big);
  const Reduction<R> middle = compose(start, reductions::reduce(start.small));
  return compose(middle, random_isomorphism(random, middle.small));
}

/// Some bigger complex => small: acyclic pairs added, then a change of basis.
template <Ring R>
Reduction<R> random_expansion(Random& random, const ChainComplex<R>& small) {
  const ChainComplex<R> pairs =
      random_elementary_complex(small.ring(), random, small.top() + 1, {.free = 0, .pairs = 1, .orders = {1}}).complex;
  const Reduction<R> projection = direct_sum(reductions::identity_reduction(small), reductions::reduce(pairs));
  return compose(inverted(random_isomorphism(random, projection.big)), projection);
}

template <Ring R>
Equivalence<R> random_equivalence(Random& random, const ChainComplex<R>& object) {
  Reduction<R> left = random_expansion(random, object);
  Reduction<R> right = random_reduction(random, left.big);
  return {std::move(left), std::move(right)};
}

/// 0 -> C0 -> C1 -> C2 -> 0 with random ends, a random chi between them, and C1 in a random basis.
template <Ring R>
ExactSequence<R> random_exact_sequence(const R& ring, Random& random, int top = 2) {
  const ChainComplex<R> c0 = random_complex(ring, random, top).complex;
  const ChainComplex<R> c2 = random_complex(ring, random, top).complex;
  const GradedMap<R> k = random_map(ring, random, 0, c2.sizes(), c0.sizes());
  const GradedMap<R> d0 = differential(c0);
  const GradedMap<R> d2 = differential(c2);
  const GradedMap<R> none = GradedMap<R>::zero(ring, -1, c0.sizes(), c2.sizes());
  const Reduction<R> basis = random_isomorphism(random, complex_with(block_map(d0, d0 * k - k * d2, none, d2)));
  const GradedMap<R> one0 = identity_of(c0);
  const GradedMap<R> one2 = identity_of(c2);
  const GradedMap<R> from0 = GradedMap<R>::zero(ring, 0, c0.sizes(), c2.sizes());
  const GradedMap<R> from2 = GradedMap<R>::zero(ring, 0, c2.sizes(), c0.sizes());
  return {c0,
          basis.small,
          c2,
          basis.f * stacked(one0, from0),
          beside(from0, one2) * basis.g,
          beside(one0, from2) * basis.g,
          basis.f * stacked(from2, one2)};
}

}  // namespace sesame::tests
