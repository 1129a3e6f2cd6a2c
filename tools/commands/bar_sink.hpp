/// \file
/// Where the bars over one ring go: into a table, a file, and a list if they are to be kept.
#pragma once

#include <algorithm>
#include <utility>

#include "engine/homology_tracker.hpp"
#include "replay/barcode/barcode_files.hpp"
#include "replay/tower/tower_report.hpp"

namespace sesame::tools {

/// Where the bars over one ring go.
class BarSink {
 public:
  /// Bars above the last of `dimensions` go nowhere.
  BarSink(const replay::BarSelection& selection, engine::Dimensions dimensions, bool keeps_bars,
          replay::PersWriter* pers)
      : dimensions_{dimensions}, pers_{pers} {
    result_.selection = selection;
    if (keeps_bars) {
      result_.barcode.emplace();
    }
  }

  void add(const engine::Bar& bar) {
    if (!dimensions_.have(static_cast<std::size_t>(bar.dimension))) {
      return;
    }
    if (result_.barcode) {
      result_.barcode->bars.push_back(bar);
    }
    if (result_.selection.is_too_short(bar)) {
      ++result_.shorter;
      return;
    }
    if (result_.selection.is_left_out_as_open(bar)) {
      ++result_.open;
      return;
    }
    result_.statistics.add(bar);
    if (pers_ != nullptr) {
      pers_->add(bar);
    }
  }

  /// The result, once all bars have been added.
  replay::TowerResult finish(replay::Provenance provenance, std::uint64_t hidden) {
    result_.provenance = std::move(provenance);
    result_.hidden = hidden;
    if (result_.barcode) {
      result_.barcode->hidden = hidden;
      std::ranges::sort(result_.barcode->bars);
    }
    return std::move(result_);
  }

 private:
  engine::Dimensions dimensions_;
  replay::PersWriter* pers_;
  replay::TowerResult result_;
};

}  // namespace sesame::tools
