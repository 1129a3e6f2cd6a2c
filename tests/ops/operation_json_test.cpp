#include <limits>

#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Contains;

namespace {

std::string complaint(const std::string& line) {
  const Result<Operation> parsed = parse_operation(line);
  if (parsed) {
    FAIL("accepted: " << line);
  }
  CHECK(parsed.error().code == Errc::bad_input);
  return parsed.error().what;
}

/// The text of what the text of an operation says; the same again when nothing is lost.
std::string there_and_back(const Operation& op) { return to_text(operation(to_text(op))); }

const std::string nested(std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); }

}  // namespace

TEST_CASE("every op has one canonical text, which says the same operation", "[ops]") {
  const std::vector<std::string> lines{
      R"({"op":"simplex","name":"t","dim":2})",
      R"({"op":"simplex","name":"t","dim":1,"at":[[0.0,1.5,-2.0],[1.0,0.1,1e-12]]})",
      R"({"op":"simploid","name":"q","type":[2,1]})",
      R"({"op":"simploid","name":"q","type":[]})",
      R"({"op":"simploid","name":"q","type":[1],"at":[[0.0,0.0,0.0],[1.0,0.0,0.0]]})",
      R"({"op":"complex","name":"K","cells":[]})",
      R"({"op":"complex","name":"K","cells":[{"id":"a","at":[0.0,0.0,1.0]},{"id":"e","faces":["a","a"]},{"id":"q","type":[1,1],"faces":["e","e","e","e"]},{"id":"b","type":[]}]})",
      R"({"op":"cone","apex":"v"})",
      R"({"op":"cone","apex":"v","over":"t"})",
      R"({"op":"cone","apex":"v","over":[]})",
      R"({"op":"cone","apex":"v","over":["t.0","t.1"],"at":[0.0,0.0,9.0]})",
      R"({"op":"suspend","apexes":["n","s"]})",
      R"({"op":"suspend","apexes":["n","s"],"over":"t"})",
      R"({"op":"suspend","apexes":["n","s"],"over":["t.0"],"at":[[0.0,0.0,1.0],[0.0,0.0,-1.0]]})",
      R"({"op":"identify","pairs":[]})",
      R"({"op":"identify","pairs":[["a","b"],["c","c"]]})",
      R"({"op":"identify","pairs":[["a","b"],["c","d",[2,0,1]],["e","f",[[1,0],[0,1]]]]})",
      R"({"op":"product","name":"P","left":"A","right":"A"})",
      R"({"op":"product","name":"P","left":"A","right":"B","kind":"simplicial"})",
      R"({"op":"degenerate","cell":"t","along":0})",
      R"({"op":"degenerate","cell":"q.0-1x0-1","along":[2,1]})",
      R"({"op":"deidentify","split":[]})",
      R"({"op":"deidentify","split":[{"cell":"x","as":"x2","moves":[]},{"cell":"x","as":"x3","moves":[["t",0],["x2",12]]}]})",
      R"({"op":"insert","simplex":["a",3,"03",18446744073709551615,"18446744073709551616","-1"]})",
      R"({"op":"insert","simplex":[]})",
      R"({"op":"insert","simplex":["a",3],"exist_ok":true})",
      R"({"op":"insert","simplices":[]})",
      R"({"op":"insert","simplices":[["a",3],[0],[3,"b"]]})",
      R"({"op":"insert","simplices":[["a"],["b"]],"exist_ok":false})",
      R"({"op":"collapse","from":"u","to":7})",
      R"({"op":"remove","cells":[]})",
      R"({"op":"remove","cells":["t","{a,3}"],"cofaces":true})",
      R"({"op":"replace","flip":"{a,3}"})",
      R"({"op":"replace","flip":"t.0-1","by":"e","at":[1.0,0.0,0.0],"fills":true})",
      R"({"op":"replace","subdivide":"{a,3}","by":7,"at":[0.5,0.5,0.0]})",
      R"({"op":"replace","contract":["u",7]})",
      R"({"op":"replace","contract":[7,"u"],"link_condition":false})",
      R"({"op":"expect"})",
      R"({"op":"expect","betti":[1,2,1],"torsion":[[],[2,4]],"euler":-3,"cells":[1,2,1]})",
      R"({"op":"class","chain":[]})",
      R"({"op":"class","chain":[[1,"a"],[-9223372036854775808,"b"],["9223372036854775808","c"]]})",
      R"({"op":"undo","steps":3})",
      R"({"op":"note","text":"é, ∂ and \"quotes\"\n\\"})",
      R"({"op":"note","text":""})"};
  for (const std::string& line : lines) {
    CAPTURE(line);
    CHECK(to_text(operation(line)) == line);
    CHECK(line.find("\"" + std::string{keyword(operation(line))} + "\"") != std::string::npos);
  }
}

