// Spaces whose homology is known, made by construction steps.
#include "tests/support/engines.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

using Groups = std::vector<AbelianGroup>;

struct Space {
  std::string name;
  std::vector<std::string> lines;
  Groups groups;
};

std::string cube(const std::string& name, int n) {
  std::string type;
  for (int k = 0; k < n; ++k) {
    type += k == 0 ? "1" : ",1";
  }
  return R"({"op":"simploid","name":")" + name + R"(","type":[)" + type + "]}";
}

/// The face of the n-cube "q" where coordinate i is `value`.
std::string cube_face(int n, int i, int value) {
  std::string suffix;
  for (int k = 0; k < n; ++k) {
    suffix += (k == 0 ? "" : "x") + (k == i ? std::to_string(value) : std::string{"0-1"});
  }
  return "q." + suffix;
}

std::string identify(const std::vector<std::pair<std::string, std::string>>& pairs) {
  return ops::to_text(ops::Identify{pairs});
}

int binomial(int n, int k) { return k == 0 ? 1 : binomial(n, k - 1) * (n - k + 1) / k; }

/// A cube with opposite faces glued.
Space torus_of(int n) {
  Space space{"torus of dimension " + std::to_string(n), {cube("q", n)}, {}};
  std::vector<std::pair<std::string, std::string>> pairs;
  for (int i = 0; i < n; ++i) {
    pairs.emplace_back(cube_face(n, i, 0), cube_face(n, i, 1));
  }
  space.lines.push_back(identify(pairs));
  for (int k = 0; k <= n; ++k) {
    space.groups.push_back(group(static_cast<Index>(binomial(n, k))));
  }
  return space;
}

/// A simplex of dimension n + 1 without its inside, from its n + 2 facets glued along their faces.
Space sphere_of(int n) {
  Space space{"sphere of dimension " + std::to_string(n), {}, {}};
  std::vector<std::pair<std::string, std::string>> pairs;
  std::map<std::string, std::string> first;
  for (int left_out = 0; left_out <= n + 1; ++left_out) {
    const std::string name = "s" + std::to_string(left_out);
    space.lines.push_back(R"({"op":"simplex","name":")" + name + R"(","dim":)" + std::to_string(n) + "}");
    for (int other = 0; other <= n + 1 && n > 0; ++other) {
      if (other == left_out) {
        continue;
      }
      std::string here;
      std::string everywhere;
      for (int v = 0; v <= n + 1; ++v) {
        if (v != left_out && v != other) {
          here += (here.empty() ? "" : "-") + std::to_string(v > left_out ? v - 1 : v);
          everywhere += "-" + std::to_string(v);
        }
      }
      const auto [at, is_new] = first.emplace(everywhere, name + "." + here);
      if (!is_new) {
        pairs.emplace_back(at->second, name + "." + here);
      }
    }
  }
  space.lines.push_back(identify(pairs));
  space.groups.assign(static_cast<std::size_t>(n) + 1, group(0));
  space.groups.front().rank += 1;
  space.groups.back().rank += 1;
  return space;
}

/// RP^n: the boundary of the (n+1)-dimensional cross polytope, antipodal facets glued. Facets are sign vectors; the
/// vertices +e_i and -e_i both have number i in a facet, so antipodal faces correspond in order.
Space projective_space_of(int n) {
  Space space{"projective space of dimension " + std::to_string(n), {}, {}};
  std::vector<std::pair<std::string, std::string>> pairs;
  std::map<std::string, std::string> first;
  const int facets = 1 << (n + 1);
  for (int signs = 0; signs < facets; ++signs) {
    const std::string name = "s" + std::to_string(signs);
    space.lines.push_back(R"({"op":"simplex","name":")" + name + R"(","dim":)" + std::to_string(n) + "}");
    for (int subset = 1; subset < facets; ++subset) {
      std::string here;
      std::string face;
      int lowest_sign = -1;
      for (int i = 0; i <= n; ++i) {
        if ((subset >> i & 1) != 0) {
          const int sign = signs >> i & 1;
          lowest_sign = lowest_sign < 0 ? sign : lowest_sign;  // up to the antipode: the first sign is +
          here += (here.empty() ? "" : "-") + std::to_string(i);
          face += " " + std::to_string(i) + (sign == lowest_sign ? "+" : "-");
        }
      }
      const std::string own = subset == facets - 1 ? name : name + (n == 0 ? "" : "." + here);
      const auto [at, is_new] = first.emplace(face, own);
      if (!is_new) {
        pairs.emplace_back(at->second, own);
      }
    }
  }
  space.lines.push_back(identify(pairs));
  for (int p = 0; p <= n; ++p) {
    space.groups.push_back(p == 0 || (p == n && n % 2 == 1) ? group(1)
                                                            : (p % 2 == 1 ? group(0, {Integer{2}}) : group(0)));
  }
  return space;
}

