#include "tools/bench/zigzag_scenarios.hpp"

#include <map>
#include <optional>
#include <utility>

#include "tools/bench/zigzags.hpp"

namespace sesame::tools {
namespace {

using Size = std::uint64_t;

/// The Betti numbers over Z/2 of the complex at the end, by size, as the ranks of its boundary matrices say.
using Known = std::map<Size, std::vector<std::int64_t>>;

Scenario scenario(const char* name, const char* what, Size size, Size quick_size,
                  std::function<void(std::ostream& out, Size size)> write, Known known) {
  const auto answer = [known = std::move(known)](Size n) {
    const auto found = known.find(n);
    return found == known.end() ? std::nullopt : std::optional<Answer>{Answer{found->second}};
  };
  return {name, "zigzag", what, "operations", size, quick_size, Zigzag{std::move(write)}, answer, "Z/2", true};
}

std::function<void(std::ostream& out, Size size)> random(TowerOptions options) {
  return [options](std::ostream& out, Size size) {
    TowerOptions sized = options;
    sized.operations = size;
    write_random_tower(out, sized);
  };
}

}  // namespace

void add_zigzags(std::vector<Scenario>& list) {
  list.push_back(scenario("zigzag-growing", "tetrahedra on 5000 vertices, three operations in ten a deletion", 100'000,
                          2'000, random({0, 5'000, 3, 0, true, 1, 0.3, 0}),
                          {{2'000, {105, 140, 3}}, {100'000, {2, 30142}}}));
  list.push_back(scenario("zigzag-oscillating",
                          "tetrahedra on 300 vertices, whose number goes up and down, 10,000 operations each way",
                          50'000, 2'000, random({0, 300, 3, 0, true, 1, 0.25, 10'000}),
                          {{2'000, {34, 208, 0, 2}}, {50'000, {1, 1719, 22}}}));
  list.push_back(scenario(
      "temporal-network", "cliques of four of 500 people at most, of whose contacts the last 1000 are remembered",
      100'000, 2'000, [](std::ostream& out, Size size) { write_temporal_network(out, size, 500, 1'000, 1); },
      {{2'000, {2, 242}}, {100'000, {2, 258}}}));
}

}  // namespace sesame::tools
