// Towers and filtrations in every format: what is read is tracked over two fields, beside an engine that knows cells
// and undo, and beside a reduction of the boundary matrix as it is in the books.
#include "replay/tower/tower_replay.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "engine/towers/barcode_tracker.hpp"
#include "replay/text/text_buffer.hpp"
#include "replay/tower/tower_reader.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/engine_tower.hpp"
#include "tests/support/piece_input.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::Bar;
using replay::TowerFormat;
using replay::TowerOperation;

namespace {

constexpr std::size_t longest = 4096, most_compared = 60, largest_completed = 8;

/// An operation that owns its labels.
struct Operation {
  TowerOperation::Kind kind;
  engine::Time time;
  int dimension;
  std::vector<std::uint64_t> labels;

  [[nodiscard]] TowerOperation view() const { return {kind, time, dimension, labels}; }
};

struct Reading {
  std::string text;
  std::vector<Operation> operations;
};

Reading read(replay::ByteSource source, TowerFormat format) {
  Reading reading;
  auto opened = replay::TowerReader::from(std::move(source), format, longest);
  if (!went_well(opened)) {
    reading.text = opened.error().what;
    return reading;
  }
  replay::TowerReader& reader = **opened;
  reading.text = std::string{replay::format_name(reader.format())} + "\n";
  if (reader.format() == TowerFormat::script) {
    return reading;
  }
  TowerOperation operation{};
  engine::Time last = -std::numeric_limits<double>::infinity();
  while (true) {
    const Result<bool> next = reader.next(operation);
    if (!went_well(next)) {
      reading.text += next.error().what + "\n";
      demand(!reader.next(operation).value(), "there is nothing behind an error");
      return reading;
    }
    if (!*next) {
      return reading;
    }
    demand(operation.time.is_finite() && operation.time >= last, "times do not decrease");
    last = operation.time;
    reading.text += std::to_string(operation.dimension) + " " + replay::number_text(operation.time);
    for (const std::uint64_t label : operation.labels) {
      reading.text += " " + std::to_string(label);
    }
    reading.text += "\n";
    reading.operations.push_back(
        {operation.kind, operation.time, operation.dimension, {operation.labels.begin(), operation.labels.end()}});
  }
}

Reading read_in_pieces(std::string_view text, TowerFormat format) {
  std::vector<std::string> pieces;
  for (std::size_t at = 0; at < text.size(); at += 9) {
    pieces.emplace_back(text.substr(at, 9));
  }
  auto source = replay::ByteSource::from(std::make_unique<PieceInput>(std::move(pieces), End::whole), "tower");
  return went_well(source) ? read(std::move(*source), format) : Reading{source.error().what, {}};
}

/// A tower with trackers over Z/2 and Z/3.
class Tracked {
 public:
  Tracked(bool is_matrix, bool keeps_cycles) {
    const engine::TrackerOptions options{is_matrix ? engine::Slots::shared : engine::Slots::by_dimension,
                                         engine::all_dimensions, keeps_cycles};
    std::vector<engine::TowerTracker*> told;
    for (const char* ring : {"Z/2", "Z/3"}) {
      if (is_matrix && !trackers_.empty()) {
        break;  // without signs there is only Z/2
      }
      const std::size_t k = trackers_.size();
      const auto add = [this, k](const Bar& bar) { bars_[k].push_back(bar); };
      trackers_.push_back(engine::make_barcode_tracker(sparse::parse_ring(ring).value(), add, options));
      told.push_back(trackers_.back().get());
    }
    tower_.emplace(told, keeps_cycles ? &history_ : nullptr);
  }
  Tracked(const Tracked&) = delete;
  Tracked& operator=(const Tracked&) = delete;

  [[nodiscard]] replay::TowerReplay& tower() { return *tower_; }
  [[nodiscard]] const std::vector<std::unique_ptr<engine::BarcodeTracker>>& trackers() const { return trackers_; }

