// Lists of facets in the ways in which they are written down.
#include "replay/script/facet_list.hpp"

#include "replay/tower/tower_format.hpp"
#include "tests/replay/replay_support.hpp"

using namespace sesame;
using namespace sesame::tests;
using Catch::Contains;
using replay::Facet;
using replay::FacetParser;
using replay::FormatFinder;
using replay::TowerFormat;

namespace {

using Facets = std::vector<std::vector<std::string>>;

/// The facets of a text that messages call "list", or what is wrong with it.
Result<std::vector<Facet>> parsed(const std::string& text) {
  FacetParser parser("list");
  std::vector<Facet> facets;
  std::uint64_t number = 0;
  for (const std::string& line : lines_of(text)) {
    if (Status taken = parser.take(line, ++number); !taken) {
      return taken.error();
    }
    while (std::optional<Facet> facet = parser.next()) {
      facets.push_back(*std::move(facet));
    }
  }
  const Status finished = parser.finish();
  return finished ? Result{std::move(facets)} : finished.error();
}

Facets facets(const std::string& text) {
  const auto result = parsed(text);
  if (!result) {
    FAIL(result.error().what);
  }
  Facets labels;
  for (const Facet& facet : *result) {
    labels.push_back(facet.labels);
  }
  return labels;
}

std::string complaint(const std::string& text) {
  const auto result = parsed(text);
  if (result) {
    FAIL("accepted: " << text);
  }
  CHECK(result.error().code == Errc::bad_input);
  return result.error().what;
}

/// The name of the format that a text has, or the error.
std::string format_of(const std::string& text) {
  FormatFinder finder("file");
  std::uint64_t number = 0;
  for (const std::string& line : lines_of(text)) {
    const Result<TowerFormat> found = finder.take(line, ++number);
    if (!found) {
      return found.error().what;
    }
    if (*found != TowerFormat::automatic) {
      return std::string{format_name(*found)};
    }
  }
  const Result<TowerFormat> found = finder.finish();
  return found ? std::string{format_name(*found)} : found.error().what;
}

const Facets square{{"1", "2", "3"}, {"1", "2", "4"}};

}  // namespace

TEST_CASE("a facet a line or in brackets of any kind is one list, with blanks or commas", "[replay]") {
  for (const std::string text :
       {"1 2 3\n1 2 4\n", "1,2,3\n1,2,4", "# two triangles\n\n  1, 2,3 # one\n1\t2  4,\r\n", "[1,2,3]\n[1,2,4]\n",
        "{1 2 3}\n{1 2 4}\n", "(1, 2, 3), (1, 2, 4)\n", "[[1,2,3],[1,2,4]]\n", "[ [ 1, 2, 3 ],\n  [ 1, 2, 4 ] ]\n",
        "{(1, 2, 3), (1, 2, 4)}\n", "[[1,2,\n3],[1,\n2,4]]", "manifold_lex_d2_n4_o1_g0_#1=[[1,2,3],[1,2,4]]\n",
        "manifold_2_4_1 =\n[[1,2,3],\n [1,2,4]]\n", "M := SCFromFacets([[1,2,3],[1,2,4]]);\n",
        "SimplicialComplex([(1,2,3),(1,2,4)])\n", "facets = [[\"1\",'2',3],[1,2,004]];  # Python\n"}) {
    CAPTURE(text);
    CHECK(facets(text) == square);
    CHECK(format_of(text) == "facets");
  }
}

TEST_CASE("labels are whole numbers of any size, and names", "[replay]") {
  CHECK(facets("[[a,b_1,'x.y'],[99999999999999999999999,00]]") ==
        Facets{{"a", "b_1", "x.y"}, {"99999999999999999999999", "0"}});
  CHECK(facets("u v\nv w\n") == Facets{{"u", "v"}, {"v", "w"}});
  for (const std::string word : {"1.5", "-1", "+2", "3e5", "..", "'a b'", "''", "*"}) {
    CAPTURE(word);
    CHECK_THAT(complaint("[[1,2]]\n"
                         "[[" +
                         word + "]]"),
               Contains("list:2: "));
    CHECK_THAT(complaint("[[1,2],\n[" + word + "]]"), Contains("list:2: ") && Contains("should be a vertex"));
    CHECK_THAT(complaint("1 2\n" + word), Contains("list:2: ") && Contains("should be a vertex"));
  }
}

TEST_CASE("facets know the line where they end", "[replay]") {
  const auto result = parsed("[[1,2,\n3],[4],[5,\n\n6]]\n");
  REQUIRE(result);
  std::vector<std::uint64_t> lines;
  for (const Facet& facet : *result) {
    lines.push_back(facet.line);
  }
  CHECK(lines == std::vector<std::uint64_t>{2, 2, 4});
}

