#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/open.hpp"
#include "replay/script/groups.hpp"
#include "replay/script/replay.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/interrupt.hpp"
#include "tools/commands/log_input.hpp"
#include "tools/commands/options.hpp"

namespace sesame::tools {
namespace {

using replay::Outcome;

struct Arguments {
  std::string file;
  std::size_t longest_line = replay::longest_line;
  bool json = false, no_replay = false;
};

/// What there is to know of a log.
struct Info {
  ops::Header header;
  std::map<std::string, std::uint64_t> operations;
  std::optional<engine::Binding> bound;  ///< the last line that binds
  engine::LogPosition end;
  std::uint64_t torn = 0;
  std::optional<std::string> damage;
  std::optional<std::uint64_t> snapshot;   ///< the bytes of the one beside it
  std::unique_ptr<engine::Engine> engine;  ///< after the steps; null when they are not taken
};

int fail(const std::string& what, Outcome outcome) {
  std::cerr << "sesame info: " << what << '\n';
  return static_cast<int>(outcome);
}

/// Takes the next entry in. Errors: what is wrong with it.
Status take(Info& info, engine::LogReader::Entry entry) {
  if (const auto* binding = std::get_if<engine::Binding>(&entry)) {
    info.bound = *binding;
    return info.engine == nullptr ? Status{Done{}} : engine::check_binding(*info.engine, *binding);
  }
  ++info.operations[std::string{ops::keyword(std::get<ops::Operation>(entry))}];
  if (info.engine == nullptr) {
    return Done{};
  }
  const Result<engine::StepReport> report = info.engine->apply(std::get<ops::Operation>(std::move(entry)));
  return report ? Status{Done{}} : report.error();
}

/// Reads a log as far as it is whole. Errors: io; a header that is none.
Result<Info> read_info(engine::LogReader& reader, bool takes_steps) {
  Info info;
  const Result<std::optional<ops::Header>> header = reader.header();
  if (!header) {
    return header.error();
  }
  if (!*header) {
    return Error{Errc::bad_input, reader.name() + ": this log is empty: it has no header yet"};
  }
  info.header = **header;
  Result<std::unique_ptr<engine::Engine>> engine = engine_for(info.header);
  if (!engine) {
    return Error{Errc::bad_input, reader.name() + ": " + engine.error().what};
  }
  if (takes_steps) {
    info.engine = std::move(*engine);
  }
  while (!stop_requested()) {
    info.end = reader.position();
    Result<std::optional<engine::LogReader::Entry>> entry = reader.next();
    if (!entry && !reader.damage()) {
      return entry.error();
    }
    if (!entry) {
      info.damage = fmt::format("record {}, at byte {}: {}", reader.damage()->record, reader.damage()->byte,
                                reader.damage()->what);
      break;
    }
    if (!*entry) {
      break;
    }
    if (const Status taken = take(info, std::move(**entry)); !taken) {
      info.damage = fmt::format("record {}, at byte {}: {}", info.end.records, info.end.bytes, taken.error().what);
      break;
    }
  }
  info.end = info.damage ? info.end : reader.position();
  info.torn = reader.torn();
  return info;
}

void write_json(const Info& info) {
  nlohmann::ordered_json out{{"title", info.header.title}, {"ring", info.header.ring}, {"steps", info.end.steps()}};
  out["operations"] = info.operations;
  if (info.engine != nullptr) {
    const engine::Homology homology = info.engine->homology();
    nlohmann::ordered_json torsion = nlohmann::ordered_json::array();
    for (const auto& orders : homology.torsion) {
      nlohmann::ordered_json texts = nlohmann::ordered_json::array();
      for (const sparse::Integer& order : orders) {
        const auto word = order.to_int64();
        texts.push_back(word ? nlohmann::ordered_json(*word) : nlohmann::ordered_json(order.to_string()));
      }
      torsion.push_back(texts);
    }
    out["cells"] = std::vector<std::uint64_t>(info.engine->cells().begin(), info.engine->cells().end());
    out["betti"] = homology.betti;
    out["torsion"] = torsion;
  }
  out["bytes"] = info.end.bytes + info.torn;
  out["checksums"] = info.end.is_checked;
  out["synced"] = info.end.synced;
  out["bound"] = info.bound ? nlohmann::ordered_json(info.bound->steps) : nlohmann::ordered_json(nullptr);
  out["snapshot"] = info.snapshot ? nlohmann::ordered_json(*info.snapshot) : nlohmann::ordered_json(nullptr);
  out["torn"] = info.torn;
  out["damage"] = info.damage ? nlohmann::ordered_json(*info.damage) : nlohmann::ordered_json(nullptr);
  std::cout << out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

void write_text(const Info& info) {
  const auto row = [](const char* what, const std::string& text) {
    std::cout << fmt::format("{:<11}{}\n", what, text);
  };
  row("title", info.header.title.empty() ? "none" : info.header.title);
  row("ring", info.header.ring);
  std::string operations;
  for (const auto& [keyword, count] : info.operations) {
    operations += fmt::format("{}{} {}", operations.empty() ? ": " : ", ", count, keyword);
  }
  row("steps", fmt::format("{}{}", info.end.steps(), operations));
  if (info.engine != nullptr) {
    row("cells", fmt::format("{}", fmt::join(info.engine->cells(), " ")));
    row("homology", replay::homology_line(info.engine->homology(), info.engine->ring()));
  }
  row("checksums", info.end.is_checked ? "yes" : "none: a script");
  if (info.end.is_checked) {
    row("on disk", fmt::format("step {}, at least, when the log was last written", info.end.synced));
    row("bound", info.bound ? fmt::format("to the answers after step {}", info.bound->steps) : "not yet");
  }
  row("snapshot", info.snapshot ? fmt::format("{} bytes", *info.snapshot) : "none");
  if (info.torn > 0) {
    row("torn", fmt::format("{} bytes at the end, which are no whole record", info.torn));
  }
  row("damage", info.damage.value_or("none"));
}

int run_info(const Arguments& arguments) {
  catch_interrupt();
  Result<engine::LogReader> reader = open_log(arguments.file, arguments.longest_line);
  if (!reader) {
    return fail(reader.error().what, Outcome::wrong_usage);
  }
  Result<Info> info = read_info(*reader, !arguments.no_replay);
  if (!info) {
    return fail(info.error().what, replay::outcome_of(info.error().code));
  }
  if (stop_requested()) {
    return static_cast<int>(Outcome::interrupted);
  }
  std::error_code unknown;
  const auto size = std::filesystem::file_size(engine::LogSnapshots::path_of(arguments.file), unknown);
  info->snapshot = unknown ? std::nullopt : std::optional<std::uint64_t>{size};
  (arguments.json ? write_json : write_text)(*info);
  return static_cast<int>(info->damage ? Outcome::wrong_script : Outcome::done);
}

}  // namespace

void add_info_command(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("info", "What is in a log: steps, cells, groups, and whether it is sound");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("LOG", arguments->file, "A log, or a script; - for standard input")->required();
  command->add_flag("--no-replay", arguments->no_replay, "Do not take its steps: no cells and no groups, but at once");
  command->add_option("--max-line", arguments->longest_line, "Refuse lines of more bytes")
      ->capture_default_str()
      ->check(from_one_on());
  command->add_flag("--json", arguments->json, "One JSON object on standard output");
  command->footer(
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 damaged (what comes before it is shown), 130\n"
      "interrupted by Ctrl-C.");
  command->callback([arguments, &status] { status = run_info(*arguments); });
}

}  // namespace sesame::tools
