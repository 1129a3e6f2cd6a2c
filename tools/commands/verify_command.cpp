#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/open.hpp"
#include "replay/script/replay.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/interrupt.hpp"
#include "tools/commands/log_input.hpp"
#include "tools/commands/options.hpp"

namespace sesame::tools {
namespace {

using replay::Outcome;

struct Arguments {
  std::string file, salvaged;
  std::size_t longest_line = replay::longest_line;
  bool json = false, laws = false;
};

/// What was found in a log.
struct Findings {
  std::optional<engine::Damage> damage;
  std::optional<std::string> broken_law;
  std::uint64_t torn = 0;
  engine::LogPosition good;  ///< the end of what is whole
};

int fail(const std::string& what) {
  std::cerr << "sesame verify: " << what << '\n';
  return static_cast<int>(Outcome::wrong_usage);
}

/// Applies a record, as it should be possible, and checks every law.
class Audit {
 public:
  /// What is wrong with the log, or with sesame. Errors: what is wrong with the record.
  Result<std::optional<std::string>> take(const engine::LogReader::Entry& entry) {
    if (const auto* binding = std::get_if<engine::Binding>(&entry)) {
      const Status bound = engine::check_binding(*engine_, *binding);
      return bound ? std::optional<std::string>{} : std::optional{bound.error().what};
    }
    const Result<engine::StepReport> report = engine_->apply(std::get<ops::Operation>(entry));
    if (!report) {
      return report.error();
    }
    std::optional<std::string> defect = engine_->first_defect();
    if (defect) {
      *defect = fmt::format("after step {} ({}) a law does not hold: {}", report->step, report->op, *defect);
    }
    return defect;
  }
  Status begin(const ops::Header& header) {
    Result<std::unique_ptr<engine::Engine>> engine = engine_for(header);
    if (!engine) {
      return engine.error();
    }
    engine_ = std::move(*engine);
    return Done{};
  }

 private:
  std::unique_ptr<engine::Engine> engine_;
};

/// Reads a log to its end, or to what is wrong in it. Errors: io; what is no log at all.
Result<Findings> examine(engine::LogReader& reader, bool laws) {
  Findings found;
  const auto ended = [&](const Error& error) -> Result<Findings> {
    found.good = reader.position();
    found.damage = reader.damage();
    return found.damage ? Result<Findings>{found} : error;
  };
  Audit audit;
  const Result<std::optional<ops::Header>> header = reader.header();
  if (!header) {
    return ended(header.error());
  }
  if (*header && laws) {
    if (const Status begun = audit.begin(**header); !begun) {
      found.damage = engine::Damage{0, 0, begun.error().what};
      return found;
    }
  }
  while (*header && !stop_requested()) {
    found.good = reader.position();
    const Result<std::optional<engine::LogReader::Entry>> entry = reader.next();
    if (!entry) {
      return ended(entry.error());
    }
    if (!*entry) {
      break;
    }
    if (!laws) {
      continue;
    }
    const Result<std::optional<std::string>> defect = audit.take(**entry);
    if (!defect) {
      found.damage = engine::Damage{found.good.records, found.good.bytes, defect.error().what};
      return found;
    }
    if (*defect) {
      found.broken_law = *defect;
      return found;
    }
  }
  found.good = reader.position();
  found.torn = reader.torn();
  return found;
}

void write_json(const Findings& found) {
  nlohmann::ordered_json out{{"steps", found.good.steps()},
                             {"whole", !found.damage && found.torn == 0},
                             {"torn", found.torn},
                             {"damage", nullptr}};
  if (found.damage) {
    out["damage"] = {{"record", found.damage->record}, {"byte", found.damage->byte}, {"what", found.damage->what}};
  }
  if (found.broken_law) {
    out["law"] = *found.broken_law;
  }
  std::cout << out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

void write_text(const Arguments& arguments, const Findings& found) {
  const std::string& name = arguments.file;
  if (found.damage) {
    std::cout << fmt::format("{}: record {}, at byte {}: {}\n", name, found.damage->record, found.damage->byte,
                             found.damage->what);
    std::cout << fmt::format("{}: {} steps before it are whole{}\n", name, found.good.steps(),
                             arguments.salvaged.empty() ? "; --salvage NEW writes them into a new log" : "");
  } else if (found.broken_law) {
    std::cout << fmt::format("{}: {}\n", name, *found.broken_law);
  } else {
    std::cout << fmt::format("{}: {} steps, {}{}\n", name, found.good.steps(),
                             found.good.is_checked ? "whole" : "whole as far as can be said: a script has no checksums",
                             arguments.laws ? "; every law holds at every step" : "");
  }
  if (found.torn > 0) {
    std::cout << fmt::format("{}: {} bytes behind step {} are no whole record, cut off while it was written\n", name,
                             found.torn, found.good.steps());
  }
}

int run_verify(const Arguments& arguments) {
  if (arguments.file == "-" && !arguments.salvaged.empty()) {
    return fail("--salvage reads the log twice, which standard input cannot be; give a file");
  }
  catch_interrupt();
  Result<engine::LogReader> reader = open_log(arguments.file, arguments.longest_line);
  if (!reader) {
    return fail(reader.error().what);
  }
  const Result<Findings> found = examine(*reader, arguments.laws);
  if (!found) {
    return fail(found.error().what);
  }
  if (stop_requested()) {
    return static_cast<int>(Outcome::interrupted);
  }
  if (!arguments.salvaged.empty()) {
    if (const Status salvaged = salvage(arguments.file, found->good, arguments.salvaged); !salvaged) {
      return fail(salvaged.error().what);
    }
  }
  if (arguments.json) {
    write_json(*found);
  } else {
    write_text(arguments, *found);
  }
  return static_cast<int>(found->damage       ? Outcome::wrong_script
                          : found->broken_law ? Outcome::law_failed
                                              : Outcome::done);
}

}  // namespace

void add_verify_command(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("verify", "Whether a log is as it was written, and what is good of it");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("LOG", arguments->file, "A log, or a script; - for standard input")->required();
  command->add_flag("--laws", arguments->laws, "Take its steps, and check every law after each of them (slow)");
  command->add_option("--salvage", arguments->salvaged, "Write what is whole, from the beginning on, into a new log");
  command->add_option("--max-line", arguments->longest_line, "Refuse lines of more bytes")
      ->capture_default_str()
      ->check(from_one_on());
  command->add_flag("--json", arguments->json, "One JSON object on standard output");
  command->footer(
      "Exit status: 0 whole, or torn off at the end only; 1 wrong usage or unreadable file; 2 damaged; 4 a law or an\n"
      "answer that the log is bound to does not hold; 130 interrupted by Ctrl-C.");
  command->callback([arguments, &status] { status = run_verify(*arguments); });
}

}  // namespace sesame::tools
