#include "sparse/smith.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

/// Determinant of the chosen rows and columns, by expansion along the first row.
std::int64_t minor(const Dense& a, std::vector<Index> rows, const std::vector<Index>& columns) {
  if (rows.empty()) {
    return 1;
  }
  const Index first = rows.front();
  rows.erase(rows.begin());
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    std::vector<Index> others = columns;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    sum += (k % 2 == 0 ? 1 : -1) * a(first, columns[k]) * minor(a, rows, others);
  }
  return sum;
}

std::vector<std::vector<Index>> subsets(Index n, std::size_t size) {
  std::vector<std::vector<Index>> result;
  for (std::uint32_t mask = 0; mask < (1u << n); ++mask) {
    std::vector<Index> subset;
    for (Index i = 0; i < n; ++i) {
      if ((mask >> i & 1) != 0) {
        subset.push_back(i);
      }
    }
    if (subset.size() == size) {
      result.push_back(subset);
    }
  }
  return result;
}

/// The invariant factors by definition: quotients of the gcds of all minors of one size.
std::vector<Integer> factors_by_minors(const Dense& a) {
  std::vector<Integer> factors;
  std::int64_t previous = 1;
  for (std::size_t size = 1; size <= std::min(a.rows, a.columns); ++size) {
    std::int64_t divisor = 0;
    for (const auto& rows : subsets(a.rows, size)) {
      for (const auto& columns : subsets(a.columns, size)) {
        divisor = std::gcd(divisor, minor(a, rows, columns));
      }
    }
    if (divisor == 0) {
      break;
    }
    factors.emplace_back(divisor / previous);
    previous = divisor;
  }
  return factors;
}

/// Every promise of SmithForm; empty when all hold.
template <Ring R>
std::string broken_promise(const Matrix<R>& matrix, const SmithForm<R>& form) {
  const R& ring = matrix.ring();
  const auto one = [&](Index n) { return Matrix<R>::identity(ring, n); };
  Matrix<R> diagonal(ring, matrix.rows(), matrix.columns());
  for (Index i = 0; i < form.factors.size(); ++i) {
    const Term<R> entry{i, form.factors[i]};
    diagonal.set_column(i, {&entry, 1});
    const Integer value = ring.to_integer(form.factors[i]);
    if (R::is_field ? value != Integer{1} : value.sign() <= 0) {
      return "a factor is not normal";
    }
    if (i > 0 && !divide(value, ring.to_integer(form.factors[i - 1])).remainder.is_zero()) {
      return "a factor does not divide the next";
    }
  }
  if (!(form.left * matrix * form.right == diagonal)) {
    return "left * M * right is not the diagonal";
  }
  if (!(form.left * form.left_inverse == one(matrix.rows())) ||
      !(form.left_inverse * form.left == one(matrix.rows()))) {
    return "left_inverse";
  }
  if (!(form.right * form.right_inverse == one(matrix.columns())) ||
      !(form.right_inverse * form.right == one(matrix.columns()))) {
    return "right_inverse";
  }
  return invariant_factors(matrix) == form.factors ? "" : "invariant_factors finds others";
}

/// A random matrix of determinant +-1 and its inverse, as a product of elementary ones.
template <Ring R>
std::pair<Matrix<R>, Matrix<R>> random_invertible(const R& ring, Random& random, Index n) {
  auto there = Matrix<R>::identity(ring, n), back = there;
  for (Index i = 0; n > 1 && i < 2 * n; ++i) {
    const Index from = below(random, n), to = (from + 1 + below(random, n - 1)) % n;
    auto step = Matrix<R>::identity(ring, n), undo = step;
    const Term<R> plus{to, ring.from(below(random, 2) == 0 ? 1 : -1)};
    step.add_to_column(from, ring.one(), {&plus, 1});
    undo.add_to_column(from, ring.negate(ring.one()), {&plus, 1});
    there = step * there;
    back = back * undo;
  }
  return {there, back};
}

template <Ring R>
using Complex = std::vector<Matrix<R>>;  // boundaries, d[0] first

