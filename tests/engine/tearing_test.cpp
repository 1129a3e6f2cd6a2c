// De-identification: spaces cut open, complexes torn apart, gluings taken back in any order, and what that costs.
#include "tests/support/tearing.hpp"
#include "ops/cells/cofaces.hpp"

#include <memory>
#include <numeric>

#include "tests/support/bodies.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

using Split = ops::Deidentify::Split;

/// Every law holds, and the homology is that of a Smith form from scratch.
void check_state(Engine& engine) { REQUIRE(engine.first_defect().value_or("") == ""); }

std::uint64_t total(const engine::Work& work) { return work.boundary_entries + work.rewritten_terms; }

// ---- surfaces as polygons with glued sides

/// Sides are a_1 b_1 a_1^-1 b_1^-1 a_2 ...: the last two of four go backwards.
bool is_backward(int side) { return side % 4 >= 2; }

/// A polygon "K" of triangles t around a centre c: side e_k has corners p_k and p_(k+1).
ops::MakeComplex polygon(int sides) {
  ops::MakeComplex complex{"K", {{"c", {}, {}, {}}}};
  const auto corner = [sides](int k) { return "p" + std::to_string(k % sides); };
  const auto radius = [sides](int k) { return "r" + std::to_string(k % sides); };
  for (int k = 0; k < sides; ++k) {
    const int from = is_backward(k) ? k + 1 : k;
    const int to = is_backward(k) ? k : k + 1;
    const std::string number = std::to_string(k);
    complex.cells.push_back({corner(k), {}, {}, {}});
    complex.cells.push_back({radius(k), {}, {"c", corner(k)}, {}});
    complex.cells.push_back({"e" + number, {}, {corner(to), corner(from)}, {}});
    complex.cells.push_back({"t" + number, {}, {radius(to), radius(from), "e" + number}, {}});
  }
  return complex;
}

/// Sides k and k + 2 of each four are one loop.
Pairs sides_to_glue(int sides) {
  Pairs pairs;
  for (int k = 0; k < sides; ++k) {
    if (!is_backward(k)) {
      pairs.emplace_back("K.e" + std::to_string(k), "K.e" + std::to_string(k + 2));
    }
  }
  return pairs;
}

/// Cuts along a loop: side k gets an edge of its own; its ends stay.
Split cut_along(int k) {
  const std::string number = std::to_string(k);
  return {"K.e" + number, "f" + number, {{"K.t" + number, 2}}};
}

/// A vertex of its own for corner k. Requires: all loops are cut; side m is "f"m when it goes backwards.
Split cut_off_corner(int k, int sides) {
  const auto side = [](int m) { return (is_backward(m) ? "f" : "K.e") + std::to_string(m); };
  const int before = (k + sides - 1) % sides;
  const std::string number = std::to_string(k);
  return {"K.p0",
          "q" + number,
          {{"K.r" + number, 1}, {side(k), is_backward(k) ? 0 : 1}, {side(before), is_backward(before) ? 1 : 0}}};
}

void shuffle(std::vector<int>& list, Random& random) {
  for (std::size_t k = list.size(); k > 1; --k) {
    std::swap(list[k - 1], list[static_cast<std::size_t>(random.in(0, static_cast<int>(k) - 1))]);
  }
}

// ---- a torus as a grid

/// The cells of an n x n torus of squares, "K" or, lazily, the product "K" of two circles of n edges.
struct Grid {
  int n;
  bool lazy;

