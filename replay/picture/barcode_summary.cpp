#include "replay/picture/barcode_summary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "replay/picture/svg.hpp"
#include "replay/text/text_buffer.hpp"
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

DrawnBarcode drawn(const engine::Barcode& barcode, const DrawingOptions& options) {
  DrawnBarcode drawn{{}, barcode, 0, 0, std::nullopt};
  std::vector<engine::Bar>& bars = drawn.counted.bars;
  const std::vector<DimensionSummary> summaries = by_dimension(barcode);
  if (!summaries.empty() && summaries.back().dimension == options.top_dimension.value_or(0) &&
      summaries.back().dimension > 0 && summaries.back().bars > 1 &&
      summaries.back().essential == summaries.back().bars) {
    drawn.truncated = summaries.back();
    bars.resize(bars.size() - drawn.truncated->bars);  // they are sorted
  }
  drawn.bars = selected(drawn.counted, options.selection);
  for (const engine::Bar& bar : bars) {
    const bool is_too_short = options.selection.is_too_short(bar);
    drawn.shorter += is_too_short ? 1 : 0;
    drawn.open += !is_too_short && options.selection.is_left_out_as_open(bar) ? 1 : 0;
  }
  return drawn;
}

std::vector<std::string> facts(const DrawnBarcode& drawn, const Provenance& provenance, const DrawingOptions& options) {
  const engine::Barcode& barcode = drawn.bars;
  const auto essential = static_cast<std::uint64_t>(std::count_if(
      barcode.bars.begin(), barcode.bars.end(), [](const engine::Bar& bar) { return bar.death == engine::never; }));
  std::vector<std::string> facts{"coefficients " + provenance.ring, counted(provenance.operations, "operation"),
                                 fmt::format("{}, of which {} never end{}", counted(barcode.bars.size(), "bar"),
                                             with_separators(essential), essential == 1 ? "s" : ""),
                                 counted(barcode.hidden, "bar") + " of length 0 left out"};
  if (drawn.shorter > 0) {
    facts.push_back(fmt::format("{} shorter than {} left out", counted(drawn.shorter, "bar"),
                                number_text(options.selection.min_length)));
  }
  if (drawn.open > 0) {
    facts.push_back(counted(drawn.open, "bar") + " that never end left out");
  }
  if (drawn.truncated) {
    facts.push_back(
        fmt::format("{0} of H{1}, the top dimension, left out: nothing there could end them (--max-dim {1} "
                    "draws them)",
                    counted(drawn.truncated->bars, "bar"), drawn.truncated->dimension));
  }
  if (provenance.max_dimension) {
    facts.push_back(fmt::format("dimensions up to {}", *provenance.max_dimension));
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
