#include "tools/commands/replay_pages.hpp"

#include <filesystem>
#include <iostream>
#include <utility>
#include <vector>

#include "replay/page/page_writer.hpp"
#include "tools/commands/interrupt.hpp"

namespace sesame::tools {
namespace {

/// What a page calls the script.
std::string name_on_page(const ReplayArguments& arguments) {
  return arguments.file == "-" ? "standard input" : std::filesystem::path(arguments.file).filename().string();
}

}  // namespace

PageOutput::PageOutput(const ReplayArguments& arguments)
    : arguments_{arguments},
      files_{arguments.log.empty() ? std::vector{arguments.file} : std::vector{arguments.file, arguments.log}} {}

Status PageOutput::open(replay::ReplayOptions& options) {
  const Result<std::ostream*> out = files_.open(arguments_.html);
  if (!out) {
    return out.error();
  }
  out_ = *out;
  if (out_ != nullptr) {
    options.header = &header_;
    options.observer = [this](const ops::Operation& operation, const engine::StepReport& report) {
      history_.take(*arguments_.engine, operation, report);
    };
  }
  return Done{};
}

Status PageOutput::write(bool is_interrupted) {
  if (out_ == nullptr) {
    return Done{};
  }
  const std::string notes = is_interrupted ? "The replay was interrupted: later steps are not here." : "";
  write_page(*out_, history_, *arguments_.engine,
             {header_.title, name_on_page(arguments_), notes, is_interrupted ? nullptr : &stop_requested()});
  return files_.commit();
}

Status LivePages::start(const ReplayArguments& arguments) {
  if (arguments.serve.empty()) {
    return Done{};
  }
  const Result<ServerAddress> address = parse_server_address(arguments.serve);
  if (!address) {
    return Error{Errc::bad_input, "--serve: " + address.error().what};
  }
  const HeldSignals held;  // its threads have this from here: signals are for the one that replays
  Result<std::unique_ptr<LiveServer>> server = LiveServer::start(*address, arguments.is_writable);
  if (!server) {
    return Error{Errc::io, "--serve: " + server.error().what};
  }
  server_ = std::move(*server);
  std::cerr << "sesame replay: serving " << server_->url() << '\n';
  if (!server_->is_local()) {
    std::cerr << "sesame replay: whoever reaches this machine can see it\n";
  }
  return Done{};
}

void LivePages::open(const ReplayArguments& arguments, replay::ReplayOptions& options) {
  if (server_ == nullptr) {
    return;
  }
  const auto live = std::make_shared<LiveReplay>(name_on_page(arguments), &stop_requested());
  options.shared = &live->shared;
  options.header = &header_;
  options.observer = [this, &arguments, live](const ops::Operation& operation, const engine::StepReport& report) {
    live->head.title = header_.title;
    live->history.take(*arguments.engine, operation, report);
  };
  server_->show(live);
}

}  // namespace sesame::tools
