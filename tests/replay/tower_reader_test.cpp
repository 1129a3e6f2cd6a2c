#include "replay/tower/tower_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "replay/text/text_buffer.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/inputs.hpp"
#include "tests/support/temporary_file.hpp"

using namespace sesame;
using replay::TowerFormat;
using replay::TowerOperation;
using replay::TowerReader;
using tests::gzipped;
using tests::TemporaryFile;
using Lines = std::vector<std::string>;

namespace {

/// The reading end of a pipe into which a thread writes a text, so many bytes at a time.
class Pipe {
 public:
  Pipe(std::string content, std::size_t piece) {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    reading_ = ends[0];
    writer_ = std::thread([content = std::move(content), piece, end = ends[1]] {
      for (std::size_t at = 0; at < content.size();) {
        const ssize_t wrote = ::write(end, content.data() + at, std::min(piece, content.size() - at));
        if (wrote <= 0) {
          break;
        }
        at += static_cast<std::size_t>(wrote);
      }
      ::close(end);
    });
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    writer_.join();
    ::close(reading_);
  }
  [[nodiscard]] std::string path() const { return "/dev/fd/" + std::to_string(reading_); }

 private:
  int reading_ = -1;
  std::thread writer_;
};

std::string binary(const std::vector<std::int64_t>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(std::int64_t)};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Each operation as `LINE: time kind dimension [labels]`; an error as it is, at the end, the path written as FILE.
Lines read_all(TowerReader& reader, const std::string& path) {
  Lines seen;
  TowerOperation operation;
  while (true) {
    const Result<bool> got = reader.next(operation);
    if (!got) {
      seen.push_back(replaced(got.error().what, path, "FILE"));
      return seen;
    }
    if (!*got) {
      return seen;
    }
    const char* kinds[] = {"i", "d", "c", "column"};
    seen.push_back(fmt::format("{}: {} {} {} [{}]", reader.line(), replay::number_text(operation.time),
                               kinds[static_cast<std::size_t>(operation.kind)], operation.dimension,
                               fmt::join(operation.labels, " ")));
  }
}

Lines read_path(const std::string& path, TowerFormat format = TowerFormat::automatic) {
  const Result<std::unique_ptr<TowerReader>> reader = TowerReader::open(path, format);
  return reader ? read_all(**reader, path) : Lines{replaced(reader.error().what, path, "FILE")};
}

Lines read(const std::string& content, TowerFormat format = TowerFormat::automatic) {
  const TemporaryFile file(content);
  return read_path(file.path(), format);
}

std::optional<TowerFormat> format_of(const std::string& content) {
  const TemporaryFile file(content);
  const auto reader = TowerReader::open(file.path());
  return reader ? std::optional{(*reader)->format()} : std::nullopt;
}

const std::string a_tower = "i 0\ni 1\ni 0 1\nc 1 0\n";
const std::string a_matrix = "0\n0\n1 0 1\n";
const std::string a_list = "0 5 0\n0 7 0.5\n1 5 7 2\n";
const std::string a_binary = binary({3, 0, 0, 0, 0, 1, 2, 0, 1});
const std::string a_script =
    "# a comment\n{\"sesame\":1,\"ring\":\"Z\",\"title\":\"x\"}\n{\"op\":\"note\",\"text\":\"x\"}\n";

const Lines read_tower{"1: 0 i 0 [0]", "2: 1 i 0 [1]", "3: 2 i 1 [0 1]", "4: 3 c 0 [1 0]"};
const Lines read_matrix{"1: 0 column 0 []", "2: 1 column 0 []", "3: 2 column 1 [0 1]"};
const Lines read_list{"1: 0 i 0 [5]", "2: 0.5 i 0 [7]", "3: 2 i 1 [5 7]"};
const Lines read_binary{"0: 0 column 0 []", "1: 1 column 0 []", "2: 2 column 1 [0 1]"};

}  // namespace

