// Products glued: mapping tori of circles, spheres and tori, and what two solid tori make.
#include <array>
#include <numeric>

#include "tests/support/bodies.hpp"
#include "tests/support/tearing.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

/// A 2 x 2 matrix by rows.
using Matrix2 = std::array<std::array<int, 2>, 2>;

Matrix2 multiply(const Matrix2& a, const Matrix2& b) {
  Matrix2 c{};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j];
    }
  }
  return c;
}
int determinant(const Matrix2& m) { return m[0][0] * m[1][1] - m[0][1] * m[1][0]; }

/// Z^2 by the columns of n: its invariant factors are the greatest common divisor of the entries, and what is left of
/// the determinant.
AbelianGroup cokernel(const Matrix2& n) {
  const int divisor = std::gcd(std::gcd(n[0][0], n[0][1]), std::gcd(n[1][0], n[1][1]));
  return group(0, {Integer{divisor}, Integer{divisor == 0 ? 0 : determinant(n) / divisor}});
}

/// The homology of the mapping torus of a map of the torus that is m on H_1, by Wang's sequence: H_n is the cokernel of
/// m - 1 on H_n, and its kernel on H_(n-1).
Groups mapping_torus_groups(const Matrix2& m) {
  const Matrix2 n{{{m[0][0] - 1, m[0][1]}, {m[1][0], m[1][1] - 1}}};
  const AbelianGroup h1 = cokernel(n);
  const int degree = determinant(m);  // on H_2
  const AbelianGroup kernel = group(h1.rank);
  return trimmed({group(1), direct_sum(group(1), h1), direct_sum(kernel, group(0, {Integer{degree - 1}})),
                  group(degree == 1 ? 1 : 0)});
}

/// A torus of two triangles "x, then y" and "y, then x" for two loops x, y, with x + y as the third; and what its loops
/// are in the torus that we started with: the columns of `basis`.
struct LayeredTorus {
  std::string x_then_y;
  std::string y_then_x;
  Matrix2 basis{{{1, 0}, {0, 1}}};
};

/// Layers tetrahedra on a torus. Each has three edges p, q, p in a row: the triangles "p, q" and "q, p" make a torus
/// with diagonal p + q, and on the other side "p, p + q" and "p + q, p" make one with diagonal 2p + q. So a tetrahedron
/// flips a diagonal, and changes the basis by a shear:
///   l: y becomes x + y,   L: y becomes y - x,   r: x becomes x + y,   R: x becomes x - y,   s: x and y swap, no layer.
class Layers {
 public:
  Layers(Engine& engine, LayeredTorus torus) : engine_{engine}, torus_{std::move(torus)} {}

  const LayeredTorus& add(const std::string& word) {
    for (const char letter : word) {
      if (letter == 's') {
        std::swap(torus_.x_then_y, torus_.y_then_x);
        change_basis({{{0, 1}, {1, 0}}});
      } else {
        add_tetrahedron(letter);
      }
    }
    return torus_;
  }

 private:
  void add_tetrahedron(char letter) {
    const std::string t = "t" + std::to_string(++count_);
    carry_out(engine_, ops::MakeSimplex{t, 3, {}});
    const bool on_x = letter == 'l' || letter == 'L';  // p = x, else p = y
    const bool is_inverse = letter == 'L' || letter == 'R';
    std::string& p_first = on_x ? torus_.x_then_y : torus_.y_then_x;
    std::string& p_last = on_x ? torus_.y_then_x : torus_.x_then_y;
    const auto side = [&](bool with_q) {  // its triangles: first p, then the other; and the other way round
      return with_q ? std::pair{t + ".0-1-2", t + ".1-2-3"} : std::pair{t + ".0-1-3", t + ".0-2-3"};
    };
    const auto [below_first, below_last] = side(!is_inverse);
    carry_out(engine_, identify({{below_first, p_first}, {below_last, p_last}}));
    std::tie(p_first, p_last) = side(is_inverse);
    const int sign = is_inverse ? -1 : 1;
    change_basis(on_x ? Matrix2{{{1, sign}, {0, 1}}} : Matrix2{{{1, 0}, {sign, 1}}});
  }
  void change_basis(const Matrix2& m) { torus_.basis = multiply(torus_.basis, m); }

  Engine& engine_;
  LayeredTorus torus_;
  int count_ = 0;
};

struct Monodromy {
  std::string word;
  Matrix2 matrix;
};

