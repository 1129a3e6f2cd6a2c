#include "replay/script/script.hpp"

#include "tests/replay/replay_support.hpp"
#include "tests/support/inputs.hpp"

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
  ScriptReader reader(replay::ByteSource::of_text(text, "s.jsonl"));
  return read_all(reader);
}

/// Reads what comes in these pieces, and is stopped after the last.
std::vector<std::string> read_pieces(const std::vector<std::string>& pieces) {
  ScriptReader reader(source_of(pieces, End::stopped, "s.jsonl"));
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

  ScriptReader reader(replay::ByteSource::of_text(header_line + "\n\n" + vertex_a + "\n", "s.jsonl"));
  CHECK(reader.header());
  CHECK(reader.place() == "s.jsonl:1: ");
  CHECK(reader.next());
  CHECK(reader.place() == "s.jsonl:3: ");
}

TEST_CASE("lines of any length follow each other", "[replay]") {
  const auto complex = [](const std::string& name, int cells) {
    std::string line = R"({"op":"complex","name":")" + name + R"(","cells":[)";
    for (int k = 0; k < cells; ++k) {
      line += (k == 0 ? R"({"id":")" : R"(,{"id":")") + std::to_string(k) + R"("})";
    }
    return line + "]}";
  };
  // The long ones take more than a mebibyte, and give it back.
  const std::string text = header_line + "\n" + complex("K", 3) + "\n" + complex("L", 100'000) + "\n" + vertex_a +
                           "\n" + complex("M", 200'000) + "\n" + complex("N", 70'000);
  const auto seen = read_text(text);
  REQUIRE(seen.size() == 6);
  std::size_t begin = 0;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    CHECK((seen[k] == std::to_string(k + 1) + " " + text.substr(begin, end - begin)));
    begin = end + 1;
  }
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
    return replay::count_operations(replay::ByteSource::of_text(text, "s.jsonl")).value();
  };
  CHECK(count("") == 0);
  CHECK(count("# comment\n\n") == 0);
  CHECK(count(header_line) == 0);
  CHECK(count(header_line + "\n" + vertex_a) == 1);
  CHECK(count("#\r\n" + header_line + "\r\n\r\n" + vertex_a + "\r\n \t\r\n# x\r\n" + vertex_b + "\r\n") == 2);
  CHECK(count("\xEF\xBB\xBF" + header_line + "\n" + vertex_a + "\nnot even JSON\n") == 2);
}

TEST_CASE("more operations than it takes to know are not counted", "[replay]") {
  const std::string text = header_line + "\n" + vertex_a + "\n" + vertex_b + "\n";
  const auto count = [&](std::uint64_t most) {
    return replay::count_operations(replay::ByteSource::of_text(text, "s.jsonl"), most).value();
  };
  CHECK(count(1) == 1);
  CHECK(count(2) == 2);
  CHECK(count(3) == 2);
  const auto broken = replay::count_operations(source_of({text}, End::failed, "s.jsonl"));
  REQUIRE(!broken);
  CHECK(broken.error().code == Errc::io);
  CHECK(replay::count_operations(source_of({text}, End::failed, "s.jsonl"), 2).value() == 2);
}

TEST_CASE("an input that breaks is an error, never a shorter script, wherever it breaks", "[replay]") {
  const std::string text = header_line + "\n# comment\n" + vertex_a + "\n\n" + vertex_b + "\n";
  const auto whole = read_text(text);
  for (std::size_t broken_at = 1; broken_at <= text.size(); ++broken_at) {
    ScriptReader reader(source_of({text.substr(0, broken_at)}, End::failed, "s.jsonl"));
    const auto seen = read_all(reader);
    CAPTURE(broken_at);
    REQUIRE(!seen.empty());
    CHECK(seen.back() == "cannot read the input: it broke");
    CHECK(std::equal(seen.begin(), seen.end() - 1, whole.begin()));
  }
}

