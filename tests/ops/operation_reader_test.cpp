#include "ops/vocabulary/operation_reader.hpp"

#include <random>

#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

/// What a line says, or what is wrong with it.
std::string said(const Result<Operation>& read) { return read ? to_text(*read) : "error: " + read.error().what; }

/// Lines that are read without help, one of each kind of field.
const std::vector<std::string>& common_lines() {
  static const std::vector<std::string> lines{
      R"({"op":"simplex","name":"t","dim":2})",
      R"( { "dim" : 0 , "at":[[1,-2.5e-3]], "name":"\u00e9\"\\", "op":"simplex"} )",
      R"({"op":"simplex","name":"t","dim":1,"at":[[-0,1.5,-2.0],[1.0,0.1,1e-12]]})",
      R"({"op":"simplex","name":"t","dim":0,"at":[[0.1,4.9406564584124654e-324,-1.7976931348623157e308]]})",
      R"({"op":"simploid","name":"q","type":[1,2]})",
      R"({"type":[],"op":"simploid","name":"v"})",
      R"({"op":"complex","name":"K","cells":[]})",
      R"({"op":"complex","name":"K","cells":[{"id":"a","at":[0.0,0.0,1.0],"faces":[]},{"id":"e","faces":["a","a"]},{"faces":["e","e","e","e"],"id":"q","type":[1,1]},{"id":"b","type":[]}]})",
      R"({"op":"identify","pairs":[]})",
      R"({"op":"identify","pairs":[["a","b"],["c","d",[2,0,1]],["e","f",[[1,0],[0,1]]],["g","h",[[]]]]})",
      R"({"op":"deidentify","split":[]})",
      R"({"op":"deidentify","split":[{"cell":"x","as":"x2","moves":[]},{"moves":[["t",0],["x2",12]],"cell":"x","as":"x3"}]})",
      R"({"op":"insert","simplex":["a",3,"03",18446744073709551615,"18446744073709551616","-1"]})",
      R"({"op":"insert","simplex":[]})",
      R"({"op":"insert","simplex":["a",3],"exist_ok":true})",
      R"({"op":"insert","exist_ok":false,"simplices":[["a",3],[0],[3,"b"]]})",
      R"({"op":"insert","simplices":[]})",
      R"({"op":"collapse","to":7,"from":"u"})",
      R"({"op":"polygon","name":"p","sides":4})",
      R"({"op":"polygon","at":[],"sides":1,"as":"simplices","name":"p\u00e9"})",
      R"({"op":"polygon","name":"p","sides":100000000,"at":[[0,-0],[1.5,2,3]]})",
      R"({"op":"gmap","name":"g","alpha":[]})",
      R"({"op":"gmap","name":"g","alpha":[[1,0],[0,1],[]],"at":[[0,0]]})",
      R"({"alpha":[[0,4294967294]],"as":"simplices","name":"g","op":"gmap"})",
      R"({"op":"sew","dim":2,"pairs":[["p:2","q:7"],["p:4","r:1"]]})",
      R"({"pairs":[],"dim":0,"op":"sew"})",
      R"({"op":"unsew","dim":3,"darts":["m:3","m:4'"]})",
      R"({"op":"unsew","darts":[],"dim":1000000})"};
  return lines;
}

/// Changed at a few places: bytes that mean something to JSON, lost, doubled, exchanged.
std::string damaged(std::string line, std::mt19937& random) {
  static const std::string bytes = "{}[]\",:0123456789-+.eE \t\\utrfnl\x01\x7f\xc3\xa9\xff";
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  for (std::size_t changes = 1 + below(3); changes > 0 && !line.empty(); --changes) {
    const std::size_t at = below(line.size());
    switch (below(5)) {
      case 0:
        line.erase(at, 1 + below(3));
        break;
      case 1:
        line.insert(at, 1, bytes[below(bytes.size())]);
        break;
      case 2:
        line[at] = bytes[below(bytes.size())];
        break;
      case 3:
        line.insert(at, line.substr(below(line.size()), 1 + below(12)));
        break;
      default:
        std::swap(line[at], line[below(line.size())]);
    }
  }
  return line;
}

}  // namespace

TEST_CASE("common lines are read without a JSON value, and say the same", "[ops]") {
  OperationReader reader;
  for (const std::string& line : common_lines()) {
    CAPTURE(line);
    const std::optional<Operation> read = reader.read_common(line);
    REQUIRE(read);
    REQUIRE(parse_operation(line));
    CHECK(to_text(*read) == to_text(*parse_operation(line)));
  }
}

TEST_CASE("random operations are read alike in both ways", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 8U));
  CAPTURE(seed);
  OperationReader reader;
  Workshop shop;
  RandomSteps steps(seed, seed % 2 == 0 ? everything(60) : everything_and_maps(60));
  for (int k = 0; k < 60; ++k) {
    const std::string line = to_text(steps.next(shop.structure()));
    CHECK(said(reader.read(line)) == line);
    REQUIRE(shop.apply(operation(line)));
  }
}

