// The text form of operations on maps.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

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

std::vector<std::vector<Dart>> read_alpha(Fields& in) {
  constexpr std::string_view expected = "a list for each involution, with the image of each dart";
  return read_each(in.items("alpha", in.need("alpha"), expected), [&](const Json& images) {
    return read_each(in.items("alpha", images, expected), [&](const Json& d) { return read_dart(in, "alpha", d); });
  });
}

MakeGMap read_gmap(Fields& in) {
  MakeGMap op;
  op.name = in.text("name");
  op.alpha = read_alpha(in);
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

MakeChainOfMaps::Level read_level(const Json& value) {
  if (!value.is_object()) {
    throw Wrong{fmt::format("field \"levels\" should be a list of objects with \"alpha\" and \"sigma\", but holds {}",
                            json_kind(value))};
  }
  Fields in(value, "a level of a chain of maps");
  MakeChainOfMaps::Level level;
  level.alpha = read_alpha(in);
  level.sigma = read_each(in.items("sigma", in.need("sigma"), "a list of darts of the level below, one for each dart"),
                          [&](const Json& d) { return read_dart(in, "sigma", d); });
  in.finish();
  return level;
}

/// Level 0 has neither involutions nor images: how many darts it has may be said, or is as many as level 1 needs.
std::optional<Dart> read_points_of_chain(const Json& value) {
  if (!value.is_object()) {
    throw Wrong{
        fmt::format("field \"levels\" should begin with an object for the vertices, such as {{\"darts\":3}}, but "
                    "with {}",
                    json_kind(value))};
  }
  Fields in(value, "level 0 of a chain of maps");
  for (const char* field : {"alpha", "sigma"}) {
    constexpr std::string_view expected = "an empty list on level 0, or left out";
    if (const Json* list = in.find(field); list != nullptr && !in.items(field, *list, expected).empty()) {
      in.wrong(field, expected, *list);
    }
  }
  const Json* darts = in.find("darts");
  const std::optional<Dart> count = darts != nullptr ? std::optional{read_dart(in, "darts", *darts)} : std::nullopt;
  in.finish();
  return count;
}

MakeChainOfMaps read_chain_of_maps(Fields& in) {
  MakeChainOfMaps op;
  op.name = in.text("name");
  const std::vector<Json>& levels = in.items("levels", in.need("levels"), "a list of levels, from the vertices on");
  if (levels.empty()) {
    in.wrong("levels", "a list of levels, from the vertices on", in.need("levels"));
  }
  const std::optional<Dart> points = read_points_of_chain(levels[0]);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    op.levels.push_back(read_level(levels[i]));
  }
  if (points) {
    op.points = *points;
  } else if (!op.levels.empty() && !op.levels[0].sigma.empty()) {
    op.points = std::ranges::max(op.levels[0].sigma) + 1;
  } else {
    throw Wrong{"level 0 of a chain of maps needs a field \"darts\", the number of vertices, where there is no other"};
  }
  op.as_simplices = read_as_simplices(in);
  op.at = read_points(in);
  return op;
}

void write_chain_of_maps(const MakeChainOfMaps& op, JsonText& out) {
  out.field("name", op.name);
  out.key("levels");
  out.begin_list();
  out.begin_object();
  out.field("darts", op.points);
  out.end_object();
  for (const MakeChainOfMaps::Level& level : op.levels) {
    out.begin_object();
    out.field("alpha", level.alpha);
    out.field("sigma", level.sigma);
    out.end_object();
  }
  out.end_list();
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
constinit const Form<MakeChainOfMaps> chain_of_maps_form{"chain_of_maps", read_chain_of_maps, write_chain_of_maps};
constinit const Form<Sew> sew_form{"sew", read_sew, write_sew};
constinit const Form<Unsew> unsew_form{"unsew", read_unsew, write_unsew};
constinit const Form<Extend> extend_form{"extend", read_extend, write_extend};

}  // namespace sesame::ops
