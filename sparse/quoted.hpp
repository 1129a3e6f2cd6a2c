/// \file
/// Texts that somebody else wrote, in our sentences.
#pragma once

#include <string>
#include <string_view>

namespace sesame::sparse {

/// The text in quotes, as a line of a terminal can show it: control characters, other ends of lines and what is no
/// UTF-8 become `?`. Of a text of more than 200 bytes it is the beginning, and says how many there are.
[[nodiscard]] std::string quoted(std::string_view text);
/// The same without the quotes.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace sesame::sparse
