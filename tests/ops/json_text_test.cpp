// JSON text that is written straight away, against the same value made by the library and written then.
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "ops/vocabulary/json_text.hpp"
#include "tests/support/catch.hpp"

using namespace sesame;
using ops::JsonText;
using Json = nlohmann::ordered_json;

namespace {

template <class T>
std::string text_of(const T& value) {
  std::string text;
  JsonText(text).value(value);
  return text;
}

std::string library_text(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

TEST_CASE("texts are written as the library writes them, whatever bytes are in them", "[ops]") {
  std::mt19937 random(7);
  // Each byte alone; then bytes that are ASCII, the beginnings of longer characters, or what goes on with one.
  const std::string bytes = "a\"\\\x1f\n\x7f\x80\xbf\xc2\xc3\xe0\xe2\x88\x82\xed\xa0\xf0\x9f\x98\x80\xf4\x90\xff";
  std::vector<std::string> texts{"", "plain"};
  for (int byte = 0; byte < 256; ++byte) {
    texts.emplace_back(1, static_cast<char>(byte));
  }
  for (int k = 0; k < 5000; ++k) {
    std::string text;
    for (std::size_t length = random() % 9; text.size() < length;) {
      text += bytes[random() % bytes.size()];
    }
    texts.push_back(text);
  }
  for (const std::string& text : texts) {
    CAPTURE(text);
    CHECK(text_of(text) == library_text(text));
  }
}

TEST_CASE("numbers are written as the library writes them, integers beyond 64 bits as digits in quotes", "[ops]") {
  std::mt19937_64 random(7);
  std::vector<double> numbers{0.0, -0.0, 1.0, 1e15, 1e16, -2.5, 1e-5, 0.1, 5e-324, std::numeric_limits<double>::max()};
  numbers.push_back(std::numeric_limits<double>::infinity());
  numbers.push_back(std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < 1000; ++k) {
    numbers.push_back(static_cast<double>(random()) / static_cast<double>(random() % 1000 + 1));
  }
  for (const double x : numbers) {
    CHECK(text_of(x) == library_text(x));
  }
  CHECK(text_of(std::numeric_limits<std::int64_t>::min()) == "-9223372036854775808");
  CHECK(text_of(std::numeric_limits<std::uint64_t>::max()) == "18446744073709551615");
  CHECK(text_of(7) == "7");
  CHECK(text_of(sparse::Integer{std::numeric_limits<std::int64_t>::min()}) == "-9223372036854775808");
  CHECK(text_of(*sparse::Integer::parse("9223372036854775808")) == "\"9223372036854775808\"");
}

TEST_CASE("lists, objects and truth values stand with commas between them", "[ops]") {
  CHECK(text_of(std::vector<int>{}) == "[]");
  CHECK(text_of(std::vector<std::vector<std::string>>{{}, {"a"}, {"b", "c"}}) == R"([[],["a"],["b","c"]])");
  std::string text;
  JsonText out(text);
  out.begin_object();
  out.field("is", true);
  out.key("of \"all\" kinds");
  out.list_of("a", 1, 0.5, false, std::vector<int>{1, 2});
  out.key("inner");
  out.begin_object();
  out.end_object();
  out.key("nothing");
  out.null();
  out.end_object();
  CHECK(text == R"({"is":true,"of \"all\" kinds":["a",1,0.5,false,[1,2]],"inner":{},"nothing":null})");
  CHECK(Json::parse(text).size() == 4);
}
