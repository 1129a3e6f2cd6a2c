#include <algorithm>
#include <limits>

#include "tests/support/catch.hpp"
#include "tests/tools/mesh_support.hpp"

namespace sesame::tools {

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using FaceList = std::vector<std::vector<std::uint32_t>>;

const FaceList one_triangle{{0, 1, 2}};
const FaceList tetrahedron{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

}  // namespace

TEST_CASE("OFF skips comments, blank lines and colours", "[mesh]") {
  const auto mesh = read_fixture("torus.off");
  CHECK(mesh.points.size() == 9);
  CHECK(mesh.points[3] == Point{-1.5, 2.6, 0});
  REQUIRE(mesh.faces.size() == 9);
  CHECK(faces_of(mesh)[6] == std::vector<std::uint32_t>{6, 7, 1, 0});
  CHECK(mesh.remarks.empty());
}

TEST_CASE("OFF is read with every form of its head", "[mesh]") {
  const std::string head = GENERATE("OFF\n3 1 0\n", "OFF 3 1 0\n", "OFF3 1 0\n", "OFF 3\n1 0\n", "OFF\n3\n1\n0\n",
                                    "off\n3 1 0\n", "Off3 1 3\n", "# first\n\n  OFF\n\n# second\n3 1\n",
                                    "OFF\r\n3 1 0\r\n", "OFF\r3 1 0\r", "3 1 0\n", "\xef\xbb\xbfOFF\n3 1 0\n",
                                    "nOFF 3 3 1 0\n", "nOFF3\n3 1 0\n", "4nOFF 2\n3 1 0\n", "OFF 3 1 # no edges\n");
  const auto mesh = parsed(head + "\n0 0 0\n+1 0 0\n 0\t1e0 0 # here\n\n3 0 1 2 0.1 0.2 0.3\n", "a.off");
  CHECK(mesh.points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(faces_of(mesh) == one_triangle);
}

TEST_CASE("OFF skips the numbers that its prefixes announce, wherever lines break", "[mesh]") {
  const auto [head, others] = GENERATE(table<std::string, std::string>({{"OFF", ""},
                                                                        {"COFF", " 255 0 0 255"},
                                                                        {"cOff", " .1 .2 .3 1"},
                                                                        {"NOFF", " 0 0 1"},
                                                                        {"STOFF", " 0.5 0.5"},
                                                                        {"STCNOFF", " 0 0 1 1 0 0 1 0.5 0.5"},
                                                                        {"NCSTOFF", " 0 0 1 1 0 0 1 0.5 0.5"},
                                                                        {"ST4OFF", " 1 0.5 0.5"}}));
  std::string body;
  for (const char* point : {"0 0 0", "2 0 0", "0 2 0", "2 2 0"}) {
    body += point + others + "\n";
  }
  const std::string faces = "3 0 1 2 7\n3 1 3 2\n";
  std::string one_line = body;
  std::replace(one_line.begin(), one_line.end(), '\n', ' ');
  std::string one_number_a_line = body;
  std::replace(one_number_a_line.begin(), one_number_a_line.end(), ' ', '\n');
  for (const auto& points : {body, one_line, one_number_a_line}) {
    const auto mesh = parsed(head + " 4 2 5\n" + points + faces, "a.off");
    CHECK(mesh.points == std::vector<Point>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}});
    CHECK(faces_of(mesh) == FaceList{{0, 1, 2}, {1, 3, 2}});
  }
  CHECK(faces_of(parsed(head + "4 2 5 " + one_line + "3\n0 1\n2 7\n3 1 3\n2", "a.off")) ==
        FaceList{{0, 1, 2}, {1, 3, 2}});
}

