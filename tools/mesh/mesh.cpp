#include "tools/mesh/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "replay/text/byte_source.hpp"
#include "tools/mesh/map_file.hpp"
#include "tools/mesh/readers.hpp"
#include "tools/mesh/text.hpp"
#include "tools/mesh/weld.hpp"

namespace sesame::tools {

namespace {

constexpr std::string_view known_formats = "an OFF, OBJ, PLY or STL mesh is expected";
constexpr std::size_t size_limit = std::numeric_limits<std::uint32_t>::max();  ///< 32-bit numbers count what is read

bool has_obj_vertex(std::string_view bytes) {
  LineReader lines{bytes, {}};
  while (lines.next_with_words()) {
    auto rest = lines.line();
    if (next_word(rest) == "v") {
      return true;
    }
  }
  return false;
}

/// No text has a byte that is zero.
bool has_zero(std::string_view bytes) { return bytes.find('\0') != std::string_view::npos; }

Error unknown_format(std::string_view name) {
  return {Errc::bad_input,
          fmt::format("{}:1: neither the name nor the content tells the format, {}", name, known_formats)};
}

Error too_large(std::string_view name) {
  return {Errc::bad_input, fmt::format("{}:1: this is larger than the 4 GB up to which meshes are read", name)};
}

/// Data that begin like no mesh may have no end: they are not read up to it.
Status check_beginning(std::string_view bytes, std::string_view name, Format format) {
  if (!has_zero(bytes) || format != Format::automatic || format_of_extension(name) != Format::automatic ||
      format_of_content(bytes) != Format::automatic) {
    return Done{};
  }
  const auto size = binary_stl_size(bytes);
  return !size || (bytes.size() <= *size && *size < size_limit) ? Status{Done{}} : unknown_format(name);
}

Result<Mesh> read_as(Format format, std::string_view bytes, std::string_view name) {
  switch (format) {
    case Format::off:
      return read_off(bytes, name);
    case Format::obj:
      if (has_zero(bytes)) {
        return Error{Errc::bad_input,
                     fmt::format("{}: byte {} of this is zero, and OBJ is a text", name, bytes.find('\0'))};
      }
      return read_obj(bytes, name);
    case Format::ply:
      return read_ply(bytes, name);
    case Format::stl:
      return read_stl(bytes, name);
    case Format::facets:
      return Error{Errc::bad_input,
                   fmt::format("{}:1: a list of facets is no mesh; `sesame import` makes a script of it", name)};
    case Format::map:
      return Error{Errc::bad_input,
                   fmt::format("{}:1: a map file is no mesh; `sesame import --format map` makes a script of it", name)};
    case Format::medit:
    case Format::vtk:
      return Error{Errc::bad_input, fmt::format("{}:1: a mesh of solids is none of polygons; `sesame import --cells "
                                                "--format {}` makes a script of it",
                                                name, format == Format::vtk ? "vtk" : "medit")};
    case Format::automatic:
      break;
  }
  return unknown_format(name);
}

/// What no format allows: nothing at all, UTF-16, more than 32-bit numbers can count.
Status check_readable(std::string_view bytes, std::string_view name) {
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return Error{Errc::bad_input, fmt::format("{}:1: the file is empty, {}", name, known_formats)};
  }
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
    return Error{Errc::bad_input, fmt::format("{}:1: the text is UTF-16, save it as UTF-8", name)};
  }
  if (bytes.size() >= size_limit) {
    return too_large(name);
  }
  return Done{};
}

}  // namespace

Format format_of_extension(std::string_view name) {
  constexpr std::string_view packed = ".gz";
  if (name.ends_with(packed)) {
    name.remove_suffix(packed.size());
  }
  const auto dot = name.find_last_of("./\\");
  if (dot == std::string_view::npos || name[dot] != '.') {
    return Format::automatic;
  }
  const std::string extension = lower_case(name.substr(dot + 1));
  if (extension == "off") {
    return Format::off;
  }
  if (extension == "obj") {
    return Format::obj;
  }
  if (extension == "ply") {
    return Format::ply;
  }
  if (extension == "stl") {
    return Format::stl;
  }
  if (extension == "mesh") {
    return Format::medit;
  }
  if (extension == "vtk") {
    return Format::vtk;
  }
  return map_dimension_of_extension(name) ? Format::map : Format::automatic;
}

Format format_of_content(std::string_view bytes) {
  if (bytes.starts_with("ply")) {
    return Format::ply;
  }
  if (has_off_head(bytes)) {
    return Format::off;
  }
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (bytes.size() == binary_stl_size(bytes) || lower_case(bytes.substr(std::min(first, bytes.size()), 5)) == "solid") {
    return Format::stl;
  }
  if (bytes.starts_with("# vtk DataFile")) {
    return Format::vtk;
  }
  if (bytes.starts_with("<?xml") || bytes.starts_with("<data>")) {
    return Format::map;
  }
  LineReader lines{bytes, {}};
  std::string_view line = lines.next_with_words() ? lines.line() : std::string_view{};
  if (next_word(line) == "MeshVersionFormatted") {
    return Format::medit;
  }
  return !has_zero(bytes) && has_obj_vertex(bytes) ? Format::obj : Format::automatic;
}

Result<Mesh> parse_mesh(std::string_view bytes, std::string_view name, const ReadOptions& options) {
  if (options.weld && !(std::isfinite(*options.weld) && *options.weld >= 0)) {
    return Error{Errc::bad_input, fmt::format("the welding tolerance {} is not a finite number >= 0", *options.weld)};
  }
  if (bytes.starts_with("\xef\xbb\xbf")) {
    bytes.remove_prefix(3);
  }
  if (auto readable = check_readable(bytes, name); !readable) {
    return readable.error();
  }
  auto format = options.format;
  if (format == Format::automatic) {
    format = format_of_extension(name);
  }
  if (format == Format::automatic) {
    format = format_of_content(bytes);
  }
  auto mesh = read_as(format, bytes, name);
  if (mesh && (options.weld || format == Format::stl)) {
    weld(*mesh, options.weld.value_or(0));
  }
  return mesh;
}

Result<Mesh> read_mesh(const std::string& path, const ReadOptions& options) {
  Result<replay::ByteSource> source = replay::ByteSource::open(path);
  if (!source) {
    return source.error();
  }
  bool is_first = true;
  while (true) {
    const Result<bool> got = source->more();
    if (!got) {
      return got.error();
    }
    if (!*got) {
      return parse_mesh(source->window(), source->name(), options);
    }
    if (source->window().size() >= size_limit) {
      return too_large(source->name());
    }
    if (!std::exchange(is_first, false)) {
      continue;
    }
    if (const Status mesh = check_beginning(source->window(), source->name(), options.format); !mesh) {
      return mesh.error();
    }
  }
}

}  // namespace sesame::tools
