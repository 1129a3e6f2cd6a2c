/// \file
/// The header of a PLY file: which elements follow, and which values each has.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "sparse/result.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// In bytes.
[[nodiscard]] std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string_view name;
  PlyType type;
  std::optional<PlyType> count;  ///< of a list: the type of its length
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The position of a property, or the number of properties.
  [[nodiscard]] std::size_t find(std::string_view property) const {
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [property](const PlyProperty& p) { return p.name == property; });
    return static_cast<std::size_t>(found - properties.begin());
  }
};

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
};

/// Reads the lines up to `end_header`. The names in it are those of the text that is read. Errors, bad_input.
[[nodiscard]] Result<PlyHeader> read_ply_header(LineReader& lines);

}  // namespace sesame::tools
