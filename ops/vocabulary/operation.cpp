#include "ops/vocabulary/operation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <tuple>

#include "ops/vocabulary/json_line.hpp"
#include "ops/vocabulary/operation_form.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

/// A form for each operation, in the order in which a sentence lists them.
constexpr std::tuple forms{
    &simplex_form,    &simploid_form,      &complex_form,    &incidence_form,   &gmap_form,          &map_form,
    &polygon_form,    &chain_of_maps_form, &cone_form,       &suspension_form,  &product_form,       &identify_form,
    &sew_form,        &unsew_form,         &extend_form,     &remove_cell_form, &contract_cell_form, &insert_cell_form,
    &split_cell_form, &degenerate_form,    &deidentify_form, &insert_form,      &collapse_form,      &remove_form,
    &replace_form,    &expect_form,        &class_form,      &undo_form,        &note_form};

template <class Op>
const Form<Op>& form_of(const Op& /*operation*/) {
  return *std::get<const Form<Op>*>(forms);
}

template <class Op>
Op read_as(const Form<Op>& form, const Json& object) {
  Fields in(object, fmt::format("\"{}\"", form.keyword));
  (void)in.find("op");
  Op operation = form.read(in);
  in.finish();
  return operation;
}

Operation read_operation(const Json& object) {
  const auto op = object.find("op");
  if (op == object.end() || !op->is_string()) {
    throw Wrong{object.contains("sesame") ? "a script has one header, and this is another"
                                          : "a step needs a field \"op\" that says which operation it is"};
  }
  const std::string word = op->get<std::string>();
  std::optional<Operation> operation;
  const auto read_if_named = [&](const auto& form) {
    if (form.keyword == word) {
      operation = read_as(form, object);
    }
    return operation.has_value();
  };
  if (std::apply([&](const auto*... form) { return (read_if_named(*form) || ...); }, forms)) {
    return *std::move(operation);
  }
  const auto known = std::apply([](const auto*... form) { return std::array{form->keyword...}; }, forms);
  throw Wrong{fmt::format("there is no op {}; the ops are: {}", sparse::quoted(word), fmt::join(known, ", "))};
}

template <class Read>
auto parse_line(std::string_view line, Read read) -> Result<decltype(read(Json{}))> {
  try {
    return read(JsonLine(line).object());
  } catch (Wrong& wrong) {
    return Error{Errc::bad_input, std::move(wrong.what)};
  }
}

/// The object whose fields `write(out)` adds.
template <class Write>
std::string object_text(Write write) {
  std::string text;
  JsonText out(text);
  out.begin_object();
  write(out);
  out.end_object();
  return text;
}

}  // namespace

std::string_view keyword(const Operation& operation) {
  return std::visit([](const auto& op) { return form_of(op).keyword; }, operation);
}

Result<Operation> parse_operation(std::string_view line) { return parse_line(line, read_operation); }

Result<Header> parse_header(std::string_view line) { return parse_line(line, read_header); }

std::string to_text(const Operation& operation) {
  return object_text([&](JsonText& out) {
    out.field("op", keyword(operation));
    std::visit([&](const auto& op) { form_of(op).write(op, out); }, operation);
  });
}

std::string to_text(const Header& header) {
  return object_text([&](JsonText& out) { write_header(header, out); });
}

}  // namespace sesame::ops
