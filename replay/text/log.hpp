/// \file
/// Who says what in this folder: see engine/log.hpp.
#pragma once

#include "engine/log.hpp"

namespace sesame::replay {

spdlog::logger& replay_log();  ///< "sesame.replay": scripts
spdlog::logger& tower_log();   ///< "sesame.tower": towers and filtrations

}  // namespace sesame::replay
