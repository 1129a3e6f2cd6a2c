#include "replay/script/script.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "replay/text/input_kind.hpp"
#include "replay/text/line_words.hpp"

namespace sesame::replay {
namespace {

constexpr std::string_view command = "sesame replay";

bool carries_an_object(std::string_view line) {
  return !line.empty() && line.front() != '#' && line.find_first_not_of(" \t\r") != std::string_view::npos;
}

/// Data that are no text may have no lines.
Status check_is_text(std::string_view beginning, const std::string& name) {
  const std::size_t zero = beginning.find('\0');
  if (zero == std::string_view::npos) {
    return Done{};
  }
  return Error{Errc::bad_input, fmt::format("{}: a script is a text, but byte {} of this is zero{}", name, zero,
                                            advice_on(beginning.substr(0, zero), name, command))};
}

}  // namespace

/// The next header or operation, or nothing at the end.
Result<engine::RecordReader::Entry> ScriptReader::next_entry() {
  using Entry = engine::RecordReader::Entry;
  while (true) {
    const Result<std::optional<std::string_view>> line = lines_.next();
    if (!line) {
      return line.error();
    }
    if (!*line) {
      return Entry{};
    }
    if (!lines_.has_end() && (records_.position().is_checked || engine::LineChecker::is_checked(**line))) {
      return Error{Errc::bad_input, fmt::format("{}this log ends in the middle of a record, with which it was cut off; "
                                                "\"sesame replay --log {} --append\" goes on from what is whole",
                                                place(), lines_.name())};
    }
    const bool is_header = records_.position().records == 0;
    Result<Entry> entry = records_.take(**line);
    if (!entry) {
      const std::string advice = is_header && !is_broken() ? advice_on(**line, lines_.name(), command) : "";
      return Error{entry.error().code, place() + entry.error().what + advice};
    }
    if (const auto* binding = std::get_if<engine::Binding>(&*entry)) {
      binding_ = *binding;
    } else if (!std::holds_alternative<std::monostate>(*entry)) {
      return entry;
    }
  }
}

Result<ops::Header> ScriptReader::header() {
  const Result<std::string_view> beginning = lines_.beginning();
  if (!beginning) {
    return beginning.error();
  }
  if (Status text = check_is_text(*beginning, lines_.name()); !text) {
    return text.error();
  }
  Result<engine::RecordReader::Entry> entry = next_entry();
  if (!entry) {
    return entry.error();
  }
  if (auto* header = std::get_if<ops::Header>(&*entry)) {
    return std::move(*header);
  }
  return Error{Errc::bad_input, lines_.name() +
                                    ": this script is empty: its first object should be the header, such as "
                                    "{\"sesame\":1,\"ring\":\"Z\",\"title\":\"torus\"}"};
}

Result<std::optional<ops::Operation>> ScriptReader::next() {
  Result<engine::RecordReader::Entry> entry = next_entry();
  if (!entry) {
    return entry.error();
  }
  if (std::holds_alternative<std::monostate>(*entry)) {
    return std::optional<ops::Operation>{};
  }
  lines_.drop();  // a mesh is one line: what is read of it takes enough
  return std::optional{std::get<ops::Operation>(std::move(*entry))};
}

Result<std::uint64_t> count_operations(ByteSource source, std::uint64_t most) {
  LineSource lines(std::move(source));
  bool is_header = true;
  for (std::uint64_t operations = 0; operations < most;) {
    const Result<std::optional<std::string_view>> line = lines.next();
    if (!line) {
      return line.error();
    }
    if (!*line) {
      return operations;
    }
    if (carries_an_object(**line) && !std::exchange(is_header, false)) {
      ++operations;
    }
  }
  return most;
}

}  // namespace sesame::replay
