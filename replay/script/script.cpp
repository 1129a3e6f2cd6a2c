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

Result<std::optional<std::string_view>> ScriptReader::next_object() {
  while (true) {
    Result<std::optional<std::string_view>> line = lines_.next();
    if (!line || !*line || carries_an_object(**line)) {
      return line;
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
  const Result<std::optional<std::string_view>> line = next_object();
  if (!line) {
    return line.error();
  }
  if (!*line) {
    return Error{Errc::bad_input, lines_.name() +
                                      ": this script is empty: its first object should be the header, such as "
                                      "{\"sesame\":1,\"ring\":\"Z\",\"title\":\"torus\"}"};
  }
  Result<ops::Header> header = ops::parse_header(**line);
  if (header) {
    return header;
  }
  return Error{header.error().code, place() + header.error().what + advice_on(**line, lines_.name(), command)};
}

Result<std::optional<ops::Operation>> ScriptReader::next() {
  const Result<std::optional<std::string_view>> line = next_object();
  if (!line) {
    return line.error();
  }
  if (!*line) {
    return std::optional<ops::Operation>{};
  }
  Result<ops::Operation> operation = reader_.read(**line);
  if (!operation) {
    return Error{operation.error().code, place() + operation.error().what};
  }
  lines_.drop();  // a mesh is one line: what is read of it takes enough
  return std::optional{std::move(*operation)};
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
