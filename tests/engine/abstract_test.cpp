// Abstract simplicial complexes under insertions and collapses: homology, laws, undo, persistence.
#include "sparse/smith.hpp"
#include "tests/support/abstract_steps.hpp"
#include "tests/support/engines.hpp"

using namespace sesame;
using namespace sesame::tests;
using Catch::Matchers::Contains;
using engine::Bar;
using engine::Barcode;

namespace {

const std::vector<std::string> rings{"Z", "Z/2", "Z/3"};

void insert_all(Engine& engine, const std::vector<std::vector<std::string>>& simplices) {
  for (const auto& simplex : simplices) {
    carry_out(engine, insert(simplex));
  }
}

std::vector<AbelianGroup> groups_of(const std::vector<std::vector<std::string>>& simplices,
                                    const std::vector<std::pair<std::string, std::string>>& collapses,
                                    const std::string& ring) {
  Engine engine(ring_named(ring));
  insert_all(engine, simplices);
  for (const auto& [from, to] : collapses) {
    carry_out(engine, collapse(from, to));
    CHECK(engine.first_defect().value_or("") == "");
  }
  return live_groups(engine);
}

/// The same with every edge of the simplices cut in the middle and every triangle in four, the middle of {a,b} being
/// the vertex "a-b"; as a list of triangles.
std::vector<std::vector<std::string>> subdivided(const std::vector<std::vector<std::string>>& triangles) {
  const auto middle = [](const std::string& a, const std::string& b) { return std::min(a, b) + "-" + std::max(a, b); };
  std::vector<std::vector<std::string>> parts;
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      parts.push_back({t[k], middle(t[k], t[(k + 1) % 3]), middle(t[k], t[(k + 2) % 3])});
    }
    parts.push_back({middle(t[0], t[1]), middle(t[0], t[2]), middle(t[1], t[2])});
  }
  return parts;
}

/// A chain of cells of the past, as the cells that they are now.
CellChain carried_forward(const ops::Structure& structure, const CellChain& chain, const std::vector<int>& signs) {
  CellChain image{chain.degree, {}};
  for (std::size_t k = 0; k < chain.terms.size(); ++k) {
    const auto [cell, sign] = structure.forest().find_oriented(chain.terms[k].generator);
    if (cell != ops::none) {
      const int total = sign * signs[k] * structure.directory().sign_of_name(cell);
      image.terms.push_back({total > 0 ? chain.terms[k].coefficient : -chain.terms[k].coefficient, cell});
    }
  }
  return sum({chain.degree, {}}, 1, image, ring_named("Z"));
}

/// A basis of homology at some step, as cells and the signs with which their names stood for them.
struct PastBasis {
  std::vector<std::vector<std::pair<CellChain, std::vector<int>>>> cycles;  ///< by degree
};

PastBasis basis_now(Engine& engine) {
  PastBasis basis;
  for (int p = 0; p < static_cast<int>(engine.cells().size()); ++p) {
    auto& cycles = basis.cycles.emplace_back();
    for (const engine::Generator& generator : engine.generators(p)) {
      std::vector<int> signs;
      for (const auto& term : generator.cycle.terms) {
        signs.push_back(engine.structure().directory().sign_of_name(term.generator));
      }
      cycles.emplace_back(generator.cycle, signs);
    }
  }
  return basis;
}

/// The rank of the map from homology then to homology now.
template <sparse::Ring R>
std::size_t rank_of_map(Engine& engine, const R& ring, const PastBasis& basis, std::size_t p) {
  if (p >= basis.cycles.size() || p >= engine.cells().size()) {
    return 0;
  }
  const auto rows = static_cast<sparse::Index>(engine.homology().betti[p]);
  sparse::Matrix<R> matrix(ring, rows, 0);
  for (const auto& [cycle, signs] : basis.cycles[p]) {
    const ClassAnswer answer = engine.classify(carried_forward(engine.structure(), cycle, signs));
    REQUIRE(answer.is_cycle);
    sparse::RawTerms<R> column;
    for (std::size_t k = 0; k < answer.coefficients.size(); ++k) {
      column.push_back({static_cast<sparse::Index>(k), from_rational(ring, answer.coefficients[k])});
    }
    matrix.append_column(std::move(column).normal(ring));
  }
  return sparse::invariant_factors(matrix).size();
}