  std::string cell(const std::string& a, int i, const std::string& b, int j) const {
    const std::string left = a + std::to_string((i + n) % n);
    const std::string right = b + std::to_string((j + n) % n);
    return lazy ? pair_name("K", "A." + left, "B." + right) : "K." + left + right;
  }
  std::string vertex(int i, int j) const { return cell("v", i, "v", j); }
  /// The step that makes the vertex at (i, j), which is now the cell `from`, one of its own again: `as`.
  ops::Operation split(int i, int j, const std::string& from, const std::string& as) const {
    return ops::Deidentify{{{from,
                             as,
                             {{cell("e", i, "v", j), 1},
                              {cell("e", i - 1, "v", j), 0},
                              {cell("v", i, "e", j), 1},
                              {cell("v", i, "e", j - 1), 0}}}}};
  }
  void make(Engine& engine) const {
    if (lazy) {
      carry_out(engine, circle("A"));
      carry_out(engine, circle("B"));
      carry_out(engine, product("K", "A", "B", false));
      return;
    }
    ops::MakeComplex complex{"K", {}};
    const auto add = [&](const std::string& a, int i, const std::string& b, int j, std::vector<std::string> faces) {
      ops::MakeComplex::Cell made{cell(a, i, b, j).substr(2), {}, {}, {}};
      for (const std::string& face : faces) {
        made.faces.push_back(face.substr(2));
      }
      if (faces.size() == 4) {
        made.type = ops::CellType{1, 1};
      }
      complex.cells.push_back(std::move(made));
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        add("v", i, "v", j, {});
        add("e", i, "v", j, {vertex(i + 1, j), vertex(i, j)});
        add("v", i, "e", j, {vertex(i, j + 1), vertex(i, j)});
        add("e", i, "e", j,
            {cell("v", i + 1, "e", j), cell("v", i, "e", j), cell("e", i, "v", j + 1), cell("e", i, "v", j)});
      }
    }
    carry_out(engine, complex);
  }

 private:
  ops::Operation circle(const std::string& name) const {
    ops::MakeComplex complex{name, {}};
    for (int k = 0; k < n; ++k) {
      complex.cells.push_back({"v" + std::to_string(k), {}, {}, {}});
      complex.cells.push_back(
          {"e" + std::to_string(k), {}, {"v" + std::to_string((k + 1) % n), "v" + std::to_string(k)}, {}});
    }
    return complex;
  }
};

// ---- gluings that are taken back in any order

/// Standard cells, and pairs of their cells that are glued and unglued, in any order, with the object that this should
/// be: the quotient by the equations that hold now.
class Gluings {
 public:
  /// The standard cells are those that the engine has.
  explicit Gluings(const Engine& engine) {
    const ops::Structure& structure = engine.structure();
    for (ops::CellId c = 0; c < structure.cells().size(); ++c) {
      types_.push_back(structure.cells().type_id(c));
      dimensions_.push_back(structure.dimension(c));
      faces_.emplace_back(structure.faces().of(c).begin(), structure.faces().of(c).end());
      original_names_.emplace_back(structure.name(c));
    }
    names_ = original_names_;
    classes_ = quotient();
  }

  /// Draws a pair of different cells of one type: its number.
  std::size_t draw(Random& random) {
    const auto cell = [&] {
      return ops::CellId{static_cast<unsigned>(random.in(0, static_cast<int>(types_.size()) - 1))};
    };
    ops::CellId a = cell();
    ops::CellId b = cell();
    while (a == b || types_[a] != types_[b]) {
      a = cell();
      b = cell();
    }
    equations_.push_back({a, b, false});
    return equations_.size() - 1;
  }

  ops::Operation glue(std::size_t k) {
    equations_[k].holds = true;
    const auto& [a, b, holds] = equations_[k];
    const ops::Identify step{{{names_[classes_[a]], names_[classes_[b]]}}};
    const std::vector<ops::CellId> before = std::exchange(classes_, quotient());
    for (ops::CellId c = 0; c < classes_.size(); ++c) {
      names_[classes_[c]] = names_[before[classes_[c]]];
    }
    return step;
  }

