// Names as texts: brackets, endings, hashes of parts.
#include "ops/cells/name_text.hpp"

#include <map>

#include "ops/name_table.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame::ops;
using namespace sesame::tests;

namespace {

/// A text of characters that mean something in names.
std::string random_text(Random& random, int most) {
  const std::string characters = "(){}|*^.,-x0123ab";
  std::string text;
  for (int length = random.in(1, most); length > 0; --length) {
    text += characters[static_cast<std::size_t>(random.in(0, static_cast<int>(characters.size()) - 1))];
  }
  return text;
}

/// What a text is without its lists of labels, which are replaced by letters; nothing when one does not end.
std::optional<std::string> without_labels(std::string text) {
  for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{')) {
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) {
      return std::nullopt;
    }
    text.replace(open, close + 1 - open, close + 1 - open, 'a');
  }
  return text;
}

}  // namespace

TEST_CASE("brackets are matched, and lists of labels are as one letter", "[ops]") {
  Random random(1);
  for (int k = 0; k < 3000; ++k) {
    const std::string text = random_text(random, 14);
    CAPTURE(text);
    const auto plain = without_labels(text);
    const Brackets brackets(text);
    if (!plain) {
      CHECK_FALSE(is_well_bracketed(text));
      continue;
    }
    std::map<int, std::vector<std::size_t>> bars;
    bool is_good = true;
    for (std::size_t open = 0; open < plain->size(); ++open) {
      const auto* pair = brackets.at(open);
      REQUIRE((pair != nullptr) == ((*plain)[open] == '('));
      if (pair == nullptr) {
        continue;
      }
      std::size_t close = open;
      std::vector<std::size_t> inside;
      for (int depth = 0; close < plain->size(); ++close) {
        depth += (*plain)[close] == '(' ? 1 : (*plain)[close] == ')' ? -1 : 0;
        if (depth == 0) {
          break;
        }
        if (depth == 1 && (*plain)[close] == '|') {
          inside.push_back(close);
        }
      }
      CHECK(pair->close == (close == plain->size() ? Brackets::nowhere : close));
      CHECK(pair->bar == (inside.size() == 1 ? inside[0] : Brackets::nowhere));
    }
    int depth = 0;
    for (const char c : *plain) {
      depth += c == '(' ? 1 : c == ')' ? -1 : 0;
      is_good = is_good && depth >= 0 && (c != '|' || depth > 0);
    }
    CHECK(is_well_bracketed(text) == (is_good && depth == 0));
  }
}

TEST_CASE("what stands in matched brackets can be put together without a doubt", "[ops]") {
  for (const std::string good : {"", "a", "P.(a|b)", "{a(,b|c}", "v*P.(Q.(a|b)|c)^0,1", "a)b(", "}", "x{|}y"}) {
    CHECK(is_well_bracketed(good) == (good != "a)b("));
  }
  for (const std::string bad : {"a|b", "a(", "a)", "{", "a{b", "P.(a|b", "(a)|b"}) {
    CHECK_FALSE(is_well_bracketed(bad));
  }
}

TEST_CASE("collapsed directions at the end of a name are read", "[ops]") {
  const auto read = [](std::string_view text) {
    const auto split = split_directions(text);
    return split ? std::pair{std::string{text.substr(0, split->length)}, split->collapsed}
                 : std::pair{std::string{"none"}, Degeneracy{0}};
  };
  CHECK(read("a^0,2") == std::pair{std::string{"a"}, Degeneracy{5}});
  CHECK(read("a^b^62") == std::pair{std::string{"a^b"}, Degeneracy{1} << 62});
  CHECK(read("^1") == std::pair{std::string{}, Degeneracy{2}});
  for (const std::string text :
       {"", "a", "a^", "a^b", "a^0,", "a^,0", "a^0,,1", "a^63", "a^99999999999999999999", "0,1", "a^0)"}) {
    CAPTURE(text);
    CHECK(read(text).first == "none");
  }
}

TEST_CASE("vertices at the end of a name are read, sorted, with their order", "[ops]") {
  const auto split = split_vertices("a.b.2-0x1");
  REQUIRE(split);
  CHECK(split->length == 3);
  CHECK(split->vertices == "2-0x1");
  for (const std::string text : {"", "a", "2-0", ".2-0", "a.b", "a.2-0b", "a.2-0*"}) {
    CAPTURE(text);
    CHECK_FALSE(split_vertices(text));
  }
  const auto read = [](std::string_view text, const CellType& type) {
    const auto list = read_vertices(text, type);
    std::string order;
    for (const std::uint8_t place : list ? list->order : std::vector<std::uint8_t>{}) {
      order += " " + std::to_string(place);
    }
    return !list ? "none" : list->sorted + order + (list->is_whole ? " whole" : "");
  };
  CHECK(read("0", {2}) == "0");
  CHECK(read("0-2", {2}) == "0-2 0 1");
  CHECK(read("2-0", {2}) == "0-2 1 0");
  CHECK(read("1-2-0", {2}) == "0-1-2 1 2 0 whole");
  CHECK(read("2-1-0", {2}) == "0-1-2 2 1 0 whole");
  CHECK(read("0-1-2", {2}) == "0-1-2 0 1 2 whole");
  CHECK(read("1-0x0", {1, 1}) == "0-1x0 1 0");
  CHECK(read("1-0x2-0", {1, 2}) == "0-1x0-2 1 0 3 2");
  CHECK(read("10-9", {12}) == "9-10 1 0");
  for (const std::string text : {"", "3", "0-0", "0-", "-0", "00", "0-01", "0x0", "0x", "x0", "0--1", "99999999999"}) {
    CAPTURE(text);
    CHECK(read(text, {2}) == "none");
  }
  CHECK(read("0", {1, 1}) == "none");
  CHECK(read("0x0x0", {1, 1}) == "none");
  CHECK(read("0", {}) == "none");
}

TEST_CASE("the hash of a part is that of a text of its own", "[ops]") {
  Random random(2);
  for (int k = 0; k < 200; ++k) {
    const std::string text = random_text(random, 40);
    const PartHashes hashes(text);
    for (std::size_t begin = 0; begin <= text.size(); ++begin) {
      TextHash hash;
      for (std::size_t end = begin; end <= text.size(); ++end) {
        REQUIRE(hashes.value(begin, end) == hash.value());
        if (end < text.size()) {
          hash.add(text[end]);
        }
      }
    }
  }
}
