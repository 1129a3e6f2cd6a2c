#include "tools/bench/torsion_scenarios.hpp"

#include <map>
#include <optional>
#include <utility>

#include "tools/bench/constructions.hpp"

namespace sesame::tools {
namespace {

std::uint32_t small(std::uint64_t size) { return static_cast<std::uint32_t>(size); }

Answer summands(std::uint64_t pieces, std::uint64_t of_order_two) {
  const auto count = static_cast<std::int64_t>(of_order_two);
  return {{static_cast<std::int64_t>(pieces), count}, {{}, std::vector<std::int64_t>(of_order_two, 2)}};
}

Scenario scenario(const char* name, const char* what, const char* size_name, std::uint64_t size, std::uint64_t quick,
                  std::function<std::vector<ops::Operation>(std::uint64_t)> make,
                  std::map<std::uint64_t, Answer> known) {
  const auto answer = [known = std::move(known)](std::uint64_t n) {
    const auto found = known.find(n);
    return found == known.end() ? std::nullopt : std::optional<Answer>{found->second};
  };
  return {name, "with torsion", what, size_name, size, quick, Construction{std::move(make)}, answer, "Z", false};
}

}  // namespace

void add_torsion(std::vector<Scenario>& list) {
  const std::vector<std::int64_t> threes(45, 3);
  Scenario one_by_one = scenario("torsion", "squares, each made and glued to a Klein bottle", "squares", 400, 12,
                                 [](std::uint64_t n) { return separate_klein_bottles(small(n)); }, {});
  one_by_one.answer = [](std::uint64_t n) { return summands(n, n); };
  std::get<Construction>(one_by_one.input).follow = [](std::uint64_t) -> AnswerAfter {
    return [](std::size_t step) { return summands(step / 2 + 1, (step + 1) / 2); };
  };
  one_by_one.all_methods = true;
  list.push_back(std::move(one_by_one));
  // Of matching complexes: X. Dong and M. Wachs, 2002; J. Shareshian and M. Wachs, 2007.
  list.push_back(scenario("torsion-matching", "the matching complex of a complete graph, in one step",
                          "vertices of the graph", 11, 7, [](std::uint64_t n) { return matching_complex(small(n)); },
                          {{7, {{1, 0, 20}, {{}, {3}}}},
                           {9, {{1, 0, 42, 70}, {{}, {}, {3, 3, 3, 3, 3, 3, 3, 3}}}},
                           {11, {{1, 0, 0, 1188, 252}, {{}, {}, {}, threes}}}}));
  // Of chessboard complexes: the first torsion is known (Shareshian and Wachs); the Betti numbers over Q, Z/2, Z/3 and
  // Z/5 fit the rest, and the Euler characteristics.
  Scenario chessboard = scenario("torsion-chessboard", "the chessboard complex in one step, and its generators",
                                 "squares a side", 7, 5, [](std::uint64_t n) { return chessboard_complex(small(n)); },
                                 {{5, {{1, 0, 0, 56}, {{}, {}, {3}}}},
                                  {6, {{1, 0, 0, 25, 210}, {{}, {}, {}, std::vector<std::int64_t>(10, 3)}}},
                                  {7, {{1, 0, 0, 0, 588, 792}, {{}, {}, {}, {}, std::vector<std::int64_t>(66, 3)}}}});
  std::get<Construction>(chessboard.input).generators_every = 1;
  list.push_back(std::move(chessboard));
  // The others: of Smith forms of the whole complex, and the Betti numbers over Z/2 and Z/3 agree.
  list.push_back(scenario("torsion-gluings", "tetrahedra whose faces are glued in random pairs", "tetrahedra", 1000, 40,
                          [](std::uint64_t n) { return random_gluings(small(n), 1); },
                          {{40, {{1, 0, 35}, {{}, {}, {2}}}}, {1000, {{1, 0, 993}, {{}, {}, {2}}}}}));
  list.push_back(scenario("torsion-random", "all edges, then triangles in random order that raise the rank", "vertices",
                          60, 16, [](std::uint64_t n) { return acyclic_triangles(small(n), 1); },
                          {{16, {{1}}}, {60, {{1}, {{}, {976837914}}}}}));
}

}  // namespace sesame::tools