TEST_CASE("fields come in any order, with spaces, and with defaults", "[ops]") {
  CHECK(to_text(operation(" \t{ \"dim\" : 2 , \"op\":\"simplex\",\"name\" : \"t\" } \r")) ==
        R"({"op":"simplex","name":"t","dim":2})");
  CHECK(std::get<Undo>(operation(R"({"op":"undo"})")).steps == 1);
  CHECK(to_text(operation(R"({"op":"cone","apex":"v","at":[1,2]})")) ==
        R"({"op":"cone","apex":"v","at":[1.0,2.0,0.0]})");
  CHECK(to_text(operation(R"({"op":"class","chain":[["007","a"],["-5","b"]]})")) ==
        R"({"op":"class","chain":[[7,"a"],[-5,"b"]]})");
  CHECK(to_text(operation(R"({"kind":"simploidal","right":"B","left":"A","name":"P","op":"product"})")) ==
        R"({"op":"product","name":"P","left":"A","right":"B"})");
  CHECK(to_text(operation(R"({"op":"insert","simplices":[["3","a"]]})")) ==
        R"({"op":"insert","simplex":[3,"a"],"exist_ok":true})");
  CHECK(to_text(operation(R"({"exist_ok":false,"op":"insert","simplex":[1]})")) == R"({"op":"insert","simplex":[1]})");
  CHECK_FALSE(std::get<Degenerate>(operation(R"({"op":"degenerate","along":2,"cell":"t"})")).component);
  CHECK(std::get<Degenerate>(operation(R"({"op":"degenerate","along":[3,"1"],"cell":"t"})")).component == 3);
}

TEST_CASE("what random operations say survives their text form", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 6U));
  CAPTURE(seed);
  Workshop shop;
  RandomSteps steps(seed, seed % 2 == 0 ? StreamShape{} : everything_and_maps(40));
  for (int k = 0; k < 40; ++k) {
    const Operation op = steps.next(shop.structure());
    CHECK(there_and_back(op) == to_text(op));
    CHECK(operation(to_text(op)).index() == op.index());
    // The operation read back does the same.
    REQUIRE(shop.plan(operation(to_text(op))));
    const std::string names = shop.last_plan().names;
    const std::vector<CellId> faces = shop.last_plan().faces;
    const std::size_t merges = shop.last_plan().merges.size();
    REQUIRE(shop.apply(op));
    CHECK(shop.last_plan().names == names);
    CHECK(shop.last_plan().faces == faces);
    CHECK(shop.last_plan().merges.size() == merges);
  }
}

TEST_CASE("coordinates survive to the last bit", "[ops]") {
  const Point p{0.1, std::numeric_limits<double>::denorm_min(), -1.7976931348623157e308};
  const Operation op = MakeSimplex{"t", 0, {p}};
  CHECK(std::get<MakeSimplex>(operation(to_text(op))).at == std::vector<Point>{p});
}

