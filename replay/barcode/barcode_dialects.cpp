#include "replay/barcode/barcode_dialects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "replay/text/line_words.hpp"

namespace sesame::replay {
namespace {

using Json = nlohmann::json;

constexpr std::string_view heading = "persistence intervals in dim ", blanks = " \t\r\v\f";

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// As a word of a line; what is no number or text is as good as any other wrong word.
std::string word_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

Error error_at(const std::string& name, std::uint64_t line, const std::string& what) {
  return {Errc::bad_input, fmt::format("{}:{}: {}", name, line, what)};
}

/// Why an object has no barcode, or that it is one of the states before it.
std::string objection(const Json& object) {
  if (object.contains("rings")) {
    return "these are the barcodes over several rings; run sesame tower with one --ring for each";
  }
  return object.contains("groups") ? "these are groups over Z, which have no bars; take a field, such as --ring Z/2"
                                   : "";
}

}  // namespace

BarcodeDialect dialect_of(std::string_view line) {
  line = without_blanks(line);
  if (line.starts_with('{')) {
    return BarcodeDialect::json;
  }
  for (const std::string_view start :
       {heading, std::string_view{"value range:"}, std::string_view{"distance matrix with"},
        std::string_view{"sparse distance matrix with"}, std::string_view{"point cloud with"}}) {
    if (line.starts_with(start)) {
      return BarcodeDialect::ripser;
    }
  }
  return BarcodeDialect::pers;
}

Result<std::string> RipserLines::take(std::string_view line) {
  line = without_blanks(line);
  if (line.starts_with(heading)) {
    line.remove_prefix(heading.size());
    dimension_ = std::string{line.substr(0, line.find_first_of(": \t"))};
    return std::string{};
  }
  if (dimension_.empty() || line.empty()) {
    return std::string{};
  }
  const std::size_t comma = line.find(','), end = line.find(')');
  if (!line.starts_with('[') || comma == std::string_view::npos || end == std::string_view::npos || end < comma) {
    return Error{Errc::bad_input,
                 fmt::format("{} should be an interval, as Ripser writes it: [birth,death)", shown(line))};
  }
  const std::string_view birth = without_blanks(line.substr(1, comma - 1));
  const std::string_view death = without_blanks(line.substr(comma + 1, end - comma - 1));
  return fmt::format("{} {} {}", dimension_, birth, death.empty() ? "inf" : death);
}

Result<std::vector<PersLine>> bars_of_json(std::string_view text, const std::string& name, std::uint64_t first) {
  const auto line_of = [&](std::size_t byte) {
    return first + static_cast<std::uint64_t>(std::count(
                       text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size())), '\n'));
  };
  std::istringstream input{std::string{text}};
  Json found;
  std::uint64_t line = first;
  std::string reason = "the file has no object with \"bars\", as `sesame tower --json` prints it";
  while (!(input >> std::ws).eof()) {
    const auto begin = static_cast<std::size_t>(input.tellg());
    try {
      Json object;
      input >> object;
      if (object.is_object() && object.contains("bars")) {
        line = line_of(begin);
        found = std::move(object["bars"]);
      } else if (object.is_object() && !objection(object).empty()) {
        line = line_of(begin);
        reason = objection(object);
      }
    } catch (const Json::exception& e) {
      const auto* parse_error = dynamic_cast<const Json::parse_error*>(&e);
      return error_at(name, line_of(begin + (parse_error != nullptr ? parse_error->byte : 0)), "this is no JSON");
    }
  }
  if (!found.is_array()) {
    return error_at(name, line, reason);
  }
  std::vector<PersLine> lines;
  for (const Json& bar : found) {
    if (!bar.is_array() || bar.size() != 3) {
      return error_at(name, line, fmt::format("{} should be a bar, [dim,birth,death]", shown(bar.dump())));
    }
    lines.push_back(
        {fmt::format("{} {} {}", word_of(bar[0]), word_of(bar[1]), bar[2].is_null() ? "inf" : word_of(bar[2])), line});
  }
  return lines;
}

}  // namespace sesame::replay
