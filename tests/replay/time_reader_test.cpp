#include "replay/text/time_reader.hpp"

#include <vector>

#include "replay/text/text_buffer.hpp"
#include "tests/support/catch.hpp"

using namespace sesame;
using engine::Time;
using replay::json_number_text;
using replay::number_text;
using replay::TimeReader;

namespace {

/// What reading the words of one file after the other says: the times, or the error that ends it.
std::string read(const std::vector<std::string>& words) {
  TimeReader reader;
  std::string seen;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const Result<Time> time = reader.read(words[k], "a time", "FILE", k + 1);
    if (!time) {
      CHECK(time.error().code == Errc::bad_input);
      return seen + time.error().what;
    }
    seen += number_text(*time) + " ";
  }
  return seen;
}

}  // namespace

TEST_CASE("whole numbers of 64 bits are read and written to the last digit", "[replay][time]") {
  for (const char* digits : {"0", "-1", "1732800000000000001", "9007199254740991", "9007199254740992",
                             "9007199254740993", "-9007199254740993", "9223372036854775807", "9223372036854775808",
                             "-9223372036854775808", "18446744073709551615", "1000000000000000"}) {
    CHECK(read({digits}) == std::string{digits} + " ");
  }
  CHECK(read({"-0", "007", "-9223372036854775807"}) == "0 7 -9223372036854775807 ");
}

TEST_CASE("other numbers are doubles, which are written so that they are read as such", "[replay][time]") {
  CHECK(read({"0.1", "1e3", "3.0", ".5", "-2.5e-7", "inf", "-inf"}) == "0.1 1000 3 0.5 -2.5e-07 inf -inf ");
  CHECK(read({"1e18", "9007199254740993.0", "123456789012345683968.0"}) ==
        "1e+18 9007199254740992 1.2345678901234568e+20 ");
  CHECK(read({"1.8446744073709551616e19"}) == "1.8446744073709552e+19 ");
}

TEST_CASE("what is no number, or too large, is refused", "[replay][time]") {
  for (const char* word : {"", "x", "1x", "nan", "-nan", "--1", "-", "1e999", "0x10", "1 2", "+1"}) {
    CHECK(read({word}) == "\"" + std::string{word} + "\" should be a time");
  }
  CHECK(
      read({"18446744073709551616"}) ==
      "\"18446744073709551616\" should be a time: whole numbers have 64 bits at most, larger ones are written with an "
      "exponent, as doubles, 1.8446744073709552e+19");
  CHECK_THAT(read({"-9223372036854775809"}), Catch::Contains("64 bits at most"));
  CHECK(read({std::string(400, '9')}) == "\"" + std::string(40, '9') + "...\" should be a time");
}

TEST_CASE("whole numbers beyond 2^53 and numbers that may have been rounded do not go together", "[replay][time]") {
  const std::string why =
      ": whole numbers beyond 2^53 are exact, numbers with a point or an exponent are rounded, and together they have "
      "no "
      "order; write all of them in one of the two ways";
  CHECK(read({"0.5", "9007199254740993"}) == "0.5 9007199254740993, but FILE:1 has 0.5" + why);
  CHECK(read({"7", "-9007199254740993", "8", "1e300"}) ==
        "7 -9007199254740993 8 1e300, but FILE:2 has -9007199254740993" + why);
  CHECK(read({"9007199254740993", "9007199254740993.5"}) ==
        "9007199254740993 9007199254740993.5, but FILE:1 has 9007199254740993" + why);
  // No rounding, or none that could be seen.
  CHECK(read({"9007199254740993", "3.0", "1e3", "inf"}) == "9007199254740993 3 1000 inf ");
  CHECK(read({"0.5", "9007199254740992", "1e18", "1e300"}) == "0.5 9007199254740992 1e+18 1e+300 ");
}

TEST_CASE("whole numbers that JSON readers would round are strings", "[replay][time]") {
  CHECK(json_number_text(9007199254740992) == "9007199254740992");
  CHECK(json_number_text(9007199254740993) == "\"9007199254740993\"");
  CHECK(json_number_text(-9007199254740993) == "\"-9007199254740993\"");
  CHECK(json_number_text(1e18) == "1e+18");
  CHECK(json_number_text(0.25) == "0.25");
}
