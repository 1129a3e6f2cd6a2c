#include "replay/script.hpp"

#include <sstream>

#include "tests/replay/replay_support.hpp"

using namespace sesame;
using namespace sesame::tests;
using replay::ScriptReader;

namespace {

const std::string vertex_a = R"({"op":"simplex","name":"a","dim":0})";
const std::string vertex_b = R"({"op":"simplex","name":"b","dim":0})";

/// Each operation in canonical text after the number of its line, the header first; an error as it is, at the end.
std::vector<std::string> read_all(ScriptReader& reader) {
  std::vector<std::string> seen;
  const auto add = [&](const std::string& text) { seen.push_back(std::to_string(reader.line()) + " " + text); };
  const Result<ops::Header> header = reader.header();
  if (!header) {
    return {header.error().what};
  }
  add(ops::to_text(*header));
  while (true) {
    const auto operation = reader.next();
    if (!operation) {
      seen.push_back(operation.error().what);
      return seen;
    }
    if (!*operation) {
      return seen;
    }
    add(ops::to_text(**operation));
  }
}

std::vector<std::string> read_text(const std::string& text) {
  std::istringstream input(text);
  ScriptReader reader(input, "s.jsonl");
  return read_all(reader);
}

/// Reads what grows by the given pieces, one each time that the reader waits, and is stopped after the last.
std::vector<std::string> read_pieces(std::vector<std::string> pieces) {
  std::stringstream input;
  std::size_t given = 0;
  ScriptReader reader(input, "s.jsonl", [&] {
    if (given == pieces.size()) {
      return false;
    }
    input.clear();
    input << pieces[given++];
    return true;
  });
  return read_all(reader);
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("blank lines and comments are skipped but counted", "[replay]") {
  const auto seen = read_text("# a comment\n\n" + header_line + "\n \t\n#{\"op\":\"nonsense\"}\n" + vertex_a +
                              "\n\n#\n" + vertex_b + "\n#last");
  CHECK(seen == std::vector<std::string>{"3 " + header_line, "6 " + vertex_a, "9 " + vertex_b});
}

TEST_CASE("carriage returns, a byte order mark and a missing last newline change nothing", "[replay]") {
  const std::string mark = "\xEF\xBB\xBF";
  const std::vector<std::string> expected{"1 " + header_line, "3 " + vertex_a};
  CHECK(read_text(header_line + "\n\n" + vertex_a + "\n") == expected);
  CHECK(read_text(header_line + "\n\n" + vertex_a) == expected);
  CHECK(read_text(header_line + "\r\n\r\n" + vertex_a + "\r\n") == expected);
  CHECK(read_text(mark + header_line + "\n\n" + vertex_a) == expected);
  CHECK(read_text(mark + "# comment\n" + header_line) == std::vector<std::string>{"2 " + header_line});
  CHECK(read_text(mark + "\r\n" + header_line) == std::vector<std::string>{"2 " + header_line});
}

TEST_CASE("an error says where it is, before what it is", "[replay]") {
  const auto seen = read_text("\n" + header_line + "\n" + vertex_a + "\n# comment\n{\"op\":\"simplexx\"}\n" + vertex_b);
  REQUIRE(seen.size() == 3);
  CHECK(seen[2].starts_with("s.jsonl:5: "));
  CHECK(contains(seen[2], "simplexx"));

  const auto wrong_header = read_text("# comment\n{\"sesame\":7}\n");
  REQUIRE(wrong_header.size() == 1);
  CHECK(wrong_header[0].starts_with("s.jsonl:2: "));

  const auto not_json = read_text(header_line + "\n{\"op\":\"simplex\",\n");
  REQUIRE(not_json.size() == 2);
  CHECK(not_json[1].starts_with("s.jsonl:2: "));

  std::istringstream input(header_line + "\n\n" + vertex_a + "\n");
  ScriptReader reader(input, "s.jsonl");
  CHECK(reader.header());
  CHECK(reader.place() == "s.jsonl:1: ");
  CHECK(reader.next());
  CHECK(reader.place() == "s.jsonl:3: ");
}

TEST_CASE("a script without an object is called empty", "[replay]") {
  for (const std::string text : {"", "\n", "# only a comment", "\r\n\r\n#\n", "\xEF\xBB\xBF"}) {
    CAPTURE(text);
    const auto seen = read_text(text);
    REQUIRE(seen.size() == 1);
    CHECK(seen[0].starts_with("s.jsonl: this script is empty"));
  }
}

TEST_CASE("a followed script reads the same wherever its growth pauses", "[replay]") {
  const std::string text =
      "\xEF\xBB\xBF# \xC3\xA9\r\n" + header_line + "\r\n\n#\n" + vertex_a + "\n" + vertex_b + "\r\n";
  const auto whole = read_text(text);
  REQUIRE(whole.size() == 3);
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    CAPTURE(cut);
    CHECK(read_pieces({text.substr(0, cut), text.substr(cut)}) == whole);
  }
  std::vector<std::string> letters;
  for (const char letter : text) {
    letters.emplace_back(1, letter);
    letters.emplace_back();  // nothing new this time
  }
  CHECK(read_pieces(letters) == whole);
}

TEST_CASE("a line that is unfinished when a followed script is stopped is left out", "[replay]") {
  const std::string start = header_line + "\n" + vertex_a + "\n";
  const std::vector<std::string> expected{"1 " + header_line, "2 " + vertex_a};
  CHECK(read_pieces({start}) == expected);
  CHECK(read_pieces({start + vertex_b}) == expected);  // complete, but for all we know more was to come
  CHECK(read_pieces({start, "{\"op\":"}) == expected);
  CHECK(read_pieces({start, "# com", "ment"}) == expected);
  CHECK(read_pieces({start, vertex_b, "\n"}).size() == 3);
}

TEST_CASE("a followed script that is stopped before its header is empty", "[replay]") {
  for (const std::string text : {"", "# comment\n", "{\"sesame\":1"}) {
    CAPTURE(text);
    const auto seen = read_pieces({text});
    REQUIRE(seen.size() == 1);
    CHECK(seen[0].starts_with("s.jsonl: this script is empty"));
  }
}

TEST_CASE("operations are counted without header, comments and blank lines", "[replay]") {
  const auto count = [](const std::string& text) {
    std::istringstream input(text);
    return replay::count_operations(input);
  };
  CHECK(count("") == 0);
  CHECK(count("# comment\n\n") == 0);
  CHECK(count(header_line) == 0);
  CHECK(count(header_line + "\n" + vertex_a) == 1);
  CHECK(count("#\r\n" + header_line + "\r\n\r\n" + vertex_a + "\r\n \t\r\n# x\r\n" + vertex_b + "\r\n") == 2);
  CHECK(count("\xEF\xBB\xBF" + header_line + "\n" + vertex_a + "\nnot even JSON\n") == 2);
}