  /// Takes equation k back; of each class that falls apart, the part that keeps the cell is drawn. Nothing when what it
  /// says follows from the others.
  std::optional<ops::Operation> unglue(std::size_t k, Random& random, const std::string& prefix) {
    equations_[k].holds = false;
    const std::vector<ops::CellId> before = std::exchange(classes_, quotient());
    std::map<ops::CellId, std::vector<ops::CellId>> parts;  // of each class before
    for (ops::CellId c = 0; c < classes_.size(); ++c) {
      if (classes_[c] == c) {
        parts[before[c]].push_back(c);
      }
    }
    ops::Deidentify step;
    std::map<ops::CellId, std::size_t> split_of;  // new class -> the copy that it is
    std::vector<std::string> names(names_.size());
    for (const auto& [whole, pieces] : parts) {
      const auto keeper = static_cast<std::size_t>(random.in(0, static_cast<int>(pieces.size()) - 1));
      for (std::size_t m = 0; m < pieces.size(); ++m) {
        names[pieces[m]] = names_[whole];
        if (m != keeper) {
          names[pieces[m]] = prefix + std::to_string(step.splits.size());
          split_of.emplace(pieces[m], step.splits.size());
          step.splits.push_back({names_[whole], names[pieces[m]], {}});
        }
      }
    }
    for (ops::CellId t = 0; t < classes_.size(); ++t) {
      for (std::size_t slot = 0; classes_[t] == t && slot < faces_[t].size(); ++slot) {
        if (const auto split = split_of.find(classes_[faces_[t][slot]]); split != split_of.end()) {
          step.splits[split->second].moves.emplace_back(names[t], static_cast<std::int64_t>(slot));
        }
      }
    }
    names_ = std::move(names);
    return step.splits.empty() ? std::nullopt : std::optional<ops::Operation>{step};
  }

  /// The step that makes the object, as it should be now, from the standard cells.
  ops::Operation all_at_once() const {
    ops::Identify step;
    for (const auto& [a, b, holds] : equations_) {
      if (holds) {
        step.pairs.emplace_back(original_names_[a], original_names_[b]);
      }
    }
    return step;
  }
  std::vector<std::uint64_t> counts() const {
    std::vector<std::uint64_t> counts;
    for (ops::CellId c = 0; c < classes_.size(); ++c) {
      if (classes_[c] == c) {
        const auto p = static_cast<std::size_t>(dimensions_[c]);
        counts.resize(std::max(counts.size(), p + 1));
        ++counts[p];
      }
    }
    return counts;
  }

 private:
  struct Equation {
    ops::CellId a, b;
    bool holds;
  };

  /// The class of each cell under the equations that hold: its smallest member.
  std::vector<ops::CellId> quotient() const {
    std::vector<ops::CellId> smallest(types_.size());
    std::iota(smallest.begin(), smallest.end(), ops::CellId{});
    std::vector<std::pair<ops::CellId, ops::CellId>> pending;
    for (const auto& [a, b, holds] : equations_) {
      if (holds) {
        pending.emplace_back(a, b);
      }
    }
    while (!pending.empty()) {
      const auto [a, b] = pending.back();
      pending.pop_back();
      const auto [low, high] = std::minmax(smallest[a], smallest[b]);
      if (low == high) {
        continue;
      }
      std::replace(smallest.begin(), smallest.end(), ops::CellId{high}, ops::CellId{low});
      for (std::size_t slot = 0; slot < faces_[a].size(); ++slot) {
        pending.emplace_back(faces_[a][slot], faces_[b][slot]);
      }
    }
    return smallest;
  }

  std::vector<ops::TypeId> types_;
  std::vector<int> dimensions_;
  std::vector<std::vector<ops::CellId>> faces_;
  std::vector<std::string> original_names_;
  std::vector<std::string> names_;  ///< per class, at its smallest member: a name that it has in the engine
  std::vector<ops::CellId> classes_;
  std::vector<Equation> equations_;
};

/// A few standard cells side by side.
std::vector<ops::Operation> standard_cells(Random& random, int count) {
  const std::vector<ops::CellType> types{{1}, {2}, {3}, {1, 1}, {2, 1}, {1, 2}, {2}, {3}};
  std::vector<ops::Operation> steps;
  for (int k = 0; k < count; ++k) {
    steps.push_back(simploid("s" + std::to_string(k), types[static_cast<std::size_t>(random.in(0, 7))]));
  }
  return steps;
}

}  // namespace

