#include "tools/bench/method.hpp"

#include <map>

#include "reductions/defect.hpp"
#include "tests/support/abstract_steps.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/random_steps.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/eager_method.hpp"
#include "tools/bench/sessions.hpp"
#include "tools/bench/theorem_method.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

tools::MethodEntry entry_named(const std::string& name) {
  for (const tools::MethodEntry& entry : tools::methods()) {
    if (entry.name == name) {
      return entry;
    }
  }
  FAIL("no method " << name);
  return {};
}

std::unique_ptr<tools::Method> method_named(const std::string& name, const std::string& ring) {
  return entry_named(name).make(ring_named(ring));
}

/// Groups as a text that also says how many dimensions were answered for.
std::string to_text(const engine::Homology& homology) {
  std::string text;
  for (std::size_t p = 0; p < homology.betti.size(); ++p) {
    text += " " + std::to_string(homology.betti[p]);
    for (const Integer& t : homology.torsion[p]) {
      text += "+" + t.to_string();
    }
  }
  return text;
}

void take(tools::Method& method, const ops::Operation& operation) {
  if (const Status status = method.apply(operation); !status) {
    FAIL(ops::to_text(operation) << ": " << status.error().what);
  }
}

/// Takes the steps with each of the methods and compares their answers after every one.
void require_agreement(const std::vector<std::string>& names, const std::string& ring,
                       const tools::Operations& operations) {
  std::vector<std::unique_ptr<tools::Method>> methods;
  for (const std::string& name : names) {
    methods.push_back(method_named(name, ring));
  }
  for (std::size_t step = 0; step < operations.size(); ++step) {
    CAPTURE(ring, step, ops::to_text(operations[step]));
    for (auto& method : methods) {
      take(*method, operations[step]);
    }
    const std::string answer = to_text(methods.front()->homology());
    for (std::size_t k = 1; k < methods.size(); ++k) {
      CAPTURE(names[k]);
      REQUIRE(to_text(methods[k]->homology()) == answer);
    }
  }
}

const std::vector<std::string> all{"live", "eager", "eager-small", "recompute"};

}  // namespace

TEST_CASE("all methods agree on every assembly after each step", "[bench]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const tools::Order order = GENERATE(tools::Order::inside_out, tools::Order::random, tools::Order::tiles_first);
  const tools::Assembly assembly{order, 5};
  require_agreement(all, ring, tools::torus(3, assembly));
  require_agreement(all, ring, tools::klein_bottle(3, assembly));
  require_agreement(all, ring, tools::surface_of_genus(2, 4, assembly));
  require_agreement(all, ring, tools::menger_sponge(1, assembly));
  require_agreement(all, ring, tools::freudenthal_torus(2, assembly));
}

TEST_CASE("all methods agree on cones, suspensions and insertions after each step", "[bench]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  require_agreement(all, ring, tools::iterated_cones(3, 4));
  require_agreement(all, ring, tools::suspended_points(3));
  require_agreement(all, ring, tools::suspended_klein_bottle(3));
  require_agreement(all, ring, tools::random_triangles(7, 25, 3));
}

TEST_CASE("all methods that can agree on gluings, splits, undos and products after each step", "[bench]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  require_agreement({"live", "eager", "recompute"}, ring, tools::glued_and_split(2, 9));
  require_agreement({"live", "eager", "recompute"}, ring, tools::glued_and_cut_square(3));
  require_agreement({"live", "eager", "recompute"}, ring, tools::glued_triangles(4, 1));
  require_agreement({"live", "eager", "recompute"}, ring, tools::steps_of(tools::GraphEditing(8, true, 1), 60));
  require_agreement(all, ring, tools::glued_and_undone(2, 9));
  require_agreement(all, ring, tools::replayed_backwards(tools::klein_bottle(3)));
  require_agreement({"live", "recompute"}, ring, tools::glued_product_of_circles(3, 2, 2));
  require_agreement({"live", "recompute"}, ring, tools::product_of_circles(2, 3));
}

