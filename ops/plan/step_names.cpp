#include "ops/plan/step_names.hpp"

#include <fmt/format.h>

#include <string_view>

#include "ops/cells/name_reader.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {

using sparse::quoted;

namespace {

bool is_dart(const std::string& name, const Structure& structure) {
  const std::size_t colon = name.rfind(':');
  const DartStore::Made* map =
      colon == std::string::npos ? nullptr : map_named(structure, std::string_view{name}.substr(0, colon));
  return map != nullptr && dart_of_text(*map, std::string_view{name}.substr(colon + 1)) != no_dart;
}

std::string why_unreadable(const std::string& name, NameReader::Failure failure, const Structure& structure) {
  switch (failure) {
    case NameReader::Failure::nested:
      return fmt::format("the name {} has more than {} products and cones within one another, the limit", quoted(name),
                         NameReader::most_nested);
    case NameReader::Failure::ambiguous:
      return fmt::format(
          "the name {} can be taken apart in too many ways, since there are names with brackets that "
          "do not match or with bars outside of brackets",
          quoted(name));
    case NameReader::Failure::unknown:
      break;
  }
  return fmt::format("there is no cell {}{}", quoted(name),
                     structure.lookup_body(name) ? ": this is the name of a body; name a cell of it"
                     : is_dart(name, structure)  ? ": this is a dart; its i-cell is m.i:k for the dart m:k"
                                                 : "");
}

}  // namespace

Result<Value> resolve_cell(const std::string& name, const Structure& structure) {
  NameReader reader(structure, name);
  auto named = reader.read();
  if (!named) {
    return Error{Errc::unknown_name, why_unreadable(name, reader.failure(), structure)};
  }
  return what_is_now(*named, name, structure);
}

Result<Value> what_is_now(Value value, const std::string& name, const Structure& structure) {
  Lineage(structure).advance_to_now(value);
  if (const FamilyId consumer = structure.lazy().consumed_by(value.cell); consumer != none) {
    const LazyFamily& product = structure.lazy().family(consumer);
    return Error{
        Errc::unknown_name,
        fmt::format("the cell \"{}\" went into the product \"{}\", whose cells have names such as \"{}.(a|b)\"", name,
                    product.name, product.name)};
  }
  if (is_deleted(structure.forest(), value.cell)) {
    const std::string own = structure.name(value.cell);
    return Error{Errc::unknown_name, fmt::format("the cell {} was removed{}: undo that, or name another cell",
                                                 quoted(name), own == name ? "" : fmt::format(", as {}", quoted(own)))};
  }
  return value;
}

Result<BodyId> resolve_body(const std::string& name, const Structure& structure) {
  const auto body = structure.lookup_body(name);
  if (!body) {
    return Error{Errc::unknown_name,
                 fmt::format("there is no body {}{}", quoted(name),
                             structure.lookup(name) ? ": this is a cell; name the body that it belongs to" : "")};
  }
  if (const FamilyId family = structure.bodies().consumed_by(*body); family != none) {
    return Error{Errc::unknown_name, fmt::format("the body \"{}\" went into the product \"{}\": it can be used no more",
                                                 name, structure.lazy().family(family).name)};
  }
  return *body;
}

Status check_simploids(BodyId body, std::string_view what, const Structure& structure) {
  return structure.bodies().kind(body).has_others
             ? Error{Errc::refused,
                     fmt::format(
                         "the body \"{}\" has cells that are no simploids: {} is possible of simploids only; make "
                         "maps \"as\":\"simplices\"",
                         structure.directory().name_of_body(body), what)}
             : Status{Done{}};
}

Result<BodyId> abstract_body(LabelId label, const Structure& structure) {
  const AbstractComplex& complex = structure.abstract();
  const VertexId vertex = complex.vertex(label);
  if (complex.is_contracted(label)) {
    return Error{Errc::refused, fmt::format("\"{}\" was collapsed into another vertex: write \"{}\"",
                                            complex.text(label), complex.text(complex.label_of(vertex)))};
  }
  CellId cell = complex.find({&vertex, 1});
  if (cell == none) {  // it was removed, and is known by its name
    cell = structure.lookup(fmt::format("{{{}}}", complex.text(label))).value();
  }
  const BodyId body = structure.body_of(cell);
  if (!structure.bodies().kind(body).is_abstract) {
    return Error{Errc::refused,
                 fmt::format("the body \"{}\" of the vertex \"{}\" was changed by another operation: insert and "
                             "collapse work on bodies that only they have made; undo that, or use new labels",
                             structure.directory().name_of_body(body), complex.text(label))};
  }
  return body;
}

Status check_new_name(const std::string& name, const Structure& structure) {
  if (!is_name(name)) {
    return Error{Errc::bad_input,
                 fmt::format("{} is not a name: a name is UTF-8, not empty, and has no white space or control "
                             "characters",
                             quoted(name))};
  }
  if (structure.is_name_taken(name)) {
    return Error{Errc::bad_input, fmt::format("the name {} is in use: names are unique, choose another", quoted(name))};
  }
  return Done{};
}

bool is_free_beginning(std::string_view beginning, const Structure& structure, std::size_t most) {
  const NameTable& names = structure.directory().names();
  bool is_free = names.size() <= most;
  for (std::uint32_t number = 0; is_free && number < names.size(); ++number) {
    is_free = !names[number].text.starts_with(beginning);
  }
  return is_free;
}

Status check_new_apex(const std::string& name, const Structure& structure) {
  if (Status s = check_new_name(name, structure); !s) {
    return s;
  }
  if (structure.directory().is_ambiguous_prefix(name)) {
    return Error{Errc::bad_input,
                 fmt::format("the name \"{}\", or that of an apex or a product, goes on after the other with \"*\" or "
                             "\".(\", so that names of their cells could be mistaken for one another: choose another",
                             name)};
  }
  return Done{};
}

Status check_new_prefix(const std::string& name, const Structure& structure) {
  if (Status s = check_new_apex(name, structure); !s) {
    return s;
  }
  if (structure.directory().is_prefix_taken(name)) {
    return Error{Errc::bad_input,
                 fmt::format("names that begin with \"{0}*\" or \"{0}.(\", as those of the new cells would, can be "
                             "those of other cells: choose another",
                             name)};
  }
  return Done{};
}

}  // namespace sesame::ops
