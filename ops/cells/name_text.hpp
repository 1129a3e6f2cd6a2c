/// \file
/// Names as texts: what the brackets of a name enclose, and the endings that cells of standard simploids and degenerate
/// cells have.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ops/cells/cell_type.hpp"
#include "ops/cells/degeneracy.hpp"

namespace sesame::ops {

/// The round brackets of a text, matched. Between { and the next } stand labels, which may contain all other
/// characters: nothing there counts as a bracket or a bar. Cost: the length of the text.
class Brackets {
 public:
  static constexpr std::size_t nowhere = SIZE_MAX;
  struct Pair {
    std::size_t open;
    std::size_t close = nowhere;  ///< of its partner
    std::size_t bar = nowhere;    ///< the only "|" between the two that is in no bracket within
    std::size_t bars = 0;
  };

  explicit Brackets(std::string_view text);
  /// The pair that opens at a place, or null.
  [[nodiscard]] const Pair* at(std::size_t open) const;

 private:
  std::vector<Pair> pairs_;  // in the order in which they open
};

/// Whether a text can stand in the brackets of another without a doubt about where it ends: all its brackets are
/// matched and no bar is outside of them.
[[nodiscard]] bool is_well_bracketed(std::string_view text);

/// The places at which the name of a cone's apex or of a product may end, within a text that names one of its cells:
/// before each "*", and before each ".(". Not the first.
[[nodiscard]] inline bool ends_prefix(std::string_view text, std::size_t k) {
  return k > 0 && (text[k] == '*' || (text[k] == '.' && k + 1 < text.size() && text[k + 1] == '('));
}

/// Whether a name begins with another and goes on as those of the cells of a cone or a product of that name do.
[[nodiscard]] inline bool extends_name(std::string_view name, std::string_view prefix) {
  return name.size() > prefix.size() && name.starts_with(prefix) && ends_prefix(name, prefix.size());
}

/// "a^0,2" as (1, {0, 2}): the length of what comes before, and the directions. Nothing when the text ends otherwise.
struct WithDirections {
  std::size_t length;
  Degeneracy collapsed;
};
[[nodiscard]] std::optional<WithDirections> split_directions(std::string_view text);

/// "t.2-0" as (1, "2-0"): the length of what comes before the ".", and the vertices, or the dimension and the dart of
/// "m.1:3". Nothing when the text ends otherwise.
struct WithVertices {
  std::size_t length;
  std::string_view vertices;
};
[[nodiscard]] std::optional<WithVertices> split_vertices(std::string_view text);

/// "m.1:3" as (1, 1, "3"): the length of what comes before the ".", a dimension, and a dart, "3" or "3'". Nothing when
/// the text ends otherwise.
struct SeenFrom {
  std::size_t length;
  int dimension;
  std::string_view dart;
};
[[nodiscard]] std::optional<SeenFrom> split_dart(std::string_view text);

/// A list of vertices of a standard simploid, such as "2-0x1": one or more of each component, in any order.
struct VertexList {
  std::string sorted;
  /// Of those vertices, component by component where there is more than one: vertex k as listed is vertex order[k].
  std::vector<std::uint8_t> order;
  bool is_whole;  ///< it lists all vertices of the simploid
};
/// Nothing when the text lists no vertices of a simploid of that type, or one twice.
[[nodiscard]] std::optional<VertexList> read_vertices(std::string_view text, const CellType& type);

}  // namespace sesame::ops