namespace {

/// Random steps of every kind that all methods know; what the methods are asked after each.
template <class Ask>
void follow_random_steps(unsigned seed, const Ask& ask) {
  Engine engine(sparse::Integers{}, ops::Limits{.cells_of_explicit_cone = 1'000'000});
  StreamShape shape = everything(30);
  shape.products = shape.removals = shape.replacements = false;
  RandomSteps steps(seed, shape);
  for (int k = 0; k < 30; ++k) {
    const ops::Operation operation = steps.next(engine.structure());
    CAPTURE(seed, k, ops::to_text(operation));
    carry_out(engine, operation);
    ask(engine, operation);
  }
}

/// The first generator of S whose boundary has a unit entry, as a text: such a pair should have been eliminated.
template <Ring R>
std::string unit_left_in(const ChainComplex<R>& small) {
  for (int p = 1; p <= small.top(); ++p) {
    for (Index column = 0; column < small.size(p); ++column) {
      for (const auto& term : small.boundary(p).column(column)) {
        if (small.ring().is_unit(term.coefficient)) {
          return "generator " + std::to_string(column) + " of degree " + std::to_string(p);
        }
      }
    }
  }
  return "";
}

template <Ring R>
void require_laws(const tools::EagerMethod<R>& method) {
  const auto equivalence = method.matrices();
  REQUIRE(defect_of(equivalence) == "");
  REQUIRE(unit_left_in(equivalence.small()) == "");
}

template <Ring R>
R third_ring() {
  if constexpr (std::same_as<R, sparse::Zp>) {
    return sparse::Zp::make(3).value();
  } else {
    return R{};
  }
}

}  // namespace

TEMPLATE_TEST_CASE("the matrices of the eager method are an equivalence after every step", "[bench][stream]", Integers,
                   sparse::Z2, sparse::Zp) {
  const unsigned seed = GENERATE(range(0U, 12U));
  tools::EagerMethod<TestType> method(third_ring<TestType>(), tools::Keep::all_maps);
  follow_random_steps(seed, [&](const Engine&, const ops::Operation& operation) {
    take(method, operation);
    require_laws(method);
  });
}

TEST_CASE("all methods agree on random steps of every kind but products, removals and replacements",
          "[bench][stream]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const unsigned seed = GENERATE(range(20U, 40U));
  const auto eager = method_named("eager", ring), recompute = method_named("recompute", ring);
  const auto live = method_named("live", ring);
  follow_random_steps(seed, [&](const Engine&, const ops::Operation& operation) {
    for (tools::Method* method : {live.get(), eager.get(), recompute.get()}) {
      take(*method, operation);
    }
    const std::string answer = to_text(live->homology());
    REQUIRE(to_text(eager->homology()) == answer);
    REQUIRE(to_text(recompute->homology()) == answer);
  });
}

TEST_CASE("the theorem agrees with the live method after each step", "[bench]") {
  const std::vector<std::string> names{"live", "theorem"};
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  require_agreement(names, ring, tools::torus(2, {tools::Order::random, 5}));
  require_agreement(names, ring, tools::klein_bottle(3, {tools::Order::inside_out, 5}));
  require_agreement(names, ring, tools::iterated_cones(3, 3));
  require_agreement(names, ring, tools::glued_and_split(2, 9));
  require_agreement(names, ring, tools::glued_and_cut_square(3));
  require_agreement(names, ring, tools::glued_triangles(3, 1));
  require_agreement(names, ring, tools::glued_and_undone(2, 9));
  require_agreement(names, ring, tools::replayed_backwards(tools::klein_bottle(3)));
}

TEMPLATE_TEST_CASE("what the theorem gives is an equivalence after every step, and no larger than need be",
                   "[bench][stream]", Integers, sparse::Z2, sparse::Zp) {
  const unsigned seed = GENERATE(range(0U, 6U));
  tools::TheoremMethod<TestType> method(third_ring<TestType>());
  tools::EagerMethod<TestType> eager(third_ring<TestType>(), tools::Keep::all_maps);
  follow_random_steps(seed, [&](const Engine&, const ops::Operation& operation) {
    take(method, operation);
    take(eager, operation);
    REQUIRE(defect_of(method.equivalence()) == "");
    REQUIRE(unit_left_in(method.equivalence().small()) == "");
    REQUIRE(to_text(method.homology()) == to_text(eager.homology()));
    REQUIRE(method.homology().big == eager.homology().big);
  });
}

TEST_CASE("the theorem undoes several steps at once, refuses products, and counts generators", "[bench]") {
  const auto method = method_named("theorem", "Z");
  const tools::Operations operations = tools::klein_bottle(3);
  for (const ops::Operation& operation : operations) {
    take(*method, operation);
  }
  const std::string answer = to_text(method->homology());
  const std::uint64_t terms = method->generators();
  take(*method, ops::Undo{operations.size() / 2});
  for (std::size_t k = operations.size() - operations.size() / 2; k < operations.size(); ++k) {
    take(*method, operations[k]);
  }
  CHECK(to_text(method->homology()) == answer);
  CHECK(method->generators() == terms);
  CHECK_FALSE(method->apply(ops::Undo{operations.size() + 1}));
  const auto product = method_named("theorem", "Z");
  const tools::Operations circles = tools::product_of_circles(3, 2);
  for (std::size_t k = 0; k + 1 < circles.size(); ++k) {
    take(*product, circles[k]);
  }
  const Status status = product->apply(circles.back());
  REQUIRE_FALSE(status);
  CHECK_THAT(status.error().what, Catch::Contains("no products"));
}