std::size_t bars_over(const Barcode& barcode, std::size_t p, double from, double to) {
  return static_cast<std::size_t>(std::count_if(barcode.bars.begin(), barcode.bars.end(), [&](const Bar& bar) {
    return bar.dimension == static_cast<int>(p) && bar.birth <= from && bar.death > to;
  }));
}

}  // namespace

TEST_CASE("a list of simplices is one step, which undo takes back", "[engine]") {
  const std::string projective_plane =
      R"({"op":"insert","simplices":[[1,2,3],[1,2,6],[1,3,4],[1,4,5],[1,5,6],[2,3,5],[2,4,5],[2,4,6],[3,4,6],[3,5,6]]})";
  Engine engine(ring_named("Z"));
  carry_out(engine, insert({"1", "2", "7"}));
  const engine::StepReport report = carry_out(engine, operation(projective_plane));
  CHECK(report.already == 0);
  CHECK(report.sequence.has_value());
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}, {0, {2}}});
  CHECK(engine.first_defect().value_or("") == "");
  CHECK(carry_out(engine, operation(projective_plane)).already == 10);
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, ops::Undo{2});
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}});
  CHECK(engine.cells()[0] == 3);
}

TEST_CASE("a circle is contracted to a point", "[engine]") {
  for (const std::string& ring : rings) {
    CAPTURE(ring);
    Engine engine(ring_named(ring));
    insert_all(engine, {{"0", "1"}, {"1", "2"}, {"2", "3"}, {"3", "0"}});
    CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}, {1, {}}});
    carry_out(engine, collapse("0", "1"));
    CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}, {1, {}}});
    carry_out(engine, collapse("1", "2"));
    CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}});
    carry_out(engine, collapse("2", "3"));
    CHECK(engine.cells().size() == 1);
    CHECK(engine.first_defect().value_or("") == "");
  }
}

TEST_CASE("a projective plane that is subdivided and contracted keeps its torsion", "[engine]") {
  const auto fine = subdivided(projective_plane());
  std::vector<std::pair<std::string, std::string>> collapses;
  for (int a = 1; a <= 6; ++a) {
    for (int b = a + 1; b <= 6; ++b) {
      collapses.emplace_back(std::to_string(a) + "-" + std::to_string(b), std::to_string((a + b) % 2 == 0 ? a : b));
    }
  }
  const std::vector<AbelianGroup> integral{{1, {}}, {0, {2}}};
  CHECK(groups_of(fine, {}, "Z") == integral);
  CHECK(groups_of(fine, collapses, "Z") == integral);
  CHECK(groups_of(fine, collapses, "Z/2") == std::vector<AbelianGroup>{{1, {}}, {1, {}}, {1, {}}});
  CHECK(groups_of(fine, collapses, "Z/3") == std::vector<AbelianGroup>{{1, {}}});
}

TEST_CASE("orders of vertices that do not agree keep torsion and orientations right", "[engine]") {
  // Labels such that every collapse meets edges the other way round.
  std::vector<std::vector<std::string>> triangles = subdivided(projective_plane());
  std::vector<std::pair<std::string, std::string>> collapses;
  for (int a = 1; a <= 6; ++a) {
    for (int b = a + 1; b <= 6; ++b) {
      collapses.emplace_back(std::to_string(a) + "-" + std::to_string(b), std::to_string(a * b % 3 == 0 ? a : b));
    }
  }
  Engine engine(ring_named("Z"));
  insert_all(engine, triangles);
  for (const auto& [from, to] : collapses) {
    carry_out(engine, collapse(from, to));
  }
  CHECK_FALSE(engine.structure().bodies().kind(0).keeps_orders);
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}, {0, {2}}});
  CHECK(engine.first_defect().value_or("") == "");
  const auto generators = engine.generators(1);
  REQUIRE(generators.size() == 1);
  CHECK(generators[0].order == Integer{2});
  CHECK(engine.maps().boundary(generators[0].cycle).terms.empty());
}

