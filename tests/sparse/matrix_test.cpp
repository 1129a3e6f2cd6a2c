#include "sparse/matrix.hpp"

#include <algorithm>

#include "sparse/matrix_text.hpp"
#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

Rest random_rest(Random& random) { return below(random, 2) == 0 ? Rest::zero : Rest::identity; }

/// A pair of a shape that is often not square.
template <Ring R>
Pair<R> any_pair(const R& ring, Random& random, Index rows, Index columns) {
  return random_pair(ring, random, rows, columns, random_rest(random), 1 + below(random, 6));
}

template <Ring R>
Terms<R> random_terms(const R& ring, Random& random, Index rows) {
  RawTerms<R> terms;
  for (Index i = 0; i < rows; ++i) {
    if (below(random, 3) == 0) {
      terms.push_back({i, ring.from(std::int64_t{below(random, 7)} - 3)});
    }
  }
  return std::move(terms).normal(ring);
}

}  // namespace

TEMPLATE_TEST_CASE("products agree with the dense twin", "[sparse][twin]", Integers, Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 200u))};
  const Index m = below(random, 9), n = below(random, 9), q = below(random, 9);
  const auto a = any_pair(ring, random, m, n), b = any_pair(ring, random, n, q);
  CHECK(difference(a.sparse * b.sparse, product(a.dense, b.dense)) == "");
}

TEMPLATE_TEST_CASE("sums, differences and multiples agree with the dense twin", "[sparse][twin]", Integers, Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 200u))};
  const Index m = below(random, 9), n = below(random, 9);
  const auto a = any_pair(ring, random, m, n), b = any_pair(ring, random, m, n);
  const std::int64_t factor = std::int64_t{below(random, 7)} - 3;
  Dense sum(m, n), minus(m, n), opposite(m, n), more(m, n), twice(m, n), scaled(m, n);
  for (std::size_t i = 0; i < sum.entries.size(); ++i) {
    const std::int64_t x = a.dense.entries[i], y = b.dense.entries[i];
    sum.entries[i] = x + y;
    minus.entries[i] = x - y;
    opposite.entries[i] = -x;
    more.entries[i] = x + factor * y;
    twice.entries[i] = 2 * x;
    scaled.entries[i] = factor * x;
  }
  CHECK(difference(a.sparse + b.sparse, sum) == "");
  CHECK(difference(a.sparse - b.sparse, minus) == "");
  CHECK(difference(-a.sparse, opposite) == "");
  auto c = a.sparse;
  c.add(ring.from(factor), b.sparse);
  CHECK(difference(c, more) == "");
  c = a.sparse;
  c.add(ring.one(), c);
  CHECK(difference(c, twice) == "");
  c = a.sparse;
  c.scale(ring.from(factor));
  CHECK(difference(c, scaled) == "");
  CHECK((a.sparse - a.sparse).is_zero());
}

TEMPLATE_TEST_CASE("transpose and application agree with the dense twin", "[sparse][twin]", Integers, Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 200u))};
  const Index m = 1 + below(random, 9), n = 1 + below(random, 9);
  const auto a = any_pair(ring, random, m, n);
  Dense turned(n, m);
  for (Index i = 0; i < m; ++i) {
    for (Index j = 0; j < n; ++j) {
      turned(j, i) = a.dense(i, j);
    }
  }
  CHECK(difference(a.sparse.transposed(), turned) == "");
  CHECK(a.sparse.transposed().rest() == a.sparse.rest());

  const Dense v = random_dense(random, n, 1);
  const auto image = a.sparse.apply(Chain<TestType>(ring, {3}, to_sparse(ring, v).column(0)), -1);
  CHECK(image.degree() == Degree{2});
  CHECK(image.terms() == to_sparse(ring, product(a.dense, v)).column(0));
}

