// Barcodes in files: lines, JSON and Ripser's text. What is read is written and read back the same.
#include <algorithm>
#include <sstream>

#include "replay/barcode/barcode_dialects.hpp"
#include "replay/barcode/barcode_files.hpp"
#include "replay/distance/diagram_distance.hpp"
#include "tests/fuzz/target.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

constexpr std::size_t most_compared = 30;

Result<replay::PersFile> read(std::string_view text) {
  replay::TimeReader times;
  return replay::read_pers(replay::ByteSource::of_text(text, "bars"), times);
}

/// Zeros of either sign, and times that are one number, are one.
void demand_same(const engine::Barcode& one, const engine::Barcode& other, const std::string& text) {
  if (one.bars != other.bars) {
    violation("what is written is read back the same:\n" + text);
  }
}

void demand_round_trips(const engine::Barcode& barcode) {
  const replay::Provenance provenance{.ring = "Z/2", .operations = 7, .source = "fuzz", .max_dimension = {}};
  std::ostringstream lines;
  write_pers(lines, barcode, provenance);
  const auto from_lines = read(lines.str());
  demand(went_well(from_lines), "lines that are written are read: " + lines.str());
  demand_same(barcode, from_lines->barcode, lines.str());

  std::ostringstream json;
  {
    replay::TextBuffer text(json);
    text.add('{');
    add_barcode_fields(text, barcode, provenance);
    text.add("}\n");
  }
  const auto from_json = read(json.str());
  if (barcode.bars.empty()) {
    return;  // which looks like no barcode
  }
  demand(went_well(from_json), "JSON that is written is read: " + json.str());
  demand_same(barcode, from_json->barcode, json.str());
}

/// From itself a diagram is at distance 0, and all its bars are matched.
void demand_distances(const engine::Barcode& barcode) {
  const auto same = replay::bottleneck_distance(barcode.bars, barcode.bars);
  demand(same.value == engine::Time{0}, "a diagram is at distance 0 from itself");
  demand(same.matching.size() == barcode.bars.size(), "every bar is matched once");
  const auto none = replay::bottleneck_distance(barcode.bars, {});
  const auto also_none = replay::bottleneck_distance({}, barcode.bars);
  demand(none.value == also_none.value, "distances are symmetric");
  const auto sum = replay::wasserstein_distance(barcode.bars, barcode.bars);
  demand(sum.value == engine::Time{0}, "by sums, too");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = text_of(data, size);
  const auto file = read(text);
  if (!went_well(file)) {
    return 0;
  }
  for (const engine::Bar& bar : file->barcode.bars) {
    demand(bar.birth < bar.death && bar.birth.is_finite(), "bars have a length");
    demand(bar.dimension >= 0 && bar.dimension <= replay::largest_dimension_read, "bars have a dimension");
  }
  demand(std::is_sorted(file->barcode.bars.begin(), file->barcode.bars.end()), "bars are sorted");
  demand_round_trips(file->barcode);
  std::ostringstream csv;
  replay::write_betti_csv(csv, file->barcode);
  if (file->barcode.bars.size() <= most_compared) {
    demand_distances(file->barcode);
  }
  return 0;
}
