// The format: 3D Systems, "StereoLithography Interface Specification" (1989), section 6.5.
#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "tools/mesh/readers.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {

namespace {

constexpr std::size_t head_size = 84;
constexpr std::size_t triangle_size = 50;

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = (value << 8) | static_cast<unsigned char>(bytes[offset + i]);
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
                         fmt::format("{} triangles are announced, which takes {} bytes, but the file has {}", triangles,
                                     end, bytes.size()));
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
    mesh.remarks.push_back(fmt::format("the {} bytes after the last triangle were left out", bytes.size() - end));
  }
  return mesh;
}

bool same_keyword(std::string_view word, std::string_view lower_case) {
  if (word.size() != lower_case.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i] >= 'A' && word[i] <= 'Z' ? static_cast<char>(word[i] - 'A' + 'a') : word[i];
    if (c != lower_case[i]) return false;
  }
  return true;
}

class TextStlReader {
 public:
  TextStlReader(std::string_view bytes, std::string_view name) : lines_{bytes, name} {}

  Result<Mesh> read() {
    bool inside = false;
    while (next_statement()) {
      if (!inside && same_keyword(keyword_, "solid")) {
        inside = true;
      } else if (inside && same_keyword(keyword_, "endsolid")) {
        inside = false;
      } else if (inside && same_keyword(keyword_, "facet")) {
        if (auto done = read_facet(); !done) return done.error();
      } else {
        return lines_.error(fmt::format("{} in a place where {} is expected", shown(keyword_),
                                        inside ? "`facet` or `endsolid`" : "`solid`"));
      }
    }
    if (inside) mesh_.remarks.emplace_back("the file ends without `endsolid`; it may have been cut");
    return std::move(mesh_);
  }

 private:
  bool next_statement() {
    do {
      if (!lines_.next()) {
        keyword_ = {};
        return false;
      }
      rest_ = lines_.line();
      keyword_ = next_word(rest_);
    } while (keyword_.empty());
    return true;
  }

  Status expect_statement(std::string_view keyword) {
    next_statement();
    if (same_keyword(keyword_, keyword)) return Done{};
    return lines_.error(fmt::format("{} in the place of `{}` of a facet", shown(keyword_), keyword));
  }

  Status read_facet() {
    if (auto done = expect_statement("outer"); !done) return done;
    for (int corner = 0; corner < 3; ++corner) {
      if (auto done = expect_statement("vertex"); !done) return done;
      Point point{};
      for (double& x : point) {
        const auto word = next_word(rest_);
        if (!parse_coordinate(word, x)) return lines_.error(not_a_coordinate(word));
      }
      mesh_.faces.push_corner(static_cast<std::uint32_t>(mesh_.points.size()));
      mesh_.points.push_back(point);
    }
    mesh_.faces.close_face();
    if (auto done = expect_statement("endloop"); !done) return done;
    return expect_statement("endfacet");
  }

  LineReader lines_;
  std::string_view keyword_;
  std::string_view rest_;
  Mesh mesh_;
};

}  // namespace

bool has_binary_stl_size(std::string_view bytes) {
  return bytes.size() >= head_size && bytes.size() == head_size + std::size_t{word_at(bytes, 80)} * triangle_size;
}

Result<Mesh> read_stl(std::string_view bytes, std::string_view name) {
  // Binary files may begin with "solid" too, so the size decides first.
  if (has_binary_stl_size(bytes)) return read_binary(bytes, name);
  auto rest = bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  const bool is_text = same_keyword(rest.substr(0, 5), "solid");
  return is_text ? TextStlReader{bytes, name}.read() : read_binary(bytes, name);
}

}  // namespace sesame::tools