TEMPLATE_TEST_CASE("the matrices of the eager method follow insertions and collapses", "[bench][stream]", Integers,
                   sparse::Z2, sparse::Zp) {
  const unsigned seed = GENERATE(range(0U, 6U));
  tools::EagerMethod<TestType> method(third_ring<TestType>(), tools::Keep::all_maps);
  RandomAbstractSteps steps(seed, 7, 3);
  for (int k = 0; k < 40; ++k) {
    const ops::Operation operation = steps.next();
    CAPTURE(seed, k, ops::to_text(operation));
    take(method, operation);
    require_laws(method);
  }
}

TEST_CASE("the eager method that keeps little agrees on random insertions and collapses", "[bench][stream]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const unsigned seed = GENERATE(range(0U, 10U));
  RandomAbstractSteps steps(seed, 8, 3);
  tools::Operations operations;
  for (int k = 0; k < 60; ++k) {
    operations.push_back(steps.next());
  }
  require_agreement(all, ring, operations);
}

TEST_CASE("a coefficient that becomes a unit by an elimination is eliminated too", "[bench]") {
  tools::EagerEquivalence<Integers> equivalence(Integers{}, tools::Keep::all_maps);
  equivalence.add_cell(0, 0, {});
  equivalence.add_cell(1, 1, {});
  equivalence.add_cell(2, 1, {});
  equivalence.add_cell(3, 2, {{1, 2}, {2, 3}});
  CHECK(equivalence.homology(3).small == std::vector<std::uint32_t>{1, 2, 1});
  equivalence.add_cell(4, 2, {{1, 1}, {2, 1}});  // cell 3 is twice this one and once the other loop
  CHECK(equivalence.homology(3).small == std::vector<std::uint32_t>{1, 0, 0});
  CHECK(to_text(equivalence.homology(3)) == " 1 0 0");
}

TEST_CASE("every method undoes several steps at once and goes on", "[bench]") {
  for (const std::string& name : all) {
    CAPTURE(name);
    const auto method = method_named(name, "Z"), fresh = method_named(name, "Z");
    const tools::Operations operations = tools::klein_bottle(3);
    const std::size_t half = operations.size() / 2;
    for (const ops::Operation& operation : operations) {
      take(*method, operation);
    }
    take(*method, ops::Note{"one step more"});
    take(*method, ops::Undo{operations.size() - half + 1});
    for (std::size_t k = 0; k < half; ++k) {
      take(*fresh, operations[k]);
    }
    CHECK(to_text(method->homology()) == to_text(fresh->homology()));
    CHECK(method->generators() == fresh->generators());
    for (std::size_t k = half; k < operations.size(); ++k) {
      take(*method, operations[k]);
    }
    CHECK(to_text(method->homology()) == " 1 1+2 0");
    const Status status = method->apply(ops::Undo{operations.size() + 1});
    REQUIRE_FALSE(status);
    CHECK(status.error().code == Errc::refused);
    CHECK(to_text(method->homology()) == " 1 1+2 0");
  }
}

TEST_CASE("generators have the terms that cycles must have", "[bench]") {
  // A circle of five edges: all of them, and a vertex.
  for (const std::string& name : all) {
    CAPTURE(name);
    const auto method = method_named(name, "Z");
    for (const ops::Operation& operation : tools::product_of_circles(5, 1)) {
      take(*method, operation);
    }
    CHECK(method->generators() == (name == "eager-small" ? 0U : 6U));
  }
}

