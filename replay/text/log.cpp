#include "replay/text/log.hpp"

namespace sesame::replay {

spdlog::logger& replay_log() {
  static const auto logger = engine::registered_logger("sesame.replay");
  return *logger;
}

spdlog::logger& tower_log() {
  static const auto logger = engine::registered_logger("sesame.tower");
  return *logger;
}

}  // namespace sesame::replay
