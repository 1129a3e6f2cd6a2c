// Names: made by steps that the input says, a line each, and read in whatever way it asks for them.
#include "ops/name_table.hpp"

#include <map>
#include <optional>
#include <vector>

#include "ops/cells/name_reader.hpp"
#include "ops/cells/name_text.hpp"
#include "ops/plan/workspace.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/plain_names.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

constexpr std::size_t most_lines = 64, longest_plain = 24;
constexpr std::uint64_t most_nodes = 2000;
constexpr ops::Limits limits{
    .cells_of_standard = 256, .cells_per_step = 256, .cells_of_explicit_cone = 8, .cells = 4000};

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) {
      return parts;
    }
    text.remove_prefix(end + 1);
  }
}

/// The step that a line says by its first character, if it is one.
std::optional<ops::Operation> step_of(const std::string& line) {
  const std::vector<std::string> words =
      split(std::string_view{line}.substr(std::min<std::size_t>(2, line.size())), ' ');
  const std::string& first = words.front();
  const std::string second = words.size() > 1 ? words[1] : "", third = words.size() > 2 ? words[2] : "";
  switch (line[0]) {
    case '0':
    case '1':
    case '2':
    case '3':
      return ops::MakeSimplex{first, line[0] - '0', {}};
    case 'q':
      return ops::MakeSimploid{first, {1, 1}, {}};
    case 'v':
      return ops::MakeCone{first, {}, {}};
    case 'w':
      return ops::MakeCone{first, second, {}};
    case 'x':
      return ops::MakeProduct{first, second, third, false};
    case 'y':
      return ops::MakeProduct{first, second, third, true};
    case '=':
      return ops::Identify{{{first, second}}, {}};
    case '!':
      return ops::Degenerate{first, 1, 0};
    case '{':
      return ops::Insert{{words}, true};
    case '>':
      return ops::Collapse{first, second};
    case '/':
      return ops::Deidentify{{{first, second, {}}}};
    case '5':
    case '6':
      return ops::MakePolygon{first, 1 + static_cast<int>(second.size() % 6), line[0] == '6'};
    case '+':
      return ops::Sew{2, {{first, second}}};
    case '-':
      return ops::Unsew{2, {first}};
    case '^':
      return ops::Extend{words};
    default:
      return std::nullopt;
  }
}

/// The parts of a name, each by itself.
void take_apart(const std::string& name) {
  const ops::Brackets brackets(name);
  for (std::size_t k = 0; k < name.size(); ++k) {
    if (const auto* pair = brackets.at(k)) {
      demand(pair->open == k && (pair->close == ops::Brackets::nowhere || name.at(pair->close) == ')'),
             "brackets match");
      demand(pair->bar == ops::Brackets::nowhere || name.at(pair->bar) == '|', "a bar is a bar");
    }
  }
  if (const auto split_off = ops::split_directions(name)) {
    demand(split_off->length < name.size(), "directions take a part of the name");
  }
  const auto vertices = ops::split_vertices(name);
  for (const ops::CellType& type : {ops::CellType{2}, ops::CellType{1, 1}, ops::CellType{2, 1, 3}}) {
    if (const auto list = ops::read_vertices(vertices ? vertices->vertices : std::string_view{name}, type)) {
      demand(!list->sorted.empty(), "a list of vertices has some");
      const auto again = ops::read_vertices(list->sorted, type);
      demand(again && again->sorted == list->sorted && again->is_whole == list->is_whole, "sorted lists stay");
    }
  }
}

class Session {
 public:
  void take(const std::string& line) {
    const auto step = step_of(line);
    if (step && structure().cells().size() < most_nodes) {
      before_.push_back(said_);
      if (went_well(workspace_.plan(*step))) {
        workspace_.carry_out();
      } else {
        before_.pop_back();
      }
    } else if (line[0] == '<') {
      if (went_well(workspace_.take_back(1))) {
        said_ = before_.back();
        before_.pop_back();
      }
    } else {
      ask(line);
    }
    look_again();
  }

