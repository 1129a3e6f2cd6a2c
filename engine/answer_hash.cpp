#include "engine/answer_hash.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "engine/durable/log_format.hpp"

namespace sesame::engine {

std::uint64_t answer_hash(std::span<const std::uint64_t> cells, const Homology& homology) {
  std::vector<std::string> torsion;
  for (const auto& orders : homology.torsion) {
    std::vector<std::string> texts;
    for (const Integer& order : orders) {
      texts.push_back(order.to_string());
    }
    torsion.push_back(fmt::format("[{}]", fmt::join(texts, ",")));
  }
  const std::string answers = fmt::format("{{\"cells\":[{}],\"betti\":[{}],\"torsion\":[{}]}}", fmt::join(cells, ","),
                                          fmt::join(homology.betti, ","), fmt::join(torsion, ","));
  return checksum(answers, 0);
}

}  // namespace sesame::engine
