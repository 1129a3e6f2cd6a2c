// The text form of the operations on abstract simplicial complexes.
#include <charconv>
#include <nlohmann/json.hpp>

#include "ops/vocabulary/operation_form.hpp"

namespace sesame::ops {
namespace {

/// A label as a text: integers in decimal.
std::string read_label(Fields& in, const std::string& field, const Json& value) {
  if (value.is_string()) {
    return value.get<std::string>();
  }
  if (!value.is_number_unsigned()) {
    in.wrong(field, "made of labels, which are strings or integers from 0 on", value);
  }
  return std::to_string(value.get<std::uint64_t>());
}

/// An integer that 64 bits can say as a number, any other label as a string.
void write_label(std::string_view label, JsonText& out) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(label.data(), label.data() + label.size(), number);
  if (error == std::errc{} && std::to_string(number) == label) {
    out.value(number);
  } else {
    out.value(label);
  }
}

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