TEST_CASE("edges that are merged head to tail cancel, and do not when they are merged head to head", "[engine]") {
  // The circle a b c d; c becomes a: the edges ab, bc become one, passed in both directions.
  Engine engine(ring_named("Z"));
  insert_all(engine, {{"a", "b"}, {"b", "c"}, {"c", "d"}, {"a", "d"}});
  carry_out(engine, collapse("c", "a"));
  const auto chain = [&](const std::vector<std::pair<Integer, std::string>>& terms) {
    return engine.chain(terms).value();
  };
  CHECK(chain({{1, "{a,b}"}, {1, "{b,c}"}}).terms.empty());
  CHECK(chain({{1, "{a,b}"}, {-1, "{b,c}"}}).terms.size() == 1);
  CHECK(chain({{1, "{a,d}"}, {1, "{c,d}"}}).terms.front().coefficient == Integer{2});
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{{1, {}}});
}

TEST_CASE("classes are asked for by any name of a cell, with the orientation of that name", "[engine]") {
  Engine engine(ring_named("Z"));
  insert_all(engine, {{"a", "b"}, {"b", "c"}, {"a", "c"}, {"p", "z"}, {"q", "z"}, {"r", "z"}});
  carry_out(engine, collapse("a", "z"));  // the loop goes b, c, z now
  const auto coefficient = [&](const std::vector<std::pair<Integer, std::string>>& terms) {
    const ClassAnswer answer = engine.classify(engine.chain(terms).value());
    REQUIRE(answer.is_cycle);
    return answer.coefficients.at(0);
  };
  const sparse::Rational once = coefficient({{1, "{a,b}"}, {1, "{b,c}"}, {-1, "{a,c}"}});
  CHECK((once == Integer{1} || once == Integer{-1}));
  CHECK(coefficient({{-1, "{b,z}"}, {1, "{b,c}"}, {1, "{c,z}"}}) == once);
  CHECK(coefficient({{1, "{z,b}"}, {-1, "{c,b}"}, {1, "{c,z}"}}) == once);
  // A generator that is written down and read again is the same class.
  const CellChain cycle = engine.generators(1).at(0).cycle;
  std::vector<std::pair<Integer, std::string>> written;
  for (const auto& [factor, cell] : cycle.terms) {
    written.emplace_back(factor.numerator(), engine.structure().name(cell));
  }
  CHECK(coefficient(written) == Integer{1});
}

TEST_CASE(
    "a name that lists vertices out of order is the opposite cell in chains, and so are cones and products over it",
    "[engine]") {
  Engine engine(ring_named("Z"));
  insert_all(engine, {{"0", "2", "10"}});
  build(engine, {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"cone","apex":"v"})",
                 R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"f","dim":1})",
                 R"({"op":"product","name":"P","left":"e","right":"f"})"});
  const auto chain = [&](const std::vector<std::pair<Integer, std::string>>& terms) {
    return engine.chain(terms).value();
  };
  for (const auto& [one, other] : std::vector<std::pair<std::string, std::string>>{{"{2,0}", "{0,2}"},
                                                                                   {"{2,0,10}", "{0,2,10}"},
                                                                                   {"t.2-0", "t.0-2"},
                                                                                   {"t.2-1-0", "t"},
                                                                                   {"v*{2,0}", "v*{0,2}"},
                                                                                   {"v*t.1-0", "v*t.0-1"},
                                                                                   {"P.(e.1-0|f)", "P.(e|f)"},
                                                                                   {"P.(e|f.1-0)", "P.(e|f)"}}) {
    CAPTURE(one);
    CHECK(chain({{1, one}, {1, other}}).terms.empty());
    CHECK(chain({{1, one}}) == chain({{-1, other}}));
  }
  const auto boundary = [&](const std::string& name) { return engine.maps().boundary(chain({{1, name}})); };
  CHECK(boundary("{2,0}") == chain({{1, "{0}"}, {-1, "{2}"}}));
  CHECK(boundary("{10,2,0}") == chain({{1, "{2,0}"}, {-1, "{10,0}"}, {1, "{10,2}"}}));
  CHECK(boundary("v*{2,0}") == chain({{1, "v*{0}"}, {-1, "v*{2}"}, {1, "{2,0}"}}));
  CHECK(boundary("P.(e.1-0|f)") ==
        chain({{1, "P.(e.0|f)"}, {-1, "P.(e.1|f)"}, {-1, "P.(e.1-0|f.1)"}, {1, "P.(e.1-0|f.0)"}}));
}