TEST_CASE("a line that is too long is refused, and ends the script", "[replay]") {
  const std::string start = header_line + "\n" + vertex_a + "\n";
  const std::string note = R"({"op":"note","text":")" + std::string(200, 'x') + "\"}";
  const auto read_up_to = [&](std::size_t longest) {
    ScriptReader reader(replay::ByteSource::of_text(start + note + "\n" + vertex_b, "s.jsonl"), longest);
    return read_all(reader);
  };
  CHECK(read_up_to(note.size()).size() == 4);
  const auto seen = read_up_to(note.size() - 1);
  REQUIRE(seen.size() == 3);
  CHECK(seen[2] == "s.jsonl:3: this line is longer than " + std::to_string(note.size() - 1) +
                       " bytes; where such lines are meant, --max-line (replay, tower) raises the limit");
  ScriptReader reader(replay::ByteSource::of_text(start + note + "\n" + vertex_b, "s.jsonl"), 100);
  CHECK(reader.header());
  CHECK(reader.next());
  CHECK(!reader.next());
  CHECK(reader.place() == "s.jsonl:3: ");
  CHECK(!reader.next().value());
}

TEST_CASE("a line that is too long is refused before all of it is read", "[replay]") {
  ScriptReader reader(
      source_of({header_line, "\n", std::string(300'000, ' '), "behind it the input breaks"}, End::failed, "s.jsonl"),
      100);
  CHECK(reader.header());
  CHECK(reader.next().error().code == Errc::bad_input);
}

TEST_CASE("data that are no text are refused by their first bytes", "[replay]") {
  const std::string zeros(1000, '\0');
  for (const std::string& data : {zeros, "# " + zeros, "\n{\"sesame\":1" + zeros}) {
    ScriptReader reader(source_of({data}, End::failed, "s.jsonl"));  // no more than these is asked for
    const auto seen = read_all(reader);
    REQUIRE(seen.size() == 1);
    CHECK(seen[0] == "s.jsonl: a script is a text, but byte " + std::to_string(data.find('\0')) + " of this is zero");
  }
  ScriptReader reader(source_of({header_line + "\n# " + zeros}, End::failed, "s.jsonl"));
  CHECK(read_all(reader).back() == "s.jsonl:2: byte 2 of this line is zero, and no text has such bytes");
  CHECK(reader.is_broken());
}

TEST_CASE("a zero byte anywhere is told in the same words in whatever pieces a script comes", "[replay]") {
  const std::string text = "\n# a comment\n" + header_line + "\n\n# with a \n" + vertex_a + "\n";
  for (std::size_t at = 0; at < text.size(); at += 3) {
    std::string data = text;
    data[at] = '\0';
    ScriptReader whole(source_of({data}, End::whole, "s.jsonl"));
    std::vector<std::string> pieces;
    for (std::size_t k = 0; k < data.size(); k += 5) {
      pieces.push_back(data.substr(k, 5));
    }
    ScriptReader in_pieces(source_of(pieces, End::whole, "s.jsonl"));
    CAPTURE(at);
    CHECK(read_all(in_pieces) == read_all(whole));
  }
}

TEST_CASE("an input for another command is refused with the name of that command", "[replay]") {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"i 0\ni 1\n", "sesame tower"},     {"# a tower\n\n3.5 i 0\n", "sesame tower"},
      {"c 1 2\n", "sesame tower"},        {"0\n0\n1 0 1\n", "sesame tower"},
      {"0 1 0.5\n", "sesame distance"},   {"OFF\n3 1 0\n", "sesame mesh"},
      {"COFF\n3 1 0\n", "sesame import"}, {"ply\nformat ascii 1.0\n", "sesame mesh"},
      {"solid cube\n", "sesame mesh"},    {"# Blender\nmtllib cube.mtl\nv 0 0 0\n", "sesame mesh"},
      {"v 0 0 0\n", "sesame mesh"},
  };
  for (const auto& [text, command] : cases) {
    const auto seen = read_text(text);
    CAPTURE(text);
    REQUIRE(seen.size() == 1);
    CHECK(contains(seen[0], "a line should be one JSON object, {...} (it looks like "));
    CHECK(contains(seen[0], command));
  }
  CHECK(!contains(read_text("nonsense\n")[0], "looks like"));
  CHECK(!contains(read_text("{\"sesame\":9}\n")[0], "looks like"));
  ScriptReader mesh(replay::ByteSource::of_text(std::string(100, '\0'), "cube.STL.gz"));
  CHECK(contains(read_all(mesh)[0], "sesame mesh"));
}
