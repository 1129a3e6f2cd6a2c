// The text form of the operations on abstract simplicial complexes.
#include <nlohmann/json.hpp>

#include "ops/vocabulary/field_values.hpp"
#include "ops/vocabulary/operation_form.hpp"

namespace sesame::ops {
namespace {

/// Of a list of simplices one expects that some are there already; of one simplex, unless it is said, that it is not.
Insert read_insert(Fields& in) {
  const auto simplex = [&](const std::string& field, const Json& value) {
    return read_each(in.items(field, value, "a list of vertex labels"),
                     [&](const Json& item) { return read_label(in, field, item); });
  };
  Insert op;
  const Json* one = in.find("simplex");
  const Json* many = in.find("simplices");
  if ((one == nullptr) == (many == nullptr)) {
    throw Wrong{R"("insert" needs a field "simplex" or a field "simplices", one of the two)"};
  }
  if (one != nullptr) {
    op.simplices.push_back(simplex("simplex", *one));
  } else {
    for (const Json& item : in.items("simplices", *many, "a list of simplices, [[\"a\",\"b\"],...]")) {
      op.simplices.push_back(simplex("simplices", item));
    }
  }
  const Json* exist_ok = in.find("exist_ok");
  op.exist_ok = exist_ok != nullptr ? in.truth("exist_ok", *exist_ok) : many != nullptr;
  return op;
}

void write_insert(const Insert& op, JsonText& out) {
  const bool is_one = op.simplices.size() == 1;
  out.key(is_one ? "simplex" : "simplices");
  if (!is_one) {
    out.begin_list();
  }
  for (const NameLists::List labels : op.simplices) {
    out.begin_list();
    for (const std::string_view label : labels) {
      write_label(label, out);
    }
    out.end_list();
  }
  if (!is_one) {
    out.end_list();
  }
  if (op.exist_ok == is_one) {
    out.field("exist_ok", op.exist_ok);
  }
}

Collapse read_collapse(Fields& in) {
  Collapse op;
  op.from = read_label(in, "from", in.need("from"));
  op.to = read_label(in, "to", in.need("to"));
  return op;
}

void write_collapse(const Collapse& op, JsonText& out) {
  out.key("from");
  write_label(op.from, out);
  out.key("to");
  write_label(op.to, out);
}

}  // namespace

constinit const Form<Insert> insert_form{"insert", read_insert, write_insert};
constinit const Form<Collapse> collapse_form{"collapse", read_collapse, write_collapse};

}  // namespace sesame::ops