TEST_CASE("a name of labels that have met counts as 0, and stays a name", "[engine]") {
  Engine engine(ring_named("Z"));
  insert_all(engine, {{"a", "c"}, {"b"}, {"z"}});
  carry_out(engine, collapse("a", "b"));
  CHECK_FALSE(engine.classify(engine.chain({{1, "{b,c}"}}).value()).is_cycle);
  carry_out(engine, collapse("b", "c"));
  for (const std::string name : {"{b,c}", "{c,a}", "{a,b}"}) {
    const CellChain chain = engine.chain({{1, name}}).value();
    CHECK(chain.degree == 1);
    CHECK(chain.terms.empty());
    const ClassAnswer answer = engine.classify(chain);
    CHECK((answer.is_cycle && answer.is_zero && answer.bounds && answer.bounds->terms.empty()));
  }
  CHECK(engine.chain({{3, "{a,b,c}"}}).value().degree == 2);
  CHECK_THAT(engine.chain({{1, "{a,z}"}}).error().what, Contains("there is no cell \"{a,z}\""));
  CHECK_THAT(engine.chain({{1, "{a,b}"}, {1, "{a}"}}).error().what, Contains("dimension 1"));
}

TEST_CASE("over every ring all laws hold along random insertions and collapses", "[engine][stream]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const unsigned seed = GENERATE(range(0U, 12U));
  CAPTURE(ring, seed);
  Engine engine(ring_named(ring));
  RandomAbstractSteps steps(seed, 8, 3);
  for (int k = 0; k < 40; ++k) {
    const ops::Operation op = steps.next();
    CAPTURE(k, ops::to_text(op));
    carry_out(engine, op);
    REQUIRE(engine.first_defect().value_or("") == "");
    REQUIRE(std::vector<std::uint64_t>(engine.cells().begin(), engine.cells().end()) == steps.complex().counts());
  }
}

TEST_CASE("insertions and collapses can be taken back one by one", "[engine][stream]") {
  const std::string ring = GENERATE("Z", "Z/3");
  const unsigned seed = GENERATE(range(0U, 6U));
  CAPTURE(ring, seed);
  Engine engine(ring_named(ring));
  RandomAbstractSteps steps(seed, 7, 2);
  std::vector<std::string> states;
  for (int k = 0; k < 30; ++k) {
    states.push_back(dump(engine));
    carry_out(engine, steps.next());
  }
  for (; !states.empty(); states.pop_back()) {
    REQUIRE(engine.undo());
    REQUIRE(first_difference(dump(engine), states.back()) == "");
  }
}

TEST_CASE("after undo the engine goes on as one that never did what was undone", "[engine][stream]") {
  const unsigned seed = GENERATE(range(50U, 58U));
  CAPTURE(seed);
  Engine engine(ring_named("Z"));
  Engine fresh(ring_named("Z"));
  RandomAbstractSteps steps(seed, 7, 3);
  for (int k = 0; k < 12; ++k) {
    const ops::Operation op = steps.next();
    carry_out(engine, op);
    carry_out(fresh, op);
  }
  RandomAbstractSteps detour = steps;
  for (int k = 0; k < 10; ++k) {
    carry_out(engine, detour.next());
  }
  REQUIRE(engine.undo(10));
  for (int k = 0; k < 12; ++k) {
    const ops::Operation op = steps.next();
    carry_out(engine, op);
    carry_out(fresh, op);
  }
  CHECK(first_difference(dump(engine), dump(fresh)) == "");
}

