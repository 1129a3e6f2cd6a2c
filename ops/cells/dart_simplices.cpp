#include "ops/cells/dart_simplices.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>

namespace sesame::ops {
namespace {

IndexSet all_numbers(int dimension) { return (IndexSet{2} << dimension) - 1; }

}  // namespace

int seen_index(int dimension, IndexSet numbers) {
  const IndexSet missing = all_numbers(dimension) & ~numbers;
  return std::has_single_bit(missing) ? std::countr_zero(missing) : dimension + static_cast<int>(numbers);
}

IndexSet numbers_of_seen(int dimension, int index) {
  return index <= dimension ? all_numbers(dimension) & ~(IndexSet{1} << index)
                            : static_cast<IndexSet>(index - dimension);
}

std::string text_of_numbers(IndexSet numbers) {
  std::string text = "<";
  for (; numbers != 0; numbers &= numbers - 1) {
    text += (text.size() > 1 ? "-" : "") + std::to_string(std::countr_zero(numbers));
  }
  return text + '>';
}

std::string name_of_simplex(const Structure& structure, int dimension, IndexSet numbers, Dart dart) {
  const DartStore::Made& map = structure.darts().map_of(dimension, dart);
  return fmt::format("{}.{}:{}", structure.directory().names()[map.name].text, text_of_numbers(numbers),
                     dart_text(map, dart - map.first));
}

std::optional<SimplexOfDart> split_simplex(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  const std::size_t open = colon == std::string_view::npos ? colon : text.rfind(".<", colon);
  if (open == std::string_view::npos || open == 0 || text[colon - 1] != '>') {
    return std::nullopt;
  }
  IndexSet numbers = 0;
  for (std::size_t at = open + 2; at < colon; ++at) {  // past "-" or ">"
    int number = 0;
    const auto [end, failure] = std::from_chars(text.data() + at, text.data() + colon, number);
    if (failure != std::errc{} || number < 0 || number > largest_map_dimension || numbers >> number != 0) {
      return std::nullopt;
    }
    numbers |= IndexSet{1} << number;
    at = static_cast<std::size_t>(end - text.data());
  }
  const bool is_list = numbers != 0 && text.substr(open + 1, colon - open - 1) == text_of_numbers(numbers);
  return is_list ? std::optional{SimplexOfDart{open, numbers, text.substr(colon + 1)}} : std::nullopt;
}

std::optional<NamedSimplex> simplex_named(const Structure& structure, std::string_view name) {
  const auto split = split_simplex(name);
  const DartStore::Made* map = split ? map_named(structure, name.substr(0, split->length)) : nullptr;
  if (map == nullptr || !map->is_by_simplices || split->numbers > all_numbers(map->dimension)) {
    return std::nullopt;
  }
  const Dart dart = dart_of_text(*map, split->dart);
  return dart == no_dart ? std::nullopt : std::optional{NamedSimplex{map, split->numbers, map->first + dart}};
}

}  // namespace sesame::ops