TEST_CASE("what a method cannot do it refuses with a sentence, and nothing has happened", "[bench]") {
  const auto check_refused = [](const std::string& name, const tools::Operations& before, const ops::Operation& last,
                                const std::string& sentence) {
    CAPTURE(name, ops::to_text(last));
    const auto method = method_named(name, "Z/2");
    for (const ops::Operation& operation : before) {
      take(*method, operation);
    }
    const std::string answer = to_text(method->homology());
    const auto counts = method->counts();
    const Status status = method->apply(last);
    REQUIRE_FALSE(status);
    CHECK(status.error().code == Errc::refused);
    CHECK_THAT(status.error().what, Catch::Contains(sentence));
    CHECK(to_text(method->homology()) == answer);
    take(*method, ops::Undo{1});  // the last step that was taken
    take(*method, before.back());
    CHECK(to_text(method->homology()) == answer);
  };
  tools::Operations circles = tools::product_of_circles(3, 2);
  const ops::Operation product = circles.back();
  circles.pop_back();
  check_refused("eager", circles, product, "no products");
  check_refused("eager-small", circles, product, "no products");
  tools::Operations glued = tools::glued_and_split(1, 1);
  const ops::Operation split = glued.back();
  glued.pop_back();
  check_refused("eager-small", glued, split, "gS and hS");
  for (const std::string name : {"eager", "eager-small", "recompute"}) {
    check_refused(name, circles, ops::AskClass{{{1, "c0.e0"}}}, "not \"class\"");
    check_refused(name, circles, ops::Expect{}, "not \"expect\"");
  }
}

TEST_CASE("names that are not there are errors in every method", "[bench]") {
  for (const std::string& name : all) {
    const Status status = method_named(name, "Z")->apply(identify({{"a", "b"}}));
    REQUIRE_FALSE(status);
    CHECK(status.error().code == Errc::unknown_name);
  }
}

namespace {

std::uint64_t count_named(const tools::Method& method, const std::string& name) {
  for (const auto& [key, value] : method.counts()) {
    if (key == name) {
      return value;
    }
  }
  FAIL("no count " << name);
  return 0;
}

/// What a step costs on average over the second half of an assembly of n x n squares, in hundredths.
std::uint64_t cost_of_a_step(const std::string& name, const std::string& count, std::uint32_t n) {
  const auto method = method_named(name, "Z/2");
  const tools::Operations operations = tools::torus(n);
  std::uint64_t before = 0;
  for (std::size_t k = 0; k < operations.size(); ++k) {
    if (k == operations.size() / 2) {
      before = count_named(*method, count);
    }
    take(*method, operations[k]);
    if (name == "recompute") {
      static_cast<void>(method->homology());
    }
  }
  return 100 * (count_named(*method, count) - before) / (operations.size() - operations.size() / 2);
}

/// What mapping the generators of a circle back costs the eager method, in entries.
std::uint64_t cost_of_generators(std::uint32_t edges) {
  const auto method = method_named("eager", "Z");
  for (const ops::Operation& operation : tools::product_of_circles(edges, 1)) {
    take(*method, operation);
  }
  const std::uint64_t before = count_named(*method, "entries_touched");
  REQUIRE(method->generators() == edges + 1);
  return count_named(*method, "entries_touched") - before;
}

/// What the steps from one number to another cost, in `count` of a method.
std::uint64_t cost_between(const std::string& name, const std::string& count, const tools::Operations& operations,
                           std::size_t from, std::size_t to) {
  const auto method = method_named(name, "Z");
  std::uint64_t before = 0;
  for (std::size_t k = 0; k < to; ++k) {
    before = k == from ? count_named(*method, count) : before;
    take(*method, operations.at(k));
    static_cast<void>(method->homology());
  }
  return count_named(*method, count) - before;
}

}  // namespace

TEST_CASE("what the eager method maps back costs it as much as that is long", "[bench]") {
  const std::uint64_t small = cost_of_generators(50);
  CHECK(small >= 51);
  CHECK(cost_of_generators(500) <= 11 * small);
}

TEST_CASE("the method without memory costs the same whatever there was before", "[bench]") {
  const tools::Operations operations = tools::glued_and_split(1, 500);
  const auto cost = [&](std::size_t from) {
    return cost_between("recompute", "cells_read", operations, from, from + 100);
  };
  CHECK(cost(3) > 0);
  CHECK(cost(903) == cost(3));
}

TEST_CASE("the cost of a step is flat when only the small complex is asked for, and grows when all maps are kept",
          "[bench]") {
  for (const auto& [name, count] : {std::pair{"live", "rewritten_terms"}, {"eager-small", "entries_touched"}}) {
    CAPTURE(name);
    CHECK(10 * cost_of_a_step(name, count, 24) <= 11 * cost_of_a_step(name, count, 6));
  }
  CHECK(cost_of_a_step("eager", "entries_touched", 24) >= 2 * cost_of_a_step("eager", "entries_touched", 6));
  CHECK(cost_of_a_step("recompute", "matrix_entries", 24) >= 8 * cost_of_a_step("recompute", "matrix_entries", 6));
}
