#include "replay/script/facet_list.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ops/simplicial/abstract_complex.hpp"
#include "ops/vocabulary/operation.hpp"
#include "replay/text/line_words.hpp"

namespace sesame::replay {
namespace {

constexpr std::string_view opening = "([{", closing = ")]}", blanks = " \t\r\v\f", quotes = "'\"";

bool is_one_of(char c, std::string_view characters) { return characters.find(c) != std::string_view::npos; }
bool is_separator(char c) { return c == ',' || is_one_of(c, blanks); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// A letter of ASCII or a piece of any other character.
bool starts_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80U;
}

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// Up to a `#` that begins a word.
std::string_view without_comment(std::string_view text) {
  for (std::size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at + 1)) {
    if (at == 0 || is_one_of(text[at - 1], blanks)) {
      return text.substr(0, at);
    }
  }
  return text;
}

/// Whether it is one word that starts as names do.
bool is_word(std::string_view text) {
  return !text.empty() && starts_name(text[0]) && text.find_first_of(" \t\r\v\f,;=:") == std::string_view::npos;
}

/// Whether this may stand before the first bracket: `NAME =`, `NAME :=`, `FUNCTION(` or both.
bool is_heading(std::string_view text, char bracket) {
  if (const std::size_t equals = text.find('='); equals != std::string_view::npos) {
    const std::size_t end = equals > 0 && text[equals - 1] == ':' ? equals - 1 : equals;
    if (!is_word(without_blanks(text.substr(0, end)))) {
      return false;
    }
    text.remove_prefix(equals + 1);
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  }
  return text.empty() || (bracket == '(' && is_word(text));
}

}  // namespace

bool starts_facet_groups(std::string_view line) {
  line = without_blanks(without_comment(line));
  const std::size_t bracket = line.find_first_of(opening);
  if (bracket == std::string_view::npos) {
    return line.ends_with('=') && is_heading(line, ' ');
  }
  const std::string_view inside = without_blanks(line.substr(bracket + 1));
  const bool is_object = line[bracket] == '{' && (inside.empty() || inside[0] == '"' || inside[0] == '}');
  return !(bracket == 0 && is_object) && is_heading(line.substr(0, bracket), line[bracket]);
}

Error FacetParser::error(const std::string& what) const {
  return {Errc::bad_input, fmt::format("{}:{}: {}", name_, line_, what)};
}

Status FacetParser::take(std::string_view text, std::uint64_t line) {
  line_ = line;
  text = without_blanks(without_comment(text));
  if (text.empty()) {
    return Done{};
  }
  if (style_ == Style::unknown) {
    style_ = starts_facet_groups(text) || is_one_of(text[0], opening) ? Style::groups : Style::lines;
    if (style_ == Style::groups) {
      text.remove_prefix(std::min(text.find_first_of(opening), text.size()));
    }
  }
  return style_ == Style::groups ? take_groups(text) : take_facet(text);
}

Status FacetParser::take_facet(std::string_view text) {
  std::vector<std::string> labels;
  while (!text.empty()) {
    if (is_separator(text[0]) || text == ";") {
      text.remove_prefix(1);
      continue;
    }
    if (is_one_of(text[0], opening) || is_one_of(text[0], closing)) {
      return error(
          "brackets in a list that has not begun with one; before the "
          "first there may be a name with =, or the "
          "name of a function");
    }
    if (Status taken = take_label(text, labels); !taken) {
      return taken;
    }
  }
  return labels.empty() ? Status{Done{}} : add(std::move(labels));
}

Status FacetParser::take_groups(std::string_view text) {
  while (!text.empty()) {
    const char c = text[0];
    Status taken = Done{};
    if (is_one_of(c, opening)) {
      taken = open(c);
    } else if (is_one_of(c, closing)) {
      taken = close(c);
    } else if (c == ';' && open_.empty()) {
      is_closed_ = true;
    } else if (!is_separator(c)) {
      if (open_.empty()) {
        return error(
            fmt::format("{} stands outside of the brackets; a file should have the facets "
                        "of one complex, in "
                        "one list",
                        shown(text.substr(0, text.find_first_of(" \t\r\v\f,([{")))));
      }
      if (open_.back().has_groups) {
        return error(
            fmt::format("{} stands between facets, which are in brackets of their own", shown(LineWords(text).word())));
      }
      if (taken = take_label(text, open_.back().labels); !taken) {
        return taken;
      }
      continue;
    }
    if (!taken) {
      return taken;
    }
    text.remove_prefix(1);
  }
  return Done{};
}

