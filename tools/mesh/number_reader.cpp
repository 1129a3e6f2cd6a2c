#include "tools/mesh/number_reader.hpp"

#include <fmt/format.h>

namespace sesame::tools {

Result<std::int64_t> NumberReader::whole(std::string_view what, std::int64_t least, std::int64_t most) {
  const std::string_view text = word();
  std::int64_t value = 0;
  if (!parse_integer(text, value) || value < least || value > most) {
    return error(fmt::format("{}: {} should be a number from {} to {}", what, shown(text), least, most));
  }
  return value;
}

Result<Point> NumberReader::point() {
  Point point{};
  for (double& x : point) {
    const std::string_view text = word();
    if (!parse_coordinate(text, x)) {
      return error(fmt::format("a point: {}", not_a_coordinate(text)));
    }
  }
  return point;
}

bool is_number(std::string_view word) {
  double value = 0;
  return parse_real(word, value);
}

}  // namespace sesame::tools
