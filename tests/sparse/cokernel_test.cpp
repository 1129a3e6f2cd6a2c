#include "sparse/cokernel.hpp"

#include "sparse/kernel.hpp"
#include "sparse/padic_cokernel.hpp"
#include "sparse/smith.hpp"
#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

using Columns = std::vector<Terms<Integers>>;

template <Ring R>
Terms<R> random_vector(const R& ring, Random& random, Index size) {
  RawTerms<R> terms;
  for (Index k = 0; k < size; ++k) {
    terms.push_back({k, ring.from(static_cast<int>(below(random, 41)) - 20)});
  }
  return std::move(terms).normal(ring);
}

/// Every promise of Kernel; empty when all hold. The twin: a Smith form with its transforms.
template <Ring R>
std::string broken_promise(const Matrix<R>& matrix, const Kernel<R>& kernel) {
  const R& ring = matrix.ring();
  const SmithForm<R> form = smith_form(matrix);
  const auto rank = static_cast<Index>(form.factors.size());
  if (kernel.size() != matrix.columns() - rank) {
    return "the size";
  }
  for (Index k = 0; k < kernel.size(); ++k) {
    const Terms<R> unit{{k, ring.one()}};
    const Terms<R> element = kernel.combination(unit);
    if (!matrix.apply(element).empty()) {
      return "an element is not in the kernel";
    }
    if (kernel.coordinates(element) != unit) {
      return "the coordinates of an element";
    }
    const Terms<R> other = form.right.column(rank + k);
    if (kernel.combination(kernel.coordinates(other)) != other) {
      return "an element of the kernel is no combination";
    }
  }
  return "";
}

/// Every promise of Cokernel; empty when all hold. The twin: a Smith form with its transforms.
template <Ring R>
std::string broken_promise(const Matrix<R>& matrix, const Cokernel<R>& cokernel, Random& random) {
  using Element = typename R::Element;
  const R& ring = matrix.ring();
  std::vector<Element> orders;
  std::vector<Terms<R>> generators;
  for (Index k = 0; k < cokernel.summands(); ++k) {
    const auto generator = cokernel.generator(k);
    orders.push_back(generator.order);
    generators.push_back(generator.vector);
    Terms<R> multiple;
    add_multiple<R>(ring, multiple, generator.order, generator.vector);
    if (matrix.apply(generator.bounding) != multiple) {
      return "what bounds a multiple of a generator";
    }
  }
  const SmithForm<R> form = smith_form(matrix);
  std::vector<Element> expected;
  std::copy_if(form.factors.begin(), form.factors.end(), std::back_inserter(expected),
               [&](const Element& factor) { return !ring.is_unit(factor); });
  expected.resize(expected.size() + matrix.rows() - form.factors.size(), ring.zero());
  if (orders != expected) {
    return "the orders";
  }
  const auto coefficients_of = [&](const Terms<R>& v) -> std::optional<std::vector<Element>> {
    const auto found = cokernel.class_of(v);
    Terms<R> sum = matrix.apply(found.bounding);
    for (std::size_t k = 0; k < found.coefficients.size(); ++k) {
      if (!ring.is_zero(orders[k]) && !(ring.is_zero(ring.quotient(found.coefficients[k], orders[k])) || R::is_field)) {
        return std::nullopt;
      }
      add_multiple<R>(ring, sum, found.coefficients[k], generators[k]);
    }
    return sum == v ? std::optional{found.coefficients} : std::nullopt;
  };
  std::vector<Element> zero(orders.size(), ring.zero());
  for (std::size_t k = 0; k < generators.size(); ++k) {
    std::vector<Element> unit = zero;
    unit[k] = ring.one();
    if (coefficients_of(generators[k]) != unit) {
      return "the class of a generator";
    }
  }
  for (Index j = 0; j < matrix.columns(); ++j) {
    if (coefficients_of(matrix.column(j)) != zero) {
      return "the class of a column";
    }
  }
  for (int k = 0; k < 3; ++k) {
    if (!coefficients_of(random_vector(ring, random, matrix.rows()))) {
      return "the class of a vector";
    }
  }
  return "";
}

/// A square matrix of small entries at random; the first columns are multiples of these numbers.
Columns planted(Random& random, Index size, const std::vector<int>& multiples) {
  Columns columns;
  for (Index j = 0; j < size; ++j) {
    const int factor = j < multiples.size() ? multiples[j] : 1;
    RawTerms<Integers> column;
    for (Index i = 0; i < size; ++i) {
      column.push_back({i, factor * (static_cast<int>(below(random, 19)) - 9)});
    }
    columns.push_back(std::move(column).normal(Integers{}));
  }
  return columns;
}

Matrix<Integers> matrix_of(Index rows, const Columns& columns) {
  Matrix<Integers> matrix(Integers{}, rows, 0);
  for (const auto& column : columns) {
    matrix.append_column(column);
  }
  return matrix;
}