template <Ring R>
Matrix<R> as_matrix(const R& ring, Index rows, const std::vector<std::vector<std::int64_t>>& columns) {
  Dense dense(rows, static_cast<Index>(columns.size()));
  for (Index j = 0; j < dense.columns; ++j) {
    for (Index i = 0; i < rows; ++i) {
      dense(i, j) = columns[j][i];
    }
  }
  return to_sparse(ring, dense);
}

/// Every promise of AgostonBasis; empty when all hold.
template <Ring R>
std::string broken_promise(const Complex<R>& d, const std::vector<AgostonBasis<R>>& bases) {
  const R& ring = d.front().ring();
  for (std::size_t p = 0; p < d.size(); ++p) {
    const AgostonBasis<R>& basis = bases[p];
    const std::string at = " in degree " + std::to_string(p);
    const auto rank_below = p == 0 ? 0 : invariant_factors(d[p]).size();
    Matrix<R> whole(ring, d[p].columns(), 0);
    for (const auto* part : {&basis.cycles, &basis.moving}) {
      for (const Terms<R>& element : *part) {
        whole.append_column(element);
      }
    }
    const auto factors = invariant_factors(whole);
    if (whole.columns() != whole.rows() || factors.size() != whole.rows() ||
        !std::all_of(factors.begin(), factors.end(), [&](const auto& f) { return ring.is_unit(f); })) {
      return "no basis" + at;
    }
    if (basis.moving.size() != rank_below) {
      return "too few cycles" + at;
    }
    for (const Terms<R>& cycle : basis.cycles) {
      if (!d[p].apply(cycle).empty()) {
        return "a cycle is none" + at;
      }
    }
    if (basis.orders.size() != basis.bounded_by.size() ||
        basis.orders.size() != (p + 1 < d.size() ? invariant_factors(d[p + 1]).size() : 0)) {
      return "the number of orders" + at;
    }
    for (std::size_t k = 0; k < basis.orders.size(); ++k) {
      Terms<R> multiple;
      add_multiple<R>(ring, multiple, basis.orders[k], basis.cycles[k]);
      if (d[p + 1].apply(basis.bounded_by[k]) != multiple) {
        return "order * cycle is not the boundary" + at;
      }
      if (k > 0 &&
          !divide(ring.to_integer(basis.orders[k]), ring.to_integer(basis.orders[k - 1])).remainder.is_zero()) {
        return "an order does not divide the next" + at;
      }
    }
  }
  return "";
}

/// Z^b + Z/t + ..., per degree.
struct Group {
  std::size_t betti;
  std::vector<std::int64_t> torsion;
  friend bool operator==(const Group&, const Group&) = default;
};

template <Ring R>
std::vector<Group> homology(const R& ring, const std::vector<AgostonBasis<R>>& bases) {
  std::vector<Group> groups;
  for (const auto& basis : bases) {
    Group group{basis.cycles.size() - basis.orders.size(), {}};
    for (const auto& order : basis.orders) {
      if (!ring.is_unit(order)) {
        group.torsion.push_back(ring.to_integer(order).to_int64().value());
      }
    }
    groups.push_back(group);
  }
  return groups;
}

std::vector<Group> integer_homology(const Complex<Integers>& d) {
  const auto bases = agoston_bases(d);
  CHECK(broken_promise(d, bases) == "");
  return homology(Integers{}, bases);
}

