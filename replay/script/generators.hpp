/// \file
/// Which generators of homology are written, and which of their chains.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/engine.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

struct GeneratorOptions {
  std::vector<std::pair<int, int>> degrees;  ///< from, to; none: all
  /// A longer chain is given by its length.
  std::uint64_t most_terms = std::numeric_limits<std::uint64_t>::max();

  [[nodiscard]] bool wants(int degree) const;
};

/// "1", "0-2", "0,2-4". Errors: bad_input.
[[nodiscard]] Result<std::vector<std::pair<int, int>>> parse_degrees(std::string_view text);

/// The length of a chain that is not written; or only a bound, when it has not been written out to be counted.
struct ChainLength {
  std::uint64_t terms;
  bool is_exact;
};

/// The length of a cycle, or of what it bounds, when it is too long to be written; else nothing.
[[nodiscard]] std::optional<ChainLength> length_of_cycle(const engine::Generator& generator,
                                                         const GeneratorOptions& options);
[[nodiscard]] std::optional<ChainLength> length_of_bounding(const engine::Generator& generator,
                                                            const GeneratorOptions& options);

/// Passes the generators of a degree to `visit`, each as soon as it has been worked out, until that says no. Chains of
/// which more than 2^16 terms would have to be added up, and more than may be written, are not written out.
void visit_generators(engine::Engine& engine, int degree, const GeneratorOptions& options,
                      const std::function<bool(const engine::Generator&)>& visit);

}  // namespace sesame::replay
