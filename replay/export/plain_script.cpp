#include "replay/export/plain_script.hpp"

#include <fmt/format.h>

#include <string>
#include <variant>
#include <vector>

namespace sesame::replay {
namespace {

/// The steps that have not been taken back so far, as lines.
class KeptSteps {
 public:
  Status take(const ops::Operation& operation) {
    const auto* undo = std::get_if<ops::Undo>(&operation);
    if (undo == nullptr) {
      lines_.push_back(ops::to_text(operation));
      return Done{};
    }
    if (undo->steps > lines_.size()) {
      return Error{Errc::bad_input, fmt::format("there are {} steps that can be undone, and steps should not be more, "
                                                "such as {}",
                                                lines_.size(), undo->steps)};
    }
    lines_.resize(lines_.size() - undo->steps);
    return Done{};
  }

  void write(std::ostream& out) const {
    for (const std::string& line : lines_) {
      out << line << '\n';
    }
  }

 private:
  std::vector<std::string> lines_;
};

}  // namespace

Result<bool> write_plain_script(ScriptReader& script, const PlainScriptOptions& options, std::ostream& out) {
  const auto is_stopped = [&] { return options.stop != nullptr && options.stop->load(); };
  const Result<ops::Header> header = script.header();
  if (!header) {
    return is_stopped() ? Result<bool>{false} : header.error();
  }
  out << ops::to_text(*header) << '\n';
  KeptSteps kept;
  for (std::uint64_t read = 0; !options.until || read < *options.until; ++read) {
    const Result<std::optional<ops::Operation>> operation = script.next();
    if (is_stopped()) {
      return false;
    }
    if (!operation) {
      return operation.error();
    }
    if (!*operation) {
      break;
    }
    if (!options.without_undone) {
      out << ops::to_text(**operation) << '\n';
    } else if (const Status taken = kept.take(**operation); !taken) {
      return Error{taken.error().code, script.place() + taken.error().what};
    }
  }
  kept.write(out);
  return true;
}

}  // namespace sesame::replay
