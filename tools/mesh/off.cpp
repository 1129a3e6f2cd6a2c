// The format: the manual of Geomview, section OFF, and https://people.sc.fsu.edu/~jburkardt/data/off/off.html.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tools/mesh/off_head.hpp"
#include "tools/mesh/readers.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {

namespace {

/// Where lines break among the numbers of the points: anywhere, as in Geomview, or after each point, which may have
/// other numbers after its coordinates than the head says.
enum class Layout { free, line_per_point };

class BodyReader {
 public:
  BodyReader(const OffHead& head, const WordReader& words, Layout layout)
      : head_{head}, words_{words}, layout_{layout} {}

  Status read() {
    if (auto done = read_points(); !done) {
      return done;
    }
    for (std::uint64_t f = 0; f < head_.faces; ++f) {
      if (auto done = read_face(f); !done) {
        return done;
      }
    }
    WordReader rest = words_;
    if (!rest.next().empty()) {
      line_left_out_ = rest.lines().number();
    }
    return Done{};
  }

  /// The first line after the last face that has something.
  [[nodiscard]] std::optional<std::size_t> line_left_out() const { return line_left_out_; }
  /// How far it was read.
  [[nodiscard]] std::size_t line() const { return words_.lines().number(); }

  /// What was read, with its remarks.
  Mesh take() {
    if (at_infinity_ > 0) {
      mesh_.remarks.push_back(fmt::format("{} 0 as the homogeneous coordinate and {} drawn where the others say",
                                          counted(at_infinity_, "point has", "points have"),
                                          at_infinity_ == 1 ? "is" : "are"));
    }
    if (overlong_ > 0) {
      mesh_.remarks.push_back(
          fmt::format("{} more after the corners than the four numbers of a colour, the first is face {}, counted from "
                      "0; this was left out, a face begins on a line of its own",
                      counted(overlong_, "face has", "faces have"), first_overlong_));
    }
    if (line_left_out_) {
      mesh_.remarks.push_back(
          fmt::format("line {} and what follows, after the last face, was left out", *line_left_out_));
    }
    return std::move(mesh_);
  }

 private:
  Status read_points() {
    // A coordinate and the blank after it take two bytes.
    mesh_.points.reserve(std::min<std::size_t>(head_.points, words_.remaining() / (2 * head_.coordinates) + 1));
    for (std::uint64_t p = 0; p < head_.points; ++p) {
      if (auto done = read_point(p); !done) {
        return done;
      }
    }
    return Done{};
  }

  Status read_point(std::uint64_t p) {
    Point point{};
    double last = 1;
    for (std::size_t i = 0; i < head_.coordinates; ++i) {
      const auto word = words_.next();
      if (word.empty()) {
        return ends_after(p);
      }
      if (!parse_coordinate(word, last)) {
        return words_.error(fmt::format("coordinate {} of point {}: {}", i, p, not_a_coordinate(word)));
      }
      if (i < 3) {
        point[i] = last;
      }
    }
    for (std::size_t i = 0; layout_ == Layout::free && i < head_.other_numbers; ++i) {
      const auto word = words_.next();
      double unused = 0;
      if (word.empty()) {
        return ends_after(p);
      }
      if (!parse_real(word, unused)) {
        return words_.error(fmt::format("{} in the place of number {} of the normal, colour or texture of point {}",
                                        shown(word), i, p));
      }
    }
    if (layout_ == Layout::line_per_point) {
      words_.skip_line();
    }
    if (head_.is_homogeneous && !head_.has_dimension) {
      point = divided(point, last);
    }
    mesh_.points.push_back(point);
    return Done{};
  }

  [[nodiscard]] Error ends_after(std::uint64_t points) const {
    return words_.error(fmt::format("the file ends after {} of {}", points, counted(head_.points, "point", "points")));
  }

  Point divided(const Point& point, double by) {
    const Point result{point[0] / by, point[1] / by, point[2] / by};
    if (by != 0 && std::all_of(result.begin(), result.end(), [](double x) { return std::isfinite(x); })) {
      return result;
    }
    ++at_infinity_;
    return point;
  }