/// L(n, q): n tetrahedra around an axis 0-1, the rims 2-3; the upper face of each is the lower face of another one.
Space lens_space_of(int n, int q) {
  Space space{"lens space L(" + std::to_string(n) + "," + std::to_string(q) + ")", {}, {}};
  std::vector<std::pair<std::string, std::string>> pairs;
  for (int k = 0; k < n; ++k) {
    space.lines.push_back(R"({"op":"simplex","name":"t)" + std::to_string(k) + R"(","dim":3})");
    const std::string here = "t" + std::to_string(k);
    pairs.emplace_back(here + ".0-1-3", "t" + std::to_string((k + 1) % n) + ".0-1-2");
    pairs.emplace_back(here + ".0-2-3", "t" + std::to_string((k + q) % n) + ".1-2-3");
  }
  space.lines.push_back(identify(pairs));
  space.groups = {group(1), group(0, {Integer{n}}), group(0), group(1)};
  return space;
}

Space moore_space_of(int n) {
  return {"Moore space of Z/" + std::to_string(n),
          {ops::to_text(multiples_of_a_loop("m", n, true))},
          {group(1), n == 1 ? group(0) : group(0, {Integer{n}})}};
}

/// Two cones over a space: every group moves up by one.
Space suspension_of(Space space) {
  space.name = "suspension of the " + space.name;
  // The second cone must not be over the first: it names the cells of highest dimension that were there.
  std::vector<std::string> tops;
  for (const std::string& line : space.lines) {
    const ops::Operation op = operation(line);
    if (const auto* simplex = std::get_if<ops::MakeSimplex>(&op)) {
      tops.push_back(simplex->name);
    } else if (const auto* complex = std::get_if<ops::MakeComplex>(&op)) {
      for (const auto& cell : complex->cells) {
        tops.push_back(complex->name + "." + cell.id);
      }
    }
  }
  space.lines.push_back(ops::to_text(ops::MakeCone{"north", tops, {}}));
  space.lines.push_back(ops::to_text(ops::MakeCone{"south", tops, {}}));
  space.groups.insert(space.groups.begin(), group(1));
  space.groups[1].rank -= 1;
  return space;
}

