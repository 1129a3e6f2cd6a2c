#include "replay/tower/tower_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>

#include "replay/script/facet_list.hpp"
#include "replay/text/input_kind.hpp"
#include "replay/text/line_words.hpp"

namespace sesame::replay {
namespace {

struct NamedFormat {
  TowerFormat format;
  std::string_view name, description;
};
constexpr std::array formats{
    NamedFormat{TowerFormat::automatic, "auto", "what it looks like"},
    NamedFormat{TowerFormat::tower, "tower", "a tower"},
    NamedFormat{TowerFormat::phat, "phat", "a boundary matrix of PHAT"},
    NamedFormat{TowerFormat::phat_binary, "phat-binary", "a binary boundary matrix of PHAT"},
    NamedFormat{TowerFormat::gudhi, "gudhi", "a list of simplices and values, as GUDHI writes it"},
    NamedFormat{TowerFormat::facets, "facets", "a list of facets"},
    NamedFormat{TowerFormat::script, "script", "a script"},
    NamedFormat{TowerFormat::zigzag, "zigzag", "a zigzag"},
};
static_assert(formats.size() == static_cast<std::size_t>(TowerFormat::zigzag) + 1);

const NamedFormat& named(TowerFormat format) { return *std::ranges::find(formats, format, &NamedFormat::format); }

}  // namespace

std::string_view format_name(TowerFormat format) { return named(format).name; }

std::string_view format_description(TowerFormat format) { return named(format).description; }

/// Nothing when there is something else on the line, or no number.
std::optional<FormatFinder::Row> FormatFinder::row_of(std::string_view line) {
  Row row;
  for (LineWords words(line); !words.is_done();) {
    std::string_view word = words.take();
    row.has_commas = row.has_commas || word.find(',') != std::string_view::npos;
    while (!word.empty()) {
      const std::string_view text = word.substr(0, word.find(','));
      word.remove_prefix(std::min(text.size() + 1, word.size()));
      if (text.empty()) {
        continue;
      }
      Number number{};
      const char* const end = text.data() + text.size();
      const auto real = std::from_chars(text.data(), end, number.value);
      if (real.ec != std::errc{} || real.ptr != end) {
        return std::nullopt;
      }
      const auto whole = std::from_chars(text.data(), end, number.whole);
      number.is_whole = whole.ec == std::errc{} && whole.ptr == end;
      row.numbers.push_back(number);
    }
  }
  return row.numbers.empty() ? std::nullopt : std::optional{std::move(row)};
}

/// Right in its form; whether it can be one of a filtration is noted.
bool FormatFinder::continues_gudhi(std::span<const Number> numbers) {
  const auto dimension = numbers[0];
  if (!dimension.is_whole || (lines_ == 0 && dimension.whole != 0) || numbers.size() < 3 ||
      dimension.whole != numbers.size() - 3) {
    return false;
  }
  for (const Number& vertex : numbers.subspan(1, numbers.size() - 2)) {
    if (!vertex.is_whole) {
      return false;
    }
    is_filtration_ = is_filtration_ && (dimension.whole == 0) == vertices_.insert(vertex.whole).second;
  }
  is_filtration_ = is_filtration_ && (lines_ == 0 || numbers.back().value >= last_value_);
  last_value_ = numbers.back().value;
  return true;
}

bool FormatFinder::continues_phat(std::span<const Number> numbers) const {
  return numbers[0].is_whole && (lines_ > 0 || numbers.size() == 1) &&
         std::ranges::all_of(numbers.subspan(1), [&](const Number& row) { return row.is_whole && row.whole < lines_; });
}

bool FormatFinder::continues_facets(std::span<const Number> numbers) {
  std::vector<std::uint64_t> labels;
  for (const Number& number : numbers) {
    if (!number.is_whole) {
      return false;
    }
    labels.push_back(number.whole);
  }
  std::ranges::sort(labels);
  const bool is_facet = labels != last_facet_ && std::ranges::adjacent_find(labels) == labels.end();
  last_facet_ = std::move(labels);
  return is_facet;
}

/// With zeros on the diagonal, and symmetric so far.
bool FormatFinder::continues_matrix(std::span<const Number> numbers) {
  if (lines_ >= numbers.size() || numbers[lines_].value != 0) {
    return false;
  }
  for (std::size_t k = 0; k < lines_; ++k) {
    if (rows_[k][lines_] != numbers[k].value) {
      return false;
    }
  }
  std::vector<double>& row = rows_.emplace_back();
  std::ranges::transform(numbers, std::back_inserter(row), &Number::value);
  return true;
}

Result<TowerFormat> FormatFinder::take(std::string_view line, std::uint64_t number) {
  if (LineWords(line).is_done()) {
    return TowerFormat::automatic;
  }
  const std::optional<Row> row = row_of(line);
  if (lines_ == 0) {
    first_line_ = number;
    first_count_ = row ? row->numbers.size() : 0;
  }
  if (!row) {
    return lines_ == 0 ? format_of_words(line) : no_continuation(number);
  }
  look_at(*row);
  const bool is_gudhi = can_be_.gudhi && (is_filtration_ || !can_be_.facets);
  const bool is_distances = can_be_.lower || can_be_.upper || can_be_.matrix;
  if (can_be_.facets) {
    return is_gudhi || can_be_.phat || is_distances ? TowerFormat::automatic : TowerFormat::facets;
  }
  if (is_gudhi) {
    return can_be_.matrix ? TowerFormat::automatic : TowerFormat::gudhi;
  }
  if (can_be_.phat) {
    return TowerFormat::phat;
  }
  if (!is_distances && !can_be_.points) {
    return no_continuation(number);
  }
  return lines_ > 1 ? no_filtration() : Result<TowerFormat>{TowerFormat::automatic};
}

/// By the first line, which is more than numbers.
Result<TowerFormat> FormatFinder::format_of_words(std::string_view line) const {
  LineWords words(line);
  const std::string_view first = words.take();
  double time = 0;
  if (is_tower_operation(first) || (LineWords(first).take_number(time) && is_tower_operation(words.word()))) {
    return TowerFormat::tower;
  }
  if (starts_facet_groups(line)) {
    return TowerFormat::facets;
  }
  if (first.starts_with('{')) {
    return TowerFormat::script;
  }
  return error(first_line_, fmt::format("{} starts no format that is known: a tower starts "
                                        "with i, c or a time, a script with "
                                        "{{\"sesame\":1}}, a PHAT matrix with one number, a "
                                        "GUDHI list with `0 vertex value`, a list of "
                                        "facets with whole numbers or a bracket{}",
                                        shown(first), advice_on(line, name_, "sesame tower")));
}

void FormatFinder::look_at(const Row& row) {
  const std::vector<Number>& numbers = row.numbers;
  const std::size_t count = numbers.size();
  const bool is_as_wide = count == first_count_;
  can_be_.gudhi = can_be_.gudhi && !row.has_commas && continues_gudhi(numbers);
  can_be_.phat = can_be_.phat && !row.has_commas && continues_phat(numbers);
  can_be_.facets = can_be_.facets && continues_facets(numbers);
  can_be_.lower = can_be_.lower && count == lines_ + 1;
  can_be_.upper = can_be_.upper && count + lines_ == first_count_;
  can_be_.matrix = can_be_.matrix && is_as_wide && continues_matrix(numbers);
  can_be_.points = can_be_.points && is_as_wide;
  ++lines_;
}

Result<TowerFormat> FormatFinder::finish() const {
  if (lines_ == 0) {
    return TowerFormat::tower;
  }
  if (can_be_.phat || (can_be_.gudhi && !can_be_.facets)) {
    return can_be_.phat ? TowerFormat::phat : TowerFormat::gudhi;
  }
  if (can_be_.facets && can_be_.gudhi && is_filtration_) {
    return error(first_line_,
                 "this can be a GUDHI list, `dim v0 ... vd value`, and a list "
                 "of facets as well: --format gudhi or "
                 "--format facets says which");
  }
  const bool is_half = lines_ > 2 && (can_be_.lower || (can_be_.upper && lines_ == first_count_));
  const bool is_whole = lines_ > 1 && can_be_.matrix && lines_ == first_count_;
  return can_be_.facets && !is_half && !is_whole ? Result<TowerFormat>{TowerFormat::facets} : no_filtration();
}

/// What it is instead, and where filtrations come from.
Error FormatFinder::no_filtration() const {
  struct Kind {
    std::string_view name, argument, ripser;
  };
  const Kind kind =
      lines_ > 1 && can_be_.lower   ? Kind{"the lower half of a distance matrix", "distance_matrix", "lower-distance"}
      : lines_ > 1 && can_be_.upper ? Kind{"the upper half of a distance matrix", "distance_matrix", "upper-distance"}
      : can_be_.matrix              ? Kind{"a distance matrix", "distance_matrix", "distance"}
                                    : Kind{"a list of points", "points", "point-cloud"};
  return error(first_line_, fmt::format("this looks like {}, of which a filtration has to "
                                        "be made first: GUDHI's RipsComplex({}=...) "
                                        "is one, to be saved as lines `dim v0 ... vd "
                                        "value`, and `ripser --format {}` has its "
                                        "barcode{}",
                                        kind.name, kind.argument, kind.ripser,
                                        can_be_.facets ? "; if these are facets, say --format facets" : ""));
}

Error FormatFinder::no_continuation(std::uint64_t line) const {
  return error(line, fmt::format("this goes on with nothing that line {} can "
                                 "begin; --format says what it is meant to be",
                                 first_line_));
}

Result<TowerFormat> find_format(ByteSource& source, std::size_t longest) {
  constexpr std::size_t head = 8;
  constexpr std::uint64_t most_lines = 1000;  // until then, what is a filtration shows that it is no list of
                                              // facets
  while (source.window().size() < head) {
    const Result<bool> got = source.more();
    if (!got) {
      return got.error();
    }
    if (!*got) {
      break;
    }
  }
  if (source.window().substr(0, head).find('\0') != std::string_view::npos) {
    return TowerFormat::phat_binary;
  }
  FormatFinder finder(source.name());
  std::size_t begin = 0;
  for (std::uint64_t line = 1; line <= most_lines; ++line) {
    const Result<std::size_t> end = find_line_end(source, begin, line, longest);
    if (!end) {
      return end.error();
    }
    const std::string_view text = source.window().substr(begin, *end - begin);
    const Result<TowerFormat> found = finder.take(line == 1 ? without_mark(text) : text, line);
    if (!found || *found != TowerFormat::automatic) {
      return found;
    }
    if (*end == source.window().size()) {
      break;
    }
    begin = *end + 1;
  }
  return finder.finish();
}

Result<bool> is_script(ByteSource& source, std::size_t longest) {
  std::size_t begin = 0;
  constexpr std::uint64_t most_lines = 1000;
  for (std::uint64_t line = 1; line <= most_lines; ++line) {
    const Result<std::size_t> end = find_line_end(source, begin, line, longest);
    if (!end) {
      return end.error();
    }
    const std::string_view all = source.window().substr(begin, *end - begin);
    const std::string_view text = line == 1 ? without_mark(all) : all;
    if (const std::size_t first = text.find_first_not_of(" \t\r");
        first != std::string_view::npos && text[first] != '#') {
      return text[first] == '{';
    }
    if (*end == source.window().size()) {
      break;
    }
    begin = *end + 1;
  }
  return false;
}

Error FormatFinder::error(std::uint64_t line, const std::string& what) const {
  return {Errc::bad_input, fmt::format("{}:{}: {}", name_, line, what)};
}

}  // namespace sesame::replay