TEST_CASE("integers of any size are read from strings of digits, and from numbers of 64 bits", "[ops]") {
  const std::string digits(400, '7');
  const Operation op = operation(R"({"op":"class","chain":[["-)" + digits + R"(","a"],[18446744073709551615,"b"]]})");
  const auto& chain = std::get<AskClass>(op).chain;
  CHECK(chain[0].first.to_string() == "-" + digits);
  CHECK(chain[1].first.to_string() == "18446744073709551615");
  CHECK(there_and_back(op) == to_text(op));
  CHECK_THAT(complaint(R"({"op":"class","chain":[[18446744073709551616,"b"]]})"), Contains("string of digits"));
  CHECK_THAT(complaint(R"({"op":"class","chain":[["12x","b"]]})"), Contains("\"12x\" is not an integer"));
  CHECK_THAT(complaint(R"({"op":"class","chain":[["","b"]]})"), Contains("not an integer"));
  CHECK_THAT(complaint(R"({"op":"class","chain":[[1.5,"b"]]})"), Contains("fraction"));
  CHECK_THAT(complaint(R"({"op":"class","chain":[[1e400,"b"]]})"), Contains("cannot be read"));
}

TEST_CASE("an unknown op is named, and the known ones listed", "[ops]") {
  CHECK_THAT(complaint(R"({"op":"frobnicate"})"), Contains("\"frobnicate\""));
  for (const std::string word :
       {"simplex", "simploid", "complex", "cone", "suspend", "product", "identify", "degenerate", "deidentify",
        "insert", "collapse", "remove", "replace", "expect", "class", "undo", "note"}) {
    CHECK_THAT(complaint(R"({"op":"frobnicate"})"), Contains("the ops are: ") && Contains(" " + word));
  }
  for (const std::string line : {R"({})", R"({"op":3})", R"({"op":null})", R"({"name":"t"})", R"({"op":["note"]})"}) {
    CHECK_THAT(complaint(line), Contains("\"op\""));
  }
}

TEST_CASE("an unknown field is named, in every op", "[ops]") {
  for (const std::string line : {R"({"op":"simplex","name":"t","dim":2,"odd":1})",
                                 R"({"op":"simploid","name":"t","type":[2],"odd":1})",
                                 R"({"op":"complex","name":"t","cells":[],"odd":1})",
                                 R"({"op":"complex","name":"t","cells":[{"id":"a","odd":1}]})",
                                 R"({"op":"cone","apex":"v","odd":1})",
                                 R"({"op":"suspend","apexes":["n","s"],"odd":1})",
                                 R"({"op":"identify","pairs":[],"odd":1})",
                                 R"({"op":"product","name":"P","left":"A","right":"B","odd":1})",
                                 R"({"op":"degenerate","cell":"t","along":0,"odd":1})",
                                 R"({"op":"deidentify","split":[],"odd":1})",
                                 R"({"op":"deidentify","split":[{"cell":"x","as":"y","moves":[],"odd":1}]})",
                                 R"({"op":"insert","simplex":[1],"odd":1})",
                                 R"({"op":"collapse","from":1,"to":2,"odd":1})",
                                 R"({"op":"remove","cells":[],"odd":1})",
                                 R"({"op":"replace","flip":"t","odd":1})",
                                 R"({"op":"replace","subdivide":"t","by":"v","odd":1})",
                                 R"({"op":"replace","contract":["a","b"],"odd":1})",
                                 R"({"op":"expect","odd":1})",
                                 R"({"op":"class","chain":[],"odd":1})",
                                 R"({"op":"undo","odd":1})",
                                 R"({"op":"note","text":"","odd":1})"}) {
    CHECK_THAT(complaint(line), Contains("unknown field \"odd\"") && Contains("its fields are"));
  }
}