TEMPLATE_TEST_CASE("comparison finds the first difference, however things are stored", "[sparse][twin]", Integers, Z2,
                   Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 200u))};
  const Index m = 1 + below(random, 6), n = 1 + below(random, 6);
  auto a = any_pair(ring, random, m, n);
  const auto explicit_twin = to_sparse(ring, a.dense);
  CHECK(a.sparse == explicit_twin);
  CHECK(explicit_twin == a.sparse);

  const Index column = below(random, n), row = below(random, m);
  const Term<TestType> one{row, ring.one()};
  a.sparse.add_to_column(column, ring.one(), {&one, 1});
  CHECK_FALSE(a.sparse == explicit_twin);
  const auto where = first_difference(explicit_twin, a.sparse);
  REQUIRE(where.has_value());
  CHECK(where->row == row);
  CHECK(where->column == column);
  CHECK_FALSE(Matrix<TestType>(ring, m, n) == Matrix<TestType>(ring, m, n + 1));
}

TEST_CASE("an implicit identity and an implicit zero differ in their first column", "[sparse]") {
  const Matrix<Integers> zero({}, 5, 5);
  Matrix<Integers> one = Matrix<Integers>::identity({}, 5);
  REQUIRE(first_difference(zero, one).has_value());
  CHECK(first_difference(zero, one)->column == 0);
  one.set_column(0, {});
  one.set_column(1, {});
  CHECK(first_difference(one, zero)->column == 2);
}

TEMPLATE_TEST_CASE("a matrix equals its twin through any history of changes", "[sparse][stream]", Integers, Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 12u))};
  const Rest rest = random_rest(random);
  // Columns as a dense list of optional columns: the plainest twin.
  std::vector<std::optional<Terms<TestType>>> twin(below(random, 60));
  Index rows = 12;
  Matrix<TestType> matrix(ring, rows, static_cast<Index>(twin.size()), rest);
  const auto expected = [&](Index j) {
    if (twin[j]) {
      return *twin[j];
    }
    return rest == Rest::identity && j < rows ? Terms<TestType>{{j, ring.one()}} : Terms<TestType>{};
  };
  for (int step = 0; step < 1500; ++step) {
    const auto n = static_cast<Index>(twin.size());
    const Index j = n == 0 ? 0 : below(random, n);
    const auto terms = random_terms(ring, random, rows);
    switch (n == 0 ? 4u : below(random, 8)) {
      case 0:
      case 1:
        matrix.set_column(j, terms);
        twin[j] = terms;
        break;
      case 2:
        matrix.forget_column(j);
        twin[j].reset();
        break;
      case 3:
        twin[j] = expected(j);
        add_multiple<TestType>(ring, *twin[j], ring.from(2), terms);
        matrix.add_to_column(j, ring.from(2), terms);
        // (adding nothing stores the column all the same)
        break;
      case 4:
      case 5:
        matrix.append_column(terms);
        twin.push_back(terms);
        break;
      case 6:
        if (below(random, 10) == 0) {
          const Index kept = n - below(random, std::min<Index>(n, 40));
          matrix.truncate(rows, kept);
          twin.resize(kept);
        }
        break;
      default:
        if (below(random, 20) == 0) {
          rows += 1;
          matrix.append_rows(1);
        }
    }
    REQUIRE(matrix.columns() == twin.size());
    std::size_t entries = 0;
    std::vector<Index> stored;
    bool same = true;
    for (Index k = 0; k < twin.size(); ++k) {
      same = same && matrix.column(k) == expected(k);
      if (twin[k]) {
        entries += twin[k]->size();
        stored.push_back(k);
      }
    }
    REQUIRE(same);
    REQUIRE(matrix.stored() == stored);
    REQUIRE(matrix.stored_columns() == stored.size());
    REQUIRE(matrix.stored_entries() == entries);
  }
  const Matrix<TestType> copy = matrix;
  CHECK(copy == matrix);
  Matrix<TestType> moved = std::move(matrix);
  CHECK(copy == moved);
  CHECK(matrix.columns() == 0);  // NOLINT(bugprone-use-after-move): promised to be empty
  CHECK(matrix.stored_entries() == 0);
  matrix.append_column({});
  CHECK(matrix.columns() == 1);
  matrix = std::move(moved);
  CHECK(copy == matrix);
}

