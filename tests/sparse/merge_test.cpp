#include <cstdint>
#include <string>

#include "sparse/matrix_bodies.hpp"
#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

/// How often any element was looked at, copied, moved or assigned.
std::size_t touched = 0;

/// An integer that reports every use.
struct Watched {
  std::int64_t value = 0;
  Watched() = default;
  Watched(std::int64_t v) : value{v} {}  // NOLINT(google-explicit-constructor)
  Watched(const Watched& other) : value{other.value} { ++touched; }
  Watched& operator=(const Watched& other) {
    value = other.value;
    ++touched;
    return *this;
  }
  ~Watched() = default;
  friend bool operator==(const Watched& a, const Watched& b) {
    ++touched;
    return a.value == b.value;
  }
};

/// The integers, watched.
struct WatchedRing {
  using Element = Watched;
  static constexpr bool is_field = false;
  Element zero() const { return 0; }
  Element one() const { return 1; }
  Element from(std::int64_t n) const { return n; }
  Element from(const Integer& n) const { return n.to_int64().value(); }
  Integer to_integer(const Element& a) const { return a.value; }
  Element add(const Element& a, const Element& b) const { return a.value + b.value; }
  Element subtract(const Element& a, const Element& b) const { return a.value - b.value; }
  Element negate(const Element& a) const { return -a.value; }
  Element multiply(const Element& a, const Element& b) const { return a.value * b.value; }
  void add_product(Element& acc, const Element& a, const Element& b) const { acc.value += a.value * b.value; }
  bool is_zero(const Element& a) const {
    ++touched;
    return a.value == 0;
  }
  bool is_unit(const Element& a) const { return a.value == 1 || a.value == -1; }
  Element inverse(const Element& a) const { return a; }
  Element quotient(const Element& a, const Element& b) const { return a.value / b.value; }
  std::uint32_t characteristic() const { return 0; }
  std::string name() const { return "watched Z"; }
  friend bool operator==(const WatchedRing&, const WatchedRing&) = default;
};
static_assert(Ring<WatchedRing>);

using WatchedMatrix = Matrix<WatchedRing>;

Terms<WatchedRing> column_of(Index rows, Index first, Index step) {
  Terms<WatchedRing> terms;
  for (Index i = first; i < rows; i += step) {
    terms.push_back({i, std::int64_t{i} + 1});
  }
  return terms;
}

WatchedMatrix filled(Index rows, Index columns, Index step) {
  WatchedMatrix matrix(WatchedRing{}, rows, 0);
  for (Index j = 0; j < columns; ++j) {
    matrix.append_column(column_of(rows, j % step, step));
  }
  return matrix;
}

/// A matrix that stores a single column.
WatchedMatrix one_column(Index rows, Index columns, Index j) {
  WatchedMatrix matrix(WatchedRing{}, rows, columns);
  matrix.set_column(j, column_of(rows, 0, 1));
  return matrix;
}

const void* first_entry(const WatchedMatrix& matrix, Index column) {
  const void* first = nullptr;
  matrix.for_each_in_column(column, [&](const Term<WatchedRing>& entry) { first = first ? first : &entry; });
  return first;
}

/// The number of uses of elements that merging a small B, C and D into a large A takes.
std::size_t uses_in_merge(Index rows_of_a, Index columns_of_a) {
  WatchedMatrix a = filled(rows_of_a, columns_of_a, 5);
  WatchedMatrix b(WatchedRing{}, rows_of_a, 2);
  b.set_column(1, column_of(10, 0, 1));
  const WatchedMatrix c = one_column(3, columns_of_a, 7), d = one_column(3, 2, 0);
  const void* before = first_entry(a, 7);
  const std::size_t entries = a.stored_entries();
  touched = 0;
  const MergeWork work = a.merge(b, c, d);
  const std::size_t uses = touched;
  CHECK(work.entries_of_a == 0);
  CHECK(work.entries_written == 10 + 3 + 3);
  CHECK(a.stored_entries() == entries + 16);
  CHECK(first_entry(a, 7) == before);
  return uses;
}

}  // namespace

TEMPLATE_TEST_CASE("a merge agrees with the dense twin", "[sparse][twin]", Integers, Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 300u))};
  const auto any_rest = [&] { return below(random, 3) == 0 ? Rest::identity : Rest::zero; };
  const Index m = below(random, 7), n = below(random, 3) == 0 ? m : below(random, 7);
  auto a = random_pair(ring, random, m, n, below(random, 2) == 0 ? Rest::identity : Rest::zero, 1 + below(random, 4));
  for (int round = 0; round < 4; ++round) {
    const Index p = below(random, 4), q = below(random, 2) == 0 ? p : below(random, 4);
    const Index rows = a.dense.rows, columns = a.dense.columns;
    const auto b = random_pair(ring, random, rows, q, any_rest(), 3);
    const auto c = random_pair(ring, random, p, columns, any_rest(), 3);
    const auto d = random_pair(ring, random, p, q, below(random, 2) == 0 ? Rest::identity : Rest::zero, 3);
    Dense whole(rows + p, columns + q);
    for (Index i = 0; i < rows + p; ++i) {
      for (Index j = 0; j < columns + q; ++j) {
        const bool low = i >= rows, right = j >= columns;
        const Dense& block = low ? (right ? d.dense : c.dense) : (right ? b.dense : a.dense);
        whole(i, j) = block(low ? i - rows : i, right ? j - columns : j);
      }
    }
    const auto copy = blocks(a.sparse, b.sparse, c.sparse, d.sparse);
    const MergeWork work = a.sparse.merge(b.sparse, c.sparse, d.sparse);
    a.dense = whole;
    REQUIRE(difference(a.sparse, whole) == "");
    CHECK(copy == a.sparse);
    CHECK(work.entries_written <= b.sparse.nonzeros() + c.sparse.nonzeros() + d.sparse.nonzeros());
    CHECK(work.entries_of_a <= c.sparse.nonzeros());
  }
  const auto repacked = a.sparse;  // a copy joins the segments of each column
  CHECK(repacked == a.sparse);
  a.sparse.scale(ring.from(3));
  CHECK(a.sparse - repacked - repacked - repacked == Matrix<TestType>(ring, a.dense.rows, a.dense.columns));
}