TEST_CASE("a missing field is named, in every op", "[ops]") {
  const std::vector<std::pair<std::string, std::string>> lines{
      {R"({"op":"simplex","name":"t"})", "dim"},
      {R"({"op":"simplex","dim":1})", "name"},
      {R"({"op":"simploid","name":"t"})", "type"},
      {R"({"op":"simploid","type":[1]})", "name"},
      {R"({"op":"complex","name":"t"})", "cells"},
      {R"({"op":"complex","cells":[]})", "name"},
      {R"({"op":"complex","name":"t","cells":[{}]})", "id"},
      {R"({"op":"cone"})", "apex"},
      {R"({"op":"suspend"})", "apexes"},
      {R"({"op":"identify"})", "pairs"},
      {R"({"op":"product","left":"A","right":"B"})", "name"},
      {R"({"op":"product","name":"P","right":"B"})", "left"},
      {R"({"op":"product","name":"P","left":"A"})", "right"},
      {R"({"op":"degenerate","along":0})", "cell"},
      {R"({"op":"degenerate","cell":"t"})", "along"},
      {R"({"op":"deidentify"})", "split"},
      {R"({"op":"deidentify","split":[{"as":"y","moves":[]}]})", "cell"},
      {R"({"op":"deidentify","split":[{"cell":"x","moves":[]}]})", "as"},
      {R"({"op":"deidentify","split":[{"cell":"x","as":"y"}]})", "moves"},
      {R"({"op":"insert"})", "simplex"},
      {R"({"op":"collapse","to":1})", "from"},
      {R"({"op":"collapse","from":1})", "to"},
      {R"({"op":"remove"})", "cells"},
      {R"({"op":"replace","subdivide":"t"})", "by"},
      {R"({"op":"class"})", "chain"},
      {R"({"op":"note"})", "text"}};
  for (const auto& [line, field] : lines) {
    CHECK_THAT(complaint(line), Contains("needs a field \"" + field + "\""));
  }
}

