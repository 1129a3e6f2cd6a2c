/// \file
/// One reader per format; `parse_mesh` chooses. Errors as in mesh.hpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "sparse/result.hpp"
#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// Object File Format, ASCII, with any prefix of [ST][C][N][4][n]. Normals, colours and texture coordinates are
/// skipped; points are divided by a homogeneous coordinate, and of more than three coordinates the first three are
/// kept. Lines may break anywhere, but what follows the corners of a face on their line is its colour.
[[nodiscard]] Result<Mesh> read_off(std::string_view bytes, std::string_view name);

/// Wavefront OBJ: `v`, `f` and `l`, indices from 1 or negative; everything else is skipped.
[[nodiscard]] Result<Mesh> read_obj(std::string_view bytes, std::string_view name);

/// Polygon File Format, ASCII and binary of both byte orders; elements `vertex`, `face`, `tristrips` and `edge`, others
/// are skipped.
[[nodiscard]] Result<Mesh> read_ply(std::string_view bytes, std::string_view name);

/// Stereolithography, ASCII and binary. The result has three points of its own for every triangle: weld it.
[[nodiscard]] Result<Mesh> read_stl(std::string_view bytes, std::string_view name);

/// The size in bytes that data have if they are a binary STL file with the number of triangles that they claim; nothing
/// when they are too short to claim any.
[[nodiscard]] std::optional<std::size_t> binary_stl_size(std::string_view bytes);

/// Whether the first word that is not in a comment is the head of an OFF file.
[[nodiscard]] bool has_off_head(std::string_view bytes);

}  // namespace sesame::tools
