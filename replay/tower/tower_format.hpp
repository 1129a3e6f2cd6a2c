/// \file
/// The formats of towers, and how they are told apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "replay/text/byte_source.hpp"
#include "replay/text/line_source.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

enum class TowerFormat {
  automatic,    ///< found out from the content
  tower,        ///< lines `[t] i v0 ... vd` and `[t] c u v`
  phat,         ///< a boundary matrix, a line `dim r1 r2 ...` a column
  phat_binary,  ///< the same in 64 bit integers: the number of columns, then for
                ///< each dim, the number of rows, the rows
  gudhi,        ///< lines `dim v0 ... vd value`
  facets,       ///< a list of simplices, which a FacetParser reads
  script,       ///< a construction script (JSON Lines), which a ScriptReader reads
  zigzag,       ///< lines of a tower, and `[t] d v0 ... vd` or `[t] r v0 ... vd`; only told from a script
};

/// What options and JSON call it: "phat-binary".
[[nodiscard]] std::string_view format_name(TowerFormat format);
/// What people call it: "a boundary matrix of PHAT".
[[nodiscard]] std::string_view format_description(TowerFormat format);

/// Whether a word, the first of a line or the one after a time, is an operation of a tower.
[[nodiscard]] constexpr bool is_tower_operation(std::string_view word) { return word == "i" || word == "c"; }
/// The same for a zigzag.
[[nodiscard]] constexpr bool is_zigzag_operation(std::string_view word) {
  return is_tower_operation(word) || word == "d" || word == "r";
}

/// Finds out what a text is from its first lines, as many as it takes until only one format is possible.
///
/// A line that starts with `{"` is one of a script; a word `i` or `c` at the first or second place means a tower;
/// another bracket, or a name before one, facets. Lines of numbers, with blanks or commas between them, can be
///  * gudhi: the first is a vertex, `0 v value`, and each has the right count;
///  * phat: the first has one number, and rows are numbers of earlier lines;
///  * facets: whole numbers, none twice in a line, no two lines in turn the same;
///  * one half of a distance matrix, with 1, 2, 3, ... numbers, or as many less each time; a whole one, symmetric and
///    with zeros on the diagonal; points, with as many coordinates on each line.
/// What looks like both a gudhi list and facets is one of facets when it is no filtration: values decrease, or a vertex
/// comes after a simplex that has it. What can be neither is refused, with a sentence on what would make a filtration
/// of it; so is what is still not clear at the end. But what can be phat or facets to the end is phat.
class FormatFinder {
 public:
  explicit FormatFinder(std::string name) : name_{std::move(name)} {}

  /// Takes a line, which is counted from 1. Returns the format, or automatic when it is not known yet. Errors:
  /// bad_input, with the place, when it is none.
  Result<TowerFormat> take(std::string_view line, std::uint64_t number);
  /// What it is when nothing follows, or too much: never automatic. A text without lines is a tower.
  [[nodiscard]] Result<TowerFormat> finish() const;

 private:
  struct Number {
    double value;
    bool is_whole;        ///< from 0 to 2^64 - 1
    std::uint64_t whole;  ///< then
  };
  struct Row {
    std::vector<Number> numbers;
    bool has_commas = false;
  };
  struct Candidates {
    bool gudhi = true, phat = true, facets = true, lower = true, upper = true, matrix = true, points = true;
  };

  static std::optional<Row> row_of(std::string_view line);
  [[nodiscard]] Result<TowerFormat> format_of_words(std::string_view line) const;
  void look_at(const Row& row);
  bool continues_gudhi(std::span<const Number> numbers);
  [[nodiscard]] bool continues_phat(std::span<const Number> numbers) const;
  bool continues_facets(std::span<const Number> numbers);
  bool continues_matrix(std::span<const Number> numbers);
  [[nodiscard]] Error no_filtration() const;
  [[nodiscard]] Error no_continuation(std::uint64_t line) const;
  [[nodiscard]] Error error(std::uint64_t line, const std::string& what) const;

  std::string name_;
  Candidates can_be_;
  bool is_filtration_ = true;         ///< as a gudhi list
  std::set<std::uint64_t> vertices_;  ///< of it
  double last_value_ = 0;             ///< of it
  std::vector<std::uint64_t> last_facet_;
  std::vector<std::vector<double>> rows_;  ///< while they can be a matrix
  std::size_t lines_ = 0;                  ///< of numbers
  std::uint64_t first_line_ = 0;           ///< of them
  std::size_t first_count_ = 0;            ///< of numbers on that
};

/// Finds out what an input is, and consumes nothing of it. A zero byte among the first 8 means phat_binary: no text has
/// one, and every count of columns below 2^56 does. Errors: those of the source; bad_input, with the place, when it is
/// none of the formats, as data with a zero byte elsewhere in the lines that it takes to know.
Result<TowerFormat> find_format(ByteSource& source, std::size_t longest = longest_line);
/// Whether an input, of which nothing is consumed, is a script and no list of operations: by its first line that is
/// neither empty nor a comment. Errors: those of the source; bad_input, with the place.
Result<bool> is_script(ByteSource& source, std::size_t longest = longest_line);

}  // namespace sesame::replay