  /// The corners may stand on several lines; what follows them on the last one is a colour.
  Status read_face(std::uint64_t f) {
    auto word = words_.next();
    if (word.empty()) {
      return words_.error(fmt::format("the file ends after {} of {}", f, counted(head_.faces, "face", "faces")));
    }
    std::int64_t corners = 0;
    if (!parse_integer(word, corners) || corners < 1) {
      return words_.error(fmt::format("face {} begins with {}, the number of its corners is expected", f, shown(word)));
    }
    for (std::int64_t i = 0; i < corners; ++i) {
      word = words_.next();
      if (word.empty()) {
        return words_.error(fmt::format("face {} announces {}, but the file ends after {}", f,
                                        counted(static_cast<std::size_t>(corners), "corner", "corners"), i));
      }
      std::int64_t point = 0;
      if (!parse_integer(word, point) || point < 0 || static_cast<std::uint64_t>(point) >= head_.points) {
        return words_.error(fmt::format("corner {} of face {} is {}, points are numbered from 0 to {}", i, f,
                                        shown(word), static_cast<std::int64_t>(head_.points) - 1));
      }
      mesh_.faces.push_corner(static_cast<std::uint32_t>(point));
    }
    mesh_.faces.close_face();
    skip_colour(f);
    return Done{};
  }

  void skip_colour(std::uint64_t f) {
    constexpr std::size_t most = 4;
    std::size_t numbers = 0;
    while (numbers <= most && !words_.next_in_line().empty()) {
      ++numbers;
    }
    if (numbers > most && overlong_++ == 0) {
      first_overlong_ = f;
    }
    words_.skip_line();
  }

  const OffHead& head_;
  WordReader words_;
  Layout layout_;
  Mesh mesh_;
  std::size_t at_infinity_ = 0;
  std::size_t overlong_ = 0;
  std::uint64_t first_overlong_ = 0;
  std::optional<std::size_t> line_left_out_;
};

/// How many words each of the next lines has, when they all have as many.
std::optional<std::size_t> common_width(WordReader words, std::uint64_t lines) {
  std::size_t common = 0;
  if (!words.next_in_line().empty()) {
    return std::nullopt;
  }
  for (std::uint64_t i = 0; i < lines; ++i) {
    if (words.next().empty()) {
      return std::nullopt;
    }
    std::size_t width = 1;
    while (!words.next_in_line().empty()) {
      ++width;
    }
    if (i > 0 && width != common) {
      return std::nullopt;
    }
    common = width;
  }
  return common;
}

std::vector<std::string> remarks_of(const OffHead& head) {
  std::vector<std::string> remarks;
  if (!head.has_keyword) {
    remarks.emplace_back("the file does not begin with `OFF`; it was read as if it did");
  }
  if (head.is_homogeneous && !head.has_dimension) {
    remarks.emplace_back("points have a fourth, homogeneous coordinate, by which they were divided");
  } else if (head.coordinates != 3) {
    remarks.push_back(fmt::format("points have {}; up to three are kept, for drawing",
                                  counted(head.coordinates, "coordinate", "coordinates")));
  }
  return remarks;
}

/// As Geomview reads it. Where that fails or leaves something out, and all lines of points are alike but have other
/// numbers than the head announces (colours or normals, as a rule), a point per line.
Result<Mesh> read_body(const OffHead& head, const WordReader& words) {
  BodyReader free{head, words, Layout::free};
  const Status free_done = free.read();
  if (free_done && !free.line_left_out()) {
    return free.take();
  }
  const auto width = common_width(words, head.points);
  if (!width || *width < head.coordinates || *width == head.numbers()) {
    if (!free_done) {
      return free_done.error();
    }
    return free.take();
  }
  BodyReader lines{head, words, Layout::line_per_point};
  const Status lines_done = lines.read();
  if (lines_done && !(free_done && lines.line_left_out())) {
    Mesh mesh = lines.take();
    mesh.remarks.push_back(
        fmt::format("points have {} on their lines where the head announces {}; of each the first {} "
                    "were taken",
                    counted(*width, "number", "numbers"), head.numbers(), head.coordinates));
    return mesh;
  }
  if (free_done) {
    return free.take();
  }
  return free.line() <= lines.line() ? lines_done.error() : free_done.error();
}

}  // namespace

Result<Mesh> read_off(std::string_view bytes, std::string_view name) {
  WordReader words{LineReader{bytes, name}, WordReader::Comments::hash};
  const auto head = read_off_head(words);
  if (!head) {
    return head.error();
  }
  auto mesh = read_body(*head, words);
  if (!mesh) {
    return mesh;
  }
  const auto remarks = remarks_of(*head);
  mesh->remarks.insert(mesh->remarks.begin(), remarks.begin(), remarks.end());
  return mesh;
}

bool has_off_head(std::string_view bytes) {
  WordReader words{LineReader{bytes, {}}, WordReader::Comments::hash};
  OffHead head;
  return parse_off_keyword(words.next(), head).has_value();
}

}  // namespace sesame::tools