const std::vector<Monodromy> monodromies{
    {"", {{{1, 0}, {0, 1}}}},         {"lL", {{{1, 0}, {0, 1}}}},         {"l", {{{1, 1}, {0, 1}}}},
    {"ll", {{{1, 2}, {0, 1}}}},       {"lll", {{{1, 3}, {0, 1}}}},        {"R", {{{1, 0}, {-1, 1}}}},
    {"lr", {{{2, 1}, {1, 1}}}},       {"lrlr", {{{5, 3}, {3, 2}}}},       {"llrrr", {{{7, 2}, {3, 1}}}},
    {"Lr", {{{0, -1}, {1, 1}}}},      {"LrLr", {{{-1, -1}, {1, 0}}}},     {"LrL", {{{0, -1}, {1, 0}}}},
    {"LrLLrL", {{{-1, 0}, {0, -1}}}}, {"LrLLrLl", {{{-1, -1}, {0, -1}}}}, {"s", {{{0, 1}, {1, 0}}}},
    {"ls", {{{1, 1}, {1, 0}}}},       {"LrLs", {{{-1, 0}, {0, 1}}}},      {"lls", {{{2, 1}, {1, 0}}}},
    {"LrLsl", {{{-1, -1}, {0, 1}}}},
};

/// The product "P" of the torus T with an edge "I", and the triangles of its two ends.
struct Cylinder {
  LayeredTorus bottom, top;
};

/// T is one of two triangles, or the triangulated product of two circles x and y: the same complex, made in another
/// way.
Cylinder make_cylinder(Engine& engine, bool torus_as_product, bool simplicial) {
  std::string x_then_y = "T";
  std::string y_then_x = "T'";
  if (torus_as_product) {
    build(engine, circle("x"));
    build(engine, circle("y"));
    carry_out(engine, product("T", "x", "y", true));
    x_then_y = pair_name("T", "x.e^1", "y.e^0");
    y_then_x = pair_name("T", "x.e^0", "y.e^1");
  } else {
    build(engine, torus_of_triangles("T"));
  }
  build(engine, edge("I"));
  carry_out(engine, product("P", "T", "I", simplicial));
  const std::string collapsed = simplicial ? "^0,1" : "";
  return {{pair_name("P", x_then_y, "I.0" + collapsed), pair_name("P", y_then_x, "I.0" + collapsed)},
          {pair_name("P", x_then_y, "I.1" + collapsed), pair_name("P", y_then_x, "I.1" + collapsed)}};
}

struct Incidence {
  std::string cell;
  std::size_t slot;
  std::string face;
};

/// The incidences of the cells in the bottom of "P".
std::vector<Incidence> incidences_of_bottom(const Engine& engine) {
  const ops::Structure& structure = engine.structure();
  std::vector<Incidence> incidences;
  std::vector<ops::CellId> cells = structure.lazy().cells_of(body_named(engine, "P"));
  std::reverse(cells.begin(), cells.end());
  for (const ops::CellId c : cells) {
    for (std::size_t slot = 0; slot < structure.faces().of(c).size(); ++slot) {
      const std::string face{structure.name(structure.faces().of(c)[slot])};
      if (face.find("|I.0") != std::string::npos) {
        incidences.push_back({std::string{structure.name(c)}, slot, face});
      }
    }
  }
  return incidences;
}

/// Copies of all cells of the bottom: the copies have its faces, and the cells over it have the copies.
ops::Deidentify cut_fibre(const ops::Structure& structure, const std::vector<Incidence>& incidences) {
  const auto cell = [&](const std::string& name) { return structure.find(*structure.lookup(name)); };
  SplitPlan plan(structure, "cut");
  std::map<ops::CellId, std::size_t> copies;
  for (const Incidence& incidence : incidences) {
    if (!copies.contains(cell(incidence.face))) {
      copies.emplace(cell(incidence.face), plan.copy(cell(incidence.face)));
    }
  }
  for (const auto& [name, slot, face] : incidences) {
    const auto own = copies.find(cell(name));
    plan.move(own == copies.end() ? name : plan.name(own->second), slot, copies.at(cell(face)));
  }
  return plan.take();
}

/// The boundary of the cross-polytope with n + 1 axes: a simplex for each choice of axes, in their order, and of a sign
/// for each. Its id has a sign or "." per axis, so that the antipode has the other signs.
ops::MakeComplex cross_polytope(int n) {
  const std::string no_axis(static_cast<std::size_t>(n) + 1, '.');
  std::vector<std::string> ids{no_axis};
  for (std::size_t axis = 0; axis < no_axis.size(); ++axis) {
    for (std::size_t k = ids.size(); k-- > 0;) {
      for (const char sign : {'+', '-'}) {
        ids.push_back(ids[k]);
        ids.back()[axis] = sign;
      }
    }
  }
  ops::MakeComplex complex{"S", {}};
  for (const std::string& id : ids) {
    ops::MakeComplex::Cell cell{id, {}, {}, {}};
    for (std::size_t axis = 0; axis < id.size(); ++axis) {
      std::string face = id;
      face[axis] = '.';
      if (id[axis] != '.' && face != no_axis) {
        cell.faces.push_back(face);
      }
    }
    if (id != no_axis) {
      complex.cells.push_back(cell);
    }
  }
  return complex;
}

