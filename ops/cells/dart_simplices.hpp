/// \file
/// The simplices that the darts of maps by simplices belong to.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ops/cells/structure.hpp"

namespace sesame::ops {

/// What DartStore takes and gives as the dimension of a cell where it is a simplex of a map by simplices: of one with
/// all numbers but i, which i-sewing glues, i; of others, of which it only knows what `see` said, something larger.
[[nodiscard]] int seen_index(int dimension, IndexSet numbers);
/// And back.
[[nodiscard]] IndexSet numbers_of_seen(int dimension, int index);

/// "<0-2>" for the numbers 0 and 2.
[[nodiscard]] std::string text_of_numbers(IndexSet numbers);
/// "m.<0-2>:3", the simplex of a dart of a map of some dimension, called after that dart.
[[nodiscard]] std::string name_of_simplex(const Structure& structure, int dimension, IndexSet numbers, Dart dart);

/// "m.<0-2>:3" as (1, the numbers, "3"): the length of what comes before the ".", and a dart, "3" or "3'". Nothing when
/// the text ends otherwise.
struct SimplexOfDart {
  std::size_t length;
  IndexSet numbers;
  std::string_view dart;
};
[[nodiscard]] std::optional<SimplexOfDart> split_simplex(std::string_view text);

/// A simplex of a map by simplices, and a dart that it is called after.
struct NamedSimplex {
  const DartStore::Made* map;  ///< the last one that has been made under its name
  IndexSet numbers;
  Dart dart;  ///< of the dimension of the map
};
/// The same where there is such a map with such a dart. Cost: the length of the name.
[[nodiscard]] std::optional<NamedSimplex> simplex_named(const Structure& structure, std::string_view name);

}  // namespace sesame::ops
