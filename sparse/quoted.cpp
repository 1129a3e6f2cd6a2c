#include "sparse/quoted.hpp"

#include <boost/locale/utf.hpp>

#include <cstddef>

namespace sesame::sparse {
namespace {

/// What a terminal may obey, or take for the end of a line: Cc, the separators of lines and paragraphs, and the marks
/// that turn the direction of writing.
bool is_harmful(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

}  // namespace

std::string printable(std::string_view text) {
  using Utf8 = boost::locale::utf::utf_traits<char>;
  constexpr std::size_t most = 200;
  std::string shown;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    const char* const begin = at;
    const auto c = Utf8::decode(at, end);
    const bool is_legal = c != boost::locale::utf::illegal && c != boost::locale::utf::incomplete;
    if (!is_legal) {
      at = begin + 1;
    }
    const auto bytes = static_cast<std::size_t>(at - begin);
    if (shown.size() + bytes > most) {
      return shown + "... (" + std::to_string(text.size()) + " bytes)";
    }
    if (is_legal && !is_harmful(c)) {
      shown.append(begin, bytes);
    } else {
      shown += '?';
    }
  }
  return shown;
}

std::string quoted(std::string_view text) { return "\"" + printable(text) + "\""; }

}  // namespace sesame::sparse
