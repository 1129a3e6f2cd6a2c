#include "tools/commands/program_log.hpp"

#include <fcntl.h>
#include <spdlog/cfg/env.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>

#include "sesame/version.hpp"
#include "tools/commands/output_file.hpp"

namespace sesame::tools {
namespace {

constexpr const char* option_of_file = "--log-file";

std::array<spdlog::logger*, 6> loggers() {
  return {&engine::step_log(),   &engine::rebase_log(), &engine::refusal_log(),
          &replay::replay_log(), &replay::tower_log(),  &tools_log()};
}

spdlog::sink_ptr standard_error() {
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_st>();
  sink->set_pattern("[%n] [%^%l%$] %v");
  return sink;
}

/// What the option --verbose asks for, when it is given so many times.
spdlog::level::level_enum level_of(int verbosity) {
  constexpr std::array levels{spdlog::level::off, spdlog::level::info, spdlog::level::debug, spdlog::level::trace};
  return levels.at(static_cast<std::size_t>(std::clamp(verbosity, 0, 3)));
}

/// Another option with the value that names this place, or null.
const CLI::Option* other_option(const CLI::App& command, const OutputPlace& place) {
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      const Result<OutputPlace> other = find_place(value, {});
      if (!option->check_name(option_of_file) && other && other->identity == place.identity) {
        return option;
      }
    }
  }
  return nullptr;
}

}  // namespace

spdlog::logger& tools_log() {
  static const auto logger = engine::registered_logger("sesame.tools");
  return *logger;
}

ProgramLog::ProgramLog() {
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("sesame", standard_error()));
  (void)loggers();
  spdlog::cfg::load_env_levels();
}

ProgramLog::~ProgramLog() {
  for (spdlog::logger* logger : loggers()) {
    logger->sinks().clear();
  }
}

void ProgramLog::add_options(CLI::App& command) {
  command.add_flag("-v,--verbose", verbosity_,
                   "Say on standard error what is being done: milestones; -vv each step, what it took and why it was "
                   "refused; -vvv more");
  command.add_option(option_of_file, path_, "Add what -vv says to this file, with times")->option_text("FILE");
}

Status ProgramLog::start(const CLI::App& command) {
  if (!path_.empty()) {
    if (Status opened = open_file(command); !opened) {
      return opened;
    }
  }
  spdlog::sink_ptr file;
  if (file_ != nullptr) {
    file = std::make_shared<spdlog::sinks::ostream_sink_st>(stream_, true);  // flushed, for what breaks off
    file->set_pattern("[%Y-%m-%d %H:%M:%S.%f] [%n] [%l] %v");
  }
  for (spdlog::logger* logger : loggers()) {
    const auto spoken = std::min(logger->level(), level_of(verbosity_));
    logger->set_level(file == nullptr ? spoken : std::min(spoken, spdlog::level::debug));
    if (file != nullptr) {
      const spdlog::sink_ptr own = standard_error();  // loggers may speak at levels of their own
      own->set_level(spoken);
      logger->sinks() = {own, file};
    }
  }
  tools_log().info("sesame {}, {}", SESAME_VERSION, command.get_name());
  return Done{};
}

Status ProgramLog::open_file(const CLI::App& command) {
  if (is_standard_output(path_)) {
    return Error{Errc::io, "standard output is for what the command puts out; -vv says the same on standard error"};
  }
  const Result<OutputPlace> place = find_place(path_, {});
  if (!place) {
    return place.error();
  }
  const CLI::Option* other =
      place->kind == OutputPlace::Kind::device ? nullptr : other_option(command, *place);  // anybody may write to these
  if (other != nullptr) {
    return Error{Errc::io, path_ + " is what " + other->get_name() + " names; give the log a name of its own"};
  }
  const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    return cannot_write(path_);
  }
  file_ = std::make_unique<FileBuffer>(descriptor);
  stream_.rdbuf(file_.get());
  return Done{};
}

Status ProgramLog::finish() {
  const Status settled = file_ == nullptr ? Status{Done{}} : file_->settle();
  return settled ? settled : cannot_write(path_, settled.error().what);
}

}  // namespace sesame::tools