TEST_CASE("two OFF points on a line are two points, and the next line is a face", "[mesh]") {
  const auto mesh = parsed("OFF\n4 2 0\n0 0 0 1 0 0\n0 1 0 1 1 0\n3 0 1 2\n3 1 3 2\n", "a.off");
  CHECK(mesh.points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  CHECK(faces_of(mesh) == FaceList{{0, 1, 2}, {1, 3, 2}});
  // The face was a point, and the rest of the file a mesh of its own.
  CHECK_THAT(complaint("OFF 3 1 0\n0 0 0 1 0 0\n0 1 0\n3 0 1 9\n3 0 1 2\n", "a.off"),
             StartsWith("a.off:4: corner 2 of face 0 is `9`"));
}

TEST_CASE("what follows the corners of an OFF face on its line is its colour", "[mesh]") {
  const std::string head = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n";
  for (const char* colour : {"", " 7", " 255 0 0", " 0.5 0.5 0.5 1", " # 3 0 1 2"}) {
    const auto mesh = parsed(head + "3 0 1 2" + colour + "\n3 0 2 1" + colour + "\n", "a.off");
    CHECK(faces_of(mesh) == FaceList{{0, 1, 2}, {0, 2, 1}});
    CHECK(mesh.remarks.empty());
  }
  const auto more = parsed(head + "3 0 1 2 1 2 3 4 5\n3 0 2 1\n", "a.off");
  REQUIRE(more.remarks.size() == 1);
  CHECK_THAT(more.remarks[0], StartsWith("1 face has more after the corners than the four numbers of a colour"));
  CHECK_THAT(complaint(head + "3 0 1 2 3 0 2 1\n", "a.off"), StartsWith("a.off:6: the file ends after 1 of 2 faces"));
}

TEST_CASE("OFF points may have other numbers on their lines than the head announces, if all have as many", "[mesh]") {
  const auto [head, others] = GENERATE(table<std::string, std::string>(
      {{"OFF", " 255 0 0"}, {"OFF", " 0 0 1 255 0 0 255"}, {"COFF", " 255 0 0"}, {"COFF", ""}, {"NOFF", ""}}));
  std::string text = head + "\n3 1 0\n";
  for (const char* point : {"0 0 0", "1 0 0", "0 1 0"}) {
    text += point + others + "\n";
  }
  const auto mesh = parsed(text + "3 0 1 2\n", "a.off");
  CHECK(mesh.points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(faces_of(mesh) == one_triangle);
  REQUIRE(mesh.remarks.size() == 1);
  CHECK_THAT(mesh.remarks[0], Contains("on their lines where the head announces"));
  CHECK_THAT(complaint(text + "3 0 1 3\n", "a.off"), StartsWith("a.off:6: corner 2 of face 0 is `3`"));
}

TEST_CASE("OFF points are divided by a homogeneous coordinate, and of many the first three are kept", "[mesh]") {
  const auto four = parsed("4OFF 3 0 0\n1 2 3 4\n5 6 7 -1\n5 6 7 0\n", "a.off");
  CHECK(four.points == std::vector<Point>{{0.25, 0.5, 0.75}, {-5, -6, -7}, {5, 6, 7}});
  REQUIRE(four.remarks.size() == 2);
  CHECK_THAT(four.remarks[0], Contains("homogeneous"));
  CHECK_THAT(four.remarks[1], StartsWith("1 point has 0 as the homogeneous coordinate and is drawn"));
  CHECK(parsed("4OFF 1 0 0\n1e300 0 0 1e-300\n", "a.off").points == std::vector<Point>{{1e300, 0, 0}});
  const auto plane = parsed("nOFF\n2\n1 0 0\n1 2\n", "a.off");
  CHECK(plane.points == std::vector<Point>{{1, 2, 0}});
  CHECK(parsed("nOFF 5 1 0 0\n1 2 3 4 5\n", "a.off").points == std::vector<Point>{{1, 2, 3}});
  CHECK(parsed("4nOFF 4 1 0 0\n1 2 3 4 5\n", "a.off").points == std::vector<Point>{{1, 2, 3}});
  CHECK_THAT(complaint("nOFF 5\n1 0 0\n1 2 3 4\n", "a.off"), StartsWith("a.off:3: the file ends after 0 of 1 point"));
  CHECK_THAT(complaint("4nOFF 2\n1 0 0\n1 2\n", "a.off"), StartsWith("a.off:3: the file ends after 0 of 1 point"));
}

TEST_CASE("what follows the last face of an OFF file is left out with a remark", "[mesh]") {
  const auto mesh = parsed("OFF 1 0 0\n0 0 0\n{ appearance }\n", "a.off");
  REQUIRE(mesh.remarks.size() == 1);
  CHECK_THAT(mesh.remarks[0], StartsWith("line 3"));
}

TEST_CASE("numbers that are too small for a double read as 0, too large ones are refused", "[mesh]") {
  CHECK(parsed("OFF 1 0 0\n1e-999 -1e-999 4e-310\n", "a.off").points[0] == Point{0, 0, 4e-310});
  CHECK_THAT(complaint("OFF 1 0 0\n1e999 0 0\n", "a.off"), Contains("`1e999` is not finite"));
}

TEST_CASE("OBJ takes every form of corner, continued lines and quads", "[mesh]") {
  const auto mesh = read_fixture("cube.obj");
  CHECK(mesh.points.size() == 8);
  CHECK(faces_of(mesh) == FaceList{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
  CHECK(mesh.remarks.empty());
}

TEST_CASE("OBJ polylines become lines, and foreign statements a remark", "[mesh]") {
  const auto mesh = parsed(
      "v 0 0 0 1\r\nv 1 0 0 1 0.5 0.5\rv 1 1 0\nl 1 2/1 -1\ncurv 1 2\n# a path C:\\\nf 1 2 4\nv 2 2 2\n", "a.obj");
  CHECK(mesh.lines == std::vector<Edge>{{0, 1}, {1, 2}});
  CHECK(faces_of(mesh) == FaceList{{0, 1, 3}});
  REQUIRE(mesh.remarks.size() == 1);
  CHECK(mesh.remarks[0] == "left out 1 statement that this reader does not know, the first is `curv` on line 5");
}

TEST_CASE("ASCII PLY takes properties in any order and skips others", "[mesh]") {
  const auto mesh = read_fixture("tetrahedron.ply");
  CHECK(mesh.points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  CHECK(faces_of(mesh) == tetrahedron);
  REQUIRE(mesh.remarks.size() == 1);
  CHECK(mesh.remarks[0] == "left out 1 row of element `material`");
}

TEST_CASE("binary PLY is read in both byte orders", "[mesh]") {
  const bool big_endian = GENERATE(false, true);
  const auto mesh = parsed(binary_ply(big_endian), "a.ply");
  CHECK(mesh.points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}});
  CHECK(faces_of(mesh) == tetrahedron);
}

TEST_CASE("a PLY header may have any line ends, and its edges become lines", "[mesh]") {
  const std::string end = GENERATE("\n", "\r\n", "\r");
  std::string text;
  for (const char* line :
       {"ply", "format binary_little_endian 1.0", "element vertex 2", "property char x", "property char y",
        "property char z", "element edge 1", "property uchar vertex1", "property uchar vertex2", "end_header"}) {
    text += line + end;
  }
  // The first byte of the data looks like a line end.
  const auto mesh = parsed(text + std::string{"\n\1\2\xff\0\1\0\1", 8}, "a.ply");
  CHECK(mesh.points == std::vector<Point>{{10, 1, 2}, {-1, 0, 1}});
  CHECK(mesh.lines == std::vector<Edge>{{0, 1}});
}

TEST_CASE("ASCII PLY need not have a row a line", "[mesh]") {
  const auto mesh = parsed(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nproperty int y\nproperty int z\nelement face 1\n"
      "property list int int vertex_indices\nend_header\n0 0 0 1 0 0 0 1 0 3 0 1 2",
      "a.ply");
  CHECK(faces_of(mesh) == one_triangle);
}

TEST_CASE("PLY faces may have no corners, and what follows the last row is left out with a remark", "[mesh]") {
  const auto mesh = parsed(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nproperty int y\nproperty int z\nelement face 4\n"
      "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n0\n1 2\n2 0 1\n3 0 2 1\n",
      "a.ply");
  CHECK(faces_of(mesh) == FaceList{{0, 1, 2}, {}, {2}, {0, 1}});
  CHECK(mesh.remarks == std::vector<std::string>{"left out line 17 and what follows after the last element"});
  CHECK(parsed(binary_ply(true) + "tail", "a.ply").remarks.back() == "left out 4 bytes after the last element");
}

TEST_CASE("PLY triangle strips turn over every second triangle, and begin again at -1", "[mesh]") {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 7\nproperty int x\nproperty int y\nproperty int z\nelement tristrips ";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n0 3 0\n";
  const auto mesh = parsed(head + "1\nproperty list int int vertex_indices\nend_header\n" + points +
                               "15 0 1 2 3 4 -1 -1 2 3 -1 4 5 6 -1 6\n",
                           "a.ply");
  CHECK(faces_of(mesh) == FaceList{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 5, 6}});
  CHECK(mesh.remarks == std::vector<std::string>{"left out 2 strips of fewer than three points"});
  const auto rows = parsed(head + "2\nproperty list uchar uint vertex_index\nend_header\n" + points +
                               "4 0 1 2 3\n8 4 5 6 4294967295 3 2 1 0\n",
                           "a.ply");
  CHECK(faces_of(rows) == FaceList{{0, 1, 2}, {2, 1, 3}, {4, 5, 6}, {3, 2, 1}, {1, 2, 0}});
  CHECK(rows.remarks.empty());
}

TEST_CASE("STL is welded, and -0 equals 0", "[mesh]") {
  const auto mesh = read_fixture("tetrahedron.stl");
  CHECK(mesh.points.size() == 4);
  CHECK(faces_of(mesh) == FaceList{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {2, 1, 3}});
  REQUIRE(mesh.remarks.size() == 1);
  CHECK(mesh.remarks[0] == "welded 12 points that coincide into 4");
}

TEST_CASE("binary STL is told by its size, even when it begins with solid", "[mesh]") {
  const std::string head = GENERATE("solid really binary", "FileType: Binary", "");
  const std::string name = GENERATE("a.stl", "unnamed");
  const auto bytes = binary_stl(head, {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{-0.0F, 0, 0}, {0, 1, 0}, {-1, 0, 0}}}});
  const auto mesh = parsed(bytes, name);
  CHECK(mesh.points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}});
  CHECK(faces_of(mesh) == FaceList{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("STL is binary when its content is, even when it begins with solid and its size is not the expected one",
          "[mesh]") {
  const std::string head = GENERATE("solid created by a program that adds to the size", "solid", "SOLID x");
  const std::string name = GENERATE("a.stl", "unnamed");
  const auto bytes = binary_stl(head, {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}});
  for (const std::string tail : {"\n", "12345", " facet "}) {
    const auto mesh = parsed(bytes + tail, name);
    CHECK(faces_of(mesh) == FaceList{{0, 1, 2}, {1, 3, 2}});
    CHECK_THAT(mesh.remarks.at(0), StartsWith("left out " + std::to_string(tail.size()) + " byte"));
  }
  CHECK_THAT(complaint(bytes.substr(0, bytes.size() - 10), name),
             StartsWith(name + ": byte 80: 2 triangles are announced, which takes 184 bytes, but the file has 174"));
}

TEST_CASE("the statements of an STL text may share lines, and end words may be apart", "[mesh]") {
  const std::string facet = "facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n";
  const std::string text = GENERATE_COPY(
      "solid a b c\n" + facet + "endloop\nendfacet\nendsolid a b c\n",
      "solid\n" + facet + "end loop\nend facet\nend solid\n",
      "Solid x\r\nFacet\r\nOuter Loop\r\nVertex 0 0 0\r\nVertex 1 0 0 9\r\nVertex 0 1 0\r\nEndLoop\r\nEnd Facet\r\nEND "
      "SOLID x y\r\n",
      "solid\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid\n");
  for (const auto& whole : {text, text + text.substr(text.find_first_of("sS"))}) {
    const auto mesh = parsed(whole, "a.stl");
    CHECK(mesh.points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(faces_of(mesh) == FaceList(whole.size() == text.size() ? 1 : 2, {0, 1, 2}));
  }
}

TEST_CASE("STL that goes on or stops short is read with a remark", "[mesh]") {
  const auto longer = parsed(binary_stl("", {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}) + "tail", "a.stl");
  CHECK(longer.remarks == std::vector<std::string>{"left out 4 bytes after the last triangle"});
  const auto open = parsed("solid a\n", "a.stl");
  CHECK(open.remarks.size() == 1);
}

TEST_CASE("several solids make one mesh, in upper case too", "[mesh]") {
  const std::string solid =
      "SOLID a\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\nENDSOLID "
      "a\n";
  CHECK(parsed(solid + solid, "a.STL").faces.size() == 2);
}

TEST_CASE("the content tells the format where the name does not", "[mesh]") {
  CHECK(parsed(contents("torus.off"), "torus").faces.size() == 9);
  CHECK(parsed(contents("cube.obj"), "some.cube/file").faces.size() == 6);
  CHECK(parsed(contents("tetrahedron.ply"), "x.txt").faces.size() == 4);
  CHECK(parsed(contents("tetrahedron.stl"), "x").faces.size() == 4);
  CHECK(parsed(contents("torus.off"), "torus.obj", {.format = Format::off, .weld = {}}).faces.size() == 9);
  CHECK_THAT(complaint("hello\n", "x"), StartsWith("x:1: neither the name nor the content"));
}

TEST_CASE("welding with a tolerance joins points to the first one nearby", "[mesh]") {
  const std::string text = "OFF 5 2 0\n0 0 0\n1 0 0\n0 1 0\n1.04 0.04 -0.04\n-0.06 0 0\n3 0 1 2\n3 3 2 4\n";
  CHECK(parsed(text, "a.off").points.size() == 5);
  const auto near = parsed(text, "a.off", {.format = Format::automatic, .weld = 0.05});
  CHECK(near.points.size() == 4);
  CHECK(faces_of(near) == FaceList{{0, 1, 2}, {1, 2, 3}});
  const auto far = parsed(text, "a.off", {.format = Format::automatic, .weld = 0.1});
  CHECK(faces_of(far) == FaceList{{0, 1, 2}, {1, 2, 0}});
  CHECK(parsed("OFF 2 0 0\n-0 0 0\n0 0 0\n", "a.off", {.format = Format::automatic, .weld = 0.0}).points.size() == 1);
  CHECK_FALSE(parse_mesh(text, "a.off", {.format = Format::automatic, .weld = -1.0}));
  CHECK_FALSE(
      parse_mesh(text, "a.off", {.format = Format::automatic, .weld = std::numeric_limits<double>::quiet_NaN()}));
}

TEST_CASE("point clouds and faces of one or two corners are read as they are", "[mesh]") {
  CHECK(parsed("OFF\n2 0 0\n0 0 0\n1 1 1\n", "a.off").points.size() == 2);
  CHECK(parsed("v 0 0 0\n", "a.obj").points.size() == 1);
  CHECK(faces_of(parsed("OFF 2 3 0\n0 0 0\n1 1 1\n1 0\n2 0 1\n3 0 0 1\n", "a.off")) ==
        FaceList{{0}, {0, 1}, {0, 0, 1}});
}

TEST_CASE("a file that cannot be read is an error of its own kind", "[mesh]") {
  for (const auto& path : {mesh_path("absent.off"), mesh_path("")}) {
    const auto mesh = read_mesh(path);
    REQUIRE_FALSE(mesh);
    CHECK(mesh.error().code == Errc::io);
  }
  CHECK(read_mesh(mesh_path("torus.off")));
}

TEST_CASE("broken files are refused with their name and line", "[mesh]") {
  const auto [file, what] = GENERATE(table<std::string, std::string>({
      {"wrong_index.off", ":6: corner 2 of face 0 is `3`, points are numbered from 0 to 2"},
      {"wrong_count.off", ":2: 4000000000 points and 1 face are announced, but only 26 bytes follow"},
      {"wrong_end.off", ":1: nothing in the place of the number of points"},
      {"wrong_number.obj", ":3: a point: `nan` is not finite, a coordinate is a finite number"},
      {"wrong_list.ply", ":13: the file ends in row 0 of the 1 of element `face`"},
      {"wrong_loop.stl", ":7: `vertex` in the place of `endloop` of a facet"},
  }));
  const auto mesh = read_mesh(mesh_path(file));
  REQUIRE_FALSE(mesh);
  CHECK(mesh.error().code == Errc::bad_input);
  CHECK_THAT(mesh.error().what, StartsWith(mesh_path(file) + what));
}

TEST_CASE("broken texts are refused at the line that is wrong", "[mesh]") {
  const std::string ply_head = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n";
  const auto [name, text, what] = GENERATE_COPY(table<std::string, std::string, std::string>({
      {"a.off", "", ":1: the file is empty"},
      {"a.off", " \n\n", ":1: the file is empty"},
      {"a.off", "\xff\xfeO", ":1: the text is UTF-16"},
      {"a.off", "appearance {\n", ":1: `appearance` in the place of the head"},
      {"a.off", "OFF BINARY\n", ":1: binary OFF is not read"},
      {"a.off", "OFF\n-1 0 0\n", ":2: `-1` in the place of the number of points"},
      {"a.off", "OFF\n1 x 0\n", ":2: `x` in the place of the number of faces"},
      {"a.off", "nOFF 0 1 0 0\n", ":1: points of nOFF have 1 to 1000"},
      {"a.off", "nOFF 9999999999 1 0 0\n", ":1: points of nOFF have 1 to 1000"},
      {"a.off", "OFF\n18446744073709551615 1 0\n0 0 0\n", ":2: `18446744073709551615` in the place"},
      {"a.off", "OFF\n9223372036854775807 9223372036854775807 0\n0 0 0\n", ":2: 9223372036854775807 points"},
      {"a.off", "OFF\n2 0 0\n0 0 0\n# 123456789\n", ":4: the file ends after 1 of 2 points"},
      {"a.off", "OFF\n1 0 0\n0 0\n", ":3: the file ends after 0 of 1 point"},
      {"a.off", "COFF\n1 0 0\n0 0 0 255 0 x 255\n", ":3: `x` in the place of number 2 of the normal, colour"},
      {"a.off", "OFF\n1 1 x\n0 0 0\n1 0\n", ":2: `x` in the place of the number of edges"},
      {"a.off", "noff\n3 1 0\n", ":1: `noff` may be NOFF, with normals, or nOFF, with a dimension"},
      {"a.off", "CCOFF\n1 0 0\n", ":1: `CCOFF` in the place of the head of an OFF file"},
      {"a.off", "OFF\n1 0 0\n0 1,5 0\n", ":3: coordinate 1 of point 0: `1,5` is not a number"},
      {"a.off", "OFF\n1 0 0\n0 -inf 0\n", ":3: coordinate 1 of point 0: `-inf` is not finite"},
      {"a.off", "OFF\n1 2 0\n0 0 0\n1 0\n#\n", ":5: the file ends after 1 of 2 faces"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n0\n", ":4: face 0 begins with `0`"},
      {"a.off", "OFF\n1 1 0\n0 0 0\nx\n", ":4: face 0 begins with `x`"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n4000000000 0\n",
       ":4: face 0 announces 4000000000 corners, but the file ends after 1"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 -1\n", ":4: corner 2 of face 0 is `-1`"},
      {"a.obj", "# only\n", ":1: there is no point"},
      {"a.obj", "v 1 2\n", ":1: a point: nothing is not a number"},
      {"a.obj", "v 1 2 3\nf 1 0 1\n", ":2: `0` does not name a point"},
      {"a.obj", "v 1 2 3\nf 1 -2 1\n", ":2: `-2` does not name a point, a number from 1 or from -1 to -1"},
      {"a.obj", "v 1 2 3\nf 1/1/1 1/x 1\n", ":2: `1/x` does not name a point"},
      {"a.obj", "v 1 2 3\nf /1\n", ":2: `/1` does not name a point"},
      {"a.obj", "v 1 2 3\nf 99999999999 1 1\n", ":2: `99999999999` does not name a point"},
      {"a.obj", "v 1 2 3\nf 1 1 \\\n 7\nf 1 2 1\n", ":2: point 7 is named, but the file has only 1"},
      {"a.obj", "v 1 2 3\nf\n", ":2: a face without corners"},
      {"a.obj", "v 1 2 3\nl 1\n", ":2: a line with fewer than two points"},
      {"a.ply", "plywood\n", ":1: a PLY file begins with a line `ply`"},
      {"a.ply", "ply\nend_header\n", ":2: the header ends without a line `format"},
      {"a.ply", "ply\nformat binary 1.0\n", ":2: the format `binary` is unknown"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex x\n", ":3: element `vertex` has `x` in the place"},
      {"a.ply", "ply\nproperty float x\n", ":2: a property before any `element`"},
      {"a.ply", "ply\nelement v 1\nproperty quad x\n", ":3: `quad` `x` is not a property"},
      {"a.ply", "ply\nelement v 1\nproperty list float int x\n", ":3: a list counts its entries in `float`"},
      {"a.ply", "ply\nlement v 1\n", ":2: `lement` in the header"},
      {"a.ply", "ply\nformat ascii 1.0\n", ":2: the file ends before `end_header`"},
      {"a.ply", "ply\nformat ascii 1.0\nend_header\n", ":3: the header announces no element `vertex`"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nend_header\n", ":4: element `vertex` has no property"},
      {"a.ply", ply_head + "end_header\n0 0\n", ":6: element `vertex` lacks a property, `x`, `y` and `z`"},
      {"a.ply", ply_head + "property list int int z\nend_header\n0 0 1 1\n", ":7: element `vertex` lacks a property"},
      {"a.ply", ply_head + "property float z\nend_header\n0 a 1\n", ":8: `a` is not a number in row 0"},
      {"a.ply", ply_head + "property float z\nend_header\n0 0 inf\n", ":8: a coordinate of point 0 is not finite"},
      {"a.ply",
       ply_head + "property float z\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\n"
                  "end_header\n0 0 0\n0 0 0\n",
       ":11: element `vertex` is announced twice"},
      {"a.ply", ply_head + "property float z\nelement face 1\nproperty int q\nend_header\n0 0 0\n3\n",
       ":9: element `face` lacks a property, `vertex_indices`"},
      {"a.ply",
       ply_head + "property float z\nelement face 1\nproperty list int int vertex_index\nend_header\n0 0 0\n-1\n",
       ":11: the length of a list"},
      {"a.ply",
       ply_head + "property float z\nelement face 1\nproperty list int int vertex_index\nend_header\n0 0 0\n1 1\n",
       ":11: 1 does not number a point"},
      {"a.ply",
       ply_head + "property float z\nelement face 1\nproperty list int float vertex_index\nend_header\n0 0 0\n1 0.5\n",
       ":11: 0.5 does not number a point"},
      {"a.ply",
       ply_head +
           "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n2 0 -2\n",
       ":11: -2 does not number a point"},
      {"a.ply", ply_head + "property float z\nelement tristrips 1\nproperty int vertex_indices\nend_header\n0 0 0\n0\n",
       ":9: element `tristrips` lacks a property, `vertex_indices`"},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", ":4: nothing is not a number"},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", ":4: nothing in the place of `vertex`"},
      {"a.stl", "solid a\nfacet\nvertex 0 0 0\n", ":3: `vertex` in the place of `outer` of a facet"},
      {"a.stl", "solid a\nsolid b\n", ":2: `solid` in a place where `facet` or `endsolid` is expected"},
      {"a.stl", "solid a\nendsolid\nfacet\n", ":3: `facet` in a place where `solid` is expected"},
  }));
  CHECK_THAT(complaint(text, name), StartsWith(name + what));
}

TEST_CASE("broken binary files are refused at the byte that is wrong", "[mesh]") {
  CHECK_THAT(complaint("not a mesh", "a.stl"), StartsWith("a.stl: byte 10: the file ends"));
  auto stl = binary_stl("", {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}});
  CHECK_THAT(complaint(stl.substr(0, 130), "a.stl"),
             StartsWith("a.stl: byte 80: 1 triangle is announced, which takes 134"));
  stl.replace(80, 4, "\xff\xff\xff\xff");
  CHECK_THAT(complaint(stl, "a.stl"), StartsWith("a.stl: byte 80: 4294967295 triangles are announced"));
  const float infinite = std::numeric_limits<float>::infinity();
  CHECK_THAT(complaint(binary_stl("", {{{{0, 0, 0}, {1, infinite, 0}, {0, 1, 0}}}}), "a.stl"),
             StartsWith("a.stl: byte 112: a coordinate of triangle 0 is not finite"));

  const auto ply = binary_ply(false);
  const auto end = std::to_string(ply.size() - 1);
  CHECK_THAT(complaint(ply.substr(0, ply.size() - 1), "a.ply"),
             StartsWith("a.ply: byte " + end + ": the file ends in row 3 of the 4 of element `face`"));
  auto wrong = ply;
  wrong[ply.size() - 2 - 3] = 9;  // the lowest byte of the last corner
  CHECK_THAT(complaint(wrong, "a.ply"), Contains(": 9 does not number a point, the 4 points are numbered from 0"));
  wrong = ply;
  wrong.replace(wrong.find("vertex 4"), 8, "vertex 4000000000");
  CHECK_THAT(complaint(wrong, "a.ply"), Contains(": 4000000000 rows of element `vertex` are announced, but only "));
}

}  // namespace sesame::tools
