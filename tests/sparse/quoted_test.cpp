// Texts that somebody else wrote, in sentences.
#include "sparse/quoted.hpp"

#include "sparse/ring.hpp"
#include "tests/support/catch.hpp"

using namespace sesame;
using sparse::quoted;

TEST_CASE("a text in a sentence is as it is, unless a terminal would obey it", "[sparse][quoted]") {
  CHECK(quoted("t.0-1") == "\"t.0-1\"");
  CHECK(quoted("") == "\"\"");
  CHECK(quoted("\xC3\xA9\xE2\x88\x82\xF0\x9F\x8D\xA9") == "\"\xC3\xA9\xE2\x88\x82\xF0\x9F\x8D\xA9\"");
  CHECK(quoted("a\x1B[31mb\nc\x7F") == "\"a?[31mb?c?\"");
  CHECK(quoted(std::string_view{"\0x", 2}) == "\"?x\"");
  CHECK(quoted("\xC2\x9B"
               "1m") == "\"?1m\"");                       // the same escape in one character
  CHECK(quoted("\xE2\x80\xA8\xE2\x80\xAE") == "\"??\"");  // a separator of lines, and writing from right to left
  CHECK(quoted("a\xFF\xC3") == "\"a??\"");
}

TEST_CASE("of a long text a sentence has the beginning, and its length", "[sparse][quoted]") {
  CHECK(quoted(std::string(200, 'x')) == "\"" + std::string(200, 'x') + "\"");
  CHECK(quoted(std::string(100'000, 'x')) == "\"" + std::string(200, 'x') + "... (100000 bytes)\"");
  std::string text = "a";
  for (int k = 0; k < 150; ++k) {
    text += "\xC3\xA9";
  }
  CHECK(quoted(text) == "\"" + text.substr(0, 199) + "... (301 bytes)\"");  // not within a character
}

TEST_CASE("a ring that is none is named in a sentence that fits on a line", "[sparse][quoted]") {
  for (const std::string& ring :
       {"\x1B]0;" + std::string(5000, 'R'), "Z/" + std::string(5000, '9'), "Z/7\n" + std::string(500, 'x')}) {
    const auto parsed = sparse::parse_ring(ring);
    REQUIRE(!parsed);
    CHECK(parsed.error().what.size() < 1000);
    CHECK(parsed.error().what.find_first_of("\n\x1B") == std::string::npos);
  }
}
