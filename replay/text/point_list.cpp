#include "replay/text/point_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "replay/text/line_source.hpp"
#include "replay/text/line_words.hpp"

namespace sesame::replay {
namespace {

/// The numbers of a line, or what is wrong with it. A comma stands between two of them, or is no comma.
Result<std::vector<double>> numbers_of(std::string_view line) {
  std::string text{line.substr(0, line.find('#'))};
  std::vector<double> numbers;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = text.find(',', begin);
    LineWords words(std::string_view{text}.substr(begin, comma - begin));
    if (words.is_done() && (comma != std::string::npos || begin > 0)) {
      return Error{Errc::bad_input, "nothing stands on one side of a comma; a coordinate should"};
    }
    while (!words.is_done()) {
      double number = 0;
      if (const LineWords before = words; !words.take_number(number) || !std::isfinite(number)) {
        return Error{Errc::bad_input, shown(before.word()) + " should be a coordinate, a finite number"};
      }
      numbers.push_back(number);
    }
    if (comma == std::string::npos) {
      return numbers;
    }
    begin = comma + 1;
  }
}

}  // namespace

Result<PointList> read_points(ByteSource source) {
  PointList list;
  list.name = source.name();
  LineSource lines(std::move(source));
  std::uint64_t first_line = 0;
  while (true) {
    const Result<std::optional<std::string_view>> line = lines.next();
    if (!line) {
      return line.error();
    }
    if (!*line) {
      return list;
    }
    if (LineWords(**line).is_done()) {
      continue;
    }
    const Result<std::vector<double>> numbers = numbers_of(**line);
    if (!numbers) {
      return Error{Errc::bad_input, lines.place() + numbers.error().what};
    }
    if (first_line == 0) {
      first_line = lines.line();
      list.coordinates = numbers->size();
    }
    if (numbers->size() != list.coordinates) {
      return Error{Errc::bad_input, fmt::format("{}{} coordinates, but line {} has {}; all points should have the same",
                                                lines.place(), numbers->size(), first_line, list.coordinates)};
    }
    std::array<double, 3> point{};
    std::copy_n(numbers->begin(), std::min<std::size_t>(numbers->size(), 3), point.begin());
    list.points.push_back(point);
  }
}

}  // namespace sesame::replay
