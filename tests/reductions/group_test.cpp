#include "reductions/group.hpp"

#include "tests/support/catch.hpp"
#include "tests/support/complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using reductions::betti_numbers_modulo;
using reductions::group_of;
using reductions::kunneth;
using reductions::tor;

namespace {

AbelianGroup cyclic_sum(const std::vector<Integer>& orders) { return group_of(orders); }

}  // namespace

TEST_CASE("any list of cyclic orders has one canonical form", "[reductions]") {
  CHECK(cyclic_sum({2, 3}) == cyclic_sum({6}));
  CHECK(cyclic_sum({2, 3}).torsion == std::vector<Integer>{6});
  CHECK(cyclic_sum({4, 6}).torsion == std::vector<Integer>{2, 12});
  CHECK(cyclic_sum({6, 10, 15}).torsion == std::vector<Integer>{30, 30});
  CHECK(cyclic_sum({1, -1, 0, -4}).torsion == std::vector<Integer>{4});
  CHECK(cyclic_sum({1, -1, 0, -4}).rank == 1);
  CHECK(cyclic_sum({}).is_trivial());
}

TEST_CASE("the canonical form is exact beyond machine words", "[reductions]") {
  const Integer large = *Integer::parse("1000000000000000000000000000000");
  CHECK(cyclic_sum({large * 2, large * 3}).torsion == std::vector<Integer>{large, large * 6});
}

TEST_CASE("groups are written as people write them", "[reductions]") {
  CHECK(group(0).to_string() == "0");
  CHECK(group(1).to_string() == "Z");
  CHECK(group(2, {2}).to_string() == "Z^2 + Z/2");
  CHECK(group(1, {2, 2, 4}).to_string() == "Z + (Z/2)^2 + Z/4");
  CHECK(group(0, {3, 3}).to_string() == "(Z/3)^2");
  CHECK(group(3).to_string("Z/2") == "(Z/2)^3");
  CHECK(group(1).to_string("Z/5") == "Z/5");
}

TEST_CASE("tensor products and Tor of cyclic groups are cyclic of the greatest common divisor", "[reductions]") {
  CHECK(tensor(group(0, {4}), group(0, {6})) == group(0, {2}));
  CHECK(tor(group(0, {4}), group(0, {6})) == group(0, {2}));
  CHECK(tensor(group(0, {3}), group(0, {2})).is_trivial());
  CHECK(tensor(group(2, {2}), group(1, {4})) == group(2, {4, 4, 2, 2}));
  CHECK(tor(group(5, {2}), group(7)).is_trivial());
  CHECK(direct_sum(group(1, {2}), group(2, {3})) == group(3, {6}));
}

TEST_CASE("Künneth's formula keeps a Tor above the last degree", "[reductions]") {
  const std::vector<AbelianGroup> cyclic{group(0, {2})};
  CHECK(kunneth(cyclic, cyclic) == std::vector<AbelianGroup>{group(0, {2}), group(0, {2})});
  CHECK(kunneth({}, cyclic).empty());
  const std::vector<AbelianGroup> circle{group(1), group(1)};
  CHECK(kunneth(circle, circle) == std::vector<AbelianGroup>{group(1), group(2), group(1)});
}

TEST_CASE("universal coefficients count p-torsion twice, one degree apart", "[reductions]") {
  const std::vector<AbelianGroup> groups{group(1), group(1, {6}), group(0, {3}), group(1)};
  CHECK(betti_numbers_modulo(groups, 2) == std::vector<Index>{1, 2, 1, 1});
  CHECK(betti_numbers_modulo(groups, 3) == std::vector<Index>{1, 2, 2, 2});
  CHECK(betti_numbers_modulo(groups, 5) == std::vector<Index>{1, 1, 0, 1});
  CHECK(betti_numbers_modulo(std::vector<AbelianGroup>{group(0, {2})}, 2) == std::vector<Index>{1, 1});
}
