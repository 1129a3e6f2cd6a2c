/// \file
/// The text form of each operation: the word that stands for it, and how its fields are read and written.
#pragma once

#include <string_view>

#include "ops/vocabulary/json_fields.hpp"
#include "ops/vocabulary/json_text.hpp"
#include "ops/vocabulary/operation.hpp"

namespace sesame::ops {

template <class Op>
struct Form {
  std::string_view keyword;
  /// Throws Wrong.
  Op (*read)(Fields& in);
  /// Adds the fields, in the order of the documentation; not those that say no more than their absence.
  void (*write)(const Op& operation, JsonText& out);
};

// making_forms.cpp
extern const Form<MakeSimplex> simplex_form;
extern const Form<MakeSimploid> simploid_form;
extern const Form<MakeComplex> complex_form;
extern const Form<MakeIncidence> incidence_form;
extern const Form<MakeCone> cone_form;
extern const Form<MakeSuspension> suspension_form;
extern const Form<MakeProduct> product_form;
// map_forms.cpp
extern const Form<MakeGMap> gmap_form;
extern const Form<MakeMap> map_form;
extern const Form<MakePolygon> polygon_form;
extern const Form<MakeChainOfMaps> chain_of_maps_form;
extern const Form<Sew> sew_form;
extern const Form<Unsew> unsew_form;
extern const Form<Extend> extend_form;
// cell_surgery_forms.cpp
extern const Form<RemoveCell> remove_cell_form;
extern const Form<ContractCell> contract_cell_form;
extern const Form<InsertCell> insert_cell_form;
extern const Form<SplitCell> split_cell_form;
// gluing_forms.cpp
extern const Form<Identify> identify_form;
extern const Form<Degenerate> degenerate_form;
extern const Form<Deidentify> deidentify_form;
extern const Form<Remove> remove_form;
// simplicial_forms.cpp
extern const Form<Insert> insert_form;
extern const Form<Collapse> collapse_form;
// replace_form.cpp
extern const Form<Replace> replace_form;
// log_forms.cpp
extern const Form<Expect> expect_form;
extern const Form<AskClass> class_form;
extern const Form<Undo> undo_form;
extern const Form<Note> note_form;

/// The header of a log, which is no operation. Throws Wrong.
[[nodiscard]] Header read_header(const Json& object);
void write_header(const Header& header, JsonText& out);

}  // namespace sesame::ops