/// With more rows and columns, and units in these: what an elimination has to find first.
Matrix<Integers> with_units(Random& random, const Columns& block, Index units) {
  const auto size = static_cast<Index>(block.size());
  Matrix<Integers> matrix(Integers{}, size + units, 0);
  for (Index j = 0; j < units; ++j) {
    RawTerms<Integers> column{{size + j, 1}};
    for (Index k = 0; k < 4; ++k) {
      column.push_back({below(random, size + j), static_cast<int>(below(random, 5)) - 2});
    }
    matrix.append_column(std::move(column).normal(Integers{}));
  }
  for (const auto& column : block) {
    RawTerms<Integers> more{column};
    for (Index k = 0; k < 2; ++k) {
      const Terms<Integers> other = matrix.column(below(random, units));
      for (const auto& term : other) {
        more.push_back(term);
      }
    }
    matrix.append_column(std::move(more).normal(Integers{}));
  }
  return matrix;
}

}  // namespace

TEMPLATE_TEST_CASE("a kernel is that of the Smith form, with coordinates", "[sparse][twin]", Integers, Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 80u))};
  const auto matrix = to_sparse(ring, random_dense(random, below(random, 14), below(random, 14), 1 + below(random, 5)));
  CHECK(broken_promise(matrix, Kernel<TestType>(matrix)) == "");
}

TEMPLATE_TEST_CASE("a cokernel is that of the Smith form, with generators and classes", "[sparse][twin]", Integers, Z2,
                   Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 80u))};
  const auto matrix = to_sparse(ring, random_dense(random, below(random, 14), below(random, 14), 1 + below(random, 5)));
  CHECK(broken_promise(matrix, Cokernel<TestType>(matrix), random) == "");
}

TEST_CASE("orders that do not divide one another are rearranged with their generators", "[sparse][twin]") {
  Random random{1};
  Dense d(5, 6);
  d(0, 0) = 4;
  d(1, 1) = -6;
  d(2, 2) = 10;
  d(3, 3) = 15;
  const auto matrix = to_sparse(Integers{}, d);
  CHECK(broken_promise(matrix, Cokernel<Integers>(matrix), random) == "");
  CHECK(Cokernel<Integers>(matrix).summands() == 4);  // 2, 30, 60 and a free one
}

TEST_CASE("columns that are independent have no kernel, whatever their elimination would end in", "[sparse][twin]") {
  Random random{GENERATE(range(0u, 6u))};
  Columns columns = planted(random, 30, {3, 5});
  for (const Index kept : {30U, 25U}) {
    columns.resize(kept);
    const auto matrix = matrix_of(30, columns);
    CHECK(Kernel<Integers>(matrix).size() == 0);
  }
  // With two that depend on the others, one of them half a combination.
  for (const int factor : {1, 2}) {
    Terms<Integers> sum;
    for (Index j = 0; j < 4; ++j) {
      add_multiple<Integers>(Integers{}, sum, factor, columns[j]);
    }
    columns.push_back(sum);
  }
  const auto matrix = matrix_of(30, columns);
  CHECK(broken_promise(matrix, Kernel<Integers>(matrix)) == "");
}

TEST_CASE("large dense blocks have the cokernel of the Smith form", "[sparse][twin]") {
  Random random{GENERATE(range(0u, 12u))};
  const std::vector<std::vector<int>> multiples{{}, {2}, {2, 6}, {3, 3, 9}, {2, 2, 2, 2}, {2, 2, 2, 2, 2, 2}};
  const Columns block = planted(random, 24 + below(random, 3), multiples[below(random, 6)]);
  const auto matrix = with_units(random, block, 20);
  CHECK(broken_promise(matrix, Cokernel<Integers>(matrix), random) == "");
  Columns singular = block;
  singular.back() = singular.front();
  const auto of_singular = with_units(random, singular, 10);
  CHECK(broken_promise(of_singular, Cokernel<Integers>(of_singular), random) == "");
}

TEST_CASE("a block with few summands is solved, with short generators, one with many is not", "[sparse]") {
  for (unsigned seed = 0; seed < 6; ++seed) {
    Random random{seed};
    const auto one = PadicCokernel::of(planted(random, 30, {}));
    REQUIRE(one);
    const auto more = PadicCokernel::of(planted(random, 30, {2, 6, 30}));
    REQUIRE(more);
    CHECK(more->orders().size() >= 3);
    for (const auto* cokernel : {&*one, &*more}) {
      const auto last = cokernel->generator(cokernel->orders().size() - 1).vector;
      CHECK(last.size() <= 3);
      CHECK(std::all_of(last.begin(), last.end(), [](const auto& term) { return term.coefficient.is_unit(); }));
    }
    CHECK_FALSE(PadicCokernel::of(planted(random, 30, {2, 2, 2, 2, 2})));
    Columns singular = planted(random, 30, {});
    singular.back() = singular.front();
    CHECK_FALSE(PadicCokernel::of(singular));
  }
  // Nothing but units.
  Columns unimodular(30);
  for (Index j = 0; j < 30; ++j) {
    unimodular[j] = j == 0 ? Terms<Integers>{{0, 1}} : Terms<Integers>{{j - 1, 7}, {j, 1}};
  }
  const auto none = PadicCokernel::of(unimodular);
  REQUIRE(none);
  CHECK(none->orders().empty());
  const auto found = none->class_of({{3, 5}});
  CHECK(found.coefficients.empty());
  CHECK(matrix_of(30, unimodular).apply(found.bounding) == Terms<Integers>{{3, 5}});
}