TEST_CASE("Every format is read, under its name and by its content", "[tower_reader]") {
  CHECK(read(a_tower, TowerFormat::tower) == read_tower);
  CHECK(read(a_matrix, TowerFormat::phat) == read_matrix);
  CHECK(read(a_list, TowerFormat::gudhi) == read_list);
  CHECK(read(a_binary, TowerFormat::phat_binary) == read_binary);
  CHECK(read(a_tower) == read_tower);
  CHECK(read(a_matrix) == read_matrix);
  CHECK(read(a_list) == read_list);
  CHECK(read(a_binary) == read_binary);
}

TEST_CASE("Every format is known by its content, behind comments and gzip too", "[tower_reader]") {
  const std::vector<std::pair<std::string, TowerFormat>> inputs{
      {a_tower, TowerFormat::tower},           {"c 1 0", TowerFormat::tower},   {"0.25 i 7\n", TowerFormat::tower},
      {a_matrix, TowerFormat::phat},           {"0", TowerFormat::phat},        {a_list, TowerFormat::gudhi},
      {"0 0 1e-300", TowerFormat::gudhi},      {a_script, TowerFormat::script}, {"", TowerFormat::tower},
      {"{\"sesame\":1}", TowerFormat::script}, {"0 1\n", TowerFormat::facets},  {"{0 1}\n", TowerFormat::facets}};
  for (const auto& [text, format] : inputs) {
    CAPTURE(text);
    CHECK(format_of(text) == format);
    CHECK(format_of("# says nothing: i 1 2\r\n\n   \n" + text) == format);
    CHECK(format_of("\xEF\xBB\xBF" + text) == format);
    CHECK(format_of(gzipped(text)) == format);
  }
  CHECK(format_of(a_binary) == TowerFormat::phat_binary);
  CHECK(format_of(gzipped(a_binary)) == TowerFormat::phat_binary);
  CHECK(format_of(binary({10})) == TowerFormat::phat_binary);  // begins with a line feed
}

TEST_CASE("An input that is of no format is told so, with its line", "[tower_reader]") {
  const std::string start = " starts no format that is known: a tower starts with ";
  CHECK_THAT(read("# x\nhello world\n").at(0), Catch::StartsWith("FILE:2: \"hello\"" + start));
  CHECK_THAT(read("OFF\n3 1 0\n").at(0),
             Catch::StartsWith("FILE:1: \"OFF\"" + start) && Catch::EndsWith("`sesame import` makes a script of it)"));
  CHECK_THAT(read(std::string(100, 'x')).at(0),
             Catch::StartsWith("FILE:1: \"" + std::string(40, 'x') + "...\"" + start));
  CHECK_THAT(read("\n0.5,\n0.25,0.125,\n").at(0), Catch::StartsWith("FILE:2: this looks like the lower half of"));
  CHECK(read("# a comment\n(a b" + std::string(9, '\0')).at(0) ==
        "FILE:2: byte 4 of this line is zero, and no text has such bytes");
}

TEST_CASE("Facets are inclusions, one at a time, wherever their brackets break", "[tower_reader]") {
  const Lines facets{"1: 0 i 2 [1 2 3]", "1: 1 i 1 [4 2]"};
  CHECK(read("1 2 3\n4 2\n") == Lines{facets[0], "2: 1 i 1 [4 2]"});
  CHECK(read("M=[[1,2,3],[4,2]];") == facets);
  CHECK(read("[[1,2,\n3],[4,\n2]]\n") == Lines{"2: 0 i 2 [1 2 3]", "3: 1 i 1 [4 2]"});
  CHECK(read("[[1,2,3],[4,2]\n") ==
        Lines{facets[0], facets[1], "FILE:1: the list ends here, but '[' has not been closed"});
  CHECK(read("[[1,2,3],\n[4,a]]\n").size() == 2);
  CHECK_THAT(read("[[1,2,3],\n[4,a]]\n").back(), Catch::StartsWith("FILE:2: \"a\" should be a vertex of a tower"));
  CHECK(read("0 1 2\n0 2 3\n", TowerFormat::facets) == Lines{"1: 0 i 2 [0 1 2]", "2: 1 i 2 [0 2 3]"});
}