 private:
  [[nodiscard]] const ops::Structure& structure() const { return workspace_.structure(); }

  [[nodiscard]] std::optional<ops::Value> value_of(const std::string& name) const {
    const auto node = structure().lookup(name);
    return node ? std::optional{structure().values().of(*node)} : std::nullopt;
  }

  /// What a name denotes, by both readers; and the canonical name of that denotes the same.
  void ask(const std::string& name) {
    take_apart(name);
    const auto denoted = structure().denoted(name);
    const auto once_more = structure().denoted(name);
    demand(denoted.has_value() == once_more.has_value() && (!denoted || denoted->node == once_more->node),
           "names do not change");
    const Result<ops::Value> resolved = workspace_.planner().resolve(name);
    (void)went_well(resolved);
    const auto value = value_of(name);
    if (value) {
      const std::string canonical = structure().name(value->cell);
      const auto same = value_of(canonical);
      demand(same && same->cell == value->cell, "a canonical name denotes its cell: " + canonical);
      demand(denoted.has_value(), "what is looked up is denoted");
      said_[name] = canonical_of(*value);
    }
    // Names of cells of maps go with their darts, of which the plain rules know nothing.
    if (name.size() <= longest_plain && !structure().maps().has_orders() && structure().darts().maps() == 0) {
      const auto plain = PlainReader(structure()).read(name);
      if (plain && (!value || structure().values().of(plain->cell) != structure().values().of(value->cell))) {
        demand(!value && is_given_up(name), "a name denotes what the plain rules say: " + name);
      }
    }
  }

  [[nodiscard]] bool is_given_up(const std::string& name) const {
    ops::NameReader reader(structure(), name);
    return !reader.read() && reader.failure() != ops::NameReader::Failure::unknown;
  }

  [[nodiscard]] std::string canonical_of(const ops::Value& value) const { return structure().name(value.cell); }

  /// What denoted something goes on doing so, and no new name may be taken of those.
  void look_again() {
    for (const auto& [name, canonical] : said_) {
      demand(value_of(name).has_value() || is_gone(canonical), "a name that denotes something goes on: " + name);
      demand(structure().is_name_taken(name) || is_gone(canonical), "a name that denotes something is taken: " + name);
    }
  }
  /// A product consumes its factors.
  [[nodiscard]] bool is_gone(const std::string& canonical) const {
    const auto node = structure().lookup(canonical);
    return !node || structure().lazy().is_consumed(*node);
  }

  ops::Workspace workspace_{limits};
  std::map<std::string, std::string> said_;  ///< names that denote something, and what
  std::vector<std::map<std::string, std::string>> before_;
};

/// The table beside a map.
void compare_tables(const std::vector<std::string>& lines) {
  ops::NameTable table;
  std::map<std::string, std::uint32_t> plain;
  std::vector<std::string> given;
  for (const std::string& line : lines) {
    if (line == "<") {
      if (!given.empty()) {
        table.pop_back();
        plain.erase(given.back());
        given.pop_back();
      }
    } else if (!plain.contains(line)) {
      demand(table.find(line) == nullptr, "a name that was not given is not there");
      plain[line] = table.size();
      table.add(line, ops::CellId{static_cast<std::uint32_t>(given.size())}, ops::none);
      given.push_back(line);
    }
    demand(table.size() == plain.size(), "as many names as were given");
  }
  for (const auto& [text, number] : plain) {
    demand(table.number_of(text) == number && table[number].text == text, "a name that was given is there");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> lines = split(text_of(data, size), '\n');
  if (lines.size() > most_lines) {
    lines.resize(most_lines);
  }
  compare_tables(lines);
  Session session;
  for (const std::string& line : lines) {
    if (!line.empty()) {
      session.take(line);
    }
  }
  return 0;
}
