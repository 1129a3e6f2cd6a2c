// The format: https://people.sc.fsu.edu/~jburkardt/data/off/off.html and the manual of Geomview, section OFF.
#include <fmt/format.h>

#include <algorithm>

#include "tools/mesh/readers.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {

namespace {

struct Head {
  std::size_t dimension = 3;  ///< coordinates per point
  bool any_dimension = false;
  std::uint64_t points = 0;
  std::uint64_t faces = 0;
};

/// Reads `[ST][C][N][4][n]OFF`; false when the word is not of that form.
bool parse_keyword(std::string_view word, Head& head) {
  const auto skip = [&word](std::string_view prefix) {
    const bool there = word.starts_with(prefix) && word.size() > prefix.size();
    if (there) word.remove_prefix(prefix.size());
    return there;
  };
  skip("ST");
  skip("C");
  skip("N");
  const bool four = skip("4");
  head.any_dimension = skip("n");
  head.dimension = four ? 4 : 3;
  return word == "OFF";
}

class OffReader {
 public:
  OffReader(std::string_view bytes, std::string_view name) : lines_{bytes, name} {}

  Result<Mesh> read() {
    if (auto done = read_head(); !done) return done.error();
    if (auto done = read_points(); !done) return done.error();
    if (auto done = read_faces(); !done) return done.error();
    if (lines_.next_with_words()) {
      mesh_.remarks.push_back(
          fmt::format("line {} and what follows, after the last face, was left out", lines_.number()));
    }
    return std::move(mesh_);
  }

 private:
  /// The next word of the head, which may be spread over lines; empty at the end of the file.
  std::string_view head_word() {
    auto word = next_word(rest_);
    while (word.empty() && lines_.next_with_words()) {
      rest_ = without_comment(lines_.line());
      word = next_word(rest_);
    }
    return word;
  }

  Status read_count(std::string_view word, std::string_view what, std::uint64_t& count) {
    std::int64_t value = 0;
    if (!parse_integer(word, value) || value < 0) {
      return lines_.error(
          fmt::format("{} in the place of the number of {}, a number from 0 is expected", shown(word), what));
    }
    count = static_cast<std::uint64_t>(value);
    return Done{};
  }

  Status read_head() {
    auto word = head_word();
    std::int64_t number = 0;
    if (parse_keyword(word, head_)) {
      word = head_word();
    } else if (!parse_integer(word, number)) {
      return lines_.error(fmt::format("{} in the place of the head of an OFF file, `OFF` is expected", shown(word)));
    } else {
      mesh_.remarks.emplace_back("the file does not begin with `OFF`; it was read as if it did");
    }
    if (word == "BINARY") return lines_.error("binary OFF is not read, save the mesh as ASCII OFF or binary PLY");
    if (head_.any_dimension) {
      std::uint64_t dimension = 0;
      if (auto done = read_count(word, "coordinates", dimension); !done) return done;
      if (dimension == 0 || dimension > 1000) return lines_.error("points of nOFF have 1 to 1000 coordinates");
      head_.dimension = static_cast<std::size_t>(dimension) + (head_.dimension == 4 ? 1 : 0);
      word = head_word();
    }
    if (auto done = read_count(word, "points", head_.points); !done) return done;
    if (auto done = read_count(head_word(), "faces", head_.faces); !done) return done;
    if (head_.dimension != 3) {
      mesh_.remarks.push_back(
          fmt::format("points have {} coordinates; up to three are kept, for drawing", head_.dimension));
    }
    return check_counts();
  }

  /// How many bytes follow the present line.
  std::size_t room() const { return lines_.text().size() - std::min(lines_.offset(), lines_.text().size()); }

  /// Claims that no file of this size can keep are refused here; those that come close, where the file ends.
  Status check_counts() const {
    if (head_.points <= room() && head_.faces <= room()) return Done{};
    return lines_.error(fmt::format("{} and {} are announced, but only {} follow",
                                    counted(head_.points, "point", "points"), counted(head_.faces, "face", "faces"),
                                    counted(room(), "byte", "bytes")));
  }

  Status read_points() {
    // A coordinate and the blank after it take two bytes.
    mesh_.points.reserve(std::min<std::size_t>(head_.points, room() / (2 * head_.dimension) + 1));
    for (std::uint64_t p = 0; p < head_.points; ++p) {
      if (!lines_.next_with_words()) {
        return lines_.error(fmt::format("the file ends after {} of {} points", p, head_.points));
      }
      auto rest = without_comment(lines_.line());
      Point point{};
      for (std::size_t i = 0; i < std::max<std::size_t>(head_.dimension, 1); ++i) {
        const auto word = next_word(rest);
        double value = 0;
        if (!parse_coordinate(word, value)) {
          return lines_.error(fmt::format("coordinate {} of point {}: {}", i, p, not_a_coordinate(word)));
        }
        if (i < 3) point[i] = value;
      }
      mesh_.points.push_back(point);
    }
    return Done{};
  }

  Status read_faces() {
    for (std::uint64_t f = 0; f < head_.faces; ++f) {
      if (!lines_.next_with_words()) {
        return lines_.error(fmt::format("the file ends after {} of {} faces", f, head_.faces));
      }
      if (auto done = read_face(f); !done) return done;
    }
    return Done{};
  }

  Status read_face(std::uint64_t f) {
    auto rest = without_comment(lines_.line());
    auto word = next_word(rest);
    std::int64_t corners = 0;
    if (!parse_integer(word, corners) || corners < 1) {
      return lines_.error(fmt::format("face {} begins with {}, the number of its corners is expected", f, shown(word)));
    }
    for (std::int64_t i = 0; i < corners; ++i) {
      word = next_word(rest);
      std::int64_t point = 0;
      if (word.empty()) {
        return lines_.error(fmt::format("face {} announces {} corners, but the line has {}", f, corners, i));
      }
      if (!parse_integer(word, point) || point < 0 || static_cast<std::uint64_t>(point) >= head_.points) {
        return lines_.error(fmt::format("corner {} of face {} is {}, points are numbered from 0 to {}", i, f,
                                        shown(word), static_cast<std::int64_t>(head_.points) - 1));
      }
      mesh_.faces.push_corner(static_cast<std::uint32_t>(point));
    }
    mesh_.faces.close_face();
    return Done{};
  }

  LineReader lines_;
  std::string_view rest_;
  Head head_;
  Mesh mesh_;
};

}  // namespace

Result<Mesh> read_off(std::string_view bytes, std::string_view name) { return OffReader{bytes, name}.read(); }

bool has_off_head(std::string_view bytes) {
  LineReader lines{bytes, {}};
  if (!lines.next_with_words()) return false;
  auto rest = without_comment(lines.line());
  Head head;
  return parse_keyword(next_word(rest), head);
}

}  // namespace sesame::tools