TEST_CASE("a torus cut along its two circles is a square again", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  Engine engine(ring_named(ring), {}, taking_splits_in);
  build(engine, torus_of_square("q"));
  CHECK(live_groups(engine) == Groups{group(1), group(2), group(1)});
  // Slots of the square: q.0-1 of 1x, of 0x, then of x1, of x0. Slots of an edge: its end, its start.
  SECTION("in one step") {
    carry_out(engine, ops::Deidentify{{{"q.0x0-1", "right", {{"q", 0}}},
                                       {"q.0-1x0", "top", {{"q", 2}}},
                                       {"q.0x0", "x", {{"right", 1}, {"q.0-1x0", 0}}},
                                       {"q.0x0", "y", {{"q.0x0-1", 0}, {"top", 1}}},
                                       {"q.0x0", "xy", {{"right", 0}, {"top", 0}}}}});
  }
  SECTION("one circle after the other") {
    carry_out(engine, ops::Deidentify{{{"q.0x0-1", "right", {{"q", 0}}},
                                       {"q.0x0", "x", {{"right", 0}, {"right", 1}, {"q.0-1x0", 0}}}}});
    CHECK(live_groups(engine) == Groups{group(1), group(1)});
    CHECK(engine.first_defect().value_or("") == "");
    carry_out(engine, ops::Deidentify{{{"q.0-1x0", "top", {{"q", 2}}},
                                       {"q.0x0", "y", {{"q.0x0-1", 0}, {"top", 1}}},
                                       {"x", "xy", {{"right", 0}, {"top", 0}}}}});
  }
  CHECK(live_groups(engine) == Groups{group(1)});
  CHECK(counts_of(engine, "q") == std::vector<std::uint64_t>{4, 4, 1});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("a closed surface cut along its loops is a polygon again", "[engine]") {
  const int genus = GENERATE(range(1, 5));
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const int sides = 4 * genus;
  CAPTURE(genus, ring);
  Engine engine(ring_named(ring), {}, taking_splits_in);
  carry_out(engine, polygon(sides));
  const auto counts = counts_of(engine, "K");
  carry_out(engine, identify(sides_to_glue(sides)));
  CHECK(live_groups(engine) == Groups{group(1), group(static_cast<Index>(2 * genus)), group(1)});
  std::vector<Split> cuts;
  std::vector<int> order;
  for (int k = 0; k < sides; ++k) {
    if (is_backward(k)) {
      cuts.push_back(cut_along(k));
    }
    if (k > 0) {
      order.push_back(k);
    }
  }
  SECTION("in one step, edges and their common vertex") {
    for (const int k : order) {
      cuts.push_back(cut_off_corner(k, sides));
    }
    carry_out(engine, ops::Deidentify{cuts});
  }
  SECTION("loop by loop, then corner by corner in any order") {
    Index loops = static_cast<Index>(2 * genus);
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      carry_out(engine, ops::Deidentify{{cuts[k]}});
      // The first cut opens the surface: every loop that it has is a generator from then on.
      loops += k == 0 ? 0 : 1;
      CHECK(live_groups(engine) == Groups{group(1), group(loops)});
      CHECK(engine.first_defect().value_or("") == "");
    }
    CHECK(loops == static_cast<Index>(sides) - 1);
    Random random(static_cast<unsigned>(genus));
    shuffle(order, random);
    for (const int k : order) {
      carry_out(engine, ops::Deidentify{{cut_off_corner(k, sides)}});
      loops -= 1;
      CHECK(live_groups(engine) == trimmed({group(1), group(loops)}));
      CHECK(engine.first_defect().value_or("") == "");
    }
  }
  CHECK(live_groups(engine) == Groups{group(1)});
  CHECK(counts_of(engine, "K") == counts);
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("a random complex is torn apart to isolated standard cells, with the right homology all the way",
          "[engine][stream]") {
  const unsigned seed = GENERATE(range(0U, 12U));
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  CAPTURE(seed, ring);
  Random random(seed);
  Engine engine(ring_named(ring), {}, taking_splits_in);
  for (const ops::Operation& step : standard_cells(random, 7)) {
    carry_out(engine, step);
  }
  Gluings gluings(engine);
  for (int k = 0; k < 12; ++k) {
    carry_out(engine, gluings.glue(gluings.draw(random)));
  }
  check_state(engine);
  std::vector<ops::CellId> tops;
  std::vector<std::uint64_t> counts;
  for (const ops::CellId c : all_cells(engine)) {
    if (cofaces(engine.structure(), c).empty()) {
      tops.push_back(c);
      for (const ops::StandardFace& face :
           engine.structure().types().standard(engine.structure().cells().type_id(c)).cells) {
        const auto p = static_cast<std::size_t>(engine.structure().types().info(face.type).dimension);
        counts.resize(std::max(counts.size(), p + 1));
        ++counts[p];
      }
    }
  }
  std::vector<int> order(tops.size());
  std::iota(order.begin(), order.end(), 0);
  shuffle(order, random);
  std::vector<Groups> history;
  for (const int k : order) {
    history.push_back(live_groups(engine));
    const auto split =
        tearing_split(engine.structure(), tops[static_cast<std::size_t>(k)], "n" + std::to_string(k) + "_");
    carry_out(engine, split ? ops::Operation{*split} : ops::Operation{ops::Note{"it was one"}});
    check_state(engine);
  }
  CHECK(std::vector<std::uint64_t>(engine.cells().begin(), engine.cells().end()) == counts);
  CHECK(live_groups(engine) == Groups{group(static_cast<Index>(tops.size()))});
  for (; !history.empty(); history.pop_back()) {
    carry_out(engine, ops::Undo{1});
    CHECK(live_groups(engine) == history.back());
  }
  check_state(engine);
}

TEST_CASE("cells of products and cones are cut off from the rest, with the right homology all the way", "[engine]") {
  const bool simplicial = GENERATE(false, true);
  const bool lazy_cones = GENERATE(false, true);
  CAPTURE(simplicial, lazy_cones);
  Engine engine(ring_named("Z"), limits(lazy_cones), taking_splits_in);
  build(engine, plane_of_three_cells("A"));
  build(engine, circle("B"));
  carry_out(engine, product("P", "A", "B", simplicial));
  carry_out(engine, cone_over_body("v", "P"));
  CHECK(live_groups(engine) == Groups{group(1)});
  const std::size_t most = 40;
  std::size_t steps = 0;
  for (std::size_t next = 0; next < all_cells(engine).size() && steps < most; ++next) {
    const ops::CellId cell = all_cells(engine)[next];
    if (const auto split = isolating_split(engine.structure(), cell, "n" + std::to_string(next) + "_")) {
      CAPTURE(engine.structure().name(cell));
      carry_out(engine, *split);
      check_state(engine);
      ++steps;
    }
  }
  CHECK(steps > 5);
  carry_out(engine, ops::Undo{steps});
  CHECK(live_groups(engine) == Groups{group(1)});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("the cofaces of a cell are what a search through all faces finds, whatever has been asked for before",
          "[engine]") {
  const bool lazy_cones = GENERATE(false, true);
  const bool simplicial = GENERATE(false, true);
  CAPTURE(lazy_cones, simplicial);
  std::vector<ops::Operation> steps = plane_of_three_cells("A").steps;
  for (const ops::Operation& step :
       {circle("B").steps.front(), product("P", "A", "B", simplicial), cone_over_body("v", "P"),
        cone_over_body("w", "P"), point("c").steps.front(), product("Q", "c", "P", false), cone_over_body("u", "Q")}) {
    steps.push_back(step);
  }
  const auto made = [&] {
    auto engine = std::make_unique<Engine>(ring_named("Z"), limits(lazy_cones));
    for (const ops::Operation& step : steps) {
      carry_out(*engine, step);
    }
    return engine;
  };
  using Names = std::set<std::string, std::less<>>;
  std::map<std::string, Names> expected;
  const auto searched = made();
  const ops::Structure& all = searched->structure();
  for (const ops::CellId c : all_cells(*searched)) {
    expected[std::string{all.name(c)}];
    for (const ops::CellId face : all.faces().of(c)) {
      expected[std::string{all.name(all.values().of(face).cell)}].emplace(all.name(c));
    }
  }
  for (const auto& [name, around] : expected) {
    CAPTURE(name);
    const auto engine = made();
    const ops::Structure& structure = engine->structure();
    Names found;
    for (const ops::CellId c : cofaces(structure, structure.find(*structure.lookup(name)))) {
      found.emplace(structure.name(c));
    }
    CHECK(found == around);
  }
}

TEST_CASE("an edge from the apex of a cone does not leave it alone", "[engine]") {
  const bool lazy_cones = GENERATE(false, true);
  CAPTURE(lazy_cones);
  Engine engine(ring_named("Z"), limits(lazy_cones), taking_splits_in);
  build(engine, point("a"));
  carry_out(engine, cone_over_body("v", "a"));
  carry_out(engine, cone_over_body("w", "a"));
  // The triangle w*v*a has the edge w*v, and w again by its edge w*a.
  CHECK_FALSE(engine.apply(ops::Deidentify{{{"w", "x", {{"w*v", 0}}}}}));
  check_state(engine);
  carry_out(engine, ops::Deidentify{{{"w", "x", {{"w*v", 0}, {"w*a", 0}}}}});
  CHECK(live_groups(engine) == Groups{group(2)});
  check_state(engine);
}

TEST_CASE("an edge that faces are degenerate over does not leave its end alone", "[engine]") {
  // A 3-simplex glued to the boundary of s_0 s_0 of an edge: its triangles are s_0 of it, and s_0 s_0 of its start.
  const bool is_factor = GENERATE(false, true);
  const bool simplicial = GENERATE(false, true);
  CAPTURE(is_factor, simplicial);
  Engine engine({}, {}, taking_splits_in);
  carry_out(engine, ops::MakeSimplex{"t", 3, {}});
  for (const std::string cell : {"t.0-1", "t.1-2", "t.0-1-2", "t.0-1-3", "t.0-2-3", "t.1-2-3"}) {
    carry_out(engine, ops::Degenerate{cell, {}, 0});
  }
  REQUIRE(counts_of(engine, "t") == std::vector<std::uint64_t>{2, 1, 0, 1});
  std::string start = "t.0";
  std::string edge = "t.0-3";
  if (is_factor) {
    build(engine, point("b"));
    carry_out(engine, product("P", "t", "b", simplicial));
    start = pair_name("P", start, "b");
    edge = pair_name("P", edge, simplicial ? "b^0" : "b");
  }
  CHECK_FALSE(engine.apply(ops::Deidentify{{{start, "x", {{edge, 1}}}}}));
  check_state(engine);
}

TEST_CASE("gluings are taken back in any order, and what is left is the quotient by the others", "[engine][stream]") {
  const unsigned seed = GENERATE(range(0U, 12U));
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  CAPTURE(seed, ring);
  Random random(seed);
  const std::vector<ops::Operation> start = standard_cells(random, 6);
  Engine engine(ring_named(ring), {}, taking_splits_in);
  for (const ops::Operation& step : start) {
    carry_out(engine, step);
  }
  const auto is_the_quotient = [&](const Gluings& gluings) {
    Engine other(engine.ring(), {}, taking_splits_in);
    for (const ops::Operation& step : start) {
      carry_out(other, step);
    }
    carry_out(other, gluings.all_at_once());
    REQUIRE(std::vector<std::uint64_t>(engine.cells().begin(), engine.cells().end()) == gluings.counts());
    REQUIRE(live_groups(engine) == live_groups(other));
    check_state(engine);
  };
  Gluings gluings(engine);
  constexpr int pairs = 10;
  for (int k = 0; k < pairs; ++k) {
    carry_out(engine, gluings.glue(gluings.draw(random)));
  }
  is_the_quotient(gluings);
  const std::uint64_t all_glued = engine.undoable();
  const std::string text = dump(engine);
  std::vector<int> order(pairs);
  std::iota(order.begin(), order.end(), 0);
  shuffle(order, random);
  for (const int k : order) {
    if (const auto step = gluings.unglue(static_cast<std::size_t>(k), random, "u" + std::to_string(k) + "_")) {
      carry_out(engine, *step);
    }
    is_the_quotient(gluings);
  }
  CHECK(live_groups(engine) == Groups{group(static_cast<Index>(start.size()))});
  const std::deque<ops::Operation> log = engine.log();
  const std::string torn = dump(engine);
  const std::uint64_t steps = engine.undoable() - all_glued;
  carry_out(engine, ops::Undo{steps});
  CHECK(dump(engine) == text);
  for (std::uint64_t k = 0; k < steps; ++k) {
    carry_out(engine, log[all_glued + k]);
  }
  CHECK(dump(engine) == torn);
}

TEST_CASE("splitting a glued pair costs its generating loops at most, not the object", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2");
  const bool lazy = GENERATE(true, false);
  CAPTURE(ring, lazy);
  std::vector<std::uint64_t> costs;
  for (const int n : {6, 12, 24, 48, 96, 150}) {
    CAPTURE(n);
    const Grid grid{n, lazy};
    Engine engine(ring_named(ring), {}, taking_splits_in);
    grid.make(engine);
    const std::uint64_t building = total(engine.work());
    carry_out(engine, identify({{grid.vertex(1, 1), grid.vertex(n / 2, n / 3)}}));
    CHECK(live_groups(engine) == Groups{group(1), group(3), group(1)});
    const std::uint64_t before = total(engine.work());
    carry_out(engine, grid.split(n / 2, n / 3, grid.vertex(1, 1), "w"));
    CHECK(live_groups(engine) == Groups{group(1), group(2), group(1)});
    costs.push_back(total(engine.work()) - before);
    // A loop around the torus has n edges, and there are n^2 squares.
    CHECK(costs.back() > 0);
    CHECK(costs.back() <= 30 + 6 * static_cast<std::uint64_t>(n));
    if (!lazy && n == 150) {
      CHECK(1000 * costs.back() < building);
    }
    if (lazy) {  // the loops are in the factors, which nothing touches
      CHECK(costs.back() == costs.front());
    }
    if (n <= 6) {
      CHECK(engine.first_defect().value_or("") == "");
    }
  }
}

TEST_CASE("one place is glued and unglued as often as one likes", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2");
  Engine engine(ring_named(ring), {}, taking_splits_in);
  build(engine,
        std::vector<std::string>{R"({"op":"simplex","name":"a","dim":2})", R"({"op":"simplex","name":"b","dim":2})",
                                 R"({"op":"identify","pairs":[["a.0-1","b.0-1"]]})"});
  // The last vertex of b, or of what it is a copy of, is glued to that of a: a loop. Then it gets its edges back.
  std::vector<std::uint64_t> work;
  for (int k = 0; k < 100; ++k) {
    const std::string last = k == 0 ? "b.2" : "c" + std::to_string(k - 1);
    carry_out(engine, identify({{"a.2", last}}));
    CHECK(live_groups(engine) == Groups{group(1), group(1)});
    const std::uint64_t before = total(engine.work());
    carry_out(engine, ops::Deidentify{{{"a.2", "c" + std::to_string(k), {{"b.0-2", 0}, {"b.1-2", 0}}}}});
    work.push_back(total(engine.work()) - before);
    CHECK(live_groups(engine) == Groups{group(1)});
    if (k % 20 == 0) {
      CHECK(engine.first_defect().value_or("") == "");
    }
  }
  CHECK(counts_of(engine, "a") == std::vector<std::uint64_t>{4, 5, 2});
  // Every split of a place adds to the boundaries of its cofaces, so that the next one costs a little more, until the
  // equivalence of these eleven cells is begun afresh: the hundredth split costs what the fourth did.
  CHECK(*std::max_element(work.begin(), work.end()) <= 48);
  for (int k = 199; k >= 0; --k) {
    carry_out(engine, ops::Undo{1});
    CHECK(live_groups(engine) == (k % 2 == 0 ? Groups{group(1)} : Groups{group(1), group(1)}));
  }
  CHECK(engine.first_defect().value_or("") == "");
}
