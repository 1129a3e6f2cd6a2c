#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>

#include "sparse/contract.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/draws.hpp"

namespace sesame::tools {
namespace {

/// Triangles aK and bK with a common edge, for each place K.
Operations pairs_of_triangles(std::uint32_t places) {
  Operations operations;
  for (std::uint32_t place = 0; place < places; ++place) {
    const std::string k = std::to_string(place);
    operations.emplace_back(ops::MakeSimplex{"a" + k, 2, {}});
    operations.emplace_back(ops::MakeSimplex{"b" + k, 2, {}});
    operations.emplace_back(ops::Identify{{{"a" + k + ".0-1", "b" + k + ".0-1"}}});
  }
  return operations;
}

}  // namespace

Operations glued_and_split(std::uint32_t places, std::uint64_t times) {
  sparse::expects(places >= 1, "there is a place to glue at");
  Operations operations = pairs_of_triangles(places);
  std::vector<std::string> last;  // the third vertex of bK: itself, then its latest copy
  for (std::uint32_t place = 0; place < places; ++place) {
    last.push_back("b" + std::to_string(place) + ".2");
  }
  for (std::uint64_t time = 0; time < times; ++time) {
    const std::size_t place = time % places;
    const std::string k = std::to_string(place);
    operations.emplace_back(ops::Identify{{{"a" + k + ".2", last[place]}}});
    last[place] = "c" + std::to_string(time);
    operations.emplace_back(
        ops::Deidentify{{{"a" + k + ".2", last[place], {{"b" + k + ".0-2", 0}, {"b" + k + ".1-2", 0}}}}});
  }
  return operations;
}

Operations glued_and_undone(std::uint32_t places, std::uint64_t times) {
  sparse::expects(places >= 1, "there is a place to glue at");
  Operations operations = pairs_of_triangles(places);
  for (std::uint64_t time = 0; time < times; ++time) {
    const std::string k = std::to_string(time % places);
    operations.emplace_back(ops::Identify{{{"a" + k + ".2", "b" + k + ".2"}}});
    operations.emplace_back(ops::Undo{1});
  }
  return operations;
}

Operations glued_and_cut_square(std::uint64_t times) {
  Operations operations{ops::MakeSimploid{"q", {1, 1}, {}}};
  const std::string bottom = "q.0-1x0", left = "q.0x0-1";
  std::string top = "q.0-1x1", right = "q.1x0-1";
  for (std::uint64_t time = 0; time < times; ++time) {
    const std::string k = std::to_string(time);
    operations.emplace_back(ops::Identify{{{bottom, top}, {left, right}}});
    top = "t" + k;
    right = "r" + k;
    // Faces of the square: 0 right, 1 left, 2 top, 3 bottom; of an edge: 0 its end, 1 its beginning.
    operations.emplace_back(ops::Deidentify{{{bottom, top, {{"q", 2}}},
                                             {left, right, {{"q", 0}}},
                                             {"q.0x0", "a" + k, {{bottom, 0}, {right, 1}}},
                                             {"q.0x0", "b" + k, {{left, 0}, {top, 1}}},
                                             {"q.0x0", "c" + k, {{top, 0}, {right, 0}}}}});
  }
  return operations;
}

Operations torus_with_triangles_edited(std::uint32_t n, std::uint64_t times, std::uint64_t seed) {
  sparse::expects(n >= 3, "a torus of triangles has three squares at least either way");
  const auto label = [n](std::uint32_t i, std::uint32_t j) { return fmt::format("{:06}", i % n * n + j % n); };
  std::vector<std::vector<std::string>> there, away;  // triangles, by their labels
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      there.push_back({label(i, j), label(i + 1, j), label(i + 1, j + 1)});
      there.push_back({label(i, j), label(i, j + 1), label(i + 1, j + 1)});
    }
  }
  std::ranges::for_each(there, [](auto& triangle) { std::ranges::sort(triangle); });
  ops::Insert all;
  for (const auto& triangle : there) {
    all.simplices.push_back(triangle);
  }
  Operations operations{std::move(all)};
  Draws draws(seed);
  for (std::uint64_t time = 0; time < times; ++time) {
    const bool removes = away.empty() || (!there.empty() && draws.below(2) == 0);
    auto& from = removes ? there : away;
    std::swap(from[draws.below(from.size())], from.back());
    const auto& triangle = from.back();
    if (removes) {
      operations.emplace_back(ops::Remove{{fmt::format("{{{}}}", fmt::join(triangle, ","))}, false});
    } else {
      operations.emplace_back(ops::Insert{{triangle}});
    }
    (removes ? away : there).push_back(triangle);
    from.pop_back();
  }
  return operations;
}

Operations replayed_backwards(Operations operations) {
  const std::size_t steps = operations.size();
  operations.insert(operations.end(), steps, ops::Undo{1});
  return operations;
}

}  // namespace sesame::tools
