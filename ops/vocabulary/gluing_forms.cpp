// The text form of the operations that glue cells, squash them, take them apart and take them away.
#include <nlohmann/json.hpp>

#include "ops/vocabulary/operation_form.hpp"

namespace sesame::ops {
namespace {

/// [2,0,1] for a simplex, a list of such lists for a simploid: one for each component.
Identify::Map read_vertex_map(Fields& in, const Json& value) {
  constexpr std::string_view expected = "a vertex map, such as [2,0,1], or [[1,0],[0,1]] for a simploid";
  const auto component = [&](const Json& entries) {
    return read_each(in.items("pairs", entries, expected), [&](const Json& n) { return in.small("pairs", n, 0); });
  };
  if (!value.is_array() || value.empty()) {
    in.wrong("pairs", expected, value);
  }
  return value[0].is_array() ? read_each(in.items("pairs", value, expected), component)
                             : Identify::Map{component(value)};
}

Identify read_identify(Fields& in) {
  Identify op;
  constexpr std::string_view expected = "a list of pairs of cells, [[\"a\",\"b\"],...] or [[\"a\",\"b\",[1,0]],...]";
  std::size_t position = 0;
  op.pairs = read_each(in.items("pairs", in.need("pairs"), expected), [&](const Json& pair) {
    if (!pair.is_array() || pair.size() < 2 || pair.size() > 3) {
      in.wrong("pairs", expected, pair);
    }
    if (pair.size() == 3) {
      op.maps.emplace(position, read_vertex_map(in, pair[2]));
    }
    ++position;
    return std::pair{in.text("pairs", pair[0]), in.text("pairs", pair[1])};
  });
  return op;
}

void write_vertex_map(const Identify::Map& map, JsonText& out) {
  if (map.size() == 1) {
    out.value(map[0]);
  } else {
    out.value(map);
  }
}

void write_identify(const Identify& op, JsonText& out) {
  out.key("pairs");
  out.begin_list();
  for (std::size_t k = 0; k < op.pairs.size(); ++k) {
    out.begin_list();
    out.value(op.pairs[k].first);
    out.value(op.pairs[k].second);
    if (const auto map = op.maps.find(k); map != op.maps.end()) {
      write_vertex_map(map->second, out);
    }
    out.end_list();
  }
  out.end_list();
}

Degenerate read_degenerate(Fields& in) {
  Degenerate op;
  op.cell = in.text("cell");
  const Json& along = in.need("along");
  if (along.is_array() && along.size() == 2) {
    op.component = in.small("along", along[0], 1);
    op.index = in.small("along", along[1], 0);
  } else if (along.is_array()) {
    in.wrong("along", "an index i for a simplex, or [i,j] for a simploid", along);
  } else {
    op.index = in.small("along", along, 0);
  }
  return op;
}

void write_degenerate(const Degenerate& op, JsonText& out) {
  out.field("cell", op.cell);
  out.key("along");
  if (op.component) {
    out.list_of(*op.component, op.index);
  } else {
    out.value(op.index);
  }
}

Deidentify::Split read_split(const Json& item) {
  Fields in(item, "a split");
  Deidentify::Split split;
  split.cell = in.text("cell");
  split.copy = in.text("as");
  constexpr std::string_view expected = "a list of incidences, [[\"cell\",face number],...]";
  split.moves = read_each(in.items("moves", in.need("moves"), expected), [&](const Json& move) {
    if (!move.is_array() || move.size() != 2) {
      in.wrong("moves", expected, move);
    }
    return std::pair{in.text("moves", move[0]), std::int64_t{in.small("moves", move[1], 0)}};
  });
  in.finish();
  return split;
}

Deidentify read_deidentify(Fields& in) {
  constexpr std::string_view expected = "a list of objects with \"cell\", \"as\" and \"moves\"";
  return {read_each(in.items("split", in.need("split"), expected), [&](const Json& item) {
    if (!item.is_object()) {
      in.wrong("split", expected, item);
    }
    return read_split(item);
  })};
}

void write_deidentify(const Deidentify& op, JsonText& out) {
  out.key("split");
  out.begin_list();
  for (const Deidentify::Split& split : op.splits) {
    out.begin_object();
    out.field("cell", split.cell);
    out.field("as", split.copy);
    out.key("moves");
    out.begin_list();
    for (const auto& [cell, face] : split.moves) {
      out.list_of(cell, face);
    }
    out.end_list();
    out.end_object();
  }
  out.end_list();
}

Remove read_remove(Fields& in) {
  Remove op;
  op.cells = in.texts("cells", in.need("cells"), "a list of cells");
  if (const Json* cofaces = in.find("cofaces")) {
    op.cofaces = in.truth("cofaces", *cofaces);
  }
  return op;
}

void write_remove(const Remove& op, JsonText& out) {
  out.field("cells", op.cells);
  if (op.cofaces) {
    out.field("cofaces", true);
  }
}

}  // namespace

constinit const Form<Identify> identify_form{"identify", read_identify, write_identify};
constinit const Form<Degenerate> degenerate_form{"degenerate", read_degenerate, write_degenerate};
constinit const Form<Deidentify> deidentify_form{"deidentify", read_deidentify, write_deidentify};
constinit const Form<Remove> remove_form{"remove", read_remove, write_remove};

}  // namespace sesame::ops
