// The format: 3D Systems, "StereoLithography Interface Specification" (1989), section 6.5.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>

#include "tools/mesh/readers.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {

namespace {

constexpr std::size_t head_size = 84;
constexpr std::size_t triangle_size = 50;

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) {
    value = (value << 8) | static_cast<unsigned char>(bytes[offset + i]);
  }
  return value;
}

Result<Mesh> read_binary(std::string_view bytes, std::string_view name) {
  if (bytes.size() < head_size) {
    return error_at_byte(name, bytes.size(),
                         "the file ends, a binary STL file has 84 bytes before its triangles and "
                         "a text one begins with `solid`");
  }
  const std::size_t triangles = word_at(bytes, 80);
  const std::size_t end = head_size + triangles * triangle_size;
  if (end > bytes.size()) {
    return error_at_byte(name, 80,
                         fmt::format("{} announced, which takes {} bytes, but the file has {}",
                                     counted(triangles, "triangle is", "triangles are"), end, bytes.size()));
  }
  Mesh mesh;
  mesh.points.reserve(3 * triangles);
  for (std::size_t triangle = 0; triangle < triangles; ++triangle) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      // The normal, 12 bytes, comes first; it says nothing that the corners do not.
      const std::size_t offset = head_size + triangle * triangle_size + 12 * (corner + 1);
      Point point{};
      for (std::size_t i = 0; i < 3; ++i) {
        point[i] = static_cast<double>(std::bit_cast<float>(word_at(bytes, offset + 4 * i)));
        if (!std::isfinite(point[i])) {
          return error_at_byte(name, offset + 4 * i,
                               fmt::format("a coordinate of triangle {} is not finite", triangle));
        }
      }
      mesh.faces.push_corner(static_cast<std::uint32_t>(mesh.points.size()));
      mesh.points.push_back(point);
    }
    mesh.faces.close_face();
  }
  if (end < bytes.size()) {
    mesh.remarks.push_back(
        fmt::format("left out {} after the last triangle", counted(bytes.size() - end, "byte", "bytes")));
  }
  return mesh;
}

/// Statements may share a line or not, and other words may follow them.
class TextStlReader {
 public:
  TextStlReader(std::string_view bytes, std::string_view name)
      : words_{LineReader{bytes, name}, WordReader::Comments::none} {}

  Result<Mesh> read() {
    bool inside = false;
    while (true) {
      const bool is_known = inside ? find({"facet", "endsolid"}) : find({"solid"});
      if (keyword_.empty()) {
        break;
      }
      if (!is_known) {
        return words_.error(fmt::format("{} in a place where {} is expected", shown(word_),
                                        inside ? "`facet` or `endsolid`" : "`solid`"));
      }
      if (keyword_ == "facet") {
        if (auto done = read_facet(); !done) {
          return done.error();
        }
      } else {
        inside = !inside;
        words_.skip_line();  // a name, of any words
      }
    }
    if (inside) {
      mesh_.remarks.emplace_back("the file ends without `endsolid`; it may have been cut");
    }
    return std::move(mesh_);
  }

 private:
  /// Goes to one of the keywords on the present line, or else to the first word of the next line that has one. Whether
  /// it is one of the keywords; at the end of the file the keyword is empty.
  bool find(std::initializer_list<std::string_view> keywords) {
    const auto is_one = [&] { return std::find(keywords.begin(), keywords.end(), keyword_) != keywords.end(); };
    for (take(words_.next_in_line()); !keyword_.empty(); take(words_.next_in_line())) {
      if (is_one()) {
        return true;
      }
    }
    take(words_.next());
    return is_one();
  }

  /// `end solid` and the like are one keyword.
  void take(std::string_view word) {
    word_ = word;
    keyword_ = lower_case(word);
    if (keyword_ == "end") {
      keyword_ += lower_case(words_.next_in_line());
    }
  }

  Status expect(std::string_view keyword) {
    if (find({keyword})) {
      return Done{};
    }
    return words_.error(fmt::format("{} in the place of `{}` of a facet", shown(word_), keyword));
  }

  Status read_facet() {
    if (auto done = expect("outer"); !done) {
      return done;
    }
    for (int corner = 0; corner < 3; ++corner) {
      if (auto done = expect("vertex"); !done) {
        return done;
      }
      Point point{};
      for (double& x : point) {
        const auto word = words_.next_in_line();
        if (!parse_coordinate(word, x)) {
          return words_.error(not_a_coordinate(word));
        }
      }
      mesh_.faces.push_corner(static_cast<std::uint32_t>(mesh_.points.size()));
      mesh_.points.push_back(point);
    }
    mesh_.faces.close_face();
    if (auto done = expect("endloop"); !done) {
      return done;
    }
    return expect("endfacet");
  }

  WordReader words_;
  std::string_view word_;
  std::string keyword_;
  Mesh mesh_;
};

/// Binary files may begin with `solid` too. Their number of triangles, in bytes 80 to 83, and their zeros are control
/// characters, which no text has.
bool is_text(std::string_view bytes) {
  constexpr std::size_t sample = 1024;
  const auto begin = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  const auto head = bytes.substr(0, sample);
  return lower_case(bytes.substr(begin, 5)) == "solid" && std::none_of(head.begin(), head.end(), [](char c) {
           const auto code = static_cast<unsigned char>(c);
           return code < ' ' && (code < '\t' || code > '\r');
         });
}

}  // namespace

std::optional<std::size_t> binary_stl_size(std::string_view bytes) {
  if (bytes.size() < head_size) {
    return std::nullopt;
  }
  return head_size + std::size_t{word_at(bytes, 80)} * triangle_size;
}

Result<Mesh> read_stl(std::string_view bytes, std::string_view name) {
  if (bytes.size() == binary_stl_size(bytes) || !is_text(bytes)) {
    return read_binary(bytes, name);
  }
  return TextStlReader{bytes, name}.read();
}

}  // namespace sesame::tools
