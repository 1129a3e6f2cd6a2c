// Engines that forget cells that are gone: they say what others say, and know little.
#include "tests/support/engines.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

constexpr engine::HistoryPolicy forgetful_history(std::uint64_t undoable) { return {undoable, false, true}; }

}  // namespace

TEST_CASE("an engine that forgets cells has the groups of one that does not, through undo and renewals",
          "[engine][renewal][stream]") {
  const unsigned seed = GENERATE(1U, 2U);
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(seed, ring);
  Engine forgets(ring_named(ring), {}, {}, forgetful_history(30));
  Engine keeps(ring_named(ring), {}, {}, {30, false});
  RandomSteps random(seed, everything_and_maps(50));
  int renewals = 0;
  const auto both = [&](const ops::Operation& step) {
    CAPTURE(ops::to_text(step));
    const engine::StepReport report = carry_out(forgets, step);
    carry_out(keeps, step);
    renewals += report.renewed ? 1 : 0;
    return report.renewed;
  };
  for (int k = 0; k < 8000; ++k) {
    CAPTURE(k);
    const bool undoes = random.random().one_in(12) && forgets.undoable() > 0;
    const bool is_renewed =
        both(undoes ? ops::Undo{1 + static_cast<std::uint64_t>(random.random().in(0, 3)) % forgets.undoable()}
                    : random.next(forgets.structure()));
    REQUIRE(std::ranges::equal(forgets.cells(), keeps.cells()));
    if (k % 25 == 0 || is_renewed) {
      REQUIRE(live_groups(forgets) == live_groups(keeps));
      REQUIRE(forgets.first_defect().value_or("") == "");
      REQUIRE(forgets.undoable() == keeps.undoable());
    }
  }
  CHECK(renewals > 0);
  CHECK(forgets.structure().cells().size() < keeps.structure().cells().size() / 2);
  CHECK(forgets.work().boundary_entries > 0);
  while (forgets.undoable() > 0) {
    both(ops::Undo{1});
    REQUIRE(live_groups(forgets) == live_groups(keeps));
  }
  CHECK(forgets.first_defect().value_or("") == "");
}

TEST_CASE("an engine with a log in memory forgets no cells", "[engine][renewal]") {
  Engine engine(sparse::Integers{}, {}, {}, engine::HistoryPolicy{5, true, true});
  for (int k = 0; k < 3000; ++k) {
    const std::string name = "t" + std::to_string(k);
    carry_out(engine, ops::MakeSimplex{name, 1, {}});
    carry_out(engine, ops::Degenerate{name, 1, 0});
    if (k > 0) {
      carry_out(engine, ops::Identify{{{"t0.0", name + ".0"}}});
    }
  }
  CHECK(engine.structure().cells().size() == 9000);
}

TEST_CASE("an engine that forgets cells has no darts of maps that are gone", "[engine][renewal]") {
  Engine engine(sparse::Integers{}, {}, {}, forgetful_history(10));
  const auto line = [](const std::string& name, const std::string& op, const std::string& rest) {
    return R"({"op":")" + op + R"(",)" + rest.substr(0, rest.find('%')) + name + rest.substr(rest.find('%') + 1) + "}";
  };
  carry_out(engine, R"({"op":"polygon","name":"p","sides":3})");
  ops::Dart most = 0;
  for (int k = 0; k < 3000; ++k) {
    const std::string name = "m" + std::to_string(k);
    carry_out(engine, line(name, "polygon", R"("name":"%","sides":4)"));
    carry_out(engine, line(name, "remove", R"("cofaces":true,"cells":["%.0:0"])"));
    carry_out(engine, line(name, "remove", R"("cofaces":true,"cells":["%.0:3"])"));
    carry_out(engine, line(name, "remove", R"("cofaces":true,"cells":["%.0:5"])"));
    carry_out(engine, line(name, "remove", R"("cofaces":true,"cells":["%.0:1"])"));
    carry_out(engine, line("k" + name, "insert_cell", R"("dim":1,"darts":["p:2"],"name":"%")"));
    carry_out(engine, line("k" + name, "remove_cell", R"("cell":"%.1:0")"));
    most = std::max(most, engine.structure().darts().darts(2));
  }
  CHECK(most < 6000);  // of 36000
  CHECK(engine.structure().darts().maps() < 1000);
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0});
}
