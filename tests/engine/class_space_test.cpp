// Classes that die one after the other, beside vectors modulo the span of relations.
#include "engine/towers/class_space.hpp"

#include <algorithm>
#include <bitset>
#include <cstdlib>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/ranks.hpp"

namespace sesame {
namespace {

using engine::ClassRef;
using engine::ClassSpace;
using tests::DenseRow;

constexpr std::size_t most_classes = 24;

template <class R>
class Twins {
 public:
  Twins(R ring, std::int64_t p, std::uint32_t seed) : space{ring}, ring_{ring}, p_{p}, random_{seed} {}

  void add() {
    if (classes_ < most_classes) {
      const auto node = space.add(static_cast<double>(classes_));
      CHECK(node == values_.size());
      values_.emplace_back(most_classes, 0);
      values_.back()[classes_++] = 1;
    }
  }

  /// Makes a sum of some nodes, and checks what it is; then it dies, or becomes a node, or is forgotten.
  void sum() {
    space.clear_sum();
    DenseRow value(most_classes, 0);
    for (auto terms = random_() % 4; terms > 0 && !values_.empty(); --terms) {
      const auto node = static_cast<std::uint32_t>(random_() % values_.size());
      const bool is_negative = random_() % 2 == 0;
      space.add_to_sum(node, is_negative);
      add_multiple(value, is_negative ? -1 : 1, values_[node]);
    }
    check_sum(value);
    if (space.sum_is_zero()) {
      return;
    }
    if (random_() % 2 == 0) {
      const auto youngest = space.sum().front().node;
      CHECK(space.kill_sum() == youngest);
      CHECK_FALSE(space.is_alive(youngest));
      relations_.push_back(value);
    } else {
      CHECK(space.keep_sum() == values_.size());
      values_.push_back(value);
    }
  }

  /// Only some references stay.
  void retire() {
    std::vector<ClassRef> refs;
    std::vector<DenseRow> referred;
    for (std::uint32_t k = 0; k < 5 && !values_.empty(); ++k) {
      const auto node = static_cast<std::uint32_t>(random_() % values_.size());
      refs.emplace_back(node, k % 2 == 0);
      referred.emplace_back(most_classes, 0);
      add_multiple(referred.back(), k % 2 == 0 ? -1 : 1, values_[node]);
    }
    const std::size_t alive = space.alive();
    const auto number = space.retire(refs);
    REQUIRE(number.size() == values_.size());
    std::vector<DenseRow> values(space.nodes());
    std::size_t stay = 0;
    for (std::size_t node = 0; node < number.size(); ++node) {
      if (number[node] != ClassSpace<R>::no_node) {
        CHECK(number[node] == stay++);
        values[number[node]] = values_[node];
      }
    }
    CHECK(stay == space.nodes());
    CHECK(space.alive() == alive);
    values_ = std::move(values);
    for (std::size_t k = 0; k < refs.size(); ++k) {
      if (!refs[k].is_zero()) {
        add_multiple(referred[k], refs[k].is_negative() ? 1 : -1, values_[refs[k].node()]);
      }
      CHECK(is_relation(referred[k]));
    }
  }

  void check() const {
    CHECK(space.alive() == classes_ - tests::rank_modulo(relations_, p_));
    std::size_t alive = 0;
    double last_birth = -1;
    for (std::uint32_t node = 0; node < space.nodes(); ++node) {
      if (space.is_alive(node)) {
        ++alive;
        CHECK(space.birth(node) > last_birth);
        last_birth = space.birth(node).nearest();
        CHECK(values_[node][static_cast<std::size_t>(last_birth)] == 1);
      }
    }
    CHECK(alive == space.alive());
  }

  ClassSpace<R> space;

 private:
  void add_multiple(DenseRow& row, std::int64_t factor, const DenseRow& other) const {
    for (std::size_t k = 0; k < row.size(); ++k) {
      row[k] = ((row[k] + factor * other[k]) % p_ + p_) % p_;
    }
  }
  [[nodiscard]] bool is_relation(const DenseRow& row) const {
    std::vector<DenseRow> more = relations_;
    more.push_back(row);
    return tests::rank_modulo(more, p_) == tests::rank_modulo(relations_, p_);
  }
  [[nodiscard]] std::int64_t coefficient(const engine::ClassTerm<R>& term) const {
    if constexpr (std::is_same_v<R, sparse::Z2>) {
      return 1;
    } else {
      return ring_.to_integer(term.coefficient).modulo(static_cast<std::uint32_t>(p_));
    }
  }

  void check_sum(DenseRow value) const {
    CHECK(space.sum_is_zero() == is_relation(value));
    std::uint32_t above = UINT32_MAX;
    for (const auto& term : space.sum()) {
      CHECK(term.node < above);
      above = term.node;
      REQUIRE(space.is_alive(term.node));
      add_multiple(value, -coefficient(term), values_[term.node]);
    }
    CHECK(is_relation(value));
  }