TEST_CASE("a map that differs from the identity in k columns stores k columns", "[sparse]") {
  const Index n = 1'000'000'000;
  Matrix<Integers> map = Matrix<Integers>::identity({}, n);
  const Terms<Integers> column{{5, 1}, {7, -2}};
  map.set_column(999'999'999, column);
  CHECK(map.stored_columns() == 1);
  CHECK(map.nonzeros() == n + std::size_t{1});
  const auto square = map * map;  // costs what is stored
  CHECK(square.stored_columns() == 1);
  CHECK(square == map);
  const auto rest = Matrix<Integers>::identity({}, n) - map;
  CHECK(rest.rest() == Rest::zero);
  CHECK(rest.stored_columns() == 1);
  CHECK(map.transposed().stored_columns() == 3);
}

TEST_CASE("cutting back what was appended leaves what was there", "[sparse]") {
  Random random{5};
  const auto start = to_sparse(Integers{}, random_dense(random, 10, 300));
  auto matrix = start;
  std::vector<const void*> before, after;
  matrix.for_each_in_column(3, [&](const Term<Integers>& entry) { before.push_back(&entry); });
  for (int round = 0; round < 20; ++round) {
    matrix.append_rows(5);
    for (int i = 0; i < 1000; ++i) {
      matrix.append_column(random_terms(Integers{}, random, matrix.rows()));
    }
    matrix.truncate(10, 300);
    REQUIRE(matrix == start);
    REQUIRE(matrix.stored_entries() == start.stored_entries());
  }
  matrix.for_each_in_column(3, [&](const Term<Integers>& entry) { after.push_back(&entry); });
  CHECK(after == before);
}

TEST_CASE("a column longer than a block is kept whole", "[sparse]") {
  Matrix<Z2> matrix(Z2{}, 100'000, 0);
  Terms<Z2> column;
  for (Index i = 0; i < 100'000; i += 3) {
    column.push_back({i, 1});
  }
  const Terms<Z2> small{{1, 1}};
  for (int i = 0; i < 3; ++i) {
    matrix.append_column(small);
    matrix.append_column(column);
  }
  for (const Index j : {0u, 2u, 4u}) {
    CHECK(matrix.column(j) == small);
    CHECK(matrix.column(j + 1) == column);
  }
  matrix.truncate(100'000, 1);
  matrix.append_column(column);
  CHECK(matrix.column(0) == small);
  CHECK(matrix.column(1) == column);
}

TEST_CASE("matrices print for people", "[sparse]") {
  Matrix<Integers> matrix = Matrix<Integers>::identity({}, 3);
  const Terms<Integers> column{{0, -12}, {2, 1}};
  matrix.set_column(1, column);
  CHECK(to_string(matrix) ==
        "[ 1 -12 0 ]\n"
        "[ 0   0 0 ]\n"
        "[ 0   1 1 ]\n");
  Matrix<Integers> large({}, 40, 50);
  large.set_column(33, column);
  CHECK(to_string(large) == "40 x 50 over Z, zero but for:\n33: -12 e0 + e2\n");
  CHECK(to_string(Matrix<Z2>(Z2{}, 0, 3)) == "0 x 3 over Z/2\n");
}

TEST_CASE("wrong shapes and places are contract breaches", "[sparse]") {
  Matrix<Integers> a({}, 2, 3);
  const Terms<Integers> low{{2, 1}};
  CHECK_THROWS_AS(a.set_column(3, {}), ContractViolation);
  CHECK_THROWS_AS(a.set_column(0, low), ContractViolation);
  CHECK_THROWS_AS(a.append_column(low), ContractViolation);
  CHECK_THROWS_AS(a * a, ContractViolation);
  CHECK_THROWS_AS(a + Matrix<Integers>({}, 3, 2), ContractViolation);
  CHECK_THROWS_AS(a.truncate(3, 3), ContractViolation);
}
