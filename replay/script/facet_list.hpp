/// \file
/// Lists of facets, as topologists write them down: the simplices of a complex that are no faces of others.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "replay/text/line_source.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

/// A facet by the labels of its vertices, which differ.
struct Facet {
  std::vector<std::string> labels;
  std::uint64_t line;  ///< where it ends
};

/// Takes the lines of a list in turn.
///
/// In a list without brackets each line is a facet: `1 2 3` or `1,2,3`. In one with brackets, ( ), [ ] or { }, over
/// lines or not, the innermost are facets: `[[1,2,3],[1,2,4]]`; `{0 1 2}` on a line; `{(0, 1, 2), (0, 1, 3)}`. A name
/// may stand before the first bracket: `manifold_lex_d2_n7_#1=[[1,2,3],...]`, `M := SCFromFacets([[1,2,3],...]);`. A
/// word that starts with `#` starts a comment.
///
/// Labels are whole numbers, kept without leading zeros, and names, which start with a letter or `_` or stand in
/// quotes.
class FacetParser {
 public:
  explicit FacetParser(std::string name) : name_{std::move(name)} {}

  /// Takes a line, which is counted from 1. Errors: bad_input, with the place: what is no label, a label twice in a
  /// facet, brackets that do not match or are at different depths, a second list.
  Status take(std::string_view text, std::uint64_t line);
  /// After the last line. Errors: bad_input, with the place, for brackets that are still open and a list without
  /// facets.
  [[nodiscard]] Status finish() const;
  /// The next facet that is complete.
  std::optional<Facet> next();

 private:
  struct Group {
    char bracket;
    bool has_groups = false;
    std::vector<std::string> labels;
  };

  Status take_groups(std::string_view text);
  Status take_facet(std::string_view text);
  Status take_label(std::string_view& text, std::vector<std::string>& labels) const;
  Status open(char bracket);
  Status close(char bracket);
  Status add(std::vector<std::string> labels);
  [[nodiscard]] Error error(const std::string& what) const;

  std::string name_;
  std::uint64_t line_ = 1;
  enum class Style { unknown, lines, groups } style_ = Style::unknown;
  std::vector<Group> open_;
  std::size_t facet_depth_ = 0;  ///< how many brackets are open inside of a
                                 ///< facet; 0: there was none yet
  bool is_closed_ = false;       ///< the list has ended
  bool has_facets_ = false;      ///< some have come
  std::deque<Facet> facets_;
};

/// Whether this line, which is neither empty nor a comment, can start a list of facets with brackets, or a name before
/// them. `{"` starts a script.
[[nodiscard]] bool starts_facet_groups(std::string_view line);

/// A whole list. Errors: those of the parser and of the source.
Result<std::vector<Facet>> read_facets(LineSource lines);

/// How a list becomes a script.
enum class FacetSteps {
  one,   ///< an `insert` of all facets
  each,  ///< an `insert` for each of them
};
/// A construction script of a list: its header and its steps, a line each.
[[nodiscard]] std::string script_of(const std::vector<Facet>& facets, const std::string& ring, const std::string& title,
                                    FacetSteps steps);

}  // namespace sesame::replay
