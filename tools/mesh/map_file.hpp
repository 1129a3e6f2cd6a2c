/// \file
/// CGAL's map files, XML: what is called .3map there, of combinatorial and of generalized maps.
#pragma once

#include <array>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ops/maps/gmap.hpp"
#include "ops/maps/nmap.hpp"
#include "sparse/result.hpp"
#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

struct MapFile {
  std::variant<ops::NMap, ops::GMap> map;  ///< dart k is the k-th of the file, counted from 0
  struct Placed {
    ops::Dart dart;
    Point point;
    std::size_t line;  ///< where it is said
  };
  std::vector<Placed> points;        ///< those of vertices, each from a dart
  std::vector<std::string> remarks;  ///< what is left out, a sentence each
};

/// The dimension in a name such as `cubes.3map` or `cubes.3map.gz`.
[[nodiscard]] std::optional<int> map_dimension_of_extension(std::string_view name);

/// Reads `data` > `darts` > `d`, one for each dart, counted from 1, with a `b` for each beta_i, i >= 1, that leads
/// somewhere, or with an `a` for each alpha_i, i >= 0, that does not fix it; and points of `attributes`. The dimension
/// is `dimension`, or else the largest i.
///
/// Errors    bad_input, `FILE:LINE: what, and what would be right`: no XML, no darts, both kinds of links, a link to no
///           dart, twice, above the dimension, or not back; a point that is none. Without a line, those of the other
///           laws of maps, with darts counted from 0. Cost: the file, and n^2 times the darts.
[[nodiscard]] Result<MapFile> parse_map_file(std::string_view bytes, std::string_view name,
                                             std::optional<int> dimension = {});

struct MapScriptOptions {
  std::string source;  ///< the file, whose stem names the map
  std::string ring = "Z";
  bool as_simplices = false;
};
struct MapScriptSummary {
  std::vector<std::size_t> cells;  ///< of the map, by dimension
  std::size_t darts = 0;
  std::vector<std::string> remarks;
};

/// Writes a script of one `map` or `gmap`, and an `expect` of the numbers of its cells. Points are written when each
/// vertex has one. Errors    refused, naming a dart: a cell that is no ball, unless the map is taken by simplices.
/// bad_input: darts of one vertex with different points.
[[nodiscard]] Result<MapScriptSummary> write_script_of_map_file(const MapFile& file, std::ostream& out,
                                                                const MapScriptOptions& options);

}  // namespace sesame::tools
