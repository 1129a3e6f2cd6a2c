#include "replay/script.hpp"

#include <string_view>

#include "replay/line_words.hpp"

namespace sesame::replay {
namespace {

bool carries_an_object(std::string_view line) {
  return !line.empty() && line.front() != '#' && line.find_first_not_of(" \t\r") != std::string_view::npos;
}

}  // namespace

ScriptReader::ScriptReader(std::istream& input, std::string name, std::function<bool()> wait_for_more)
    : input_{input}, name_{std::move(name)}, wait_for_more_{std::move(wait_for_more)} {}

std::string ScriptReader::place() const { return name_ + ":" + std::to_string(line_) + ": "; }

bool ScriptReader::read_object_line() {
  text_.clear();
  while (true) {
    std::string part;
    std::getline(input_, part);
    text_ += part;
    if (input_.bad()) {
      return false;  // what was cut off is no line of the script
    }
    if (input_.eof() && wait_for_more_) {
      if (!wait_for_more_()) {
        return false;  // an unfinished line was still being written
      }
      input_.clear();
      continue;
    }
    if (input_.eof() && text_.empty()) {
      return false;
    }
    ++line_;
    if (line_ == 1) {
      text_ = without_mark(text_);
    }
    if (carries_an_object(text_)) {
      return true;
    }
    text_.clear();
    if (!input_) {
      return false;
    }
  }
}

Result<ops::Header> ScriptReader::header() {
  if (!read_object_line()) {
    return Error{Errc::bad_input, name_ +
                                      ": this script is empty: its first object should be the header, such as "
                                      "{\"sesame\":1,\"ring\":\"Z\",\"title\":\"torus\"}"};
  }
  Result<ops::Header> header = ops::parse_header(text_);
  if (!header) {
    return Error{header.error().code, place() + header.error().what};
  }
  return header;
}

Result<std::optional<ops::Operation>> ScriptReader::next() {
  if (!read_object_line()) {
    return std::optional<ops::Operation>{};
  }
  Result<ops::Operation> operation = ops::parse_operation(text_);
  if (!operation) {
    return Error{operation.error().code, place() + operation.error().what};
  }
  return std::optional{std::move(*operation)};
}

std::uint64_t count_operations(std::istream& input) {
  std::uint64_t objects = 0;
  std::string line;
  for (bool is_first = true; std::getline(input, line); is_first = false) {
    objects += carries_an_object(is_first ? without_mark(line) : line) ? 1U : 0U;
  }
  return objects == 0 ? 0 : objects - 1;
}

}  // namespace sesame::replay