TEST_CASE("a field of the wrong kind is named, with what it should be and is", "[ops]") {
  const std::vector<std::pair<std::string, std::string>> lines{
      {R"({"op":"simplex","name":3,"dim":1})", "field \"name\" of \"simplex\" should be a string, but is 3"},
      {R"({"op":"simplex","name":"t","dim":[1]})", "field \"dim\""},
      {R"({"op":"simplex","name":"t","dim":true})", "a truth value"},
      {R"({"op":"insert","simplex":"a"})", "should be a list of vertex labels, but is a string"},
      {R"({"op":"insert","simplex":[-1]})", "labels, which are strings or integers from 0 on, but is -1"},
      {R"({"op":"insert","simplex":[1.5]})", "labels"},
      {R"({"op":"insert","simplices":["a"]})", "field \"simplices\" of \"insert\" should be a list of vertex labels"},
      {R"({"op":"insert","simplices":{}})", "should be a list of simplices, [[\"a\",\"b\"],...], but is an object"},
      {R"({"op":"insert","simplices":[[null]]})", "labels, which are strings or integers from 0 on, but is null"},
      {R"({"op":"insert","simplex":[1],"exist_ok":1})", "should be true or false, but is 1"},
      {R"({"op":"insert","simplex":[1],"simplices":[[2]]})", "\"simplex\" or a field \"simplices\", one of the two"},
      {R"({"op":"collapse","from":null,"to":1})", "field \"from\" of \"collapse\""},
      {R"({"op":"remove","cells":"t"})", "a list of cells, but is a string"},
      {R"({"op":"remove","cells":[],"cofaces":1})", "should be true or false"},
      {R"({"op":"replace"})", "\"flip\", \"subdivide\" or \"contract\", one of the three"},
      {R"({"op":"replace","flip":"t","contract":["a","b"]})", "one of the three"},
      {R"({"op":"replace","flip":"t","by":""})", "the name of what is new, or left out"},
      {R"({"op":"replace","flip":"t","by":null})", "labels"},
      {R"({"op":"replace","flip":3})", "should be a string"},
      {R"({"op":"replace","subdivide":"t","by":"v","at":[1]})", "a point"},
      {R"({"op":"replace","contract":["a"]})", "a list of two labels"},
      {R"({"op":"replace","contract":["a","b"],"link_condition":0})", "should be true or false"},
      {R"({"op":"replace","flip":"t","fills":0})", "should be true or false"},
      {R"({"op":"simplex","name":"t","dim":-1})", "from 0 on"},
      {R"({"op":"simplex","name":"t","dim":1000000000})", "1000000000"},
      {R"({"op":"simplex","name":"t","dim":"99999999999999999999"})", "99999999999999999999"},
      {R"({"op":"simplex","name":"t","dim":1.0})", "fraction"},
      {R"({"op":"simplex","name":"t","dim":1,"at":[[0,0]]})", "should have 2 points"},
      {R"({"op":"simplex","name":"t","dim":0,"at":[[0]]})", "a point"},
      {R"({"op":"simplex","name":"t","dim":0,"at":[[0,0,0,0]]})", "a point"},
      {R"({"op":"simplex","name":"t","dim":0,"at":[["0",0]]})", "a point of numbers, but is a string"},
      {R"({"op":"simplex","name":"t","dim":0,"at":7})", "a list of points, but is 7"},
      {R"({"op":"simploid","name":"t","type":2})", "a list of dimensions"},
      {R"({"op":"simploid","name":"t","type":[2,0]})", "from 1 on"},
      {R"({"op":"simploid","name":"t","type":[2,1],"at":[[0,0]]})", "should have 6 points"},
      {R"({"op":"complex","name":"t","cells":{}})", "a list of cells, but is an object"},
      {R"({"op":"complex","name":"t","cells":["a"]})", "objects with an \"id\""},
      {R"({"op":"complex","name":"t","cells":[{"id":"a","faces":"b"}]})", "a list of cell ids"},
      {R"({"op":"complex","name":"t","cells":[{"id":"a","faces":[1]}]})", "field \"faces\""},
      {R"({"op":"complex","name":"t","cells":[{"id":"e","faces":["a","a"],"at":[0,0]}]})", "only vertices"},
      {R"({"op":"cone","apex":"v","over":3})", "the name of a body or a list of cells"},
      {R"({"op":"cone","apex":"v","over":null})", "null"},
      {R"({"op":"suspend","apexes":"n"})", "a list of two names"},
      {R"({"op":"suspend","apexes":["n"]})", "a list of two names"},
      {R"({"op":"suspend","apexes":["n","s"],"at":[[0,0]]})", "2 points"},
      {R"({"op":"cone","apex":"v","over":[["t"]]})", "field \"over\""},
      {R"({"op":"identify","pairs":[["a"]]})", "a list of pairs"},
      {R"({"op":"identify","pairs":[["a","b","c"]]})", "a vertex map"},
      {R"({"op":"identify","pairs":[["a","b",[]]]})", "a vertex map"},
      {R"({"op":"identify","pairs":[["a","b",[[0],1]]]})", "a vertex map"},
      {R"({"op":"identify","pairs":[["a","b",[-1]]]})", "from 0 on"},
      {R"({"op":"identify","pairs":[["a","b",[0],[1]]]})", "a list of pairs"},
      {R"({"op":"identify","pairs":["a","b"]})", "a list of pairs"},
      {R"({"op":"identify","pairs":[["a",1]]})", "field \"pairs\""},
      {R"({"op":"product","name":"P","left":["A"],"right":"B"})", "field \"left\" of \"product\" should be a string"},
      {R"({"op":"product","name":"P","left":"A","right":2})", "field \"right\""},
      {R"({"op":"product","name":1,"left":"A","right":"B"})", "field \"name\""},
      {R"({"op":"product","name":"P","left":"A","right":"B","kind":"cubical"})", "\"simplicial\", but is \"cubical\""},
      {R"({"op":"product","name":"P","left":"A","right":"B","kind":true})", "field \"kind\""},
      {R"({"op":"degenerate","cell":["t"],"along":0})", "field \"cell\""},
      {R"({"op":"degenerate","cell":"t","along":"x"})", "\"x\" is not an integer"},
      {R"({"op":"degenerate","cell":"t","along":-1})", "from 0 on"},
      {R"({"op":"degenerate","cell":"t","along":[]})", "[i,j] for a simploid"},
      {R"({"op":"degenerate","cell":"t","along":[1]})", "[i,j] for a simploid"},
      {R"({"op":"degenerate","cell":"t","along":[1,0,0]})", "[i,j] for a simploid"},
      {R"({"op":"degenerate","cell":"t","along":[0,0]})", "from 1 on"},
      {R"({"op":"degenerate","cell":"t","along":[1,-1]})", "from 0 on"},
      {R"({"op":"degenerate","cell":"t","along":{}})", "an object"},
      {R"({"op":"deidentify","split":{}})", "\"cell\", \"as\" and \"moves\", but is an object"},
      {R"({"op":"deidentify","split":["x"]})", "\"cell\", \"as\" and \"moves\", but is a string"},
      {R"({"op":"deidentify","split":[{"cell":1,"as":"y","moves":[]}]})", "field \"cell\" of a split"},
      {R"({"op":"deidentify","split":[{"cell":"x","as":1,"moves":[]}]})", "field \"as\""},
      {R"({"op":"deidentify","split":[{"cell":"x","as":"y","moves":"t"}]})", "a list of incidences"},
      {R"({"op":"deidentify","split":[{"cell":"x","as":"y","moves":["t",0]}]})", "a list of incidences"},
      {R"({"op":"deidentify","split":[{"cell":"x","as":"y","moves":[["t"]]}]})", "a list of incidences"},
      {R"({"op":"deidentify","split":[{"cell":"x","as":"y","moves":[["t",0,1]]}]})", "a list of incidences"},
      {R"({"op":"deidentify","split":[{"cell":"x","as":"y","moves":[[0,"t"]]}]})", "field \"moves\""},
      {R"({"op":"deidentify","split":[{"cell":"x","as":"y","moves":[["t",-1]]}]})", "from 0 on"},
      {R"({"op":"deidentify","split":[{"cell":"x","as":"y","moves":[["t",0.5]]}]})", "fraction"},
      {R"({"op":"expect","betti":1})", "a list of integers"},
      {R"({"op":"expect","torsion":[2]})", "field \"torsion\""},
      {R"({"op":"expect","euler":null})", "null"},
      {R"({"op":"class","chain":[["a",1]]})", "not an integer"},
      {R"({"op":"class","chain":[[1,"a",2]]})", "a list of terms"},
      {R"({"op":"undo","steps":0})", "positive"},
      {R"({"op":"undo","steps":-2})", "positive"},
      {R"({"op":"undo","steps":"99999999999999999999"})", "positive"},
      {R"({"op":"note","text":["a"]})", "a list"}};
  for (const auto& [line, what] : lines) {
    CAPTURE(line);
    CHECK_THAT(complaint(line), Contains(what));
  }
}