TEST_CASE("what is no list of facets of one complex is refused with its line", "[replay]") {
  const std::vector<std::pair<std::string, std::string>> texts{
      {"[[1,2,3],\n[1,2,1]]", "list:2: the vertex 1 stands twice in a facet"},
      {"1 2 3\n4 4\n", "list:2: the vertex 4 stands twice"},
      {"[[1,2],[3,4]]\n[[5,6]]", "list:2: a second list begins"},
      {"M1=[[1,2],[3,4]]\nM2=[[5,6]]", "list:2: \"M2=\" stands outside of the brackets"},
      {"[[1,2]];\n[3]", "list:2: a second list begins"},
      {"[[1,2],[3,4]\n", "list:1: the list ends here, but '[' has not been closed"},
      {"[[1,2]),[3,4]]\n", "list:1: ')' cannot close '['"},
      {"[1,2]]\n", "list:1: ']' closes what is not open"},
      {"[[1,2],[[3,4]]]\n", "list:1: facets stand at different depths"},
      {"[[1,2],3]\n", "list:1: \"3]\" stands between facets"},
      {"[[1,[2,3]]]\n", "list:1: brackets open behind vertices"},
      {"[[1,2],[]]\n", "list:1: a facet should have at least one vertex"},
      {"", "list:1: this list has no facets"},
      {"# none\n\n", "list:2: this list has no facets"},
      {", ,\n", "list:1: this list has no facets"},
      {"[]\n", "list:1: this list has no facets"},
      {"\nM = [ ];\n", "list:2: this list has no facets"},
      {"{}\n", "list:1: this list has no facets"},
      {"[[]]\n", "list:1: a facet should have at least one vertex"},
      {"[]\n[[1,2]]\n", "list:2: a second list begins"},
      {"[[1;2]]\n", "list:1: \";\" should be a vertex"},
      {"1 2\n[3,4]\n", "list:2: brackets in a list that has not begun with one"},
      {"[[1,2]] and [[3,4]]\n", "list:1: \"and\" stands outside of the brackets"}};
  for (const auto& [text, what] : texts) {
    CAPTURE(text);
    CHECK_THAT(complaint(text), Contains(what));
  }
}

TEST_CASE("lines of numbers are what they can be", "[replay]") {
  const std::vector<std::pair<std::string, std::string>> texts{
      {"", "tower"},
      {"# nothing\n\n", "tower"},
      {"i 0\n", "tower"},
      {"1.5 c 0 1\n", "tower"},
      {"{\"sesame\":1}\n", "script"},
      {"{}\n", "script"},
      {"0\n0\n1 0 1\n", "phat"},
      {"0\n", "phat"},
      {"0 0 0\n", "gudhi"},
      {"0 0 0\n0 1 0\n", "gudhi"},
      {"0 1 1\n0 0 1\n", "gudhi"},
      {"0 7 0.5\n", "gudhi"},
      {"0 1 2\n0 3 2\n1 1 3 2\n", "gudhi"},
      {"0 1 -2\n", "gudhi"},
      {"0 1 2\n0 2 3\n0 3 4\n0 4 1\n", "facets"},  // values decrease
      {"0 1 2\n0 1 3\n", "facets"},                // a vertex twice
      {"0 1 2\n1 2 3 4\n", "facets"},              // an edge before its vertices
      {"0 1 2\n1 2 3\n", "facets"},
      {"0 1\n1 2\n0 2\n", "facets"},
      {"7\n1 2 3\n", "facets"},
      {"1 2 3\n", "facets"},
      {"3 2 1\n1 5\n", "facets"},
      {"0 1 2,\n", "facets"},
  };
  for (const auto& [text, format] : texts) {
    CAPTURE(text);
    CHECK(format_of(text) == format);
  }
  CHECK_THAT(format_of("\n0 1 2\n0 2 3\n0 3 4\n"),
             Contains("file:2: ") && Contains("--format gudhi or --format facets"));
  CHECK_THAT(format_of("1 2 3\n4 5 x\n"), Contains("file:2: ") && Contains("line 1"));
  CHECK_THAT(format_of("hello 1 2\n"), Contains("file:1: \"hello\" starts no format that is known"));
  CHECK_THAT(format_of(",\n"), Contains("file:1: \",\" starts no format"));
}

TEST_CASE("distances and points are no filtrations, and where one comes from is told", "[replay]") {
  const std::vector<std::pair<std::string, std::string>> texts{
      {"0.5,\n0.3,0.4,\n", "lower half of a distance matrix"},
      {"1\n2 3\n4 5 6\n", "lower half of a distance matrix"},
      {"# ripser\n\n0.5 0.25\n0.125\n", "upper half of a distance matrix"},
      {"0 1.5\n1.5 0\n", "a distance matrix"},
      {"0,1,2\n1,0,3\n2,3,0\n", "a distance matrix"},
      {"0 1 1\n1 0 1\n1 1 0\n", "a distance matrix"},
      {"0.1 0.2 0.3\n0.3 0.2 0.3\n", "a list of points"},
      {"-1 2\n3 4\n", "a list of points"},
      {"1;2\n", "starts no format"},
      {"0.25,0.5\n", "a list of points"}};
  for (const auto& [text, what] : texts) {
    CAPTURE(text);
    CHECK_THAT(format_of(text), Contains(what));
    if (what.find("format") == std::string::npos) {
      CHECK_THAT(format_of(text), Contains("GUDHI's RipsComplex(") && Contains("ripser --format "));
    }
  }
  CHECK_THAT(format_of("# ripser\n\n0.5,\n0.3,0.4,\n"), Contains("file:3: "));
  CHECK_THAT(format_of("0 1 2\n1 0 3\n2 3 0\n"), Contains("if these are facets, say --format facets"));
}
