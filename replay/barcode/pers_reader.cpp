#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <span>
#include <string_view>

#include "replay/barcode/barcode_dialects.hpp"
#include "replay/barcode/barcode_files.hpp"
#include "replay/text/line_source.hpp"
#include "replay/text/line_words.hpp"
#include "replay/text/time_reader.hpp"

namespace sesame::replay {
namespace {

using engine::Bar;

constexpr std::string_view spaces = " \t\r\v\f";
constexpr std::size_t most_numbers = 4;

std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

template <class Number>
bool parse(std::string_view word, Number& value) {
  word = without_plus(word);
  const char* const end = word.data() + word.size();
  const auto [stop, problem] = std::from_chars(word.data(), end, value);
  return problem == std::errc{} && stop == end;
}

/// Takes the lines one after the other.
class PersReader {
 public:
  PersReader(std::string name, TimeReader& times) : name_{std::move(name)}, times_{times} {}

  /// Reads one line, counted from `number`, without its end. Errors: bad_input.
  Status line(std::string_view text, std::uint64_t number) {
    line_ = number;
    std::array<std::string_view, most_numbers> words;
    const std::size_t count = split(text.substr(0, text.find('#')), words);
    if (count == 0) {
      return Done{};
    }
    if (count < 2 || count > most_numbers) {
      return error(fmt::format("a line should have 2, 3 or 4 numbers, [[field] dimension] birth death, not {}",
                               count == 1 ? "1" : "more"));
    }
    if (first_line_ == 0) {
      first_line_ = number;
      count_ = count;
      file_.has_dimensions = count > 2;
    }
    if (count != count_) {
      return error(
          fmt::format("{} numbers, but line {} has {}; all lines should have the same", count, first_line_, count_));
    }
    return bar({words.data(), count});
  }

  PersFile finished() && {
    std::sort(file_.barcode.bars.begin(), file_.barcode.bars.end());
    return std::move(file_);
  }

 private:
  /// The number of words, at most one more than there is room for.
  static std::size_t split(std::string_view text, std::array<std::string_view, most_numbers>& words) {
    std::size_t count = 0;
    while (true) {
      text.remove_prefix(std::min(text.find_first_not_of(spaces), text.size()));
      if (text.empty() || count == words.size()) {
        return count + (text.empty() ? 0 : 1);
      }
      words[count] = text.substr(0, text.find_first_of(spaces));
      text.remove_prefix(words[count++].size());
    }
  }

  Status bar(std::span<const std::string_view> words) {
    Bar bar{0, 0, 0};
    if (words.size() == 4) {
      if (Status done = field(words[0]); !done) {
        return done;
      }
    }
    const std::string_view birth = words[words.size() - 2];
    const std::string_view death = words[words.size() - 1];
    if (words.size() > 2) {
      const std::string_view dimension = words[words.size() - 3];
      if (!parse(dimension, bar.dimension) || bar.dimension < 0 || bar.dimension > largest_dimension_read) {
        return error(fmt::format("{} should be a dimension, a whole number from 0 to {}", shown(dimension),
                                 largest_dimension_read));
      }
    }
    if (Status done = time(birth, "a birth, a finite number", bar.birth); !done) {
      return done;
    }
    if (!bar.birth.is_finite()) {
      return error(fmt::format("{} should be a birth, a finite number", shown(birth)));
    }
    if (Status done = time(death, "a death, a number or inf", bar.death); !done) {
      return done;
    }
    if (bar.death < bar.birth) {
      return error(fmt::format("the death {} should not be before the birth {}", shown(death), shown(birth)));
    }
    if (bar.birth == bar.death) {
      ++file_.barcode.hidden;
    } else {
      file_.barcode.bars.push_back(bar);
    }
    return Done{};
  }

  Status time(std::string_view word, std::string_view what, engine::Time& into) {
    const Result<engine::Time> read = times_.read(without_plus(word), what, name_, line_);
    if (!read) {
      return error(read.error().what);
    }
    into = *read;
    return Done{};
  }

  /// Bars over several fields in one file are several barcodes: which, the caller should say.
  Status field(std::string_view word) {
    std::uint64_t characteristic = 0;
    if (!parse(word, characteristic)) {
      return error(fmt::format("{} should be the characteristic of the field, a whole number", shown(word)));
    }
    if (first_line_ == line_) {
      field_ = characteristic;
    }
    if (characteristic != field_) {
      return error(fmt::format("field {}, but line {} has {}; a file should have the bars over one field",
                               characteristic, first_line_, field_));
    }
    return Done{};
  }

  [[nodiscard]] Error error(const std::string& what) const {
    return {Errc::bad_input, fmt::format("{}:{}: {}", name_, line_, what)};
  }

  std::string name_;
  TimeReader& times_;
  PersFile file_;
  std::uint64_t line_ = 0, first_line_ = 0;  ///< the present line, and the first with numbers (0: none yet)
  std::size_t count_ = 0;                    ///< of numbers on it
  std::uint64_t field_ = 0;
};

}  // namespace

Result<PersFile> read_pers(ByteSource source, TimeReader& times) {
  PersReader reader(source.name(), times);
  LineSource lines(std::move(source));
  RipserLines ripser;
  std::optional<BarcodeDialect> dialect;
  std::string json;
  std::uint64_t json_line = 0;
  while (true) {
    const Result<std::optional<std::string_view>> text = lines.next();
    if (!text) {
      return text.error();
    }
    if (!*text) {
      break;
    }
    if (!dialect && LineWords(**text).is_done()) {
      continue;
    }
    if (!dialect) {
      dialect = dialect_of(**text);
      json_line = lines.line();
    }
    if (*dialect == BarcodeDialect::json) {
      json.append(**text).append("\n");
      continue;
    }
    const Result<std::string> bar =
        *dialect == BarcodeDialect::ripser ? ripser.take(**text) : Result<std::string>{std::string{**text}};
    if (!bar) {
      return Error{Errc::bad_input, lines.place() + bar.error().what};
    }
    if (Status done = reader.line(*bar, lines.line()); !done) {
      return done.error();
    }
  }
  if (dialect == BarcodeDialect::json) {
    const Result<std::vector<PersLine>> bars = bars_of_json(json, lines.name(), json_line);
    if (!bars) {
      return bars.error();
    }
    for (const PersLine& bar : *bars) {
      if (Status done = reader.line(bar.text, bar.number); !done) {
        return done.error();
      }
    }
  }
  return std::move(reader).finished();
}

}  // namespace sesame::replay
