/// \file
/// What the command line says to `sesame tower`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "replay/barcode/bars.hpp"
#include "replay/script/generators.hpp"
#include "replay/tower/tower_reader.hpp"

namespace sesame::tools {

struct TowerArguments {
  std::string command = "tower";  ///< whose arguments these are
  std::string file;
  replay::TowerFormat format = replay::TowerFormat::automatic;
  std::string ring;
  std::vector<std::string> rings;
  std::string pers, csv, svg, html;
  std::string points;  ///< the file that says where vertices are, for the page
  replay::BarSelection selection;
  std::optional<int> max_dimension;
  std::uint64_t until = 0, every = 0;
  std::size_t longest_line = replay::longest_line;
  std::optional<replay::GeneratorOptions> generators;
  bool json = false, add_faces = false, all_bars = false, partial = false, quiet = false;
  bool verifies = false;  ///< of a zigzag: the barcode is computed in two ways
};

}  // namespace sesame::tools
