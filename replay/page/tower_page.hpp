/// \file
/// A barcode as one page: its pictures, linked, the list of its bars, and the class of each bar as far as it is known.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "replay/barcode/barcode_files.hpp"
#include "replay/picture/barcode_drawing.hpp"
#include "replay/script/generators.hpp"
#include "replay/text/point_list.hpp"
#include "replay/tower/bar_chains.hpp"
#include "replay/tower/operation_list.hpp"

namespace sesame::replay {

/// How much a page has of classes that nobody has asked for by options.
struct TowerPageLimits {
  std::uint64_t bars = 2'000;             ///< that have their chains
  std::uint64_t terms = 100'000;          ///< of all of these
  std::uint64_t terms_of_chain = 20'000;  ///< of a longer chain there is its length
  std::uint64_t operations = 200'000;     ///< of more the complex is not drawn
};

/// What is known of the classes of bars.
struct TowerClasses {
  const BarChainNamer& chains;
  const OperationList& operations;
  std::optional<GeneratorOptions> wanted = {};  ///< what was asked for; without it the longest, within the limits
  const std::atomic<bool>* stop = nullptr;      ///< set from outside: no more bars after the one at hand
};

/// What a page is made of.
struct TowerPage {
  const engine::Barcode& barcode;
  const Provenance& provenance;
  const DrawingOptions& options;
  const TowerClasses* classes = nullptr;      ///< null: none, and `note` says why
  std::string note = {};                      ///< what else is to be said, if anything
  const PointList* points = nullptr;          ///< where the vertices are, or null
  const OperationList* operations = nullptr;  ///< all of them, or null when they were too many
};

/// The data of the page, as JSON. Bars are those that pictures draw (see DrawingOptions); those that are left out come
/// after them, for the Betti curves. They are numbered by dimension: those that end, by birth and death, and then the
/// open ones, by birth.
[[nodiscard]] std::string tower_page_data(const TowerPage& page, const TowerPageLimits& limits = {});

/// The page: one file of HTML that needs no other and asks for none.
void write_tower_page(std::ostream& out, const TowerPage& page, const TowerPageLimits& limits = {});

}  // namespace sesame::replay
