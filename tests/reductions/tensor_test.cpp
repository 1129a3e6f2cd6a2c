#include "reductions/tensor.hpp"

#include "reductions/direct_sum.hpp"
#include "reductions/homology.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using reductions::homology_groups;
using reductions::kunneth;
using reductions::TensorBasis;

TEST_CASE("the basis of a tensor product lists each pair once", "[reductions]") {
  const Sizes a{2, 1, 3};
  const Sizes b{1, 2};
  const TensorBasis basis(a, b);
  CHECK(basis.sizes() == Sizes{2, 5, 5, 6});
  std::vector<std::vector<int>> seen;
  for (const Index size : basis.sizes()) {
    seen.emplace_back(size, 0);
  }
  for (int p = 0; p < 3; ++p) {
    for (int q = 0; q < 2; ++q) {
      for (Index i = 0; i < a[static_cast<std::size_t>(p)]; ++i) {
        for (Index j = 0; j < b[static_cast<std::size_t>(q)]; ++j) {
          ++seen.at(static_cast<std::size_t>(p + q)).at(basis.index(p, i, q, j));
        }
      }
    }
  }
  for (const auto& degree : seen) {
    CHECK(std::all_of(degree.begin(), degree.end(), [](int times) { return times == 1; }));
  }
}

TEST_CASE("the boundary of a product of two edges is that of a square", "[reductions]") {
  const auto edge = complex_of(Integers{}, {2, 1}, {{{{0, -1}, {1, 1}}}});
  const auto square = tensor(edge, edge);
  CHECK(square.sizes() == Sizes{4, 4, 1});
  // v0 x e, v1 x e, then e x v0, e x v1; d(e x e) = de x e - e x de.
  CHECK(square.boundary(2) == matrix_of(Integers{}, 4, {{{0, -1}, {1, 1}, {2, 1}, {3, -1}}}));
  CHECK(defect_of(square) == "");
}

TEMPLATE_TEST_CASE("tensor products of complexes, reductions and equivalences are lawful", "[reductions][law]",
                   Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 25; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto a = random_complex(ring, random, 2, {1, 1, {1, 1, 2, 3}}).complex;
    const auto b = random_complex(ring, random, 2, {1, 1, {1, 1, 2, 4}}).complex;
    REQUIRE(defect_of(tensor(a, b)) == "");
    const auto rho = tensor(random_reduction(random, a), random_reduction(random, b));
    REQUIRE(defect_of(rho) == "");
    REQUIRE(rho.big == tensor(a, b));
    const auto product = tensor(random_equivalence(random, a), random_equivalence(random, b));
    REQUIRE(defect_of(product) == "");
    REQUIRE(product.object() == tensor(a, b));
  }
}

TEMPLATE_TEST_CASE("tensor products of maps compose with Koszul's sign", "[reductions][law]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 25; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Sizes x{1, 2, 1};
    const Sizes y{2, 1, 2};
    const int k = random.in(-1, 1);
    const int l = random.in(-1, 1);
    const auto phi = random_map(ring, random, 1, x, y);
    const auto psi = random_map(ring, random, k, x, y);
    const auto phi2 = random_map(ring, random, l, y, x);
    const auto psi2 = random_map(ring, random, -1, y, x);
    // (phi2 x psi2)(phi x psi) = (-1)^{|psi2| |phi|} phi2 phi x psi2 psi
    REQUIRE(tensor(phi2, psi2) * tensor(phi, psi) == -tensor(phi2 * phi, psi2 * psi));
  }
}

TEMPLATE_TEST_CASE("direct sums of complexes, reductions and equivalences are lawful", "[reductions][law]", Integers,
                   Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 25; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto a = random_complex(ring, random);
    const auto b = random_complex(ring, random);
    const auto sum = direct_sum(random_equivalence(random, a.complex), random_equivalence(random, b.complex));
    REQUIRE(defect_of(sum) == "");
    REQUIRE(sum.object() == direct_sum(a.complex, b.complex));
    const auto groups = homology_groups(sum.object());
    for (std::size_t p = 0; p < groups.size(); ++p) {
      const auto of_a = p < a.groups.size() ? a.groups[p] : AbelianGroup{};
      const auto of_b = p < b.groups.size() ? b.groups[p] : AbelianGroup{};
      REQUIRE(groups[p] == direct_sum(of_a, of_b));
    }
  }
}

TEST_CASE("the product of two projective planes: Künneth and the tensor product agree", "[reductions]") {
  const auto plane = projective_plane(Integers{});
  const std::vector<AbelianGroup> expected{group(1), group(0, {2, 2}), group(0, {2}), group(0, {2}), group(0)};
  const auto groups = homology_groups(plane);
  CHECK(groups == std::vector<AbelianGroup>{group(1), group(0, {2}), group(0)});
  CHECK(kunneth(groups, groups) == expected);
  CHECK(homology_groups(tensor(plane, plane)) == expected);
}

TEMPLATE_TEST_CASE("Künneth's formula is the homology of the tensor product", "[reductions][law]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto a = random_complex(ring, random, 2);
    const auto b = random_complex(ring, random, 2);
    auto expected = kunneth(a.groups, b.groups);
    const auto product = tensor(a.complex, b.complex);
    expected.resize(static_cast<std::size_t>(product.top() + 1));
    REQUIRE(homology_groups(product) == expected);
  }
}
