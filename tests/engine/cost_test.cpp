// What a step costs, in terms and entries: a matter of the step, not of the object or of the history.
#include <algorithm>
#include <numeric>
#include <random>

#include "tests/support/complexes.hpp"
#include "tests/support/engines.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

/// An n x n torus of squares as one complex: 4 n^2 cells. Horizontal edges h, vertical ones u, squares s.
ops::MakeComplex torus_of_squares(int n) {
  ops::MakeComplex complex{"K", {}};
  const auto at = [n](const char* kind, int i, int j) {
    return kind + std::to_string((i + n) % n) + "_" + std::to_string((j + n) % n);
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      complex.cells.push_back({at("v", i, j), {}, {}, {}});
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      complex.cells.push_back({at("h", i, j), {}, {at("v", i + 1, j), at("v", i, j)}, {}});
      complex.cells.push_back({at("u", i, j), {}, {at("v", i, j + 1), at("v", i, j)}, {}});
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      complex.cells.push_back({at("s", i, j),
                               ops::CellType{1, 1},
                               {at("u", i + 1, j), at("u", i, j), at("h", i, j + 1), at("h", i, j)},
                               {}});
    }
  }
  return complex;
}

/// A disc: n triangles around a point c, in a random order; its boundary consists of the edges e.
ops::MakeComplex fan(int n) {
  ops::MakeComplex complex{"F", {{"c", {}, {}, {}}}};
  const auto at = [n](const char* kind, int i) { return kind + std::to_string((i + n) % n); };
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937{1});
  for (const int i : order) {
    complex.cells.push_back({at("v", i), {}, {}, {}});
  }
  for (const int i : order) {
    complex.cells.push_back({at("e", i), {}, {at("v", i + 1), at("v", i)}, {}});
    complex.cells.push_back({at("s", i), {}, {at("v", i), "c"}, {}});
  }
  for (const int i : order) {
    complex.cells.push_back({at("t", i), {}, {at("e", i), at("s", i + 1), at("s", i)}, {}});
  }
  return complex;
}

std::uint64_t total(const engine::Work& work) { return work.boundary_entries + work.rewritten_terms; }

/// The work that these steps are, one by one.
std::vector<std::uint64_t> work_of(Engine& engine, const std::vector<std::string>& lines) {
  std::vector<std::uint64_t> work;
  for (const std::string& line : lines) {
    const std::uint64_t before = total(engine.work());
    carry_out(engine, line);
    work.push_back(total(engine.work()) - before);
  }
  return work;
}

/// Steps that add a gadget, glue it to the torus, cone over a part, make torsion, split nothing off.
std::vector<std::string> gadget(const std::string& name) {
  return {R"({"op":"simplex","name":")" + name + R"(","dim":2})",
          R"({"op":"identify","pairs":[[")" + name + R"(.0-1","K.h1_1"]]})",
          R"({"op":"cone","apex":"v)" + name + R"(","over":["K.h2_2",")" + name + R"(.1-2"]})",
          R"({"op":"simploid","name":"q)" + name + R"(","type":[1,1]})",
          R"({"op":"identify","pairs":[["q)" + name + R"(","K.s3_3"]]})",
          R"({"op":"identify","pairs":[[")" + name + R"(.0","K.v2_3"]]})"};
}

}  // namespace

TEST_CASE("a step costs the same on an object of a hundred cells and on one of a hundred thousand", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2");
  std::vector<std::vector<std::uint64_t>> costs;
  for (const int n : {5, 16, 50, 158}) {
    Engine engine(ring_named(ring));
    carry_out(engine, torus_of_squares(n));
    std::vector<std::uint64_t> work;
    for (const std::string name : {"a", "b", "c"}) {
      for (const std::uint64_t w : work_of(engine, gadget(name))) {
        work.push_back(w);
      }
    }
    costs.push_back(std::move(work));
  }
  for (const auto& work : costs) {
    CHECK(work == costs.front());
  }
  // The first gadget of each engine cost something at every step: the counters do count.
  for (std::size_t k = 0; k < 6; ++k) {
    CHECK(costs.front()[k] > 0);
  }
}

