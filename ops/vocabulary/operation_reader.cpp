#include "ops/vocabulary/operation_reader.hpp"

#include <new>
#include <string>
#include <utility>

#include "ops/vocabulary/line_fields.hpp"
#include "ops/vocabulary/map_lines.hpp"

namespace sesame::ops {
namespace {

using namespace line;

MakeSimplex read_simplex(json::object object) {
  MakeSimplex op;
  op.dimension = -1;
  bool is_named = false;
  each_field_but_op(object, [&](std::string_view name, json::value value) -> unsigned {
    if (name == "name") {
      op.name = text(value);
      is_named = true;
      return 1;
    }
    if (name == "dim") {
      op.dimension = small(value, 0);
      return 2;
    }
    require(name == "at");
    each(value, [&](json::value item) { op.at.push_back(point(item)); });
    require(!op.at.empty());
    return 3;
  });
  require(is_named && op.dimension >= 0);
  require(op.at.empty() || op.at.size() == static_cast<std::size_t>(op.dimension) + 1);
  return op;
}

CellType type(json::value value) {
  CellType entries;
  entries.reserve(4);  // more are rare
  each(value, [&](json::value item) { entries.push_back(small(item, 1)); });
  return entries;
}

/// One without positions.
MakeSimploid read_simploid(json::object object) {
  return read_with_name<MakeSimploid>(object, "type",
                                      [](json::value value, MakeSimploid& op) { op.type = type(value); });
}

/// Reads into a cell that has been used before: its memory is.
void read_cell(json::value item, ListedCell& cell) {
  cell.type.reset();
  cell.faces.clear();
  cell.at.reset();
  bool is_named = false;
  each_field(got(item.get_object()), [&](std::string_view name, json::value value) -> unsigned {
    if (name == "id") {
      cell.id = got(value.get_string());
      is_named = true;
      return 0;
    }
    if (name == "type") {
      cell.type = type(value);
      return 1;
    }
    if (name == "faces") {
      each(value, [&](json::value face) { cell.faces.emplace_back(got(face.get_string())); });
      return 2;
    }
    require(name == "at");
    cell.at = point(value);
    return 3;
  });
  require(is_named && (!cell.at || cell.faces.empty()));
}

MakeComplex read_complex(json::object object) {
  return read_with_name<MakeComplex>(object, "cells",
                                     [cell = ListedCell{}](json::value value, MakeComplex& op) mutable {
                                       each(value, [&](json::value item) {
                                         read_cell(item, cell);
                                         op.cells.push_back(cell);
                                       });
                                     });
}

/// [2,0,1] for a simplex, a list of such lists for a simploid: one for each component.
Identify::Map vertex_map(json::value value) {
  Identify::Map map;
  bool is_one_component = false;
  each(value, [&](json::value item) {
    const bool is_list = got(item.type()) == json::json_type::array;
    if (map.empty() && !is_list) {
      is_one_component = true;
      map.emplace_back();
    }
    require(is_list != is_one_component);
    if (is_list) {
      std::vector<int>& component = map.emplace_back();
      each(item, [&](json::value vertex) { component.push_back(small(vertex, 0)); });
    } else {
      map.back().push_back(small(item, 0));
    }
  });
  require(!map.empty());
  return map;
}

Identify read_identify(json::object object) {
  Identify op;
  bool has_pairs = false;
  each_field_but_op(object, [&](std::string_view name, json::value value) -> unsigned {
    require(name == "pairs");
    has_pairs = true;
    op.pairs.reserve(4);  // more are rare
    each(value, [&](json::value item) {
      std::pair<std::string, std::string> pair;
      unsigned parts = 0;
      each(item, [&](json::value part) {
        require(parts < 3);
        if (parts == 2) {
          op.maps.emplace(op.pairs.size(), vertex_map(part));
        } else {
          (parts == 0 ? pair.first : pair.second) = text(part);
        }
        ++parts;
      });
      require(parts >= 2);
      op.pairs.push_back(std::move(pair));
    });
    return 1;
  });
  require(has_pairs);
  return op;
}

Deidentify::Split read_split(json::object object) {
  Deidentify::Split split;
  unsigned met = 0;
  each_field(object, [&](std::string_view name, json::value value) -> unsigned {
    ++met;
    if (name == "cell") {
      split.cell = text(value);
      return 0;
    }
    if (name == "as") {
      split.copy = text(value);
      return 1;
    }
    require(name == "moves");
    each(value, [&](json::value item) {
      std::pair<std::string, std::int64_t> move;
      unsigned parts = 0;
      each(item, [&](json::value part) {
        require(parts < 2);
        if (parts++ == 0) {
          move.first = text(part);
        } else {
          move.second = small(part, 0);
        }
      });
      require(parts == 2);
      split.moves.push_back(std::move(move));
    });
    return 2;
  });
  require(met == 3);
  return split;
}

Deidentify read_deidentify(json::object object) {
  Deidentify op;
  bool has_splits = false;
  each_field_but_op(object, [&](std::string_view name, json::value value) -> unsigned {
    require(name == "split");
    has_splits = true;
    each(value, [&](json::value item) { op.splits.push_back(read_split(got(item.get_object()))); });
    return 1;
  });
  require(has_splits);
  return op;
}

std::string label(json::value value) {
  return got(value.type()) == json::json_type::number ? std::to_string(got(value.get_uint64())) : text(value);
}

Insert read_insert(json::object object) {
  Insert op;
  const auto simplex = [&](json::value value) {
    op.simplices.begin_list();
    each(value, [&](json::value item) { op.simplices.add(label(item)); });
  };
  bool is_one = false, is_list = false;
  std::optional<bool> exist_ok;
  each_field_but_op(object, [&](std::string_view name, json::value value) -> unsigned {
    if (name == "simplex") {
      is_one = true;
      simplex(value);
      return 1;
    }
    if (name == "simplices") {
      is_list = true;
      each(value, simplex);
      return 2;
    }
    require(name == "exist_ok");
    exist_ok = got(value.get_bool());
    return 3;
  });
  require(is_one != is_list);
  op.exist_ok = exist_ok.value_or(is_list);
  return op;
}

Collapse read_collapse(json::object object) {
  Collapse op;
  unsigned met = 0;
  each_field_but_op(object, [&](std::string_view name, json::value value) -> unsigned {
    ++met;
    const bool is_from = name == "from";
    require(is_from || name == "to");
    (is_from ? op.from : op.to) = label(value);
    return is_from ? 1 : 2;
  });
  require(met == 2);
  return op;
}

Operation read_operation(json::object object) {
  const std::string_view op = got(got(object.find_field("op")).get_string());
  (void)got(object.reset());
  if (op == "simplex") {
    return read_simplex(object);
  }
  if (op == "simploid") {
    return read_simploid(object);
  }
  if (op == "identify") {
    return read_identify(object);
  }
  if (op == "insert") {
    return read_insert(object);
  }
  if (op == "collapse") {
    return read_collapse(object);
  }
  if (op == "deidentify") {
    return read_deidentify(object);
  }
  if (op == "complex") {
    return read_complex(object);
  }
  return read_of_maps(op, object);
}

}  // namespace

struct OperationReader::Text {
  simdjson::ondemand::parser parser{};
  std::string copy{};  ///< of the line, with the room behind it that the parser wants

