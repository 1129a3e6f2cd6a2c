/// \file
/// The head of an OFF file: what its points have, and how much there is of everything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sparse/result.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {

struct OffHead {
  bool has_keyword = true;  ///< `OFF`; older files begin with the counts
  bool has_texture = false;
  bool has_colours = false;
  bool has_normals = false;
  bool is_homogeneous = false;    ///< there is a fourth coordinate, which divides the others
  bool has_dimension = false;     ///< the number of coordinates comes first
  bool is_ambiguous = false;      ///< `noff`: normals, or a dimension?
  std::size_t coordinates = 3;    ///< numbers that say where a point is
  std::size_t other_numbers = 0;  ///< numbers of a point after those: normal, colour, texture coordinates
  std::uint64_t points = 0;
  std::uint64_t faces = 0;

  [[nodiscard]] std::size_t numbers() const { return coordinates + other_numbers; }
};

/// Reads `[ST][C][N][4][n]OFF`, the prefixes in any order; a number may be glued to it. Returns that number, empty when
/// there is none, or nothing when the word is not of this form.
std::optional<std::string_view> parse_off_keyword(std::string_view word, OffHead& head);

/// Reads the head, and leaves the words behind it. Errors, bad_input: what is wrong in it, or more points or faces than
/// the rest of the file could hold.
[[nodiscard]] Result<OffHead> read_off_head(WordReader& words);

}  // namespace sesame::tools