TEST_CASE("a step costs the same after ten steps and after thousands", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(ring);
  Engine engine(ring_named(ring));
  carry_out(engine, R"({"op":"simplex","name":"t0","dim":2})");
  // A strip of triangles: each is glued to the one before, along alternating sides.
  std::vector<std::vector<std::uint64_t>> costs;
  for (int k = 1; k <= 3000; ++k) {
    const std::string name = "t" + std::to_string(k);
    const std::string before = "t" + std::to_string(k - 1);
    costs.push_back(
        work_of(engine, {R"({"op":"simplex","name":")" + name + R"(","dim":2})",
                         R"({"op":"identify","pairs":[[")" + before + R"(.1-2",")" + name + R"(.0-1"]]})"}));
  }
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(1)});
  for (std::size_t k = 10; k < costs.size(); ++k) {
    REQUIRE(costs[k] == costs[10]);
  }
  // Closing the strip from its last triangle to its first is a step like any other, but for what is memoised.
  const auto closing = work_of(engine, {R"({"op":"identify","pairs":[["t3000.1-2","t0.0-1"]]})"});
  CHECK(closing[0] > 0);
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(1), group(1)});
}

TEST_CASE("a step that does more costs more, and one that does nothing costs nothing", "[engine]") {
  Engine engine;
  const auto small = work_of(engine, {R"({"op":"simplex","name":"a","dim":2})"});
  const auto large = work_of(engine, {R"({"op":"simplex","name":"b","dim":7})"});
  CHECK(large[0] > 20 * small[0]);
  const auto nothing =
      work_of(engine, {R"({"op":"note","text":"nothing"})", R"({"op":"identify","pairs":[["a","a"]]})"});
  CHECK(nothing == std::vector<std::uint64_t>{0, 0});
}

TEST_CASE("doing a step again after taking it back costs the same after any history", "[engine]") {
  const auto cost_of_redoing = [](int points) {
    Engine engine;
    ops::MakeComplex complex{"K", {}};
    for (int k = 0; k < points; ++k) {
      complex.cells.push_back({std::to_string(k), {}, {}, {}});
    }
    carry_out(engine, complex);
    const auto glue = [points](int k) {
      return ops::Identify{{{"K." + std::to_string(points - 1), "K." + std::to_string(k)}}};
    };
    for (int k = points - 2; k > 0; --k) {
      carry_out(engine, glue(k));
    }
    std::uint64_t work = 0;
    for (int again = 0; again < 5; ++again) {
      const std::uint64_t before = total(engine.work());
      carry_out(engine, glue(0));
      work = total(engine.work()) - before;
      carry_out(engine, ops::Undo{1});
    }
    CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(2)});
    return work;
  };
  const std::uint64_t few = cost_of_redoing(20);
  CHECK(few > 0);
  CHECK(cost_of_redoing(2000) == few);
}

TEST_CASE("a class is found and bounded at a cost in proportion to the length of the chain", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const auto cost_of_class = [&](int n) {
    Engine engine(ring_named(ring));
    carry_out(engine, fan(n));
    ops::AskClass question;
    for (int i = 0; i < n; ++i) {
      question.chain.push_back({1, "F.e" + std::to_string(i)});
    }
    const std::uint64_t before = total(engine.work());
    const auto report = engine.apply(std::move(question));
    REQUIRE(report);
    REQUIRE(report->answer->bounds);
    CHECK(report->answer->bounds->terms.size() == static_cast<std::size_t>(n));
    return total(engine.work()) - before;
  };
  const std::uint64_t few = cost_of_class(1000);
  CHECK(few >= 1000);
  CHECK(cost_of_class(16'000) < 20 * few);
}