TEST_CASE("what is not one JSON object is refused, with the column", "[ops]") {
  for (const std::string line : {"", "   ", "[]", "3", "null", "simplex t 2", "\xef\xbb\xbf{}"}) {
    CHECK_THAT(complaint(line), Contains("one JSON object"));
  }
  for (const std::string line : {"{", "{\"op\"", R"({"op":"note","text":"a)", R"({"op":"note","text":"a"} {})",
                                 R"({"op":"note","text":"a"},)", R"({'op':'note'})", R"({"op":"note",})",
                                 "{\"op\":\"note\",\"text\":\"\x01\"}", R"({"op":"note","text":NaN})"}) {
    CAPTURE(line);
    CHECK_THAT(complaint(line), Contains("at column"));
  }
}

TEST_CASE("text that is not UTF-8 is refused", "[ops]") {
  for (const std::string bytes :
       {"\xff", "\xc3", "\xc3(", "\xe2\x82", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xc0\xaf"}) {
    CHECK_THAT(complaint(R"({"op":"note","text":")" + bytes + "\"}"), Contains("not a JSON object"));
    CHECK_FALSE(parse_operation(R"({"op":"simplex","dim":1,"name":")" + bytes + "\"}"));
  }
  CHECK_FALSE(parse_operation(R"({"op":"note","text":"\ud800"})"));
}

