// The text form of operations on maps.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "ops/vocabulary/field_values.hpp"
#include "ops/vocabulary/operation_form.hpp"

namespace sesame::ops {
namespace {

Dart read_dart(Fields& in, const std::string& field, const Json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= no_dart) {
    in.wrong(field, "lists of darts, which are numbered from 0", value);
  }
  return static_cast<Dart>(value.get<std::uint64_t>());
}

/// "as":"simplices", or left out.
bool read_as_simplices(Fields& in) {
  const Json* as = in.find("as");
  if (as != nullptr && *as != "simplices") {
    in.wrong("as", "\"simplices\", or left out", *as);
  }
  return as != nullptr;
}

/// What all that make maps have after their own fields.
template <class Op>
void write_rest(const Op& op, JsonText& out) {
  if (op.as_simplices) {
    out.field("as", "simplices");
  }
  if (!op.at.empty()) {
    out.field("at", op.at);
  }
}

MakeGMap read_gmap(Fields& in) {
  MakeGMap op;
  op.name = in.text("name");
  constexpr std::string_view expected = "a list for each involution, with the image of each dart";
  op.alpha = read_each(in.items("alpha", in.need("alpha"), expected), [&](const Json& images) {
    return read_each(in.items("alpha", images, expected), [&](const Json& d) { return read_dart(in, "alpha", d); });
  });
  op.as_simplices = read_as_simplices(in);
  op.at = read_points(in);
  return op;
}

void write_gmap(const MakeGMap& op, JsonText& out) {
  out.field("name", op.name);
  out.field("alpha", op.alpha);
  write_rest(op, out);
}

MakeMap read_map(Fields& in) {
  MakeMap op;
  op.name = in.text("name");
  constexpr std::string_view expected = "a list for each beta_i, with the image of each dart, or null where it is free";
  op.beta = read_each(in.items("beta", in.need("beta"), expected), [&](const Json& images) {
    return read_each(in.items("beta", images, expected),
                     [&](const Json& d) { return d.is_null() ? no_dart : read_dart(in, "beta", d); });
  });
  op.as_simplices = read_as_simplices(in);
  op.at = read_points(in);
  return op;
}

void write_map(const MakeMap& op, JsonText& out) {
  out.field("name", op.name);
  out.key("beta");
  out.begin_list();
  for (const std::vector<Dart>& images : op.beta) {
    out.begin_list();
    for (const Dart image : images) {
      if (image == no_dart) {
        out.null();
      } else {
        out.value(image);
      }
    }
    out.end_list();
  }
  out.end_list();
  write_rest(op, out);
}

MakePolygon read_polygon(Fields& in) {
  MakePolygon op;
  op.name = in.text("name");
  const Json& sides = in.need("sides");
  if (!sides.is_number_unsigned() || sides == 0U || sides > 100'000'000U) {
    in.wrong("sides", "a number from 1 to 100000000", sides);
  }
  op.sides = sides.get<int>();
  op.as_simplices = read_as_simplices(in);
  op.at = read_points(in);
  return op;
}

void write_polygon(const MakePolygon& op, JsonText& out) {
  out.field("name", op.name);
  out.field("sides", op.sides);
  write_rest(op, out);
}

Sew read_sew(Fields& in) {
  Sew op;
  op.dimension = in.small("dim", in.need("dim"), 0);
  constexpr std::string_view expected = "a list of pairs of darts, such as [[\"m:0\",\"k:3\"]]";
  for (const Json& pair : in.items("pairs", in.need("pairs"), expected)) {
    const std::vector<std::string> darts = in.texts("pairs", pair, expected);
    if (darts.size() != 2) {
      in.wrong("pairs", expected, pair);
    }
    op.pairs.emplace_back(darts[0], darts[1]);
  }
  return op;
}

void write_sew(const Sew& op, JsonText& out) {
  out.field("dim", op.dimension);
  out.key("pairs");
  out.begin_list();
  for (const auto& [one, other] : op.pairs) {
    out.list_of(one, other);
  }
  out.end_list();
}

Unsew read_unsew(Fields& in) {
  Unsew op;
  op.dimension = in.small("dim", in.need("dim"), 0);
  op.darts = in.texts("darts", in.need("darts"), "a list of darts, such as [\"m:3\"]");
  return op;
}

void write_unsew(const Unsew& op, JsonText& out) {
  out.field("dim", op.dimension);
  out.field("darts", op.darts);
}

Extend read_extend(Fields& in) { return {in.texts("maps", in.need("maps"), "a list of names of maps")}; }

void write_extend(const Extend& op, JsonText& out) { out.field("maps", op.maps); }

}  // namespace

constinit const Form<MakeGMap> gmap_form{"gmap", read_gmap, write_gmap};
constinit const Form<MakeMap> map_form{"map", read_map, write_map};
constinit const Form<MakePolygon> polygon_form{"polygon", read_polygon, write_polygon};
constinit const Form<Sew> sew_form{"sew", read_sew, write_sew};
constinit const Form<Unsew> unsew_form{"unsew", read_unsew, write_unsew};
constinit const Form<Extend> extend_form{"extend", read_extend, write_extend};

}  // namespace sesame::ops