ops::Operation glue(const LayeredTorus& one, const LayeredTorus& other) {
  return identify({{one.x_then_y, other.x_then_y}, {one.y_then_x, other.y_then_x}});
}

}  // namespace

TEST_CASE("mapping tori of the torus have H_1 = Z + coker(M - 1)", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const bool torus_as_product = GENERATE(false, true);
  const bool simplicial = GENERATE(false, true);
  for (const auto& [word, matrix] : monodromies) {
    CAPTURE(ring, torus_as_product, simplicial, word);
    Engine engine(ring_named(ring), {}, taking_splits_in);
    const Cylinder cylinder = make_cylinder(engine, torus_as_product, simplicial);
    const LayeredTorus top = Layers(engine, cylinder.top).add(word);
    REQUIRE(top.basis == matrix);
    CHECK(live_groups(engine) == Groups{group(1), group(2), group(1)});
    carry_out(engine, glue(cylinder.bottom, top));
    CHECK(live_groups(engine) == over(engine.ring(), mapping_torus_groups(matrix)));
    CHECK(engine.euler_characteristic() == 0);
    CHECK(engine.first_defect().value_or("") == "");
    carry_out(engine, ops::Undo{1});
    CHECK(live_groups(engine) == Groups{group(1), group(2), group(1)});
  }
}

TEST_CASE("a mapping torus may be a factor, have a cone, and a suspension", "[engine]") {
  const bool lazy_cones = GENERATE(false, true);
  const bool simplicial = GENERATE(false, true);
  for (const std::size_t k : {3U, 6U, 12U, 14U}) {
    CAPTURE(lazy_cones, simplicial, monodromies[k].word);
    Engine engine(ring_named("Z"), limits(lazy_cones), taking_splits_in);
    const Cylinder cylinder = make_cylinder(engine, true, simplicial);
    carry_out(engine, glue(cylinder.bottom, Layers(engine, cylinder.top).add(monodromies[k].word)));
    const Groups groups = mapping_torus_groups(monodromies[k].matrix);
    build(engine, circle("C"));
    carry_out(engine, product("M", "P", "C", false));
    CHECK(live_groups(engine) == trimmed(reductions::kunneth(groups, circle("C").groups)));
    carry_out(engine, ops::Undo{2});
    carry_out(engine, cone_over_body("v", "P"));
    CHECK(live_groups(engine) == Groups{group(1)});
    CHECK(engine.first_defect().value_or("") == "");
    carry_out(engine, ops::Undo{1});
    suspend(engine, "P", "v", "w");
    CHECK(live_groups(engine) == suspended(groups));
    carry_out(engine, ops::Undo{2});
    CHECK(live_groups(engine) == groups);
    CHECK(engine.first_defect().value_or("") == "");
  }
}

TEST_CASE("a mapping torus cut along its fibre is a cylinder again", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const bool simplicial = GENERATE(false, true);
  for (const auto& [word, matrix] : monodromies) {
    CAPTURE(ring, simplicial, word);
    Engine engine(ring_named(ring), {}, taking_splits_in);
    const Cylinder cylinder = make_cylinder(engine, false, simplicial);
    const LayeredTorus top = Layers(engine, cylinder.top).add(word);
    const auto counts = counts_of(engine, "P");
    const std::vector<Incidence> incidences = incidences_of_bottom(engine);
    carry_out(engine, glue(cylinder.bottom, top));
    const ops::Deidentify cut = cut_fibre(engine.structure(), incidences);
    const auto copy_of = [&](const std::string& name) {
      const std::string canonical = engine.structure().name(*engine.structure().lookup(name));
      return std::find_if(cut.splits.begin(), cut.splits.end(),
                          [&](const auto& split) { return split.cell == canonical; })
          ->copy;
    };
    const LayeredTorus copies{copy_of(cylinder.bottom.x_then_y), copy_of(cylinder.bottom.y_then_x)};
    carry_out(engine, cut);
    CHECK(live_groups(engine) == Groups{group(1), group(2), group(1)});
    CHECK(counts_of(engine, "P") == counts);
    CHECK(engine.first_defect().value_or("") == "");
    carry_out(engine, glue(copies, top));
    CHECK(live_groups(engine) == over(engine.ring(), mapping_torus_groups(matrix)));
    CHECK(engine.first_defect().value_or("") == "");
  }
}

