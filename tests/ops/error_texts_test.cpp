// What is said of texts that somebody else wrote: it fits on a line of a terminal, whatever they are.
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

/// An error, if there is one, has no control characters, and is short.
void check_sentence(const Error& error) {
  CAPTURE(error.what);
  CHECK(!error.what.empty());
  CHECK(error.what.size() < 2000);
  CHECK(std::none_of(error.what.begin(), error.what.end(),
                     [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7F'; }));
}

}  // namespace

TEST_CASE("no text of an operation gets into an error with its control characters, or whole when it is long",
          "[errors]") {
  for (const std::string& bad : {std::string{"a\x1B[31m\nb"}, "\x7F" + std::string(100'000, 'x')}) {
    Workshop shop;
    shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"insert","simplex":["u","v"]})"});
    const std::vector<Operation> operations{
        MakeSimplex{bad, 1, {}},
        MakeSimploid{bad, {1, 1}, {}},
        MakeComplex{bad, {{"a", {}, {}, {}}}},
        MakeComplex{"K", {{bad, {}, {}, {}}}},
        MakeComplex{"K", {{"e", {}, {bad, bad}, {}}}},
        MakeComplex{bad, {{"a", {}, {}, {}}, {"a", {}, {}, {}}}},
        MakeCone{bad, {}, {}},
        MakeCone{"w", bad, {}},
        MakeCone{"w", std::vector<std::string>{bad}, {}},
        MakeSuspension{{bad, bad}, {}, {}},
        MakeProduct{bad, "t", "t", false},
        MakeProduct{"P", bad, "t", false},
        Identify{{{"t", bad}}, {}},
        Identify{{{bad, "t"}}, {}},
        Degenerate{bad, {}, 0},
        Deidentify{{{bad, "y", {}}}},
        Deidentify{{{"t.0", bad, {}}}},
        Deidentify{{{"t.0", bad, {}}, {"t.1", bad, {}}}},
        Deidentify{{{"t.0", "y", {{bad, 0}}}}},
        Insert{{{bad, "v"}}, false},
        Insert{{{bad, bad}}, false},
        Collapse{bad, "v"},
        Collapse{"u", bad},
        Collapse{bad, bad},
    };
    for (const Operation& operation : operations) {
      const Status status = shop.plan(operation);
      REQUIRE(!status);
      check_sentence(status.error());
    }
  }
}

TEST_CASE("no text of a line gets into an error with its control characters, or whole when it is long", "[errors]") {
  for (const std::string& bad : {std::string{R"(a\u001b[31m\nb)"}, R"(\u007f)" + std::string(100'000, '7')}) {
    const std::vector<std::string> lines{
        R"({"op":")" + bad + R"("})",
        R"({"op":"simplex","name":"t","dim":1,")" + bad + R"(":1})",
        R"({"op":"simplex","name":"t","dim":")" + bad + R"("})",
        R"({"op":"simplex","name":"t","dim":")" + std::string(100'000, '7') + R"("})",
        R"({"op":"note",")" + bad + R"(":1,")" + bad + R"(":1})",
        R"({"op":"expect","euler":")" + bad + R"("})",
        R"({"op":"class","chain":[[")" + bad + R"(","t"]]})",
        R"({"op":"product","name":"P","left":"a","right":"b","kind":")" + bad + R"("})",
        R"({"op":"complex","name":"K","cells":[{"id":")" + bad + R"(","faces":["b","a"],"at":[1,2,3]}]})",
        R"({"op":"note","text":")" + bad + R"(")",
        "{\"op\":\"note\",\"text\":\"a\x1B\x01\"}",
    };
    for (const std::string& line : lines) {
      CAPTURE(line.substr(0, 80));
      const Result<Operation> parsed = parse_operation(line);
      REQUIRE(!parsed);
      check_sentence(parsed.error());
    }
    const Result<Header> header = parse_header(R"({"sesame":1,")" + bad + R"(":"Z"})");
    REQUIRE(!header);
    check_sentence(header.error());
  }
}
