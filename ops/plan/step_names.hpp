/// \file
/// The names in a step: what those denote that should exist, and whether those are free that it gives.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "ops/cells/structure.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// What a name denotes, of a cell of the object, in normal form: its vertices in the order in which the name stands for
/// them. Or unknown_name, with what would be right.
[[nodiscard]] Result<Value> resolve_cell(const std::string& name, const Structure& structure);
/// The same for a value of any node that a name stood for.
[[nodiscard]] Result<Value> what_is_now(Value value, const std::string& name, const Structure& structure);
/// The current body of a name. Errors: unknown_name, also for a body that went into a product.
[[nodiscard]] Result<BodyId> resolve_body(const std::string& name, const Structure& structure);
/// The body that a vertex belongs to, when insertions and collapses may change it. Errors: refused.
[[nodiscard]] Result<BodyId> abstract_body(LabelId label, const Structure& structure);

/// Has a body no cells of maps but simplices? Errors: refused, naming what cannot be done with it.
Status check_simploids(BodyId body, std::string_view what, const Structure& structure);

/// May a cell or a body be given this name? Errors: bad_input, as for those below.
Status check_new_name(const std::string& name, const Structure& structure);
/// Whether no name is in use that begins with a text, as far as is seen by looking at `most` names: those of faces and
/// of cells of families begin with a name that was given. For steps that give many names; false decides nothing.
[[nodiscard]] bool is_free_beginning(std::string_view beginning, const Structure& structure, std::size_t most);
/// May an apex, after which cells of its cone are named?
Status check_new_apex(const std::string& name, const Structure& structure);
/// May a lazy family, whose cells' names all begin with it and are not looked up one by one?
Status check_new_prefix(const std::string& name, const Structure& structure);

}  // namespace sesame::ops