Status FacetParser::take_label(std::string_view& text, std::vector<std::string>& labels) const {
  const std::string_view whole = text;
  std::string_view label;
  bool is_quoted = is_one_of(text[0], quotes);
  if (is_quoted) {
    const std::size_t end = text.find(text[0], 1);
    is_quoted = end != std::string_view::npos;
    label = text.substr(1, is_quoted ? end - 1 : end);
    text.remove_prefix(is_quoted ? end + 1 : text.size());
  } else {
    label = text.substr(0, text.find_first_of(" \t\r\v\f,;()[]{}'\""));
    text.remove_prefix(label.size());
  }
  const bool is_number = !label.empty() && std::all_of(label.begin(), label.end(), is_digit);
  if (is_number) {
    label.remove_prefix(std::min(label.find_first_not_of('0'), label.size() - 1));
  } else if (!ops::is_label(label) || !(is_quoted || starts_name(label[0]))) {
    return error(fmt::format("{} should be a vertex: a whole number from 0 on, or a name",
                             shown(label.empty() ? whole.substr(0, 1) : label)));
  }
  labels.emplace_back(label);
  return Done{};
}

Status FacetParser::open(char bracket) {
  if (is_closed_) {
    return error(
        "a second list begins; a file should have the facets of one "
        "complex, in one list");
  }
  if (!open_.empty()) {
    if (!open_.back().labels.empty()) {
      return error(
          "brackets open behind vertices; a facet should be a list of "
          "vertices and of nothing else");
    }
    open_.back().has_groups = true;
  }
  open_.push_back({bracket, false, {}});
  return Done{};
}

Status FacetParser::close(char bracket) {
  if (open_.empty() || opening.find(open_.back().bracket) != closing.find(bracket)) {
    return error(open_.empty() ? fmt::format("'{}' closes what is not open", bracket)
                               : fmt::format("'{}' cannot close '{}'", bracket, open_.back().bracket));
  }
  Group group = std::move(open_.back());
  open_.pop_back();
  const std::size_t depth = open_.size() + 1;
  const bool is_empty_list = depth == 1 && !group.has_groups && group.labels.empty() && facet_depth_ == 0;
  is_closed_ = depth == 1 && (group.has_groups || is_empty_list);
  if (group.has_groups || is_empty_list) {
    return Done{};
  }
  if (facet_depth_ != 0 && facet_depth_ != depth) {
    return error(
        "facets stand at different depths of brackets; a list of "
        "facets should have all at one");
  }
  facet_depth_ = depth;
  return add(std::move(group.labels));
}

Status FacetParser::add(std::vector<std::string> labels) {
  if (labels.empty()) {
    return error("a facet should have at least one vertex");
  }
  std::vector<std::string> sorted = labels;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end()) {
    return error(fmt::format("the vertex {} stands twice in a facet", *twice));
  }
  facets_.push_back({std::move(labels), line_});
  has_facets_ = true;
  return Done{};
}

Status FacetParser::finish() const {
  if (!open_.empty()) {
    return error(fmt::format("the list ends here, but '{}' has not been closed", open_.back().bracket));
  }
  return has_facets_ ? Status{Done{}} : error("this list has no facets; it should have one at least, such as [1,2,3]");
}

std::optional<Facet> FacetParser::next() {
  if (facets_.empty()) {
    return std::nullopt;
  }
  std::optional<Facet> facet = std::move(facets_.front());
  facets_.pop_front();
  return facet;
}

Result<std::vector<Facet>> read_facets(LineSource lines) {
  FacetParser parser(lines.name());
  std::vector<Facet> facets;
  while (true) {
    const Result<std::optional<std::string_view>> text = lines.next();
    if (!text) {
      return text.error();
    }
    const Status taken = *text ? parser.take(**text, lines.line()) : parser.finish();
    if (!taken) {
      return taken.error();
    }
    while (std::optional<Facet> facet = parser.next()) {
      facets.push_back(std::move(*facet));
    }
    if (!*text) {
      return facets;
    }
  }
}

std::string script_of(const std::vector<Facet>& facets, const std::string& ring, const std::string& title,
                      FacetSteps steps) {
  std::string script = ops::to_text(ops::Header{1, ring, title}) + "\n";
  ops::Insert insert{{}, true};
  for (const Facet& facet : facets) {
    insert.simplices.push_back(facet.labels);
    if (steps == FacetSteps::each) {
      script += ops::to_text(insert) + "\n";
      insert.simplices.clear();
    }
  }
  return steps == FacetSteps::each ? script : script + ops::to_text(insert) + "\n";
}

}  // namespace sesame::replay
