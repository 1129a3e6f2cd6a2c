// What an export writes of an object: matrices, facets, drawings, plain scripts.
#include <filesystem>
#include <memory>

#include "replay/export/boundary_matrices.hpp"
#include "replay/export/drawing.hpp"
#include "replay/export/facets.hpp"
#include "replay/export/plain_script.hpp"
#include "replay/export/positions.hpp"
#include "tests/replay/replay_support.hpp"

using namespace sesame;
using namespace sesame::tests;
using Catch::Contains;
using Catch::EndsWith;
using replay::BoundaryTerm;
using replay::ObjectCells;
using replay::Positions;

namespace {

constexpr std::uint64_t any_number = UINT64_MAX;

/// An object that a script has built, with the positions that it gave.
struct Built {
  explicit Built(const std::string& script) {
    replay::ReplayOptions options;
    options.engine = &engine;
    options.observer = [this](const ops::Operation& operation, const engine::StepReport& report) {
      positions.take(operation, report, engine->structure());
    };
    const Replayed replayed = replay_text(script, nullptr, options);
    CHECK(replayed.errors.empty());
  }
  Built(const Built&) = delete;
  Built& operator=(const Built&) = delete;
  ~Built() = default;

  [[nodiscard]] ObjectCells cells() const { return ObjectCells::list(engine->structure(), any_number).value(); }
  [[nodiscard]] std::vector<std::uint32_t> corners(const std::string& name) const {
    std::vector<std::uint32_t> corners;
    cells().corners(engine->structure().find(engine->structure().lookup(name).value()), corners);
    return corners;
  }
  [[nodiscard]] std::vector<ops::Point> points() const { return positions.of_vertices(cells()).value().points; }

  std::unique_ptr<engine::Engine> engine;
  Positions positions;
};

Built build(const std::vector<std::string>& steps) { return Built{joined({header_line}) + joined(steps)}; }

using Writer = void (*)(const ObjectCells&, std::ostream&);
std::string written(Writer write, const Built& built) {
  std::ostringstream out;
  write(built.cells(), out);
  return out.str();
}

Result<std::string> facets_of(const Built& built) {
  std::ostringstream out;
  const Status written = replay::write_facets(built.cells(), out);
  if (!written) {
    CHECK(out.str().empty());
    return written.error();
  }
  return out.str();
}

std::string plain(const std::vector<std::string>& steps, const replay::PlainScriptOptions& options = {}) {
  replay::ScriptReader script(replay::ByteSource::of_text(joined({header_line}) + joined(steps), "script"));
  std::ostringstream out;
  const Result<bool> written = write_plain_script(script, options, out);
  return written ? out.str() : written.error().what;
}

const std::string unit_square = R"({"op":"simploid","name":"q","type":[1,1],"at":[[0,0],[0,1],[1,0],[1,1]]})";
const std::string opposite_sides = R"({"op":"identify","pairs":[["q.0-1x0","q.0-1x1"],["q.0x0-1","q.1x0-1"]]})";
const std::string one_edge = R"({"op":"simplex","name":"e","dim":1})";

}  // namespace

TEST_CASE("boundaries of exported boundaries are zero in every example") {
  std::vector<BoundaryTerm> boundary;
  std::vector<BoundaryTerm> of_face;
  for (const auto& file : std::filesystem::directory_iterator(SESAME_TEST_EXAMPLES)) {
    if (file.path().extension() != ".jsonl") {
      continue;
    }
    const Built built(text_of_file(file.path().string()));
    const ObjectCells cells = built.cells();
    for (std::size_t p = 2; p < cells.dimensions(); ++p) {
      for (const ops::CellId cell : cells.of(p)) {
        std::vector<int> sums(cells.of(p - 2).size(), 0);
        cells.boundary(cell, boundary);
        for (const auto& [face, coefficient] : boundary) {
          cells.boundary(cells.of(p - 1)[face], of_face);
          for (const BoundaryTerm& term : of_face) {
            sums[term.face] += coefficient * term.coefficient;
          }
        }
        CHECK(sums == std::vector<int>(sums.size(), 0));
      }
    }
  }
}

