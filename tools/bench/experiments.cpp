// What is built for the experiments on scaling.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tools/bench/constructions.hpp"
#include "tools/bench/scaling.hpp"

namespace sesame::tools {
namespace {

using Rounds = std::vector<std::vector<ops::Operation>>;

constexpr std::uint64_t rounds_measured = 25;

/// The answers after the steps of a round when they are the same in every round.
std::function<Answer(std::size_t, std::size_t)> in_every_round(std::vector<Answer> answers) {
  return [answers = std::move(answers)](std::size_t, std::size_t step) { return answers.at(step); };
}

std::string place(const std::string& kind, std::uint64_t i, std::uint64_t j) {
  return kind + std::to_string(i) + "_" + std::to_string(j);
}

/// The torus of n x n squares as one complex K of 4 n^2 cells: vertices v, edges h and u, squares s.
ops::MakeComplex given_torus(std::uint64_t n) {
  ops::MakeComplex complex{"K", {}};
  for (std::uint64_t i = 0; i < n; ++i) {
    for (std::uint64_t j = 0; j < n; ++j) {
      const std::uint64_t right = (i + 1) % n, up = (j + 1) % n;
      const std::string v = place("v", i, j), h = place("h", i, j), u = place("u", i, j);
      complex.cells.push_back({v, {}, {}, {}});
      complex.cells.push_back({h, {}, {place("v", right, j), v}, {}});
      complex.cells.push_back({u, {}, {place("v", i, up), v}, {}});
      complex.cells.push_back(
          {place("s", i, j), ops::CellType{1, 1}, {place("u", right, j), u, place("h", i, up), h}, {}});
    }
  }
  return complex;
}

/// Steps of different kinds at places all over the torus: a triangle is glued to it along an edge, two of its edges are
/// coned, and a square is glued onto a square.
Rounds work_on_torus(std::uint64_t n) {
  Rounds rounds;
  for (std::uint64_t round = 0; round < rounds_measured; ++round) {
    const std::uint64_t at = round * (n * n / rounds_measured);
    const std::string k = std::to_string(round);
    const auto here = [i = at / n, j = at % n](const char* kind) { return place(kind, i, j); };
    rounds.push_back({ops::MakeSimplex{"a" + k, 2, {}}, ops::Identify{{{"a" + k + ".0-1", here("K.h")}}},
                      ops::MakeCone{"c" + k, std::vector<std::string>{here("K.u"), "a" + k + ".1-2"}, {}},
                      ops::MakeSimploid{"q" + k, {1, 1}, {}}, ops::Identify{{{"q" + k, here("K.s")}}}});
  }
  return rounds;
}

ScalingWorkload on_objects(std::uint64_t x) {
  const auto n = std::max<std::uint64_t>(5, static_cast<std::uint64_t>(std::sqrt(static_cast<double>(x) / 4)));
  const auto answer = [](std::size_t round, std::size_t step) {
    const std::int64_t pieces = step == 0 || step == 3 ? 2 : 1;  // what is new is not glued yet
    const std::int64_t loops = step < 2 ? 0 : 1;                 // the cone over two edges that are apart adds one
    return Answer{{pieces, 2 + static_cast<std::int64_t>(round) + loops, 1}};
  };
  return {4 * n * n, {given_torus(n)}, work_on_torus(n), answer};
}

/// Squares that are made and glued onto the first one, which is all that there is after every other step.
ScalingWorkload after_gluings(std::uint64_t x) {
  const auto glue_on = [](std::vector<ops::Operation>& operations, std::uint64_t number) {
    const std::string name = "q" + std::to_string(number);
    operations.emplace_back(ops::MakeSimploid{name, {1, 1}, {}});
    operations.emplace_back(ops::Identify{{{"q", name}}});
  };
  ScalingWorkload workload{1 + 2 * (x / 2), {ops::MakeSimploid{"q", {1, 1}, {}}}, {}, in_every_round({{{2}}, {{1}}})};
  for (std::uint64_t k = 0; k < x / 2; ++k) {
    glue_on(workload.before, k);
  }
  for (std::uint64_t k = 0; k < rounds_measured; ++k) {
    glue_on(workload.rounds.emplace_back(), x / 2 + k);
  }
  return workload;
}

/// Four places that are glued and split in turn, x steps in all.
ScalingWorkload after_splits(std::uint64_t x) {
  constexpr std::uint64_t rounds = 200;  // as few of them do most of the work
  Operations operations = glued_and_split(4, x / 2 + rounds);
  ScalingWorkload workload{0, {}, {}, in_every_round({{{4, 1}}, {{4}}})};
  const auto measured = operations.end() - static_cast<std::ptrdiff_t>(2 * rounds);
  for (auto at = measured; at != operations.end(); at += 2) {
    workload.rounds.emplace_back(at, at + 2);
  }
  workload.before.assign(std::move_iterator{operations.begin()}, std::move_iterator{measured});
  workload.x = workload.before.size();
  return workload;
}

/// As many circles as loops, each an edge and a vertex, and two bodies A and B that are one circle each. `round(k)`:
/// what is done at circle k.
template <class Round>
ScalingWorkload among_loops(std::uint64_t x, Round round, std::vector<Answer> answers) {
  ops::MakeComplex circles{"K", {}};
  for (std::uint64_t k = 0; k < x; ++k) {
    const std::string number = std::to_string(k);
    circles.cells.push_back({"v" + number, {}, {}, {}});
    circles.cells.push_back({"e" + number, {}, {"v" + number, "v" + number}, {}});
  }
  const ops::CellList circle{{"v", {}, {}, {}}, {"e", {}, {"v", "v"}, {}}};
  ScalingWorkload workload{x,
                           {std::move(circles), ops::MakeComplex{"A", circle}, ops::MakeComplex{"B", circle}},
                           {},
                           in_every_round(std::move(answers))};
  for (std::uint64_t k = 0; k < rounds_measured; ++k) {
    workload.rounds.push_back(round(std::to_string(k * (x / rounds_measured))));
  }
  return workload;
}

/// One vertex is split, which opens its loop, and that is undone.
ScalingWorkload splits_among_loops(std::uint64_t x) {
  const auto loops = static_cast<std::int64_t>(x) + 2;
  return among_loops(x,
                     [](const std::string& k) -> std::vector<ops::Operation> {
                       return {ops::Deidentify{{{"K.v" + k, "w" + k, {{"K.e" + k, 0}}}}}, ops::Undo{1}};
                     },
                     {{{loops, loops - 1}}, {{loops, loops}}});
}

/// The other two circles are multiplied, and that is undone.
ScalingWorkload products_among_loops(std::uint64_t x) {
  const auto loops = static_cast<std::int64_t>(x) + 2;
  return among_loops(x,
                     [](const std::string&) -> std::vector<ops::Operation> {
                       return {ops::MakeProduct{"P", "A", "B"}, ops::Undo{1}};
                     },
                     {{{loops - 1, loops, 1}}, {{loops, loops}}});
}

/// The class of a circle is asked for, after a step that has it worked out anew.
ScalingWorkload classes_among_loops(std::uint64_t x) {
  const auto loops = static_cast<std::int64_t>(x) + 2;
  return among_loops(x,
                     [](const std::string& k) -> std::vector<ops::Operation> {
                       return {ops::MakeSimplex{"p" + k, 0, {}}, ops::AskClass{{{1, "K.e" + k}}}, ops::Undo{2}};
                     },
                     {{{loops + 1, loops}}, {{loops + 1, loops}}, {{loops, loops}}});
}

/// A strip of triangles (k, k+1, k+2): 4 triangles + 3 cells.
ops::MakeComplex strip(const std::string& name, std::uint64_t triangles) {
  ops::MakeComplex complex{name, {}};
  const auto v = [](std::uint64_t k) { return "v" + std::to_string(k); };
  const auto side = [](std::uint64_t k) { return "e" + std::to_string(k); };
  const auto rim = [](std::uint64_t k) { return "f" + std::to_string(k); };
  for (std::uint64_t k = 0; k < triangles + 2; ++k) {
    complex.cells.push_back({v(k), {}, {}, {}});
  }
  for (std::uint64_t k = 0; k < triangles + 1; ++k) {
    complex.cells.push_back({side(k), {}, {v(k + 1), v(k)}, {}});
  }
  for (std::uint64_t k = 0; k < triangles; ++k) {
    complex.cells.push_back({rim(k), {}, {v(k + 2), v(k)}, {}});
    complex.cells.push_back({"t" + std::to_string(k), {}, {side(k + 1), rim(k), side(k)}, {}});
  }
  return complex;
}

/// Strips that are glued onto the first one, each as a whole in one step.
ScalingWorkload on_parts(std::uint64_t x) {
  constexpr std::uint64_t most_strips = 15;
  const std::uint64_t triangles = std::max<std::uint64_t>(1, x / 4), strips = x > 10'000 ? 5 : most_strips;
  const auto answer = [strips](std::size_t round, std::size_t) {  // each round makes two pieces one
    return Answer{{static_cast<std::int64_t>(strips - round)}};
  };
  ScalingWorkload workload{4 * triangles + 3, {strip("s0", triangles)}, {}, answer};
  for (std::uint64_t k = 1; k <= strips; ++k) {
    const std::string name = "s" + std::to_string(k);
    workload.before.emplace_back(strip(name, triangles));
    ops::Identify glue;
    for (std::uint64_t t = 0; t < triangles; ++t) {
      glue.pairs.emplace_back("s0.t" + std::to_string(t), name + ".t" + std::to_string(t));
    }
    workload.rounds.push_back({std::move(glue)});
  }
  return workload;
}

}  // namespace

const std::vector<Experiment>& experiments() {
  const auto among = [](const char* name, const char* what, double expected, ScalingWorkload (*make)(std::uint64_t)) {
    return Experiment{name, what, "loops", expected, "Z", {"live"}, false, 100, 100'000, 1'000, 1'000'000, make};
  };
  static const std::vector<Experiment> all{
      {"object size",
       "a triangle, a cone and a square are glued to a torus that was given at once",
       "cells",
       0,
       "Z",
       {"live"},
       false,
       100,
       1'000'000,
       10'000,
       10'000'000,
       on_objects},
      {"history length",
       "a square is made and glued onto the first one",
       "steps before",
       0,
       "Z",
       {"live"},
       false,
       100,
       1'000'000,
       10'000,
       10'000'000,
       after_gluings},
      {"history of splits",
       "four places are glued and split in turn",
       "steps before",
       0,
       "Z",
       {"live", "eager", "recompute"},
       false,
       100,
       10'000,
       1'000,
       100'000,
       after_splits},
      among("homology: splits", "in one of many circles a vertex is split, and that is undone", 0, splits_among_loops),
      among("homology: products", "beside many circles two are multiplied, and that is undone", 0,
            products_among_loops),
      among("homology: classes",
            "the class of one of many circles is asked for, with its coefficients at all generators", 1,
            classes_among_loops),
      {"touched part",
       "a strip of triangles is glued onto another one in one step",
       "cells glued",
       1,
       "Z",
       {"live"},
       false,
       10,
       100'000,
       1'000,
       1'000'000,
       on_parts},
      {"claim: small complex",
       "work on a torus as above; homology after every step",
       "cells",
       0,
       "Z",
       {"live", "eager-small"},
       false,
       1'000,
       100'000,
       3'200,
       1'000'000,
       on_objects},
      {"claim: generators",
       "the same, and all generators are mapped back after every step",
       "cells",
       1,
       "Z",
       {"live", "eager"},
       true,
       1'000,
       100'000,
       3'200,
       1'000'000,
       on_objects},
  };
  return all;
}

}  // namespace sesame::tools