/// The boundaries of an n x n grid of squares cut into triangles whose sides are glued into a torus or a Klein bottle.
Complex<Integers> glued_grid(Index n, bool klein) {
  // Crossing the right-hand side of the square turns the vertical direction over in a Klein bottle.
  const auto vertex = [&](Index x, Index y) {
    const bool turned = klein && x >= n;
    return (x % n) * n + (turned ? (2 * n - y) % n : y % n);
  };
  const auto add = [](RawTerms<Integers>& terms, Index at, int sign) { terms.push_back({at, sign}); };
  // Edges of the grid point: right (0), up (1), along the diagonal (2) are numbered by their lower left vertex.
  const auto edge = [&](Index x, Index y, Index kind) { return 3 * vertex(x, y) + kind; };
  const Integers ring;
  Matrix<Integers> d1(ring, n * n, 3 * n * n), d2(ring, 3 * n * n, 2 * n * n);
  for (Index x = 0; x < n; ++x) {
    for (Index y = 0; y < n; ++y) {
      const std::array<std::pair<Index, Index>, 3> ends{{{x + 1, y}, {x, y + 1}, {x + 1, y + 1}}};
      for (Index kind = 0; kind < 3; ++kind) {
        RawTerms<Integers> ends_of;
        add(ends_of, vertex(ends[kind].first, ends[kind].second), 1);
        add(ends_of, vertex(x, y), -1);
        d1.set_column(edge(x, y, kind), std::move(ends_of).normal(ring));
      }
      const bool turned = klein && x + 1 == n;
      const Index side = turned ? edge(x + 1, y + 1, 1) : edge(x + 1, y, 1);
      RawTerms<Integers> lower, upper;
      add(lower, edge(x, y, 0), 1);
      add(lower, side, turned ? -1 : 1);
      add(lower, edge(x, y, 2), -1);
      add(upper, edge(x, y, 1), 1);
      add(upper, edge(x, y + 1, 0), 1);
      add(upper, edge(x, y, 2), -1);
      d2.set_column(2 * vertex(x, y), std::move(lower).normal(ring));
      d2.set_column(2 * vertex(x, y) + 1, std::move(upper).normal(ring));
    }
  }
  return {Matrix<Integers>(ring, 0, n * n), d1, d2};
}

}  // namespace

TEST_CASE("invariant factors agree with the gcds of minors", "[sparse][twin]") {
  Random random{GENERATE(range(0u, 150u))};
  const Dense dense = random_dense(random, below(random, 5), below(random, 5), 1 + below(random, 3));
  const auto form = smith_form(to_sparse(Integers{}, dense));
  CHECK(form.factors == factors_by_minors(dense));
}

TEMPLATE_TEST_CASE("a Smith form keeps all its promises", "[sparse][law]", Integers, Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 60u))};
  const auto dense = random_dense(random, below(random, 14), below(random, 14), 1 + below(random, 5));
  const auto matrix = to_sparse(ring, dense);
  CHECK(broken_promise(matrix, smith_form(matrix)) == "");
}

TEST_CASE("factors that do not divide one another are rearranged", "[sparse]") {
  const auto matrix = to_sparse(Integers{}, [] {
    Dense d(4, 5);
    d(0, 0) = 4;
    d(1, 1) = -6;
    d(2, 2) = 10;
    d(3, 3) = 15;
    return d;
  }());
  const auto form = smith_form(matrix);
  CHECK(broken_promise(matrix, form) == "");
  CHECK(form.factors == std::vector<Integer>{1, 2, 30, 60});
}

TEST_CASE("a Smith form goes beyond the machine word without losing a digit", "[sparse]") {
  Random random{3};
  Matrix<Integers> matrix({}, 12, 0);
  for (Index j = 0; j < 12; ++j) {
    Terms<Integers> column;
    for (Index i = 0; i < 12; ++i) {
      column.push_back({i, Integer{static_cast<std::int64_t>(random())} * static_cast<std::int64_t>(random())});
    }
    matrix.append_column(column);
  }
  const auto form = smith_form(matrix);
  CHECK(broken_promise(matrix, form) == "");
  CHECK(form.factors.back().is_large());
}

