#include "tools/mesh/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "replay/byte_source.hpp"
#include "tools/mesh/readers.hpp"
#include "tools/mesh/text.hpp"
#include "tools/mesh/weld.hpp"

namespace sesame::tools {

namespace {

constexpr std::string_view known_formats = "an OFF, OBJ, PLY or STL mesh is expected";

bool has_obj_vertex(std::string_view bytes) {
  LineReader lines{bytes, {}};
  while (lines.next_with_words()) {
    auto rest = lines.line();
    if (next_word(rest) == "v") return true;
  }
  return false;
}

Format format_of_content(std::string_view bytes) {
  if (bytes.starts_with("ply")) return Format::ply;
  if (has_off_head(bytes)) return Format::off;
  if (has_binary_stl_size(bytes) || lower_case(bytes.substr(bytes.find_first_not_of(" \t\r\n"), 5)) == "solid") {
    return Format::stl;
  }
  return has_obj_vertex(bytes) ? Format::obj : Format::automatic;
}

Result<Mesh> read_as(Format format, std::string_view bytes, std::string_view name) {
  switch (format) {
    case Format::off:
      return read_off(bytes, name);
    case Format::obj:
      return read_obj(bytes, name);
    case Format::ply:
      return read_ply(bytes, name);
    case Format::stl:
      return read_stl(bytes, name);
    case Format::facets:
      return Error{Errc::bad_input,
                   fmt::format("{}:1: a list of facets is no mesh; `sesame import` makes a script of it", name)};
    case Format::automatic:
      break;
  }
  return Error{Errc::bad_input,
               fmt::format("{}:1: neither the name nor the content tells the format, {}", name, known_formats)};
}

/// What no format allows: nothing at all, UTF-16, more than 32-bit numbers can count.
Status check_readable(std::string_view bytes, std::string_view name) {
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return Error{Errc::bad_input, fmt::format("{}:1: the file is empty, {}", name, known_formats)};
  }
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
    return Error{Errc::bad_input, fmt::format("{}:1: the text is UTF-16, save it as UTF-8", name)};
  }
  if (bytes.size() >= std::numeric_limits<std::uint32_t>::max()) {
    return Error{Errc::bad_input,
                 fmt::format("{}:1: the file has {} bytes, meshes are read up to 4 GB", name, bytes.size())};
  }
  return Done{};
}

}  // namespace

Format format_of_extension(std::string_view name) {
  constexpr std::string_view packed = ".gz";
  if (name.ends_with(packed)) name.remove_suffix(packed.size());
  const auto dot = name.find_last_of("./\\");
  if (dot == std::string_view::npos || name[dot] != '.') return Format::automatic;
  const std::string extension = lower_case(name.substr(dot + 1));
  if (extension == "off") return Format::off;
  if (extension == "obj") return Format::obj;
  if (extension == "ply") return Format::ply;
  if (extension == "stl") return Format::stl;
  return Format::automatic;
}

Result<Mesh> parse_mesh(std::string_view bytes, std::string_view name, const ReadOptions& options) {
  if (options.weld && !(std::isfinite(*options.weld) && *options.weld >= 0)) {
    return Error{Errc::bad_input, fmt::format("the welding tolerance {} is not a finite number >= 0", *options.weld)};
  }
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  if (auto readable = check_readable(bytes, name); !readable) return readable.error();
  auto format = options.format;
  if (format == Format::automatic) format = format_of_extension(name);
  if (format == Format::automatic) format = format_of_content(bytes);
  auto mesh = read_as(format, bytes, name);
  if (mesh && (options.weld || format == Format::stl)) weld(*mesh, options.weld.value_or(0));
  return mesh;
}

Result<Mesh> read_mesh(const std::string& path, const ReadOptions& options) {
  const auto bytes = replay::read_file(path);
  if (!bytes) return bytes.error();
  return parse_mesh(*bytes, path == "-" ? "standard input" : path, options);
}

}  // namespace sesame::tools