TEST_CASE("Comments, empty lines, CR LF, tabs and a last line without end change nothing but line numbers",
          "[tower_reader]") {
  CHECK(
      read("\xEF\xBB\xBF# tower\r\n\r\n i\t0 \r\ni 1 # a vertex\n#\n\ni 0  1#no comment\n", TowerFormat::tower) ==
      Lines{"3: 0 i 0 [0]", "4: 1 i 0 [1]", "FILE:7: \"1#no\" should be a vertex, a whole number from 0 to 2^64 - 1"});
  CHECK(read("i 0\r\ni 1\r\ni 0 1\r\nc 1 0") == read_tower);
  CHECK(read("0\r\n0\r\n1 0 1") == read_matrix);
  CHECK(read("0 5 0\r\n0\t7 0.5\r\n1 5 7 2") == read_list);
  CHECK(read("# nothing\n\n").empty());
  CHECK(read("").empty());
  CHECK(read("", TowerFormat::phat).empty());
  CHECK(read("", TowerFormat::gudhi).empty());
}

TEST_CASE("A tower may have times, which may be equal, negative and fractional", "[tower_reader]") {
  CHECK(read("-1.5 i 3\n-1.5 i 18446744073709551615\n0 i 3 18446744073709551615\n1e2 c 3 18446744073709551615\n") ==
        Lines{"1: -1.5 i 0 [3]", "2: -1.5 i 0 [18446744073709551615]", "3: 0 i 1 [3 18446744073709551615]",
              "4: 100 c 0 [3 18446744073709551615]"});
}

TEST_CASE("Times that are whole numbers of 64 bits are exact", "[tower_reader][time]") {
  CHECK(read("1732800000000000001 i 0\n1732800000000000002 i 1\n18446744073709551615 i 0 1\n") ==
        Lines{"1: 1732800000000000001 i 0 [0]", "2: 1732800000000000002 i 0 [1]", "3: 18446744073709551615 i 1 [0 1]"});
  CHECK(read("9007199254740993 i 0\n9007199254740992 i 1\n").back() ==
        "FILE:2: 9007199254740992 comes after 9007199254740993: times should not decrease");
  CHECK(read("0 0 -9007199254740993\n0 1 -9007199254740992\n") ==
        Lines{"1: -9007199254740993 i 0 [0]", "2: -9007199254740992 i 0 [1]"});
  CHECK(read("0 0 9007199254740993\n0 1 9007199254740992\n").back() ==
        "FILE:2: 9007199254740992 comes after 9007199254740993: times should not decrease");
  CHECK(
      read("9007199254740992 i 0\n18446744073709551616 i 1\n").back().starts_with("FILE:2: \"18446744073709551616\""));
}

TEST_CASE("Times that cannot be told apart are refused with both lines", "[tower_reader][time]") {
  CHECK(read("0.5 i 0\n\n9007199254740993 i 1\n").back().starts_with("FILE:3: 9007199254740993, but FILE:1 has 0.5: "));
  CHECK(read("0 0 0\n0 1 9007199254740993\n0 2 9007199254740993.5\n")
            .back()
            .starts_with("FILE:3: 9007199254740993.5, but FILE:2 has 9007199254740993: "));
}