std::vector<Space> spaces() {
  std::vector<Space> all{
      {"point", {R"({"op":"simplex","name":"p","dim":0})"}, {group(1)}},
      {"ball", {R"({"op":"simploid","name":"b","type":[2,1,1]})"}, {group(1)}},
      {"two points", {R"({"op":"simplex","name":"p","dim":0})", R"({"op":"simplex","name":"q","dim":0})"}, {group(2)}},
      {"torus of two triangles",
       {R"({"op":"simplex","name":"a","dim":2})", R"({"op":"simplex","name":"b","dim":2})",
        identify({{"a.0-2", "b.0-2"}, {"a.0-1", "b.1-2"}, {"a.1-2", "b.0-1"}})},
       {group(1), group(2), group(1)}},
      {"Klein bottle of two triangles",
       {R"({"op":"simplex","name":"a","dim":2})", R"({"op":"simplex","name":"b","dim":2})",
        identify({{"a.0-2", "b.0-1"}, {"a.0-1", "b.1-2"}, {"a.1-2", "b.0-2"}})},
       {group(1), group(1, {Integer{2}})}},
      {"projective plane of two triangles",
       {R"({"op":"simplex","name":"a","dim":2})", R"({"op":"simplex","name":"b","dim":2})",
        identify({{"a.0-1", "b.0-1"}, {"a.0-2", "b.1-2"}, {"a.1-2", "b.0-2"}})},
       {group(1), group(0, {Integer{2}})}},
      {"dunce hat",
       {R"({"op":"simplex","name":"t","dim":2})", identify({{"t.0-1", "t.1-2"}, {"t.0-1", "t.0-2"}})},
       {group(1)}},
      {"Möbius strip",
       {R"({"op":"simplex","name":"t","dim":2})", identify({{"t.0-1", "t.1-2"}})},
       {group(1), group(1)}},
      {"wedge of a 2-sphere and two circles",
       {R"({"op":"simplex","name":"a","dim":1})", R"({"op":"simplex","name":"b","dim":1})",
        R"({"op":"simplex","name":"s","dim":2})", R"({"op":"simplex","name":"t","dim":2})",
        identify({{"s.0-1", "t.0-1"}, {"s.0-2", "t.0-2"}, {"s.1-2", "t.1-2"}}),
        identify({{"a.0", "a.1"}, {"b.0", "b.1"}, {"a.0", "b.0"}, {"b.1", "s.2"}})},
       {group(1), group(2), group(1)}}};
  for (int n = 1; n <= 4; ++n) {
    all.push_back(torus_of(n));
    all.push_back(sphere_of(n));
    all.push_back(projective_space_of(n));
  }
  all.push_back(sphere_of(5));
  for (const auto& [n, q] : {std::pair{2, 1}, {3, 1}, {4, 1}, {5, 2}, {7, 3}, {12, 5}}) {
    all.push_back(lens_space_of(n, q));
  }
  for (int n = 1; n <= 12; ++n) {
    all.push_back(moore_space_of(n));
  }
  all.push_back(suspension_of(projective_space_of(2)));
  all.push_back(suspension_of(lens_space_of(5, 2)));
  all.push_back(suspension_of(moore_space_of(6)));
  return all;
}

}  // namespace

TEST_CASE("known spaces have their homology over Z, and over Z/2 and Z/3 what universal coefficients say", "[engine]") {
  for (const Space& space : spaces()) {
    CAPTURE(space.name);
    Groups expected = space.groups;
    while (expected.back().is_trivial()) {
      expected.pop_back();
    }
    Engine integral;
    build(integral, space.lines);
    CHECK(live_groups(integral) == expected);
    CHECK(integral.first_defect().value_or("") == "");
    for (const std::uint32_t p : {2U, 3U}) {
      Engine modular(ring_named("Z/" + std::to_string(p)));
      build(modular, space.lines);
      Groups dimensions;
      for (const Index dimension : reductions::betti_numbers_modulo(space.groups, p)) {
        dimensions.push_back(group(dimension));
      }
      while (dimensions.back().is_trivial()) {
        dimensions.pop_back();
      }
      CHECK(live_groups(modular) == dimensions);
      CHECK(modular.first_defect().value_or("") == "");
    }
  }
}

TEST_CASE("a cone over everything is contractible, whatever it is over", "[engine][stream]") {
  const unsigned seed = GENERATE(range(0U, 8U));
  CAPTURE(seed);
  Engine engine;
  RandomSteps random(seed, {.most_cells = 60, .simploids = false, .cones = true});
  for (int k = 0; k < 20; ++k) {
    carry_out(engine, random.next(engine.structure()));
  }
  carry_out(engine, R"({"op":"cone","apex":"v"})");
  CHECK(live_groups(engine) == Groups{group(1)});
  CHECK(engine.structure().bodies().current().size() == 1);
  CHECK(engine.first_defect().value_or("") == "");
}
