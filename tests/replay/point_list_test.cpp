#include "replay/text/point_list.hpp"

#include "tests/support/catch.hpp"

using namespace sesame;

namespace {

Result<replay::PointList> points_of(const std::string& text) {
  return replay::read_points(replay::ByteSource::of_text(text, "p.txt"));
}

}  // namespace

TEST_CASE("points are read a line each, with blanks or commas, and the first three coordinates are kept",
          "[replay][points]") {
  const auto points = points_of("# x y z w\n1 2 3 4\n\n-1.5,2e1 , 0.25,9 # the second\r\n");
  REQUIRE(points);
  CHECK(points->coordinates == 4);
  CHECK(points->points == std::vector<std::array<double, 3>>{{1, 2, 3}, {-1.5, 20, 0.25}});
  const auto plane = points_of("1\t2\n3 4");
  REQUIRE(plane);
  CHECK(plane->points == std::vector<std::array<double, 3>>{{1, 2, 0}, {3, 4, 0}});
  CHECK(points_of("7\n")->points == std::vector<std::array<double, 3>>{{7, 0, 0}});
  CHECK(points_of("# nothing\n")->points.empty());
}

TEST_CASE("what is no point is refused with its line and what would be right", "[replay][points]") {
  const std::pair<const char*, const char*> wrong[] = {
      {"1 2\n1 x\n", "p.txt:2: \"x\" should be a coordinate, a finite number"},
      {"1 inf\n", "p.txt:1: \"inf\" should be a coordinate, a finite number"},
      {"1 1e999\n", "p.txt:1: \"1e999\" should be a coordinate, a finite number"},
      {"\n1 2\n# two\n1 2 3\n", "p.txt:4: 3 coordinates, but line 2 has 2; all points should have the same"},
      {"1,,2\n", "p.txt:1: nothing stands on one side of a comma; a coordinate should"},
      {"1,2,\n", "p.txt:1: nothing stands on one side of a comma; a coordinate should"},
      {",1\n", "p.txt:1: nothing stands on one side of a comma; a coordinate should"},
  };
  for (const auto& [text, what] : wrong) {
    const auto points = points_of(text);
    REQUIRE_FALSE(points);
    CHECK(points.error().what == what);
    CHECK(points.error().code == Errc::bad_input);
  }
}