TEMPLATE_TEST_CASE("columns of several segments change like any others", "[sparse][stream]", Integers, Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 60u))};
  auto a = random_pair(ring, random, 5, 8, Rest::zero, 1);
  for (int step = 0; step < 60; ++step) {
    const Index rows = a.dense.rows, columns = a.dense.columns, j = below(random, columns);
    const Dense column = random_dense(random, rows, 1);
    const auto terms = to_sparse(ring, column).column(0);
    const Index action = below(random, 6);
    if (action < 3) {  // hang a row below everything
      const Dense c = random_dense(random, 1, columns, 2);
      a.sparse.merge(Matrix<TestType>(ring, rows, 0), to_sparse(ring, c), Matrix<TestType>(ring, 1, 0));
      a.dense.rows += 1;
      a.dense.entries.insert(a.dense.entries.end(), c.entries.begin(), c.entries.end());
    } else if (action == 3) {
      a.sparse.add_to_column(j, ring.from(2), terms);
    } else if (action == 4) {
      a.sparse.set_column(j, terms);
    } else {
      a.sparse.forget_column(j);
    }
    for (Index i = 0; i < rows && action >= 3; ++i) {
      const std::int64_t old = a.dense(i, j);
      a.dense(i, j) = action == 3 ? old + 2 * column(i, 0) : (action == 4 ? column(i, 0) : 0);
    }
    REQUIRE(difference(a.sparse, a.dense) == "");
    REQUIRE(a.sparse.stored_entries() == a.sparse.nonzeros());
  }
  a.sparse.truncate(a.dense.rows, 3);
  Dense kept(a.dense.rows, 3);
  for (Index i = 0; i < kept.rows; ++i) {
    for (Index j = 0; j < 3; ++j) {
      kept(i, j) = a.dense(i, j);
    }
  }
  CHECK(difference(a.sparse, kept) == "");
  a.sparse.truncate(0, 0);
  CHECK(a.sparse.stored_entries() == 0);
}

TEST_CASE("a merge neither copies nor reads the entries of A", "[sparse]") {
  const std::size_t small = uses_in_merge(20, 20);      // A has 80 entries
  const std::size_t large = uses_in_merge(2000, 2000);  // A has 800,000
  CHECK(small == large);
  CHECK(large <= 4 * 16);  // each of the 16 entries that are written is copied a fixed number of times
}

TEST_CASE("hanging C below many times leaves the entries where they are", "[sparse]") {
  WatchedMatrix a = filled(100, 50, 3);
  std::vector<const void*> before;
  for (Index j = 0; j < 50; ++j) {
    before.push_back(first_entry(a, j));
  }
  Terms<WatchedRing> expected = a.column(9);
  for (Index round = 0; round < 3000; ++round) {
    const WatchedMatrix b(WatchedRing{}, a.rows(), 1), d(WatchedRing{}, 2, 1);
    const WatchedMatrix c = one_column(2, a.columns(), 9);
    expected.push_back({a.rows(), 1});
    expected.push_back({a.rows() + 1, 2});
    touched = 0;
    a.merge(b, c, d);
    REQUIRE(touched <= 8);
  }
  CHECK(a.column(9) == expected);
  for (Index j = 0; j < 50; ++j) {
    CHECK(first_entry(a, j) == before[j]);
  }
}

TEST_CASE("identities merge into an identity that stores only what differs", "[sparse]") {
  const Index n = 1'000'000, q = 1000;
  Matrix<Integers> a = Matrix<Integers>::identity({}, n);
  Matrix<Integers> c({}, q, n);
  const Terms<Integers> column{{0, 1}, {1, -1}};
  c.set_column(123'456, column);
  const MergeWork work = a.merge(Matrix<Integers>({}, n, q), c, Matrix<Integers>::identity({}, q));
  CHECK(work.entries_of_a == 1);
  CHECK(work.entries_written == 2);
  CHECK(a.rest() == Rest::identity);
  CHECK(a.stored_columns() == 1);
  CHECK(a.nonzeros() == n + q + 2);
  CHECK(a.column(123'456) == Terms<Integers>{{123'456, 1}, {n, 1}, {n + 1, -1}});
}

TEST_CASE("blocks that do not fit are a contract breach", "[sparse]") {
  Matrix<Integers> a({}, 2, 3);
  const Matrix<Integers> b({}, 2, 1), c({}, 4, 3), d({}, 4, 1);
  CHECK_THROWS_AS(a.merge(c, b, d), ContractViolation);
  CHECK_THROWS_AS(a.merge(b, c, b), ContractViolation);
  CHECK_THROWS_AS(a.merge(a, c, d), ContractViolation);
  CHECK(a.columns() == 3);
}
