/// \file
/// Barcodes as other programs and our own JSON write them, turned into the lines of a `.pers` file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sparse/result.hpp"

namespace sesame::replay {

enum class BarcodeDialect {
  pers,    ///< lines of numbers
  json,    ///< what `sesame tower --json` prints
  ripser,  ///< lines ` [birth,death)` below headings `persistence intervals in dim D:`
};

/// By the first line that says something.
[[nodiscard]] BarcodeDialect dialect_of(std::string_view line);

/// A line `dim birth death`, and where it is from.
struct PersLine {
  std::string text;
  std::uint64_t number;
};

/// Reads Ripser's lines. What stands before the first heading is about the points; behind an interval there may be a
/// colon and a cycle.
class RipserLines {
 public:
  /// The line of a bar; empty when it is no bar. Errors: bad_input, without the place.
  Result<std::string> take(std::string_view line);

 private:
  std::string dimension_;  ///< empty before the first heading
};

/// The bars of the last object that has some: others before it are the states of `--every`. `first` is the number of
/// the first line of the text. Errors: bad_input with the place, also for several barcodes, and for groups over Z.
Result<std::vector<PersLine>> bars_of_json(std::string_view text, const std::string& name, std::uint64_t first);

}  // namespace sesame::replay
