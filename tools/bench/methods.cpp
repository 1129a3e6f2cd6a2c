#include "tools/bench/eager_method.hpp"
#include "tools/bench/live_method.hpp"
#include "tools/bench/method.hpp"
#include "tools/bench/recompute_method.hpp"
#include "tools/bench/theorem_method.hpp"

namespace sesame::tools {

const std::vector<MethodEntry>& methods() {
  static const std::vector<MethodEntry> entries{
      {"live", "the engine: local steps, rules instead of matrices, chains on demand", make_live_method},
      {"eager", "every map of the equivalence a matrix, kept current by the exact sequence of each step",
       make_eager_method},
      {"eager-small", "the same, but only the maps that the small complex needs: no generators, no splits",
       make_small_eager_method},
      {"recompute", "the boundary matrices of the present object, reduced from scratch at every step",
       make_recompute_method},
      {"theorem", "the exact sequence of each step written out, and the theorem by whole matrices; only when named",
       make_theorem_method, true}};
  return entries;
}

}  // namespace sesame::tools
