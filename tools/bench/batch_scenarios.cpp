#include "tools/bench/batch_scenarios.hpp"

#include <optional>

#include "tools/bench/constructions.hpp"

namespace sesame::tools {

void add_batches(std::vector<Scenario>& list) {
  list.push_back(
      {"batch-klein-bottle", "all at once", "a Klein bottle of triangles as one complex, and its generators",
       "squares of two triangles a side", 300, 8,
       Construction{[](std::uint64_t n) { return klein_bottle_at_once(static_cast<std::uint32_t>(n)); }, nullptr, 1},
       [](std::uint64_t) {
         return Answer{{1, 1}, {{}, {2}}};
       }});
  // What PHAT finds over Z/2 for the same filtration: a larger Betti number over Z would be one over Z/2.
  list.push_back(
      {"batch-rips", "all at once",
       "a Vietoris-Rips complex of random points, 2000 simplices a point, in one insertion", "points", 500, 20,
       Construction{[](std::uint64_t n) { return rips_at_once(static_cast<std::uint32_t>(n), 2000 * n, 1); }},
       [](std::uint64_t n) -> std::optional<Answer> {
         return n == 20    ? std::optional{Answer{{1, 0, 0, 3876}}}
                : n == 500 ? std::optional{Answer{{1, 0, 0, 722624}}}
                           : std::nullopt;
       }});
}

}  // namespace sesame::tools
