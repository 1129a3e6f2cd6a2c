/// \file
/// Numbers that follow one another in a text in which lines may break anywhere.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "sparse/result.hpp"
#include "tools/mesh/mesh.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {

/// Each of its errors is bad_input and says the line, what is there, and what should be there instead.
class NumberReader {
 public:
  NumberReader(LineReader lines, WordReader::Comments comments) : words_{lines, comments} {}

  std::string_view word() { return words_.next(); }
  /// All lines to one without words.
  void skip_lines_to_blank() { words_.skip_lines_to_blank(); }
  [[nodiscard]] Error error(std::string_view what) const { return words_.error(what); }
  [[nodiscard]] std::size_t line() const { return words_.lines().number(); }

  /// A whole number from `least` to `most`.
  [[nodiscard]] Result<std::int64_t> whole(std::string_view what, std::int64_t least, std::int64_t most);
  /// One that 32 bits hold.
  [[nodiscard]] Result<std::int64_t> count(std::string_view what) {
    return whole(what, 0, std::numeric_limits<std::uint32_t>::max() - 1);
  }
  [[nodiscard]] Result<Point> point();

 private:
  WordReader words_;
};

[[nodiscard]] bool is_number(std::string_view word);

}  // namespace sesame::tools