TEST_CASE("Malformed lines of a tower are reported with their line and what would be right", "[tower_reader]") {
  const std::string vertex = " should be a vertex, a whole number from 0 to 2^64 - 1";
  const std::string operation = "i (a simplex is included) or c (a vertex is contracted)";
  const std::string start = " should be " + operation + ", perhaps after a time, a finite number";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"i", "i should be followed by vertices"},
      {"c # 1 2", "c should be followed by vertices"},
      {"c 1", "c should be followed by 2 vertices, not 1"},
      {"c 1 2 3", "c should be followed by 2 vertices, not 3"},
      {"i -1", "\"-1\"" + vertex},
      {"i 1.5", "\"1.5\"" + vertex},
      {"i 0 x", "\"x\"" + vertex},
      {"i 18446744073709551616", "\"18446744073709551616\"" + vertex},
      {"insert 1", "\"insert\"" + start},
      {"nan i 1", "\"nan\"" + start},
      {"1e999 i 1", "\"1e999\"" + start},
      {"1,5 i 1", "\"1,5\"" + start},
      {std::string("i\0 1", 4), "byte 1 of this line is zero, and no text has such bytes"},
      {"i\x01 1", "\"i?\"" + start},
      {"1 i 1", "an operation with a time, but the one of line 1 has none: all should have one, or none"},
      {"1 x 1", "an operation with a time, but the one of line 1 has none: all should have one, or none"}};
  for (const auto& [line, what] : cases) {
    CAPTURE(line);
    const Lines expected{"1: 0 i 0 [0]", "FILE:3: " + what};
    CHECK(read("i 0\n\n" + line + "\ni 5\n", TowerFormat::tower) == expected);
    CHECK(read("i 0\n\n" + line, TowerFormat::tower) == expected);
  }
  const std::vector<std::pair<std::string, std::string>> timed{
      {"4.5 i 1", "4.5 comes after 5: times should not decrease"},
      {"inf i 1", "\"inf\"" + start},
      {"6", "after the time, \"\" should be " + operation},
      {"6 7", "after the time, \"7\" should be " + operation},
      {"i 1", "an operation without a time, but the one of line 1 has one: all should have one, or none"}};
  for (const auto& [line, what] : timed) {
    CAPTURE(line);
    CHECK(read("5 i 0\n" + line + "\n", TowerFormat::tower) == Lines{"1: 5 i 0 [0]", "FILE:2: " + what});
  }
}

TEST_CASE("Malformed lines of a GUDHI list are reported", "[tower_reader]") {
  const std::string three = "a simplex of dimension 1 should have 2 vertices and then its value: 3 numbers, not ";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"1 0", three + "1"},
      {"1 0 5", three + "2"},
      {"1 0 5 1 9", three + "4"},
      {"x 0 1", "\"x\" should be a dimension, a whole number from 0 on"},
      {"-1 0 1", "\"-1\" should be a dimension, a whole number from 0 on"},
      {"4294967295 0", "\"0\" should be a dimension, a whole number from 0 on"},
      {"0 -3 1", "\"-3\" should be a vertex, a whole number from 0 to 2^64 - 1"},
      {"0 3 inf", "\"inf\" should be the value of the simplex, a finite number"},
      {"0 3 1x", "\"1x\" should be the value of the simplex, a finite number"},
      {"0 3 0.5", "0.5 comes after 1: times should not decrease"}};
  for (const auto& [line, what] : cases) {
    CAPTURE(line);
    CHECK(read("0 0 1\n" + line + "\n", TowerFormat::gudhi) == Lines{"1: 1 i 0 [0]", "FILE:2: " + what});
  }
}

TEST_CASE("Malformed lines of a PHAT matrix are reported", "[tower_reader]") {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"1 0 2", "row 2 of column 2 should be the index of a column before it"},
      {"1 5 0", "row 5 of column 2 should be the index of a column before it"},
      {"1 0 0", "row 0 should not be listed twice"},
      {"1 1 0 1", "row 1 should not be listed twice"},
      {"1 0 -1", "\"-1\" should be a row, a whole number from 0 to 2^64 - 1"},
      {"1.0 0 1", "\"1.0\" should be a dimension, a whole number from 0 on"}};
  for (const auto& [line, what] : cases) {
    CAPTURE(line);
    CHECK(read("0\n0\n" + line + "\n", TowerFormat::phat) ==
          Lines{"1: 0 column 0 []", "2: 1 column 0 []", "FILE:3: " + what});
  }
}

TEST_CASE("Rows come out ascending in whatever order they stand", "[tower_reader]") {
  CHECK(read("0\n0\n0\n5 2 0 1\n", TowerFormat::phat).back() == "4: 3 column 5 [0 1 2]");
  CHECK(read(binary({4, 0, 0, 0, 0, 0, 0, 5, 3, 2, 0, 1})).back() == "3: 3 column 5 [0 1 2]");
}

