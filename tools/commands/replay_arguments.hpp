/// \file
/// What the command line says to `sesame replay`.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/engine.hpp"
#include "replay/script/generators.hpp"
#include "replay/text/line_source.hpp"
#include "tools/commands/log_file.hpp"

namespace sesame::tools {

struct ReplayArguments {
  std::unique_ptr<engine::Engine> engine;  ///< of the replay, once there is one: as long as the command
  std::string file;
  std::string ring;
  std::uint64_t until = 0;
  std::uint64_t every = 0;
  std::size_t longest_line = replay::longest_line;
  std::uint64_t undoable = UINT64_MAX;
  bool forgets_cells = false;
  std::int64_t explicit_cones = ops::Limits{}.cells_of_explicit_cone;
  std::string log;
  LogFile::Old old_log = LogFile::Old::is_refused;
  engine::SyncPolicy sync = engine::SyncPolicy::batch();
  engine::Resources resources;
  double most_seconds = 0;
  bool no_snapshots = false;
  std::string html;
  std::string serve;
  bool is_writable = false;
  bool json = false;
  std::optional<replay::GeneratorOptions> generators;
  bool verify = false;
  bool follow = false;
  bool keep_going = false;
  bool in_simplices = false;
  bool quiet = false;
};

}  // namespace sesame::tools
