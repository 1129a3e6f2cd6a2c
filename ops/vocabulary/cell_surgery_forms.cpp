// The text form of the local operations on cells of maps.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "ops/vocabulary/field_values.hpp"
#include "ops/vocabulary/operation_form.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

/// The map may be named, too; the name of the cell says which it is.
template <class Op>
Op read_of_cell(Fields& in) {
  Op op{in.text("cell")};
  if (const Json* map = in.find("map")) {
    const std::string name = in.text("map", *map);
    if (op.cell != name && !op.cell.starts_with(name + '.')) {
      throw Wrong{fmt::format("field \"map\" is {}, but the cell {} is one of another map: leave it out",
                              sparse::quoted(name), sparse::quoted(op.cell))};
    }
  }
  return op;
}

template <class Op>
void write_of_cell(const Op& op, JsonText& out) {
  out.field("cell", op.cell);
}

template <class Op>
Op read_new_cell(Fields& in) {
  Op op;
  op.name = in.text("name");
  op.dimension = in.small("dim", in.need("dim"), 0);
  op.darts = in.texts("darts", in.need("darts"), "a list of darts, such as [\"m:0\",\"m:5\"]");
  op.at = read_point(in);
  return op;
}

template <class Op>
void write_new_cell(const Op& op, JsonText& out) {
  out.field("name", op.name);
  out.field("dim", op.dimension);
  out.field("darts", op.darts);
  if (op.at) {
    out.field("at", *op.at);
  }
}

}  // namespace

constinit const Form<RemoveCell> remove_cell_form{"remove_cell", read_of_cell<RemoveCell>, write_of_cell<RemoveCell>};
constinit const Form<ContractCell> contract_cell_form{"contract_cell", read_of_cell<ContractCell>,
                                                      write_of_cell<ContractCell>};
constinit const Form<InsertCell> insert_cell_form{"insert_cell", read_new_cell<InsertCell>, write_new_cell<InsertCell>};
constinit const Form<SplitCell> split_cell_form{"split_cell", read_new_cell<SplitCell>, write_new_cell<SplitCell>};

}  // namespace sesame::ops