TEST_CASE("an exported object has the cells that are counted, and each knows its number") {
  for (const char* name : {"torus", "undo", "product_of_circles", "ungluing_in_any_order", "squashed_boundaries"}) {
    const Built built(example(name));
    const ObjectCells cells = built.cells();
    const auto counts = built.engine->cells();
    REQUIRE(cells.dimensions() == counts.size());
    for (std::size_t p = 0; p < counts.size(); ++p) {
      REQUIRE(cells.of(p).size() == counts[p]);
      for (std::uint32_t k = 0; k < counts[p]; ++k) {
        CHECK(cells.number(cells.of(p)[k]) == k);
        CHECK(built.engine->structure().dimension(cells.of(p)[k]) == static_cast<int>(p));
      }
    }
    CHECK(cells.of(counts.size()).empty());
  }
}

TEST_CASE("products are written out up to a number of cells") {
  const Built built = build({one_edge, R"({"op":"product","name":"P","left":"e","right":"e"})"});
  const auto few = ObjectCells::list(built.engine->structure(), 8);
  REQUIRE_FALSE(few);
  CHECK(few.error().code == Errc::refused);
  CHECK_THAT(few.error().what, Contains("the object has 9 cells"));
  CHECK(ObjectCells::list(built.engine->structure(), 9).value().size() == 9);
  const Built plain_cells = build({one_edge});
  CHECK(ObjectCells::list(plain_cells.engine->structure(), 0).value().size() == 3);
}

TEST_CASE("the corners of a cell are those of its type in lexicographic order") {
  const Built prism = build({R"({"op":"simploid","name":"p","type":[2,1]})"});
  CHECK(prism.corners("p") == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
  CHECK(prism.corners("p.0-2x1") == std::vector<std::uint32_t>{1, 5});
  CHECK(build({unit_square, opposite_sides}).corners("q") == std::vector<std::uint32_t>{0, 0, 0, 0});
  const Built squashed =
      build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"degenerate","cell":"t.0-1","along":0})"});
  CHECK(squashed.corners("t") == std::vector<std::uint32_t>{0, 0, 1});
}

TEST_CASE("the corners of a glued cell are in the order of its canonical name") {
  const Built built =
      build({one_edge, R"({"op":"simplex","name":"t","dim":2})", R"({"op":"identify","pairs":[["t.0-1","e",[1,0]]]})"});
  CHECK(built.corners("e") == std::vector<std::uint32_t>{0, 1});
  CHECK(built.corners("t") == std::vector<std::uint32_t>{1, 0, 2});
}