TEST_CASE("Malformed binary matrices are reported with the column", "[tower_reader]") {
  const std::vector<std::pair<std::vector<std::int64_t>, std::string>> cases{
      {{-1}, "FILE: the header of the binary PHAT matrix should be the number of its columns, not -1"},
      {{2, 0, 0, 0, 0, 7}, "FILE: the header says 2 columns, but the file goes on after them"},
      {{2, 0, 0}, "FILE: column 1: the file ends here, but its header says 2 columns"},
      {{1, 0, 1, 0}, "FILE: column 0: 1 should be the number of its rows, at most the 0 columns before it"},
      {{2, 0, 0, 1, -1}, "FILE: column 1: -1 should be the number of its rows, at most the 1 columns before it"},
      {{2, 0, 0, 1, std::int64_t{1} << 60},
       "FILE: column 1: 1152921504606846976 should be the number of its rows, at most the 1 columns before it"},
      {{2, 0, 0, -1, 0}, "FILE: column 1: -1 should be a dimension, from 0 on"},
      {{2, 0, 0, std::int64_t{1} << 31, 0}, "FILE: column 1: 2147483648 should be a dimension, from 0 on"},
      {{2, 0, 0, 1, 1, 1}, "FILE: column 1: row 1 of column 1 should be the index of a column before it"},
      {{2, 0, 0, 1, 1, -1},
       "FILE: column 1: row 18446744073709551615 of column 1 should be the index of a column before it"},
      {{3, 0, 0, 0, 0, 1, 2, 1, 1}, "FILE: column 2: row 1 should not be listed twice"},
      {{std::int64_t{1} << 55, 0, 0},
       "FILE: column 1: the file ends here, but its header says 36028797018963968 columns"}};
  for (const auto& [numbers, what] : cases) {
    CAPTURE(numbers);
    CHECK(read(binary(numbers), TowerFormat::phat_binary).back() == what);
  }
}

TEST_CASE("A binary matrix that is cut off anywhere is reported", "[tower_reader]") {
  for (std::size_t size = 0; size < a_binary.size(); ++size) {
    CAPTURE(size);
    const Lines seen = read(a_binary.substr(0, size), TowerFormat::phat_binary);
    REQUIRE(!seen.empty());
    CHECK(seen.back().starts_with("FILE: "));
    CHECK(std::equal(seen.begin(), seen.end() - 1, read_binary.begin()));
  }
}

TEST_CASE("After an error the reader is at its end", "[tower_reader]") {
  const TemporaryFile file("i 0\nx\ni 1\n");
  const auto reader = TowerReader::open(file.path());
  REQUIRE(reader);
  CHECK(read_all(**reader, file.path()).size() == 2);
  CHECK(read_all(**reader, file.path()).empty());
  CHECK((*reader)->operations() == 1);
  CHECK((*reader)->place() == file.path() + ":2: ");
}

TEST_CASE("Any input arrives through a pipe in pieces of any size as from a file", "[tower_reader]") {
  for (const std::string& content : {a_tower, a_matrix, a_list, a_binary}) {
    const Lines expected = read(content);
    for (const std::string& sent : {content, gzipped(content)}) {
      for (const std::size_t piece : {1U, 3U, 1000U}) {
        CAPTURE(content, piece);
        const Pipe pipe(sent, piece);
        CHECK(read_path(pipe.path()) == expected);
      }
    }
  }
}

TEST_CASE("Lines and columns longer than any buffer are read", "[tower_reader]") {
  constexpr std::int64_t many = 200'000;
  std::string line = "i";
  std::vector<std::int64_t> numbers{many + 1};
  for (std::int64_t i = 0; i < many; ++i) {
    line += " " + std::to_string(i);
    numbers.insert(numbers.end(), {0, 0});
  }
  numbers.insert(numbers.end(), {1, many});
  for (std::int64_t i = 0; i < many; ++i) {
    numbers.push_back(i);
  }
  const auto last_labels = [](const std::string& path) {
    const auto reader = TowerReader::open(path);
    TowerOperation operation;
    std::vector<std::uint64_t> labels;
    while ((*reader)->next(operation).value()) {
      labels.assign(operation.labels.begin(), operation.labels.end());
    }
    return labels;
  };
  std::vector<std::uint64_t> expected;
  for (std::uint64_t i = 0; i < many; ++i) {
    expected.push_back(i);
  }
  for (const std::string& content : {"i 0\n" + line + "\n", "i 0\n" + line, binary(numbers)}) {
    const TemporaryFile file(content);
    CHECK((last_labels(file.path()) == expected));
    const Pipe pipe(gzipped(content), 5000);
    CHECK((last_labels(pipe.path()) == expected));
  }
}