  std::optional<Operation> read(std::string_view line);
};

OperationReader::OperationReader() : text_{std::make_unique<Text>()} {}
OperationReader::OperationReader(OperationReader&&) noexcept = default;
OperationReader& OperationReader::operator=(OperationReader&&) noexcept = default;
OperationReader::~OperationReader() = default;

/// A long line needs a multiple of its length: without that there is the other reader, and nothing of it is kept.
std::optional<Operation> OperationReader::read_common(std::string_view line) {
  constexpr std::size_t long_line = std::size_t{1} << 20;
  std::optional<Operation> operation;
  try {
    operation = text_->read(line);
  } catch (const std::bad_alloc&) {
    *text_ = Text{};
  }
  if (line.size() > long_line) {
    *text_ = Text{};
  }
  return operation;
}

std::optional<Operation> OperationReader::Text::read(std::string_view line) {
  copy.reserve(line.size() + simdjson::SIMDJSON_PADDING);
  copy.assign(line);
  try {
    json::document document = got(parser.iterate(copy.data(), copy.size(), copy.capacity()));
    Operation operation = read_operation(got(document.get_object()));
    require(document.current_location().error() == simdjson::OUT_OF_BOUNDS);  // nothing behind the object
    return operation;
  } catch (const LeftToOthers&) {
    return std::nullopt;
  }
}

Result<Operation> OperationReader::read(std::string_view line) {
  if (std::optional<Operation> operation = read_common(line)) {
    return *std::move(operation);
  }
  return parse_operation(line);
}

}  // namespace sesame::ops
