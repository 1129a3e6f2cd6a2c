// The format: Wavefront, "Object Files (.obj)", appendix B1 of the Advanced Visualizer manual.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "tools/mesh/readers.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {

namespace {

/// Statements that say nothing about points, faces and lines.
constexpr auto skipped =
    std::to_array<std::string_view>({"vt", "vn", "vp", "g", "o", "s", "mg", "p", "usemtl", "mtllib", "usemap", "maplib",
                                     "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj"});

class ObjReader {
 public:
  ObjReader(std::string_view bytes, std::string_view name) : lines_{bytes, name} {}

  Result<Mesh> read() {
    while (lines_.next()) {
      if (auto done = read_statement(logical_line()); !done) {
        return done.error();
      }
    }
    if (auto done = check_forward(); !done) {
      return done.error();
    }
    if (mesh_.points.empty()) {
      return lines_.error("there is no point, lines `v X Y Z` are expected in an OBJ file");
    }
    if (unknown_ > 0) {
      mesh_.remarks.push_back(fmt::format("left out {} that this reader does not know, the first is {} on line {}",
                                          counted(unknown_, "statement", "statements"), first_unknown_,
                                          first_unknown_line_));
    }
    return std::move(mesh_);
  }

 private:
  /// The present line, and those that a `\` at its end adds to it. A comment is not continued: comments with Windows
  /// paths may well end in `\`.
  std::string_view logical_line() {
    statement_line_ = lines_.number();
    auto line = without_comment(lines_.line());
    if (!line.ends_with('\\')) {
      return line;
    }
    joined_.clear();
    while (line.ends_with('\\')) {
      line.remove_suffix(1);
      joined_.append(line).push_back(' ');
      if (!lines_.next()) {
        return joined_;
      }
      line = without_comment(lines_.line());
    }
    joined_.append(line);
    return joined_;
  }

  Status read_statement(std::string_view rest) {
    const auto keyword = next_word(rest);
    if (keyword.empty()) {
      return Done{};
    }
    if (keyword == "v") {
      return read_point(rest);
    }
    if (keyword == "f") {
      return read_face(rest);
    }
    if (keyword == "l") {
      return read_polyline(rest);
    }
    if (std::find(skipped.begin(), skipped.end(), keyword) != skipped.end()) {
      return Done{};
    }
    if (unknown_++ == 0) {
      first_unknown_ = shown(keyword);
      first_unknown_line_ = statement_line_;
    }
    return Done{};
  }

  Status read_point(std::string_view rest) {
    Point point{};
    for (double& x : point) {
      const auto word = next_word(rest);
      if (!parse_coordinate(word, x)) {
        return error(fmt::format("a point: {}", not_a_coordinate(word)));
      }
    }
    mesh_.points.push_back(point);
    return Done{};
  }

  /// One corner `i`, `i/t`, `i//n` or `i/t/n`; i counts from 1, or backwards from the latest point.
  Status read_corner(std::string_view word, std::uint32_t& point) {
    const auto slash = std::min(word.find('/'), word.size());
    const bool tail_is_legal = word.find_first_not_of("0123456789-/", slash) == std::string_view::npos;
    const auto count = static_cast<std::int64_t>(mesh_.points.size());
    std::int64_t index = 0;
    if (!parse_integer(word.substr(0, slash), index) || !tail_is_legal || index == 0 || index < -count ||
        index > std::numeric_limits<std::uint32_t>::max()) {
      return error(
          fmt::format("{} does not name a point, a number from 1 or from -{} to -1 is expected", shown(word), count));
    }
    // A point may be named before it is given; whether it ever is shows at the end.
    if (index > count && index > furthest_) {
      furthest_ = index;
      furthest_line_ = statement_line_;
    }
    point = static_cast<std::uint32_t>(index < 0 ? count + index : index - 1);
    return Done{};
  }

  Status read_face(std::string_view rest) {
    std::size_t corners = 0;
    for (auto word = next_word(rest); !word.empty(); word = next_word(rest), ++corners) {
      std::uint32_t point = 0;
      if (auto done = read_corner(word, point); !done) {
        return done;
      }
      mesh_.faces.push_corner(point);
    }
    if (corners == 0) {
      return error("a face without corners, `f` and at least three points are expected");
    }
    mesh_.faces.close_face();
    return Done{};
  }

  Status read_polyline(std::string_view rest) {
    std::size_t corners = 0;
    std::uint32_t before = 0;
    for (auto word = next_word(rest); !word.empty(); word = next_word(rest), ++corners) {
      std::uint32_t point = 0;
      if (auto done = read_corner(word, point); !done) {
        return done;
      }
      if (corners > 0) {
        mesh_.lines.push_back({before, point});
      }
      before = point;
    }
    if (corners < 2) {
      return error("a line with fewer than two points, `l` and at least two points are expected");
    }
    return Done{};
  }

  Status check_forward() const {
    if (furthest_ <= static_cast<std::int64_t>(mesh_.points.size())) {
      return Done{};
    }
    return lines_.error_at(furthest_line_,
                           fmt::format("point {} is named, but the file has only {}", furthest_, mesh_.points.size()));
  }

  [[nodiscard]] Error error(std::string_view what) const { return lines_.error_at(statement_line_, what); }

  LineReader lines_;
  std::string joined_;
  std::size_t statement_line_ = 0;
  std::int64_t furthest_ = 0;
  std::size_t furthest_line_ = 0;
  std::size_t unknown_ = 0;
  std::string first_unknown_;
  std::size_t first_unknown_line_ = 0;
  Mesh mesh_;
};

}  // namespace

Result<Mesh> read_obj(std::string_view bytes, std::string_view name) { return ObjReader{bytes, name}.read(); }

}  // namespace sesame::tools