TEST_CASE("a line with something wrong is left to the reader that says what", "[ops]") {
  const std::vector<std::string> lines{"",
                                       "{}",
                                       "[]",
                                       "3",
                                       R"({"op":"simplex"})",
                                       R"({"op":"simplex","name":"t","dim":2,"dim":2})",
                                       R"({"op":"simplex","op":"simplex","name":"t","dim":2})",
                                       R"({"op":"simplex","name":"t","dim":-1})",
                                       R"({"op":"simplex","name":"t","dim":2.0})",
                                       R"({"op":"simplex","name":"t","dim":1000001})",
                                       R"({"op":"simplex","name":3,"dim":2})",
                                       R"({"op":"simplex","name":"t","dim":2,"at":[]})",
                                       R"({"op":"simplex","name":"t","dim":0,"at":[[1]]})",
                                       R"({"op":"simplex","name":"t","dim":0,"at":[[1,2,3,4]]})",
                                       R"({"op":"simplex","name":"t","dim":0,"at":[[1,1e999]]})",
                                       R"({"op":"simplex","name":"t","dim":0,"at":[[1,2]]} x)",
                                       R"({"op":"simplex","name":"t","dim":0}{"op":"simplex","name":"t","dim":0})",
                                       R"({"op":"simplex","name":"t","dim":0,})",
                                       R"({"op":"simplex","name":"t","dim":0,"more":0})",
                                       R"({"op":"complex","name":"K","cells":[{"id":"e","faces":["a"],"at":[0,0]}]})",
                                       R"({"op":"complex","name":"K","cells":[{"faces":["a"]}]})",
                                       R"({"op":"complex","name":"K","cells":[{"id":"a","id":"a"}]})",
                                       R"({"op":"complex","cells":[]})",
                                       R"({"op":"identify","pairs":[["a"]]})",
                                       R"({"op":"identify","pairs":[["a","b",[]]]})",
                                       R"({"op":"identify","pairs":[["a","b",[0,[1]]]]})",
                                       R"({"op":"identify","pairs":[["a","b",[[0],1]]]})",
                                       R"({"op":"identify","pairs":[["a","b",[0,1],3]]})",
                                       R"({"op":"deidentify","split":[{"cell":"x","as":"y"}]})",
                                       R"({"op":"deidentify","split":[{"cell":"x","as":"y","moves":[["t"]]}]})",
                                       R"({"op":"insert"})",
                                       R"({"op":"insert":},"simplices":[]})",
                                       R"({"op":"insert","simplex":[],"simplices":[]})",
                                       R"({"op":"insert","simplex":[-1]})",
                                       R"({"op":"insert","simplex":[18446744073709551616]})",
                                       R"({"op":"collapse","from":"u"})",
                                       "{\"op\":\"collapse\",\"from\":\"\xff\",\"to\":\"v\"}",
                                       R"({"op":"collapse","from":"\ud800","to":"v"})",
                                       R"({"op":"polygon","name":"p"})",
                                       R"({"op":"polygon","sides":3})",
                                       R"({"op":"polygon","name":"p","sides":0})",
                                       R"({"op":"polygon","name":"p","sides":-1})",
                                       R"({"op":"polygon","name":"p","sides":3.0})",
                                       R"({"op":"polygon","name":"p","sides":100000001})",
                                       R"({"op":"polygon","name":"p","sides":3,"sides":3})",
                                       R"({"op":"polygon","name":"p","sides":3,"as":"cells"})",
                                       R"({"op":"polygon","name":"p","sides":3,"as":null})",
                                       R"({"op":"polygon","name":"p","sides":3,"at":[[1]]})",
                                       R"({"op":"polygon","name":"p","sides":3,"alpha":[]})",
                                       R"({"op":"gmap","name":"g"})",
                                       R"({"op":"gmap","alpha":[[0]]})",
                                       R"({"op":"gmap","name":"g","alpha":[0]})",
                                       R"({"op":"gmap","name":"g","alpha":[[-1]]})",
                                       R"({"op":"gmap","name":"g","alpha":[[null]]})",
                                       R"({"op":"gmap","name":"g","alpha":[["0"]]})",
                                       R"({"op":"gmap","name":"g","alpha":[[4294967295]]})",
                                       R"({"op":"sew","pairs":[]})",
                                       R"({"op":"sew","dim":2})",
                                       R"({"op":"sew","dim":-1,"pairs":[]})",
                                       R"({"op":"sew","dim":2,"pairs":[["p:2"]]})",
                                       R"({"op":"sew","dim":2,"pairs":[["p:2","q:7","r:1"]]})",
                                       R"({"op":"sew","dim":2,"pairs":[["p:2",7]]})",
                                       R"({"op":"sew","dim":2,"pairs":["p:2","q:7"]})",
                                       R"({"op":"sew","dim":2,"pairs":[],"darts":[]})",
                                       R"({"op":"unsew","dim":2})",
                                       R"({"op":"unsew","dim":2,"darts":[3]})",
                                       R"({"op":"unsew","dim":2,"darts":["p:2"],"dim":2})",
                                       R"({"op":"map","name":"m","beta":[[0]]})",
                                       R"({"op":"note","text":"rare"})"};
  OperationReader reader;
  for (const std::string& line : lines) {
    CAPTURE(line);
    CHECK_FALSE(reader.read_common(line));
    CHECK(said(reader.read(line)) == said(parse_operation(line)));
  }
}

TEST_CASE("damaged lines are never read otherwise than by parse_operation", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 4U));
  CAPTURE(seed);
  std::mt19937 random(seed);
  OperationReader reader;
  std::size_t still_read = 0;
  for (int k = 0; k < 5000; ++k) {
    const std::string line = damaged(common_lines()[random() % common_lines().size()], random);
    if (const std::optional<Operation> read = reader.read_common(line)) {
      ++still_read;
      const Result<Operation> parsed = parse_operation(line);
      if (!parsed || to_text(*read) != to_text(*parsed)) {
        FAIL_CHECK(line << "\nis read as " << to_text(*read) << "\nbut is " << said(parsed));
      }
    }
  }
  CHECK(still_read > 100);
}