TEST_CASE("A long tower is read without a slip", "[tower_reader]") {
  std::string text;
  for (std::uint64_t i = 0; i < 200'000; ++i) {
    text += fmt::format("i {} {}\n", i, i * 7919 % 1'000'003);
  }
  const TemporaryFile file(text);
  const auto reader = TowerReader::open(file.path());
  TowerOperation operation;
  std::uint64_t i = 0;
  for (bool is_right = true; is_right && (*reader)->next(operation).value(); ++i) {
    is_right = operation.labels.size() == 2 && operation.labels[0] == i && operation.labels[1] == i * 7919 % 1'000'003;
    REQUIRE(is_right);
  }
  CHECK(i == 200'000);
}

TEST_CASE("gzip members one after another are one input", "[tower_reader]") {
  CHECK(read(gzipped("i 0\ni") + gzipped(" 1\ni 0 1") + gzipped("") + gzipped("\nc 1 0\n")) == read_tower);
}

TEST_CASE("gzip data that are cut off or damaged anywhere are reported, and nothing is made up", "[tower_reader]") {
  const std::string packed = gzipped(a_tower);
  for (std::size_t size = 3; size < packed.size(); ++size) {
    CAPTURE(size);
    CHECK(read(packed.substr(0, size), TowerFormat::tower).back() ==
          "FILE: the gzip data end in the middle: the file is cut off");
  }
  for (std::size_t at = 2; at < packed.size(); ++at) {
    std::string damaged = packed;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    const Lines seen = read(damaged, TowerFormat::tower);
    CAPTURE(at, seen);
    // Of the header, bytes 4 to 9 (date, system) mean nothing to the content.
    CHECK(((at >= 4 && at <= 9) || seen.back().starts_with("FILE:")));
    CHECK((!(at >= 4 && at <= 9) || seen == read_tower));
  }
  CHECK(read(packed + "trailing", TowerFormat::tower).back() == "FILE: the gzip data are damaged");
}

TEST_CASE("What is read before a damage in gzip data does not depend on the pieces in which they come",
          "[tower_reader]") {
  std::string lines;
  for (int vertex = 0; vertex < 300; ++vertex) {
    lines += "i " + std::to_string(vertex * vertex) + "\n";
  }
  const auto read_in_pieces = [](const std::string& data, std::size_t size) {
    std::vector<std::string> pieces;
    for (std::size_t at = 0; at < data.size(); at += size) {
      pieces.push_back(data.substr(at, size));
    }
    auto reader = TowerReader::from(tests::source_of(std::move(pieces), tests::End::whole, "FILE"));
    return reader ? read_all(**reader, "FILE") : Lines{reader.error().what};
  };
  const std::string packed = gzipped(lines);
  for (std::size_t at = 20; at < packed.size(); at += 7) {
    std::string data = packed;
    data[at] = static_cast<char>(data[at] ^ 0x55);
    CAPTURE(at);
    const Lines whole = read_in_pieces(data, data.size());
    CHECK(read_in_pieces(data, 1) == whole);
    CHECK(read_in_pieces(data, 50) == whole);
  }
}

TEST_CASE("A zero byte anywhere is told in the same words in whatever pieces a tower comes", "[tower_reader]") {
  const std::string text = "# a comment\n\ni 0\n# another\ni 1\n";
  for (std::size_t at = 8; at < text.size(); ++at) {
    std::string data = text;
    data[at] = '\0';
    std::vector<std::string> pieces;
    for (std::size_t k = 0; k < data.size(); k += 3) {
      pieces.push_back(data.substr(k, 3));
    }
    auto reader = TowerReader::from(tests::source_of(std::move(pieces), tests::End::whole, "FILE"));
    CAPTURE(at);
    CHECK((reader ? read_all(**reader, "FILE") : Lines{reader.error().what}) == read(data));
    CHECK_THAT(read(data).back(), Catch::EndsWith(" of this line is zero, and no text has such bytes"));
  }
}

TEST_CASE("A binary matrix is none of gzip, however many columns it has", "[tower_reader]") {
  // The first bytes of these numbers are those of gzip data: 1F 8B, and then 08 too.
  for (const std::int64_t columns : {0x8B1F, 0x088B1F, 0x10088B1F}) {
    std::vector<std::int64_t> numbers{columns, 3};
    numbers.resize(2001);
    CAPTURE(columns);
    for (const TowerFormat format : {TowerFormat::automatic, TowerFormat::phat_binary}) {
      CHECK(read(binary(numbers), format).at(999) == "999: 999 column 0 []");
    }
  }
  std::vector<std::int64_t> vertices(1 + 2 * 0x8B1F);
  vertices[0] = 0x8B1F;
  const Lines seen = read(binary(vertices));
  CHECK(seen.size() == 0x8B1F);
  CHECK(seen.back() == "35614: 35614 column 0 []");
}

TEST_CASE("A script that is cut off as gzip data ends with an error", "[tower_reader]") {
  const std::string packed = gzipped(a_script);
  for (std::size_t size = 12; size < packed.size(); ++size) {
    const TemporaryFile file(packed.substr(0, size));
    const auto reader = TowerReader::open(file.path(), TowerFormat::script);
    REQUIRE(reader);
    replay::ScriptReader script = (*reader)->take_script();
    CAPTURE(size);
    std::optional<Error> error;
    if (const auto header = script.header(); !header) {
      error = header.error();
    }
    while (!error) {
      const auto operation = script.next();
      REQUIRE((!operation || *operation));
      if (!operation) {
        error = operation.error();
      }
    }
    CHECK_THAT(error->what, Catch::Matchers::Contains("the file is cut off"));
  }
}

TEST_CASE("A script is handed on whole, from a file, a pipe and gzip", "[tower_reader]") {
  const auto steps_in = [](const std::string& path) {
    const auto reader = TowerReader::open(path);
    REQUIRE(reader);
    REQUIRE((*reader)->format() == TowerFormat::script);
    replay::ScriptReader script = (*reader)->take_script();
    TowerOperation operation;
    CHECK(!(*reader)->next(operation).value());
    REQUIRE(script.header());
    std::size_t steps = 0;
    while (script.next().value()) {
      ++steps;
    }
    return steps;
  };
  std::string long_script = a_script;
  for (int k = 0; k < 20'000; ++k)
    long_script += R"({"op":"note","text":"as long as some others"})"
                   "\n";
  const TemporaryFile file(long_script), packed_file(gzipped(long_script));
  const Pipe pipe(long_script, 5000);
  const std::size_t short_steps = steps_in(TemporaryFile(a_script).path());
  CHECK(short_steps > 0);
  for (const std::string& path : {file.path(), packed_file.path(), pipe.path()}) {
    CHECK(steps_in(path) == short_steps + 20'000);
  }
}

TEST_CASE("What cannot be read is told so", "[tower_reader]") {
  const auto missing = TowerReader::open("/nowhere/tower");
  REQUIRE(!missing);
  CHECK(missing.error().code == Errc::io);
  CHECK(missing.error().what == "cannot read /nowhere/tower: No such file or directory");
  const auto directory = TowerReader::open("/tmp");
  REQUIRE(!directory);
  CHECK(directory.error().code == Errc::io);
  CHECK(directory.error().what == "cannot read /tmp: Is a directory");
}

TEST_CASE("A stop ends the input, without an error and without half a line", "[tower_reader]") {
  for (const std::string& content : {std::string{"i 0\ni 1\ni 0 1"}, binary({3, 0, 0, 0, 0, 1, 2, 0})}) {
    const TemporaryFile file(content);
    std::atomic<bool> stop{false};
    const auto reader = TowerReader::open(file.path(), TowerFormat::automatic, &stop);
    REQUIRE(reader);
    TowerOperation operation;
    CHECK((*reader)->next(operation).value());
    stop = true;
    CHECK((*reader)->next(operation).value());
    CHECK(!(*reader)->next(operation).value());
  }
}
