#include "ops/vocabulary/map_lines.hpp"

#include <string>
#include <utility>
#include <vector>

namespace sesame::ops::line {
namespace {

/// What all that make maps have beside their own field: a name, "as" and "at".
template <class Op, class Read>
Op read_map_with(json::object object, std::string_view own, Read read) {
  Op op;
  bool is_named = false, has_own = false;
  each_field_but_op(object, [&](std::string_view name, json::value value) -> unsigned {
    if (name == "name") {
      op.name = text(value);
      is_named = true;
      return 1;
    }
    if (name == own) {
      read(value, op);
      has_own = true;
      return 2;
    }
    if (name == "as") {
      require(got(value.get_string()) == "simplices");
      op.as_simplices = true;
      return 3;
    }
    require(name == "at");
    each(value, [&](json::value item) { op.at.push_back(point(item)); });
    return 4;
  });
  require(is_named && has_own);
  return op;
}

Dart dart(json::value value) {
  const std::uint64_t number = got(value.get_uint64());
  require(number < no_dart);
  return static_cast<Dart>(number);
}

Operation read_polygon_line(json::object object) {
  return read_map_with<MakePolygon>(object, "sides", [](json::value value, MakePolygon& op) {
    const std::uint64_t sides = got(value.get_uint64());
    require(sides >= 1 && sides <= 100'000'000);
    op.sides = static_cast<int>(sides);
  });
}

Operation read_gmap_line(json::object object) {
  return read_map_with<MakeGMap>(object, "alpha", [](json::value value, MakeGMap& op) {
    each(value, [&](json::value images) {
      std::vector<Dart>& of = op.alpha.emplace_back();
      each(images, [&](json::value image) { of.push_back(dart(image)); });
    });
  });
}

/// An operation that has a dimension and one list, whose items read_item(item, operation) reads.
template <class Op, class ReadItem>
Op read_in_dimension(json::object object, std::string_view list, ReadItem read_item) {
  Op op;
  unsigned met = 0;
  each_field_but_op(object, [&](std::string_view name, json::value value) -> unsigned {
    ++met;
    if (name == "dim") {
      op.dimension = small(value, 0);
      return 1;
    }
    require(name == list);
    each(value, [&](json::value item) { read_item(item, op); });
    return 2;
  });
  require(met == 2);
  return op;
}

Operation read_sew_line(json::object object) {
  return read_in_dimension<Sew>(object, "pairs", [](json::value item, Sew& op) {
    std::pair<std::string, std::string>& pair = op.pairs.emplace_back();
    unsigned parts = 0;
    each(item, [&](json::value part) {
      require(parts < 2);
      (parts++ == 0 ? pair.first : pair.second) = text(part);
    });
    require(parts == 2);
  });
}

Operation read_unsew_line(json::object object) {
  return read_in_dimension<Unsew>(object, "darts", [](json::value item, Unsew& op) { op.darts.push_back(text(item)); });
}

}  // namespace

Operation read_of_maps(std::string_view op, json::object object) {
  if (op == "sew") {
    return read_sew_line(object);
  }
  if (op == "polygon") {
    return read_polygon_line(object);
  }
  if (op == "gmap") {
    return read_gmap_line(object);
  }
  require(op == "unsew");
  return read_unsew_line(object);
}

}  // namespace sesame::ops::line
