#include "ops/cells/name_text.hpp"

#include <algorithm>
#include <charconv>

namespace sesame::ops {
namespace {

/// Calls visit(k, character) for the brackets and bars of a text that stand in no braces. False when a brace is left
/// open.
template <class Visit>
bool for_each_bracket(std::string_view text, Visit&& visit) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    switch (text[k]) {
      case '{':
        k = text.find('}', k);
        if (k == std::string_view::npos) {
          return false;
        }
        break;
      case '(':
      case ')':
      case '|':
        visit(k, text[k]);
        break;
      default:
        break;
    }
  }
  return true;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A number in decimal without leading zeros, which is at most `largest`.
std::optional<int> read_number(std::string_view text, int largest) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_decimal = !text.empty() && is_digit(text.front()) && (text.size() == 1 || text.front() != '0');
  return is_decimal && error == std::errc{} && end == text.data() + text.size() && number <= largest
             ? std::optional{number}
             : std::nullopt;
}

/// Calls visit(part) for the parts between separators; stops, with false, when it says false.
template <class Visit>
bool for_each_part(std::string_view text, char separator, Visit&& visit) {
  while (true) {
    const std::size_t end = text.find(separator);
    if (!visit(text.substr(0, end))) {
      return false;
    }
    if (end == std::string_view::npos) {
      return true;
    }
    text.remove_prefix(end + 1);
  }
}

}  // namespace

Brackets::Brackets(std::string_view text) {
  std::vector<std::size_t> open;  // pairs
  for_each_bracket(text, [&](std::size_t k, char c) {
    if (c == '(') {
      open.push_back(pairs_.size());
      pairs_.push_back({k});
    } else if (!open.empty()) {
      Pair& pair = pairs_[open.back()];
      if (c == ')') {
        pair.close = k;
        open.pop_back();
      } else {
        pair.bar = ++pair.bars == 1 ? k : nowhere;
      }
    }
  });
}

const Brackets::Pair* Brackets::at(std::size_t open) const {
  const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), open,
                                      [](const Pair& pair, std::size_t place) { return pair.open < place; });
  return found != pairs_.end() && found->open == open ? &*found : nullptr;
}

bool is_well_bracketed(std::string_view text) {
  std::int64_t depth = 0;
  bool is_good = true;
  const bool braces_end = for_each_bracket(text, [&](std::size_t, char c) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    is_good = is_good && depth >= 0 && (c != '|' || depth > 0);
  });
  return braces_end && is_good && depth == 0;
}

std::optional<WithDirections> split_directions(std::string_view text) {
  std::size_t begin = text.size();
  while (begin > 0 && (is_digit(text[begin - 1]) || text[begin - 1] == ',')) {
    --begin;
  }
  if (begin == 0 || text[begin - 1] != '^') {
    return std::nullopt;
  }
  Degeneracy collapsed = 0;
  const bool is_list = for_each_part(text.substr(begin), ',', [&](std::string_view part) {
    int number = 0;  // zeros in front have always been understood
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
    collapsed |= Degeneracy{1} << std::min(number, largest_dimension);
    return !part.empty() && error == std::errc{} && number <= largest_dimension;
  });
  return is_list ? std::optional{WithDirections{begin - 1, collapsed}} : std::nullopt;
}

std::optional<WithVertices> split_vertices(std::string_view text) {
  constexpr std::size_t longest = 6 * largest_dimension;  // two vertices of each of so many edges, of two digits
  std::size_t begin = text.size();
  while (begin > 0 && text.size() - begin <= longest &&
         (is_digit(text[begin - 1]) || text[begin - 1] == '-' || text[begin - 1] == 'x' || text[begin - 1] == ':')) {
    --begin;
  }
  return begin < 2 || text[begin - 1] != '.' ? std::nullopt
                                             : std::optional{WithVertices{begin - 1, text.substr(begin)}};
}

std::optional<SeenFrom> split_dart(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  const std::size_t dot = colon == std::string_view::npos ? colon : text.rfind('.', colon);
  if (dot == std::string_view::npos || dot == 0) {
    return std::nullopt;
  }
  const std::string_view number = text.substr(dot + 1, colon - dot - 1);
  int dimension = 0;
  const auto [end, failure] = std::from_chars(number.data(), number.data() + number.size(), dimension);
  const bool is_number = failure == std::errc{} && end == number.data() + number.size() &&
                         (number.size() == 1 || number[0] != '0') && is_digit(number[0]);
  return is_number ? std::optional{SeenFrom{dot, dimension, text.substr(colon + 1)}} : std::nullopt;
}

std::optional<VertexList> read_vertices(std::string_view text, const CellType& type) {
  VertexList list{"", {}, true};
  std::size_t component = 0;
  const bool is_list = for_each_part(text, 'x', [&](std::string_view part) {
    if (component == type.size()) {
      return false;
    }
    std::vector<int> vertices;
    const auto add = [&](std::string_view number) {
      const auto vertex = read_number(number, type[component]);
      if (!vertex || std::find(vertices.begin(), vertices.end(), *vertex) != vertices.end()) {
        return false;
      }
      vertices.push_back(*vertex);
      return true;
    };
    if (!for_each_part(part, '-', add)) {
      return false;
    }
    list.is_whole = list.is_whole && vertices.size() == static_cast<std::size_t>(type[component]) + 1;
    for (std::size_t k = 0; k < vertices.size() && vertices.size() > 1; ++k) {
      const auto place = std::count_if(vertices.begin(), vertices.end(), [&](int v) { return v < vertices[k]; });
      list.order.push_back(static_cast<std::uint8_t>(list.order.size() - k + static_cast<std::size_t>(place)));
    }
    std::sort(vertices.begin(), vertices.end());
    list.sorted += component++ == 0 ? "" : "x";
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      list.sorted += (k == 0 ? "" : "-") + std::to_string(vertices[k]);
    }
    return true;
  });
  return is_list && component == type.size() ? std::optional{std::move(list)} : std::nullopt;
}

}  // namespace sesame::ops