  R ring_;
  std::int64_t p_;
  std::mt19937 random_;
  std::size_t classes_ = 0;
  std::vector<DenseRow> values_;     ///< per node, in the classes that were added
  std::vector<DenseRow> relations_;  ///< the sums that were killed
};

template <class R>
void check_random_steps(R ring, std::int64_t p, std::uint32_t seed) {
  Twins<R> twins(ring, p, seed);
  std::mt19937 random{seed + 1000};
  for (int step = 0; step < 150; ++step) {
    CAPTURE(step);
    const auto what = random() % 12;
    if (what < 3) {
      twins.add();
    } else if (what == 3) {
      twins.retire();
    } else {
      twins.sum();
    }
    twins.check();
  }
}

// What is wrong there is seen by the undefined-behaviour sanitizer.
TEST_CASE("a class that another was, and that dies, leaves that one no place in a pool without terms", "[engine]") {
  ClassSpace<sparse::Z2> space{sparse::Z2{}};
  space.add(0.0);
  const auto survivor = space.add(1.0), other = space.add(2.0);
  space.clear_sum();
  space.add_to_sum(survivor, false);
  space.add_to_sum(other, false);
  REQUIRE(space.kill_sum() == other);  // which is the survivor now
  space.clear_sum();
  space.add_to_sum(survivor, false);
  REQUIRE(space.kill_sum() == survivor);
  for (int k = 0; k < 2; ++k) {
    space.clear_sum();
    space.add_to_sum(other, false);
    CHECK(space.sum_is_zero());
  }
}

TEST_CASE("sums of classes are what the sums that were killed leave of them", "[engine][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  check_random_steps(sparse::Z2{}, 2, seed);
  check_random_steps(std::get<sparse::Zp>(sparse::parse_ring("Z/5").value()), 5, seed);
}

TEST_CASE("over Z/2 long sums, and few terms far apart, are what rewriting everything at once gives",
          "[engine][tower]") {
  constexpr std::uint32_t classes = 500;
  using Bits = std::bitset<classes>;
  ClassSpace<sparse::Z2> space{sparse::Z2{}};
  for (std::uint32_t k = 0; k < classes; ++k) {
    space.add(k);
  }
  std::vector<Bits> values(classes);
  for (std::uint32_t k = 0; k < classes; ++k) {
    values[k].set(k);
  }
  std::mt19937 random{GENERATE(1u, 2u, 3u)};
  std::size_t longest = 0;
  for (int step = 0; step < 1500; ++step) {
    CAPTURE(step);
    const auto most = step % 3 == 0 ? 12U : 3U;
    Bits expected;
    space.clear_sum();
    for (auto terms = 1 + random() % most; terms > 0; --terms) {
      const auto node = static_cast<std::uint32_t>(random() % classes);
      space.add_to_sum(node, false);
      expected ^= values[node];
    }
    Bits sum;
    for (const auto& term : space.sum()) {
      REQUIRE_FALSE(sum[term.node]);
      sum.set(term.node);
    }
    REQUIRE(sum == expected);
    longest = std::max(longest, sum.count());
    if (!sum.none() && space.alive() > 100) {
      const std::uint32_t dead = space.kill_sum();
      for (Bits& value : values) {
        if (value[dead]) {
          value ^= expected;
        }
      }
    }
  }
  CHECK(space.alive() == 100);
  CHECK(longest > 30);
}

TEST_CASE("over Z the youngest class with a unit dies, as long as what it leaves is mild", "[engine][tower]") {
  ClassSpace<sparse::Integers> space{sparse::Integers{}};
  for (int k = 0; k < 4; ++k) {
    space.add(k);
  }
  const auto sum = [&](const std::vector<int>& coefficients) {
    space.clear_sum();
    for (std::uint32_t node = 0; node < coefficients.size(); ++node) {
      for (int k = 0; k < std::abs(coefficients[node]); ++k) {
        space.add_to_sum(node, coefficients[node] < 0);
      }
    }
  };
  sum({2, 0, -2});
  CHECK(space.kill_sum() == ClassSpace<sparse::Integers>::no_node);
  CHECK(space.sum().size() == 2);
  sum({1, 1, 4});
  CHECK(space.kill_sum() == ClassSpace<sparse::Integers>::no_node);
  CHECK(space.alive() == 4);
  sum({1, -1, 2, -3});  // the class 1 is now 0 + 2 * 2 - 3 * 3
  CHECK(space.kill_sum() == 1);
  CHECK(space.alive() == 3);
  sum({0, 1});
  REQUIRE(space.sum().size() == 3);
  CHECK(space.sum()[0].node == 3);
  CHECK(space.sum()[0].coefficient == -3);
  CHECK(space.sum()[1].coefficient == 2);
  CHECK(space.sum()[2].coefficient == 1);
  sum({0, 0, 5, 1});  // of two terms any unit
  CHECK(space.kill_sum() == 3);
}

TEST_CASE("a reference to a class is 0, or plus or minus a node", "[engine][tower]") {
  CHECK(ClassRef{}.is_zero());
  CHECK((-ClassRef{}).is_zero());
  const ClassRef ref{ClassRef::most_nodes - 1, true};
  CHECK_FALSE(ref.is_zero());
  CHECK(ref.is_negative());
  CHECK(ref.node() == ClassRef::most_nodes - 1);
  CHECK_FALSE((-ref).is_negative());
  CHECK((-ref).node() == ref.node());
}

}  // namespace
}  // namespace sesame