TEST_CASE("matrices over the integers keep what cancels mod 2") {
  const Built built = build({R"({"op":"complex","name":"K","cells":[{"id":"v"},{"id":"e","faces":["v","v"]},)"
                             R"({"id":"f","faces":["v","v"]},{"id":"t","faces":["e","f","e"]}]})"});
  CHECK(written(replay::write_phat, built) == "0\n1\n1\n2 2\n");
  std::ostringstream out;
  replay::write_matrix_market(built.cells(), 2, out);
  CHECK(out.str() ==
        "%%MatrixMarket matrix coordinate integer general\n"
        "% the boundary from dimension 2 to 1: 2 rows, 1 columns\n"
        "% rows and columns are cells by age, oriented as their names say\n"
        "% row 1: K.e\n% row 2: K.f\n% column 1: K.t\n2 1 2\n1 1 2\n2 1 -1\n");
  const std::string words = written(replay::write_phat_binary, built);
  CHECK(words.size() == 8 * (1 + 2 * 4 + 1));
  CHECK(words.substr(0, 16) == std::string("\4\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 16));
}

TEST_CASE("facets have the labels of integers, or numbers with names behind the list") {
  const Built labels = build({R"({"op":"insert","simplices":[[9,2,4],[7]]})"});
  CHECK(facets_of(labels).value() == "# a simplicial complex of dimension 2: 4 vertices, 2 facets\n[[7],\n [2,4,9]]\n");
  const Built names = build({R"({"op":"insert","simplex":[1,"b"]})", one_edge});
  CHECK(facets_of(names).value() ==
        "# a simplicial complex of dimension 1: 4 vertices, 2 facets\n[[0,1],\n [2,3]]\n"
        "# 0: {1}\n# 1: {b}\n# 2: e.0\n# 3: e.1\n");
}

TEST_CASE("an object that is no simplicial complex has no facets, and a cell in the way is named") {
  const auto complaint = [](const std::vector<std::string>& steps) {
    const Built built = build(steps);
    const auto facets = facets_of(built);
    REQUIRE_FALSE(facets);
    CHECK(facets.error().code == Errc::refused);
    return facets.error().what;
  };
  CHECK_THAT(complaint({unit_square}), EndsWith("\"q\" is a cube of dimension 2, and should be a simplex"));
  CHECK_THAT(complaint({one_edge, R"({"op":"identify","pairs":[["e.0","e.1"]]})"}),
             EndsWith("\"e\" has the vertex \"e.0\" more than once"));
  CHECK_THAT(complaint({one_edge, R"({"op":"simplex","name":"f","dim":1})",
                        R"({"op":"identify","pairs":[["e.0","f.0"],["e.1","f.1"]]})"}),
             EndsWith("\"e\" and \"f\" have the same vertices"));
  CHECK_THAT(complaint({one_edge, R"({"op":"undo"})"}), Contains("no cells"));
}

TEST_CASE("vertices are where they were put, the oldest place of several") {
  const Built built = build({unit_square, opposite_sides});
  CHECK(built.points() == std::vector<ops::Point>{{0, 0, 0}});
  CHECK(built.positions.of_vertices(built.cells()).value().torn == 1);
  const Built same = build({unit_square, R"({"op":"simplex","name":"v","dim":0,"at":[[1,1]]})",
                            R"({"op":"identify","pairs":[["v","q.1x1"]]})"});
  CHECK(same.positions.of_vertices(same.cells()).value().torn == 0);
  CHECK(same.points() == std::vector<ops::Point>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}});
}

TEST_CASE("a position that was undone is none, and the vertex without one is named") {
  const std::string at = R"({"op":"simplex","name":"e","dim":1,"at":[[0,0],[1,0]]})";
  const Built built = build({at, R"({"op":"undo"})", one_edge});
  const auto points = built.positions.of_vertices(built.cells());
  REQUIRE_FALSE(points);
  CHECK_THAT(points.error().what, Contains("the vertex \"e.0\" has no position"));
  CHECK(build({one_edge, R"({"op":"undo"})", at}).points() == std::vector<ops::Point>{{0, 0, 0}, {1, 0, 0}});
}

TEST_CASE("apexes, copies and vertices below large cones have positions") {
  const Built built =
      build({R"({"op":"complex","name":"K","cells":[{"id":"e","faces":["b","a"]},{"id":"b","at":[1,0]},)"
             R"({"id":"a","at":[0,0]}]})",
             R"({"op":"suspend","apexes":["n","s"],"over":["K.b"],"at":[[0,0,1],[0,0,-1]]})",
             R"({"op":"deidentify","split":[{"cell":"K.b","as":"c","moves":[["K.e",0]]}]})"});
  CHECK(built.points() == std::vector<ops::Point>{{1, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}});

  engine::Engine engine(sparse::Integers{}, ops::Limits{.cells_of_explicit_cone = 0});
  Positions positions;
  engine.observe([&](const ops::Operation& operation, const engine::StepReport& report) {
    positions.take(operation, report, engine.structure());
  });
  REQUIRE(engine.apply(ops::parse_operation(unit_square).value()));
  REQUIRE(engine.apply(ops::MakeCone{"v", "q", ops::Point{5, 5, 5}}));
  REQUIRE(engine.structure().lazy().families() == 1);
  const auto cells = ObjectCells::list(engine.structure(), any_number).value();
  CHECK(positions.of_vertices(cells).value().points ==
        std::vector<ops::Point>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {5, 5, 5}});
}

