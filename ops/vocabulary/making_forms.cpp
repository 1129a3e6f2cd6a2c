// The text form of the operations that make cells out of nothing, or out of whole bodies.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "ops/vocabulary/field_values.hpp"
#include "ops/vocabulary/operation_form.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

// ------------------------------------------------------------------------------------------------- points, types,
// bases

/// A point for each vertex, or none at all.
std::vector<Point> read_points(Fields& in, std::size_t vertices) {
  std::vector<Point> all = read_points(in);
  if (in.find("at") != nullptr && all.size() != vertices) {
    throw Wrong{fmt::format("field \"at\" should have {} points, one per vertex, but has {}", vertices, all.size())};
  }
  return all;
}

void write_points(const std::vector<Point>& points, JsonText& out) {
  if (!points.empty()) {
    out.field("at", points);
  }
}

CellType read_type(Fields& in, const Json& value) {
  return read_each(in.items("type", value, "a list of dimensions >= 1, such as [2,1]"),
                   [&](const Json& a) { return in.small("type", a, 1); });
}

ConeBase read_base(Fields& in) {
  const Json* over = in.find("over");
  if (over == nullptr) {
    return {};
  }
  if (over->is_string()) {
    return over->get<std::string>();
  }
  return in.texts("over", *over, "the name of a body or a list of cells");
}

void write_base(const ConeBase& over, JsonText& out) {
  if (const auto* body = std::get_if<std::string>(&over)) {
    out.field("over", *body);
  } else if (const auto* cells = std::get_if<std::vector<std::string>>(&over)) {
    out.field("over", *cells);
  }
}

// ----------------------------------------------------------------------------------------------- simplices and
// simploids

MakeSimplex read_simplex(Fields& in) {
  MakeSimplex op;
  op.name = in.text("name");
  op.dimension = in.small("dim", in.need("dim"), 0);
  op.at = read_points(in, static_cast<std::size_t>(op.dimension) + 1);
  return op;
}

void write_simplex(const MakeSimplex& op, JsonText& out) {
  out.field("name", op.name);
  out.field("dim", op.dimension);
  write_points(op.at, out);
}

std::size_t saturating_vertices(const CellType& type) {
  std::size_t vertices = 1;
  for (const int a : type) {
    if (__builtin_mul_overflow(vertices, static_cast<std::size_t>(a) + 1, &vertices)) {
      return std::numeric_limits<std::size_t>::max();
    }
  }
  return vertices;
}

MakeSimploid read_simploid(Fields& in) {
  MakeSimploid op;
  op.name = in.text("name");
  op.type = read_type(in, in.need("type"));
  op.at = read_points(in, saturating_vertices(op.type));
  return op;
}

void write_simploid(const MakeSimploid& op, JsonText& out) {
  out.field("name", op.name);
  out.field("type", op.type);
  write_points(op.at, out);
}

// ------------------------------------------------------------------------------------------------------------
// complexes

/// "dim" and "boundary":[[2,"e"],...]: each cell once, with what its coefficients add up to.
void read_boundary(Fields& in, MakeComplex::Cell& cell) {
  if (cell.type || in.find("faces") != nullptr) {
    throw Wrong{fmt::format("cell {} has a \"dim\" or a \"boundary\", so it can have no \"type\" and no \"faces\"",
                            sparse::quoted(cell.id))};
  }
  ListedBoundary boundary;
  boundary.dimension = in.small("dim", in.need("dim"), 0);
  constexpr std::string_view expected = "a list of coefficients and cell ids, such as [[2,\"e\"],[-1,\"f\"]]";
  const Json* sum = in.find("boundary");
  if (sum == nullptr) {
    cell.boundary = std::move(boundary);
    return;
  }
  for (const Json& term : in.items("boundary", *sum, expected)) {
    if (!term.is_array() || term.size() != 2 || !term[0].is_number_integer() || !term[1].is_string()) {
      in.wrong("boundary", expected, term);
    }
    constexpr std::int64_t largest = 1'000'000'000;
    const Json& value = term[0];
    const bool is_small = value.is_number_unsigned() ? value.get<std::uint64_t>() <= std::uint64_t{largest}
                                                     : value.get<std::int64_t>() >= -largest;
    if (!is_small || value == 0) {
      throw Wrong{fmt::format("the boundary of cell {} has {} times {}: coefficients are not 0, and at most {}",
                              sparse::quoted(cell.id), value.dump(), sparse::quoted(term[1].get<std::string>()),
                              largest)};
    }
    cell.faces.push_back(term[1].get<std::string>());
    boundary.coefficients.push_back(value.get<int>());
  }
  cell.boundary = std::move(boundary);
}

MakeComplex::Cell read_cell(const Json& value) {
  if (!value.is_object()) {
    throw Wrong{
        fmt::format("field \"cells\" should be a list of objects with an \"id\", but holds {}", json_kind(value))};
  }
  Fields in(value, "a cell of a complex");
  MakeComplex::Cell cell;
  cell.id = in.text("id");
  if (const Json* type = in.find("type")) {
    cell.type = read_type(in, *type);
  }
  if (const Json* faces = in.find("faces")) {
    cell.faces = in.texts("faces", *faces, "a list of cell ids");
  }
  if (in.find("dim") != nullptr || in.find("boundary") != nullptr) {
    read_boundary(in, cell);
  }
  if (in.find("at") != nullptr && (!cell.faces.empty() || (cell.boundary && cell.boundary->dimension > 0))) {
    throw Wrong{fmt::format("cell {} has a position \"at\", but only vertices have one", sparse::quoted(cell.id))};
  }
  cell.at = read_point(in);
  in.finish();
  return cell;
}