TEST_CASE("what is refused for vertex orders leaves the engine as it was", "[engine]") {
  Engine engine(ring_named("Z"));
  insert_all(engine, {{"a", "b", "c"}, {"c", "d"}});
  carry_out(engine, collapse("c", "a"));
  const std::string before = dump(engine);
  for (const std::string line : {R"({"op":"identify","pairs":[["{a,b}","{a,b}",[1,0]]]})",
                                 R"({"op":"product","name":"P","left":"{a}","right":"{a}","kind":"simplicial"})",
                                 R"({"op":"insert","simplex":["c"]})", R"({"op":"collapse","from":"c","to":"b"})",
                                 R"({"op":"class","chain":[[1,"{a,x}"]]})"}) {
    CHECK_FALSE(engine.apply(operation(line)));
  }
  CHECK(engine.log().size() == 3);
  CHECK(first_difference(dump(engine), before) == "");
}

TEST_CASE("other operations go on from an abstract complex, with all laws", "[engine]") {
  for (const std::string& ring : rings) {
    CAPTURE(ring);
    Engine engine(ring_named(ring));
    // A circle, made by collapsing one of twice the length; its product with itself; a cone over another.
    insert_all(engine, {{"0", "1"}, {"1", "2"}, {"2", "3"}, {"0", "3"}, {"x", "y"}, {"y", "z"}, {"x", "z"}});
    carry_out(engine, collapse("1", "0"));
    build(engine,
          {R"({"op":"product","name":"T","left":"{0}","right":"{0}"})",
           R"({"op":"expect","betti":[2,3,1],"cells":[12,21,9]})", R"({"op":"cone","apex":"v","over":"{x}"})",
           R"({"op":"expect","betti":[2,2,1]})", R"({"op":"degenerate","cell":"{x,y}","along":0})",
           R"({"op":"deidentify","split":[{"cell":"{z}","as":"z2","moves":[["v*{z}",1],["{x,z}",0],["{y,z}",0]]}]})"});
    CHECK(engine.first_defect().value_or("") == "");
  }
}

// ----------------------------------------------------------------------------------------------------- barcodes

TEST_CASE("the barcode of a circle that is contracted", "[engine][barcode]") {
  Engine engine(ring_named("Z/2"));
  insert_all(engine, {{"0", "1"}, {"2"}, {"1", "2"}, {"0", "2"}});
  build(engine, {R"({"op":"note","text":""})"});
  carry_out(engine, collapse("0", "1"));
  const Barcode barcode = engine.barcode().value();
  CHECK(barcode.bars == std::vector<Bar>{{0, 1, engine::never}, {0, 2, 3}, {1, 4, 6}});
  CHECK(barcode.hidden == 0);  // what is born and dies within one step, as a vertex of the first edge, is no class
}

TEST_CASE("a barcode has the steps that are not undone, under their numbers in the log", "[engine][barcode]") {
  Engine engine(ring_named("Z/3"));
  insert_all(engine, {{"a"}, {"b"}, {"c"}});
  REQUIRE(engine.undo());
  carry_out(engine, insert({"a", "b"}));
  CHECK(engine.barcode().value().bars == std::vector<Bar>{{0, 1, engine::never}, {0, 2, 5}});
}

TEST_CASE("a barcode has the ranks of all maps between the spaces of a history", "[engine][barcode][stream]") {
  const std::string ring = GENERATE("Z/2", "Z/3");
  const unsigned seed = GENERATE(range(0U, 15U));
  CAPTURE(ring, seed);
  Engine engine(ring_named(ring));
  RandomAbstractSteps steps(seed, 7, 3, 4);
  std::vector<PastBasis> past;
  std::vector<std::vector<std::vector<std::size_t>>> ranks;  // [to][from][p]
  for (int k = 0; k < 30; ++k) {
    carry_out(engine, steps.next());
    past.push_back(basis_now(engine));
    auto& to_here = ranks.emplace_back();
    for (const PastBasis& basis : past) {
      auto& of_map = to_here.emplace_back();
      for (std::size_t p = 0; p < 4; ++p) {
        of_map.push_back(std::visit([&](const auto& r) { return rank_of_map(engine, r, basis, p); }, engine.ring()));
      }
    }
  }
  const Barcode barcode = engine.barcode().value();
  CHECK(std::is_sorted(barcode.bars.begin(), barcode.bars.end()));
  for (std::size_t to = 0; to < ranks.size(); ++to) {
    for (std::size_t from = 0; from <= to; ++from) {
      for (std::size_t p = 0; p < 4; ++p) {
        CAPTURE(from, to, p);
        REQUIRE(bars_over(barcode, p, static_cast<double>(from + 1), static_cast<double>(to + 1)) ==
                ranks[to][from][p]);
      }
    }
  }
}

