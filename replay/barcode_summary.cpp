#include "replay/barcode_summary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "replay/svg.hpp"
#include "replay/text_buffer.hpp"
#include "sesame/version.hpp"

namespace sesame::replay {

std::vector<DimensionSummary> by_dimension(const engine::Barcode& barcode) {
  std::vector<DimensionSummary> summaries;
  for (const engine::Bar& bar : barcode.bars) {
    if (summaries.empty() || summaries.back().dimension != bar.dimension) {
      summaries.push_back({bar.dimension});
    }
    DimensionSummary& summary = summaries.back();
    ++summary.bars;
    if (bar.death == engine::never) {
      ++summary.essential;
    } else {
      summary.longest = std::max(summary.longest, bar.death - bar.birth);
    }
  }
  return summaries;
}

std::string title_of(const Provenance& provenance, const DrawingOptions& options) {
  if (!options.title.empty()) {
    return options.title;
  }
  return provenance.source.empty() ? "Barcode" : provenance.source;
}

std::vector<std::string> facts(const engine::Barcode& barcode, std::uint64_t shorter, const Provenance& provenance,
                               const DrawingOptions& options) {
  const auto essential = static_cast<std::uint64_t>(std::count_if(
      barcode.bars.begin(), barcode.bars.end(), [](const engine::Bar& bar) { return bar.death == engine::never; }));
  std::vector<std::string> facts{"coefficients " + provenance.ring, counted(provenance.operations, "operation"),
                                 fmt::format("{}, of which {} never end{}", counted(barcode.bars.size(), "bar"),
                                             with_separators(essential), essential == 1 ? "s" : ""),
                                 counted(barcode.hidden, "bar") + " of length 0 left out"};
  if (shorter > 0) {
    facts.push_back(
        fmt::format("{} shorter than {} left out", counted(shorter, "bar"), number_text(options.min_length)));
  }
  if (!provenance.source.empty() && !options.title.empty()) {
    facts.push_back("from " + provenance.source);
  }
  facts.push_back(std::string{"sesame "} + SESAME_VERSION);
  return facts;
}

std::string counted(std::uint64_t n, const std::string& thing) {
  return with_separators(n) + " " + thing + (n == 1 ? "" : "s");
}

}  // namespace sesame::replay