TEMPLATE_TEST_CASE("Agoston bases of random complexes with torsion keep all their promises", "[sparse][law]", Integers,
                   Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 25u))};
  // Diagonal blocks: in each degree `free` cycles, then cycles with orders, then the elements that bound those below.
  Complex<TestType> d;
  std::vector<Group> expected;
  std::vector<std::int64_t> orders_below;
  auto basis_below = std::pair{Matrix<TestType>(ring, 0, 0), Matrix<TestType>(ring, 0, 0)};
  Index free_below = 0;
  for (int p = 0; p < 4; ++p) {
    const Index free = below(random, 3), count = p == 3 ? 0 : below(random, 4);
    std::vector<std::int64_t> orders;
    for (Index k = 0; k < count; ++k) {
      orders.push_back(std::array<std::int64_t, 6>{1, 1, 2, 4, 12, 36}[k + below(random, 3)]);
    }
    std::sort(orders.begin(), orders.end());
    const auto moving = static_cast<Index>(orders_below.size());
    const Index size = free + count + moving;
    Matrix<TestType> diagonal(ring, basis_below.first.rows(), size);
    for (Index k = 0; k < moving; ++k) {
      RawTerms<TestType> column{{free_below + k, ring.from(orders_below[k])}};
      diagonal.set_column(free + count + k, std::move(column).normal(ring));
    }
    const auto basis = random_invertible(ring, random, size);
    d.push_back(basis_below.first * diagonal * basis.second);
    expected.push_back({free, {}});
    std::copy_if(orders.begin(), orders.end(), std::back_inserter(expected.back().torsion),
                 [](std::int64_t order) { return order != 1; });
    basis_below = basis;
    orders_below = orders;
    free_below = free;
  }
  const auto bases = agoston_bases(d);
  CHECK(broken_promise(d, bases) == "");
  const bool chain = std::all_of(expected.begin(), expected.end(), [](const Group& group) {
    return std::adjacent_find(group.torsion.begin(), group.torsion.end(), [](auto a, auto b) { return b % a != 0; }) ==
           group.torsion.end();
  });
  if (!TestType::is_field && chain) {
    CHECK(homology(ring, bases) == expected);
  }
}

TEST_CASE("known spaces have their homology", "[sparse]") {
  const Integers z;
  const Matrix<Integers> no_boundary(z, 0, 1);
  SECTION("torus, Klein bottle and projective plane from one square") {
    const Matrix<Integers> loops(z, 1, 2);
    CHECK(integer_homology({no_boundary, loops, as_matrix(z, 2, {{0, 0}})}) ==
          std::vector<Group>{{1, {}}, {2, {}}, {1, {}}});
    CHECK(integer_homology({no_boundary, loops, as_matrix(z, 2, {{2, 0}})}) ==
          std::vector<Group>{{1, {}}, {1, {2}}, {0, {}}});
    CHECK(integer_homology({no_boundary, Matrix<Integers>(z, 1, 1), as_matrix(z, 1, {{2}})}) ==
          std::vector<Group>{{1, {}}, {0, {2}}, {0, {}}});
  }
  SECTION("lens spaces") {
    for (const int n : {2, 3, 7, 12}) {
      CHECK(integer_homology({no_boundary, Matrix<Integers>(z, 1, 1), as_matrix(z, 1, {{n}}),
                              Matrix<Integers>(z, 1, 1)}) == std::vector<Group>{{1, {}}, {0, {n}}, {0, {}}, {1, {}}});
    }
  }
  SECTION("triangulated torus and Klein bottle") {
    CHECK(integer_homology(glued_grid(5, false)) == std::vector<Group>{{1, {}}, {2, {}}, {1, {}}});
    CHECK(integer_homology(glued_grid(5, true)) == std::vector<Group>{{1, {}}, {1, {2}}, {0, {}}});
  }
}

TEST_CASE("boundary matrices with hundreds of rows are reduced with their transforms", "[sparse]") {
  const auto d = glued_grid(13, true);  // 169 vertices, 507 edges, 338 triangles
  CHECK(broken_promise(d[2], smith_form(d[2])) == "");
  CHECK(invariant_factors(d[1]).size() == 168);
  CHECK(integer_homology(d) == std::vector<Group>{{1, {}}, {1, {2}}, {0, {}}});
}

TEST_CASE("complexes whose shapes do not chain up are a contract breach", "[sparse]") {
  const Integers z;
  const Complex<Integers> gap{Matrix<Integers>(z, 0, 2), Matrix<Integers>(z, 3, 1)};
  CHECK_THROWS_AS(agoston_bases(gap), ContractViolation);
}