TEST_CASE("the same classes can be born and killed by cones, gluings and degeneracies", "[engine][barcode]") {
  Engine engine(ring_named("Z/2"));
  build(engine, {R"({"op":"simplex","name":"t","dim":2})",                    // 1
                 R"({"op":"identify","pairs":[["t.0-1","t.1-2"]]})",          // 2: a Moebius band
                 R"({"op":"identify","pairs":[["t.0-1","t.0-2"]]})",          // 3: the dunce hat
                 R"({"op":"simplex","name":"e","dim":1})",                    // 4
                 R"({"op":"identify","pairs":[["e.0","e.1"]]})",              // 5
                 R"({"op":"cone","apex":"v","over":"e"})",                    // 6
                 R"({"op":"simplex","name":"f","dim":1})",                    // 7
                 R"({"op":"identify","pairs":[["f.0","f.1"],["f.0","v"]]})",  // 8
                 R"({"op":"degenerate","cell":"f","along":0})"});             // 9
  CHECK(engine.barcode().value().bars ==
        std::vector<Bar>{{0, 1, engine::never}, {0, 4, engine::never}, {0, 7, 8}, {1, 2, 3}, {1, 5, 6}, {1, 8, 9}});
}

TEST_CASE("there is no barcode over the integers, or when a step is no map", "[engine][barcode]") {
  Engine integral(ring_named("Z"));
  carry_out(integral, insert({"a"}));
  CHECK_THAT(integral.barcode().error().what, Contains("barcodes need a field"));
  const std::vector<std::pair<std::string, std::string>> steps{
      {R"({"op":"product","name":"P","left":"{a}","right":"{a}"})", "step 4 is a product"},
      {R"({"op":"cone","apex":"v"})", "step 4 is a cone over more cells"}};
  for (const auto& [line, what] : steps) {
    ops::Limits limits;
    limits.cells_of_explicit_cone = 2;
    Engine engine(ring_named("Z/2"), limits);
    build(engine, {R"({"op":"insert","simplex":["x"]})", R"({"op":"undo"})", R"({"op":"insert","simplex":["a","b"]})"});
    carry_out(engine, line);
    CHECK_THAT(engine.barcode().error().what, Contains(what));
    REQUIRE(engine.undo());
    CHECK(engine.barcode().value().bars == std::vector<Bar>{{0, 3, engine::never}});
  }
}

TEST_CASE("an engine without steps has an empty barcode", "[engine][barcode]") {
  CHECK(Engine(ring_named("Z/2")).barcode().value().bars.empty());
}

TEST_CASE("what a collapse costs the equivalence is a matter of the smaller star", "[engine][cost]") {
  std::vector<std::uint64_t> entries;
  for (const int size : {50, 5000}) {
    for (const bool small_goes : {true, false}) {
      Engine engine(ring_named("Z"));
      for (int k = 0; k < size; ++k) {
        carry_out(engine, insert({"big", std::to_string(k), std::to_string(k + 1)}));
      }
      insert_all(engine, {{"small", "p", "q"}, {"small", "q", "r"}});
      const engine::Work before = engine.work();
      carry_out(engine, small_goes ? collapse("small", "big") : collapse("big", "small"));
      entries.push_back(engine.work().boundary_entries - before.boundary_entries);
      CHECK(engine.work().rewritten_terms - before.rewritten_terms < 40);
    }
  }
  CHECK(entries == std::vector<std::uint64_t>(4, entries[0]));
  CHECK(entries[0] < 10);
}
