/// \file
/// Small bodies with known homology, of every kind that constructions start from, and ways to combine them.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ops/cells/cofaces.hpp"
#include "tests/support/complexes.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/random_steps.hpp"

namespace sesame::tests {

using Groups = std::vector<AbelianGroup>;
using Pairs = std::vector<std::pair<std::string, std::string>>;

/// The rings over which what happens to torsion differs.
inline const std::vector<std::string> test_rings{"Z", "Z/2", "Z/3"};

/// Default limits, or those under which every cone over a whole body is lazy.
inline ops::Limits limits(bool lazy_cones) {
  return lazy_cones ? ops::Limits{.cells_of_explicit_cone = 0} : ops::Limits{};
}

/// A body under its name, how it is made, and its integral homology.
struct Body {
  std::string name;
  std::string what;
  std::vector<ops::Operation> steps;
  Groups groups;
  bool has_only_simplices = true;
};

inline void build(Engine& engine, const Body& body) {
  for (const ops::Operation& step : body.steps) {
    carry_out(engine, step);
  }
}

inline ops::Operation identify(Pairs pairs) { return ops::Identify{std::move(pairs)}; }
inline ops::Operation product(const std::string& name, const std::string& left, const std::string& right,
                              bool simplicial) {
  return ops::MakeProduct{name, left, right, simplicial};
}
inline ops::Operation cone_over_body(const std::string& apex, const std::string& body) {
  return ops::MakeCone{apex, body, {}};
}
inline ops::Operation cone_over_cells(const std::string& apex, std::vector<std::string> cells) {
  return ops::MakeCone{apex, std::move(cells), {}};
}

/// The name of the cell (a|b) of a product.
inline std::string pair_name(const std::string& product, const std::string& a, const std::string& b) {
  return product + ".(" + a + "|" + b + ")";
}

inline Groups trimmed(Groups groups) {
  while (!groups.empty() && groups.back().is_trivial()) {
    groups.pop_back();
  }
  return groups;
}

/// What integral groups are over a ring, by universal coefficients.
inline Groups over(const AnyRing& ring, const Groups& integral) {
  const std::uint32_t p = std::visit([](const auto& r) { return r.characteristic(); }, ring);
  if (p == 0) {
    return trimmed(integral);
  }
  Groups dimensions;
  for (const Index dimension : reductions::betti_numbers_modulo(integral, p)) {
    dimensions.push_back(group(dimension));
  }
  return trimmed(dimensions);
}

/// The reduced homology of a space that is not empty moves up by one.
inline Groups suspended(Groups groups) {
  groups.insert(groups.begin(), group(1));
  groups[1].rank -= 1;
  return trimmed(groups);
}

inline Groups sum(const Groups& a, const Groups& b) {
  Groups total;
  for (std::size_t p = 0; p < std::max(a.size(), b.size()); ++p) {
    total.push_back(direct_sum(p < a.size() ? a[p] : group(0), p < b.size() ? b[p] : group(0)));
  }
  return total;
}

// ---- standard cells

inline ops::Operation simploid(const std::string& name, const ops::CellType& type) {
  return ops::MakeSimploid{name, type, {}};
}

inline int dimension_of(const ops::CellType& type) {
  int dimension = 0;
  for (const int a : type) {
    dimension += a;
  }
  return dimension;
}

/// Every type of a dimension: its ordered partitions.
inline std::vector<ops::CellType> types_of_dimension(int dimension) {
  if (dimension == 0) {
    return {{}};
  }
  std::vector<ops::CellType> types;
  for (int first = 1; first <= dimension; ++first) {
    for (ops::CellType rest : types_of_dimension(dimension - first)) {
      rest.insert(rest.begin(), first);
      types.push_back(std::move(rest));
    }
  }
  return types;
}

/// A standard cell without its inside: its cells are called `name`.SUFFIX. Requires: not a vertex.
inline ops::MakeComplex boundary_of_standard(const std::string& name, const ops::CellType& type) {
  ops::TypeTable types;
  const ops::StandardCell& standard = types.standard(types.intern(type));
  ops::MakeComplex complex{name, {}};
  for (const ops::StandardFace& face : standard.cells) {
    if (face.suffix == standard.cells.back().suffix) {
      continue;
    }
    ops::MakeComplex::Cell cell{face.suffix, {}, {}, {}};
    if (const ops::CellType& own = types.info(face.type).type; !own.empty()) {
      cell.type = own;
    }
    for (const std::uint32_t position : face.faces) {
      cell.faces.push_back(standard.cells[position].suffix);
    }
    complex.cells.push_back(std::move(cell));
  }
  return complex;
}

inline Groups groups_of_sphere(int n) {
  Groups groups(static_cast<std::size_t>(n) + 1, group(0));
  groups.front().rank += 1;
  groups.back().rank += 1;
  return groups;
}

// ---- bodies of simplices

inline Body point(const std::string& name) { return {name, "point", {ops::MakeSimplex{name, 0, {}}}, {group(1)}}; }
inline Body edge(const std::string& name) { return {name, "edge", {ops::MakeSimplex{name, 1, {}}}, {group(1)}}; }

inline Body points(const std::string& name, int count) {
  ops::MakeComplex complex{name, {}};
  for (int k = 0; k < count; ++k) {
    complex.cells.push_back({std::to_string(k), {}, {}, {}});
  }
  return {name, std::to_string(count) + " points", {complex}, {group(static_cast<Index>(count))}};
}

/// One vertex `name`.v and one loop `name`.e.
inline Body circle(const std::string& name) {
  return {
      name, "circle", {ops::MakeComplex{name, {{"v", {}, {}, {}}, {"e", {}, {"v", "v"}, {}}}}}, {group(1), group(1)}};
}

/// A simplex whose boundary is squashed to a vertex.
inline Body squashed_sphere(const std::string& name, int n) {
  Body body{name, "squashed sphere " + std::to_string(n), {ops::MakeSimplex{name, n, {}}}, groups_of_sphere(n)};
  for (const ops::MakeComplex::Cell& cell : boundary_of_standard(name, {n}).cells) {
    if (!cell.faces.empty()) {
      body.steps.emplace_back(ops::Degenerate{name + "." + cell.id, {}, 0});
    }
  }
  return body;
}

/// The projective plane with one cell per dimension: a triangle with two equal sides, the third squashed.
inline Body plane_of_three_cells(const std::string& name) {
  return {name,
          "projective plane of three cells",
          {ops::MakeSimplex{name, 2, {}}, ops::Degenerate{name + ".0-2", {}, 0},
           identify({{name + ".0-1", name + ".1-2"}})},
          {group(1), group(0, {Integer{2}})}};
}

/// Two triangles `name` and `name`' with these sides identified.
inline Body two_triangles(const std::string& name, const std::string& what, const Pairs& sides, const Groups& groups) {
  Pairs pairs;
  for (const auto& [own, other] : sides) {
    pairs.emplace_back(name + "." + own, name + "'." + other);
  }
  return {name, what, {ops::MakeSimplex{name, 2, {}}, ops::MakeSimplex{name + "'", 2, {}}, identify(pairs)}, groups};
}
/// Triangles "x, then y" and `name`' "y, then x", for the loops x = `name`.0-1 and y = `name`.1-2.
inline Body torus_of_triangles(const std::string& name) {
  return two_triangles(name, "torus", {{"0-2", "0-2"}, {"0-1", "1-2"}, {"1-2", "0-1"}}, {group(1), group(2), group(1)});
}
inline Body klein_bottle_of_triangles(const std::string& name) {
  return two_triangles(name, "Klein bottle", {{"0-2", "0-1"}, {"0-1", "1-2"}, {"1-2", "0-2"}},
                       {group(1), group(1, {Integer{2}})});
}
inline Body plane_of_triangles(const std::string& name) {
  return two_triangles(name, "projective plane", {{"0-1", "0-1"}, {"0-2", "1-2"}, {"1-2", "0-2"}},
                       {group(1), group(0, {Integer{2}})});
}

inline Body moore_body(const std::string& name, int n) {
  return {name,
          "Moore space of Z/" + std::to_string(n),
          {multiples_of_a_loop(name, n, true)},
          {group(1), group(0, {Integer{n}})}};
}

/// A Moore space of Z/n, a circle and a point, in one body.
inline Body scattered(const std::string& name, int n) {
  ops::MakeComplex complex = multiples_of_a_loop(name, n, true);
  for (const ops::MakeComplex::Cell& cell :
       {ops::MakeComplex::Cell{"p", {}, {}, {}}, {"u", {}, {}, {}}, {"l", {}, {"u", "u"}, {}}}) {
    complex.cells.push_back(cell);
  }
  return {name,
          "Moore space of Z/" + std::to_string(n) + ", circle and point",
          {complex},
          {group(3), group(1, {Integer{n}})}};
}

// ---- bodies of simploids

inline Body torus_of_square(const std::string& name) {
  return {name,
          "torus of a square",
          {simploid(name, {1, 1}), identify({{name + ".0x0-1", name + ".1x0-1"}, {name + ".0-1x0", name + ".0-1x1"}})},
          {group(1), group(2), group(1)},
          false};
}
inline Body prism(const std::string& name) { return {name, "prism", {simploid(name, {2, 1})}, {group(1)}, false}; }
/// A square torus and a projective plane that share a vertex.
inline Body mixed_wedge(const std::string& name) {
  Body body = torus_of_square(name);
  const Body plane = plane_of_three_cells(name + "'");
  body.steps.insert(body.steps.end(), plane.steps.begin(), plane.steps.end());
  body.steps.push_back(identify({{name + ".0x0", name + "'.0"}}));
  body.what = "torus of a square and projective plane, with one point in common";
  body.groups[1].torsion = {Integer{2}};
  return body;
}

// ---- looking at bodies

inline ops::BodyId body_named(const Engine& engine, const std::string& name) {
  const auto body = engine.structure().lookup_body(name);
  if (!body) {
    FAIL("no body " << name);
  }
  return *body;
}

/// The current cells of all bodies, by body and age.
inline std::vector<ops::CellId> all_cells(const Engine& engine) {
  std::vector<ops::CellId> cells;
  for (const ops::BodyId body : engine.structure().bodies().current()) {
    const auto own = engine.structure().lazy().cells_of(body);
    cells.insert(cells.end(), own.begin(), own.end());
  }
  return cells;
}

/// The names of the cells of a body that are no face of another cell: their closure is the body.
inline std::vector<std::string> top_cells(const Engine& engine, const std::string& body) {
  std::vector<std::string> names;
  for (const ops::CellId c : engine.structure().lazy().cells_of(body_named(engine, body))) {
    if (cofaces(engine.structure(), c).empty()) {
      names.emplace_back(engine.structure().name(c));
    }
  }
  return names;
}

/// The numbers of cells of a body by dimension.
inline std::vector<std::uint64_t> counts_of(const Engine& engine, const std::string& body) {
  const auto counts = engine.structure().bodies().counts(body_named(engine, body));
  std::vector<std::uint64_t> list{counts.begin(), counts.end()};
  while (!list.empty() && list.back() == 0) {
    list.pop_back();
  }
  return list;
}

/// A body as one explicit complex, its cells numbered by age. Requires: no face is degenerate.
inline ops::MakeComplex written_out(const Engine& engine, const std::string& body, const std::string& name) {
  const ops::Structure& structure = engine.structure();
  const std::vector<ops::CellId> cells = structure.lazy().cells_of(body_named(engine, body));
  std::map<ops::CellId, std::string> ids;
  for (const ops::CellId c : cells) {
    ids.emplace(c, std::to_string(ids.size()));
  }
  ops::MakeComplex complex{name, {}};
  for (const ops::CellId c : cells) {
    ops::MakeComplex::Cell cell{ids.at(c), {}, {}, {}};
    if (structure.dimension(c) > 0) {
      cell.type = structure.cells().type(c).type;
    }
    for (const ops::CellId face : structure.faces().of(c)) {
      cell.faces.push_back(ids.at(structure.find(face)));
    }
    complex.cells.push_back(std::move(cell));
  }
  return complex;
}

/// Two cones over a body: the first over the body by its name, the second over what was there before.
inline void suspend(Engine& engine, const std::string& body, const std::string& north, const std::string& south) {
  const std::vector<std::string> tops = top_cells(engine, body);
  carry_out(engine, cone_over_body(north, body));
  carry_out(engine, cone_over_cells(south, tops));
}

}  // namespace sesame::tests