TEST_CASE("squares go round, and corners in a row that are one point are one") {
  const Built built = build({unit_square});
  const ObjectCells cells = built.cells();
  std::ostringstream out;
  CHECK(replay::write_obj({cells, built.points(), {}}, out).empty());
  CHECK(out.str() ==
        "# 4 vertices, 4 edges, 1 faces\nv 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\ng faces\nf 1 3 4 2\n"
        "g edges\nl 1 2\nl 1 3\nl 2 4\nl 3 4\n");
  const Built squashed = build({unit_square, R"({"op":"degenerate","cell":"q.0-1x0","along":0})"});
  const ObjectCells three = squashed.cells();
  std::ostringstream triangle;
  CHECK(replay::write_obj({three, squashed.points(), {}}, triangle).empty());
  CHECK_THAT(triangle.str(), Contains("\nf 1 3 2\n"));
  const Built point = build({unit_square, opposite_sides});
  const ObjectCells one = point.cells();
  std::ostringstream none;
  CHECK(replay::write_obj({one, point.points(), {}}, none).size() == 1);
  CHECK_THAT(none.str(), Contains("1 vertices, 2 edges, 0 faces"));
}

TEST_CASE("generators are named by their degree and number, and loops run along their edges") {
  const Built built = build({unit_square, opposite_sides});
  const ObjectCells cells = built.cells();
  auto generators = replay::named_generators(*built.engine, {}, 3, cells.size(), nullptr).value();
  std::vector<std::string> names;
  for (const auto& named : generators) {
    names.push_back(named.name);
  }
  CHECK(names == std::vector<std::string>{"H0_0", "H1_0", "H1_1", "H2_0"});
  std::ostringstream out;
  (void)replay::write_obj({cells, built.points(), generators}, out);
  CHECK_THAT(out.str(), EndsWith("# H1_0, free\ng H1_0\nl 1 1\n# H1_1, free\ng H1_1\nl 1 1\n"));
  const replay::CoefficientColumn column(cells, generators[1].generator);
  CHECK(column.is_integral());
  CHECK(column.degree() == 1);
  CHECK(column[0] + column[1] == 1);
  const auto refused = replay::named_generators(*built.engine, {}, 3, 100'000'000, nullptr);
  REQUIRE_FALSE(refused);
  CHECK_THAT(refused.error().what, Contains("--generators=DEGREES"));
}

TEST_CASE("cells of dimensions above 3 are no cells of a grid, which says so") {
  const Built built = build({R"({"op":"simplex","name":"t","dim":4,"at":[[0,0],[1,0],[0,1],[1,1],[2,2]]})"});
  const ObjectCells cells = built.cells();
  std::ostringstream out;
  const replay::Remarks remarks = replay::write_vtk({cells, built.points(), {}}, out);
  REQUIRE(remarks.size() == 1);
  CHECK_THAT(remarks.front(), Contains("1 cells of dimensions above 3"));
  CHECK_THAT(out.str(), Contains("\nCELLS 30 105\n"));
}

TEST_CASE("a plain script has all steps in canonical form, or those that were not taken back") {
  const auto vertex = [](const std::string& name) { return R"({"op":"simplex","name":")" + name + R"(","dim":0})"; };
  const std::string undo = R"({"op":"undo","steps":2})";
  const std::vector<std::string> steps{"# a comment", vertex("a"), vertex("b"), R"({ "op":"note", "text":"x" })",
                                       undo,          vertex("c")};
  CHECK(plain(steps) ==
        joined({header_line, vertex("a"), vertex("b"), R"({"op":"note","text":"x"})", undo, vertex("c")}));
  CHECK(plain(steps, {.without_undone = true}) == joined({header_line, vertex("a"), vertex("c")}));
  CHECK(plain(steps, {.without_undone = true, .until = 2}) == joined({header_line, vertex("a"), vertex("b")}));
  CHECK_THAT(plain({vertex("a"), undo}, {.without_undone = true}),
             Contains("script:3: there are 1 steps that can be undone"));
}