void write_boundary(const MakeComplex::Cell& cell, JsonText& out) {
  out.field("dim", cell.boundary->dimension);
  if (cell.faces.empty()) {
    return;
  }
  out.key("boundary");
  out.begin_list();
  for (std::size_t k = 0; k < cell.faces.size(); ++k) {
    out.list_of(cell.boundary->coefficients[k], cell.faces[k]);
  }
  out.end_list();
}

MakeComplex read_complex(Fields& in) {
  MakeComplex op;
  op.name = in.text("name");
  for (const Json& item : in.items("cells", in.need("cells"), "a list of cells")) {
    op.cells.push_back(read_cell(item));
  }
  return op;
}

void write_cells(const CellList& cells, JsonText& out) {
  out.key("cells");
  out.begin_list();
  for (const MakeComplex::Cell& cell : cells) {
    out.begin_object();
    out.field("id", cell.id);
    if (cell.type) {
      out.field("type", *cell.type);
    }
    if (cell.boundary) {
      write_boundary(cell, out);
    } else if (!cell.faces.empty()) {
      out.field("faces", cell.faces);
    }
    if (cell.at) {
      out.field("at", *cell.at);
    }
    out.end_object();
  }
  out.end_list();
}

void write_complex(const MakeComplex& op, JsonText& out) {
  out.field("name", op.name);
  write_cells(op.cells, out);
}

// ------------------------------------------------------------------------------------------------------------
// incidence graphs

MakeIncidence read_incidence(Fields& in) {
  MakeIncidence op;
  op.name = in.text("name");
  for (const Json& item : in.items("cells", in.need("cells"), "a list of cells")) {
    MakeComplex::Cell cell = read_cell(item);
    if (cell.type || cell.boundary) {
      throw Wrong{
          fmt::format("cell {} of an incidence graph has a \"{}\", but should have an \"id\" and \"faces\" only",
                      sparse::quoted(cell.id), cell.type ? "type" : "dim")};
    }
    op.cells.push_back(cell);
  }
  if (const Json* as = in.find("as")) {
    if (*as != "simplices") {
      in.wrong("as", "\"simplices\", or left out", *as);
    }
    op.as_simplices = true;
  }
  return op;
}

void write_incidence(const MakeIncidence& op, JsonText& out) {
  out.field("name", op.name);
  write_cells(op.cells, out);
  if (op.as_simplices) {
    out.field("as", "simplices");
  }
}

// ------------------------------------------------------------------------------------------------ cones and
// suspensions

MakeCone read_cone(Fields& in) {
  MakeCone op;
  op.apex = in.text("apex");
  op.over = read_base(in);
  op.at = read_point(in);
  return op;
}

void write_cone(const MakeCone& op, JsonText& out) {
  out.field("apex", op.apex);
  write_base(op.over, out);
  if (op.at) {
    out.field("at", *op.at);
  }
}

MakeSuspension read_suspension(Fields& in) {
  MakeSuspension op;
  constexpr std::string_view expected = "a list of two names, such as [\"n\",\"s\"]";
  const std::vector<std::string> names = in.texts("apexes", in.need("apexes"), expected);
  if (names.size() != op.apexes.size()) {
    throw Wrong{fmt::format("field \"apexes\" of a suspension should be {}, but lists {}", expected, names.size())};
  }
  std::copy(names.begin(), names.end(), op.apexes.begin());
  op.over = read_base(in);
  op.at = read_points(in, op.apexes.size());
  return op;
}

void write_suspension(const MakeSuspension& op, JsonText& out) {
  out.field("apexes", op.apexes);
  write_base(op.over, out);
  write_points(op.at, out);
}

// -------------------------------------------------------------------------------------------------------------
// products

MakeProduct read_product(Fields& in) {
  MakeProduct op;
  op.name = in.text("name");
  op.left = in.text("left");
  op.right = in.text("right");
  if (const Json* kind = in.find("kind")) {
    const std::string word = in.text("kind", *kind);
    if (word != "simploidal" && word != "simplicial") {
      throw Wrong{fmt::format("field \"kind\" of a product should be \"simploidal\" or \"simplicial\", but is {}",
                              sparse::quoted(word))};
    }
    op.simplicial = word == "simplicial";
  }
  return op;
}

void write_product(const MakeProduct& op, JsonText& out) {
  out.field("name", op.name);
  out.field("left", op.left);
  out.field("right", op.right);
  if (op.simplicial) {
    out.field("kind", "simplicial");
  }
}

}  // namespace

constinit const Form<MakeSimplex> simplex_form{"simplex", read_simplex, write_simplex};
constinit const Form<MakeSimploid> simploid_form{"simploid", read_simploid, write_simploid};
constinit const Form<MakeComplex> complex_form{"complex", read_complex, write_complex};
constinit const Form<MakeIncidence> incidence_form{"incidence", read_incidence, write_incidence};
constinit const Form<MakeCone> cone_form{"cone", read_cone, write_cone};
constinit const Form<MakeSuspension> suspension_form{"suspend", read_suspension, write_suspension};
constinit const Form<MakeProduct> product_form{"product", read_product, write_product};

}  // namespace sesame::ops