  void demand_euler() const {
    std::int64_t by_cells = 0;
    for (std::size_t p = 0; p < tower_->cells().size(); ++p) {
      by_cells += (p % 2 == 0 ? 1 : -1) * static_cast<std::int64_t>(tower_->cells()[p]);
    }
    for (const auto& tracker : trackers_) {
      std::int64_t by_ranks = 0;
      const std::vector<std::uint64_t> betti = tracker->betti();
      for (std::size_t p = 0; p < betti.size(); ++p) {
        by_ranks += (p % 2 == 0 ? 1 : -1) * static_cast<std::int64_t>(betti[p]);
      }
      demand(by_ranks == by_cells, "the Euler characteristic by ranks is that by cells");
    }
  }
  /// All bars, sorted, those that are open too.
  std::vector<Bar> bars(std::size_t k) {
    std::vector<Bar> all = bars_[k];
    trackers_[k]->for_each_open_bar([&](const Bar& bar) { all.push_back(bar); });
    for (const Bar& bar : all) {
      demand(bar.birth < bar.death, "bars that are told have a length");
    }
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  std::vector<Bar> bars_[2];
  std::vector<std::unique_ptr<engine::BarcodeTracker>> trackers_;
  replay::TowerHistory history_;
  std::optional<replay::TowerReplay> tower_;
};

void compare_with_engine(const std::vector<std::uint64_t>& betti, engine::Engine& engine) {
  std::vector<std::int64_t> expected = engine.homology().betti;
  expected.resize(std::max(expected.size(), betti.size()));
  for (std::size_t p = 0; p < expected.size(); ++p) {
    demand((p < betti.size() ? static_cast<std::int64_t>(betti[p]) : 0) == expected[p],
           "a tracker has the ranks of an engine");
  }
}

void track_simplices(const std::vector<Operation>& operations, bool adds_faces) {
  Tracked tracked(false, false), with_cycles(false, true);
  replay::FaceAdder faces, faces_with_cycles, faces_of_engine;
  faces.adds_faces = faces_with_cycles.adds_faces = faces_of_engine.adds_faces = adds_faces;
  EngineTower twin(sparse::parse_ring("Z/2").value());
  std::size_t done = 0;
  for (const Operation& operation : operations) {
    if (adds_faces && operation.labels.size() > largest_completed) {
      break;
    }
    const Status status = faces.apply(tracked.tower(), operation.view());
    (void)went_well(status);
    const Status same = faces_with_cycles.apply(with_cycles.tower(), operation.view());
    demand(same.has_value() == status.has_value(), "whoever keeps cycles takes the same");
    if (done <= most_compared) {
      const Status by_engine = faces_of_engine.apply(twin, operation.view());
      demand_equal(status ? "" : status.error().what, by_engine ? "" : by_engine.error().what,
                   "an engine takes the same operations");
    }
    tracked.demand_euler();
    if (!status) {
      continue;  // which leaves everything as it was
    }
    if (++done < most_compared) {
      compare_with_engine(tracked.trackers()[0]->betti(), twin.engine());
    }
  }
  demand(tracked.bars(0) == with_cycles.bars(0) && tracked.bars(1) == with_cycles.bars(1),
         "whoever keeps cycles has the same bars");
}

/// The standard reduction of a boundary matrix over Z/2.
std::vector<Bar> bars_from_scratch(const std::vector<Operation>& columns) {
  std::map<std::uint64_t, std::vector<std::uint64_t>> by_pivot;
  std::vector<bool> is_positive(columns.size()), is_killed(columns.size());
  std::vector<Bar> bars;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    std::vector<std::uint64_t> column = columns[j].labels;
    for (auto found = by_pivot.end(); !column.empty() && (found = by_pivot.find(column.back())) != by_pivot.end();) {
      std::vector<std::uint64_t> sum;
      std::set_symmetric_difference(column.begin(), column.end(), found->second.begin(), found->second.end(),
                                    std::back_inserter(sum));
      column = std::move(sum);
    }
    is_positive[j] = column.empty();
    if (!column.empty()) {
      const std::uint64_t born = column.back();
      is_killed[born] = true;
      bars.push_back({columns[born].dimension, columns[born].time, columns[j].time});
      by_pivot[born] = std::move(column);
    }
  }
  for (std::size_t j = 0; j < columns.size(); ++j) {
    if (is_positive[j] && !is_killed[j]) {
      bars.push_back({columns[j].dimension, columns[j].time, engine::never});
    }
  }
  std::sort(bars.begin(), bars.end());
  return bars;
}

void track_columns(const std::vector<Operation>& operations) {
  Tracked tracked(true, false), with_cycles(true, true);
  std::vector<Operation> taken;
  for (const Operation& operation : operations) {
    const Status status = tracked.tower().apply(operation.view());
    demand(with_cycles.tower().apply(operation.view()).has_value() == status.has_value(), "both take the same");
    if (!went_well(status)) {
      break;  // numbers of later rows mean nothing then
    }
    taken.push_back(operation);
    tracked.demand_euler();
  }
  demand(tracked.bars(0) == with_cycles.bars(0), "whoever keeps cycles has the same bars");
  demand(tracked.bars(0) == bars_from_scratch(taken), "bars are those of the matrix");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = text_of(data, size);
  for (const TowerFormat format : {TowerFormat::automatic, TowerFormat::tower, TowerFormat::phat,
                                   TowerFormat::phat_binary, TowerFormat::gudhi, TowerFormat::facets}) {
    const Reading reading = read(replay::ByteSource::of_text(text, "tower"), format);
    if (!text.starts_with("\x1F\x8B")) {  // a text in memory is never unpacked
      demand_equal(read_in_pieces(text, format).text, reading.text, "pieces say what the whole does");
    }
    if (format == TowerFormat::automatic || reading.operations.empty()) {
      continue;
    }
    if (reading.operations.front().kind == TowerOperation::Kind::column) {
      track_columns(reading.operations);
    } else {
      track_simplices(reading.operations, false);
      track_simplices(reading.operations, true);
    }
  }
  return 0;
}