TEST_CASE("every cut of a line is refused, and no changed byte is worse than refused", "[ops]") {
  const std::string line = GENERATE(
      R"({"op":"complex","name":"K","cells":[{"id":"a","at":[0,1]},{"id":"e","faces":["a","a"]},{"id":"q","type":[1],"faces":["a","a"]}]})",
      R"({"op":"deidentify","split":[{"cell":"x","as":"y","moves":[["t",0],["u",12]]},{"cell":"t","as":"s","moves":[]}]})",
      R"({"op":"product","name":"P","left":"A","right":"B","kind":"simplicial"})",
      R"({"op":"degenerate","cell":"t","along":[1,0]})");
  for (std::size_t n = 0; n < line.size(); ++n) {
    CHECK_FALSE(parse_operation(line.substr(0, n)));
  }
  int accepted = 0;
  for (std::size_t n = 0; n < line.size(); ++n) {
    for (const char byte : {'\0', '"', '{', '}', '[', ']', ',', ':', '9', '-', '\\', '\xff', ' '}) {
      std::string damaged = line;
      damaged[n] = byte;
      if (const auto parsed = parse_operation(damaged)) {
        ++accepted;
        CHECK(there_and_back(*parsed) == to_text(*parsed));
      } else {
        CHECK_FALSE(parsed.error().what.empty());
      }
    }
  }
  CHECK(accepted > 0);
}

TEST_CASE("nesting of any depth is refused without a crash", "[ops]") {
  CHECK_FALSE(parse_operation(nested(100'000)));
  CHECK_FALSE(parse_operation(std::string(1'000'000, '{')));
  CHECK_FALSE(parse_operation(R"({"op":"note","text":)" + nested(100'000) + "}"));
  CHECK_FALSE(parse_operation(R"({"op":"note","text":"","odd":)" + nested(100'000) + "}"));
  CHECK_FALSE(parse_operation(R"({"op":"identify","pairs":)" + nested(100'000) + "}"));
  CHECK_FALSE(parse_operation(R"({"op":"identify","pairs":)" + std::string(100'000, '[')));
  CHECK_FALSE(parse_operation(R"({"op":"deidentify","split":)" + nested(100'000) + "}"));
  CHECK_FALSE(parse_operation(R"({"op":"degenerate","cell":"t","along":)" + nested(100'000) + "}"));
  std::string objects;
  for (int k = 0; k < 100'000; ++k) {
    objects += R"({"op":)";
  }
  CHECK_FALSE(parse_operation(objects));
  CHECK(parse_operation(R"({"op":"expect","betti":)" + nested(31) + "}").error().what.find("deep") ==
        std::string::npos);
  CHECK_THAT(complaint(R"({"op":"expect","betti":)" + nested(32) + "}"), Contains("more than 32 deep"));
}

TEST_CASE("the header names its ring and its version", "[ops]") {
  const Result<Header> full = parse_header(R"({"sesame":1,"ring":"Z/2","title":"torus"})");
  REQUIRE(full);
  CHECK(full->ring == "Z/2");
  CHECK(to_text(*full) == R"({"sesame":1,"ring":"Z/2","title":"torus"})");
  const Result<Header> least = parse_header(R"({"sesame":1})");
  REQUIRE(least);
  CHECK(least->ring == "Z");
  CHECK(least->title.empty());
  const std::vector<std::pair<std::string, std::string>> wrong{
      {R"({"op":"note","text":""})", "should be the header"},
      {R"({"sesame":2})", "version 1"},
      {R"({"sesame":"1"})", "version 1"},
      {R"({"sesame":1,"ring":2})", "field \"ring\""},
      {R"({"sesame":1,"field":"Z"})", "unknown field \"field\""},
      {"sesame", "one JSON object"}};
  for (const auto& [line, what] : wrong) {
    const Result<Header> parsed = parse_header(line);
    REQUIRE_FALSE(parsed);
    CHECK_THAT(parsed.error().what, Contains(what));
  }
}