TEST_CASE("the Klein bottle is the mapping torus of a reflection of the circle", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const bool simplicial = GENERATE(false, true);
  const bool reflected = GENERATE(false, true);
  CAPTURE(ring, simplicial, reflected);
  Engine engine(ring_named(ring), {}, taking_splits_in);
  // Two edges from v to w: the reflection swaps them.
  carry_out(engine,
            ops::MakeComplex{
                "C", {{"v", {}, {}, {}}, {"w", {}, {}, {}}, {"a", {}, {"w", "v"}, {}}, {"b", {}, {"w", "v"}, {}}}});
  build(engine, edge("I"));
  carry_out(engine, product("P", "C", "I", simplicial));
  const auto end = [&](const std::string& a, const std::string& vertex) {
    return pair_name("P", a, vertex + (simplicial ? "^0" : ""));
  };
  carry_out(engine, identify({{end("C.a", "I.0"), end(reflected ? "C.b" : "C.a", "I.1")},
                              {end("C.b", "I.0"), end(reflected ? "C.a" : "C.b", "I.1")}}));
  CHECK(live_groups(engine) ==
        over(engine.ring(), reflected ? klein_bottle_of_triangles("K").groups : torus_of_triangles("T").groups));
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("mapping tori of spheres know the degree of the antipodal map", "[engine]") {
  const int n = GENERATE(range(0, 4));
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const bool simplicial = GENERATE(false, true);
  const bool antipodal = GENERATE(false, true);
  CAPTURE(n, ring, simplicial, antipodal);
  Engine engine(ring_named(ring), {}, taking_splits_in);
  carry_out(engine, cross_polytope(n));
  CHECK(live_groups(engine) == groups_of_sphere(n));
  build(engine, edge("I"));
  carry_out(engine, product("P", "S", "I", simplicial));
  Pairs pairs;
  for (const ops::CellId c : engine.structure().lazy().cells_of(body_named(engine, "P"))) {
    const std::string name{engine.structure().name(c)};
    if (const std::size_t end = name.find("|I.0"); end != std::string::npos) {
      std::string other = name;
      other[end + 3] = '1';
      std::transform(name.begin(), name.end(), other.begin(), other.begin(), [&](char sign, char same) {
        return !antipodal ? same : (sign == '+' ? '-' : (sign == '-' ? '+' : same));
      });
      pairs.emplace_back(name, other);
    }
  }
  carry_out(engine, identify(pairs));
  // Degree (-1)^(n+1): Wang's sequence again. Two points swapped make one circle.
  const int degree = antipodal && n % 2 == 0 ? -1 : 1;
  Groups expected(static_cast<std::size_t>(n) + 2, group(0));
  expected[0].rank += 1;
  expected[1].rank += 1;
  const auto top = static_cast<std::size_t>(n);
  if (degree == 1) {
    expected[top].rank += 1;
    expected[top + 1].rank += 1;
  } else if (n > 0) {
    expected[top] = direct_sum(expected[top], group(0, {Integer{2}}));
  }
  CHECK(live_groups(engine) == over(engine.ring(), trimmed(expected)));
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("two solid tori make a lens space, a sphere, or the product of a sphere and a circle", "[engine]") {
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  const bool lazy_cones = GENERATE(false, true);
  for (const auto& [word, matrix] : monodromies) {
    CAPTURE(ring, lazy_cones, word);
    Engine engine(ring_named(ring), limits(lazy_cones), taking_splits_in);
    // A solid torus is a disc, the cone over the circle x, times the circle y; x bounds in it.
    const auto solid = [&](const std::string& name) {
      build(engine, circle("x" + name));
      carry_out(engine, cone_over_body("v" + name, "x" + name));
      build(engine, circle("y" + name));
      carry_out(engine, product(name, "x" + name, "y" + name, true));
      return LayeredTorus{pair_name(name, "x" + name + ".e^1", "y" + name + ".e^0"),
                          pair_name(name, "x" + name + ".e^0", "y" + name + ".e^1")};
    };
    const LayeredTorus outside = solid("A");
    const LayeredTorus inside = solid("B");
    const LayeredTorus layered = Layers(engine, outside).add(word);
    CHECK(live_groups(engine) == Groups{group(2), group(2)});
    carry_out(engine, glue(inside, layered));
    // The new x is m_00 x + m_10 y; both x bound.
    const AbelianGroup h1 = group(0, {Integer{matrix[1][0]}});
    CHECK(live_groups(engine) == over(engine.ring(), {group(1), h1, group(h1.rank), group(1)}));
    CHECK(engine.first_defect().value_or("") == "");
  }
}
