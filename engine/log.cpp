#include "engine/log.hpp"

#include <spdlog/spdlog.h>

namespace sesame::engine {

std::shared_ptr<spdlog::logger> registered_logger(const char* name) {
  if (std::shared_ptr<spdlog::logger> found = spdlog::get(name)) {
    return found;
  }
  const auto& sinks = spdlog::default_logger_raw()->sinks();
  auto made = std::make_shared<spdlog::logger>(name, sinks.begin(), sinks.end());
  made->set_level(spdlog::level::warn);
  spdlog::register_logger(made);  // and not `initialize_logger`, which would set the pattern of sinks that are not ours
  return made;
}

spdlog::logger& step_log() {
  static const auto logger = registered_logger("sesame.engine");
  return *logger;
}

spdlog::logger& rebase_log() {
  static const auto logger = registered_logger("sesame.rebase");
  return *logger;
}

spdlog::logger& refusal_log() {
  static const auto logger = registered_logger("sesame.refusals");
  return *logger;
}

}  // namespace sesame::engine
