/// \file
/// Building structures and looking at them, for the tests of ops/ and engine/.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "ops/cells/cofaces.hpp"
#include "ops/cells/structure.hpp"
#include "ops/plan/planner.hpp"
#include "ops/plan/step_sequence.hpp"
#include "ops/plan/workspace.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"
#include "tests/support/catch.hpp"

namespace sesame::tests {

/// The operation that a line says. A line that cannot be read ends the test.
inline ops::Operation operation(const std::string& line) {
  auto parsed = ops::parse_operation(line);
  if (!parsed) {
    FAIL(line << ": " << parsed.error().what);
  }
  return *parsed;
}

/// The names that a plan gives to its new cells.
inline std::vector<std::string> names_of_new_cells(const ops::Plan& plan, ops::TypeTable& types) {
  std::vector<std::string> names;
  std::size_t begin = 0;
  for (const ops::Plan::NewCell& cell : plan.cells) {
    if (plan.standard == ops::none) {
      names.push_back(plan.names.substr(begin, cell.name_end - begin));
      begin = cell.name_end;
    } else {
      names.push_back(*plan.new_body + "." + types.standard(plan.standard).cells[names.size()].suffix);
    }
  }
  if (plan.standard != ops::none) {
    names.back() = *plan.new_body;
  }
  return names;
}

/// How much of everything there is in a structure, and the position of its journal.
struct StructureMark {
  ops::Journal::Position position = 0;
  ops::Moment moment;
  std::uint32_t names = 0, cones = 0, simplicial_changes = 0;
  friend bool operator==(const StructureMark&, const StructureMark&) = default;
};
inline StructureMark mark_of(const ops::Structure& structure) {
  return {structure.journal().end(), structure.now(), structure.directory().names().size(), structure.cones().size(),
          structure.abstract().mark()};
}

/// A workspace in which what has to work works.
class Workshop {
 public:
  explicit Workshop(ops::Limits limits = {}) : workspace_{limits} {}

  const ops::Structure& structure() const { return workspace_.structure(); }
  const ops::Planner& planner() const { return workspace_.planner(); }
  const ops::Plan& last_plan() const { return workspace_.planned(); }
  const std::deque<ops::Workspace::Step>& steps() const { return workspace_.steps(); }

  Status plan(const ops::Operation& op) { return workspace_.plan(op); }
  void carry_out() { workspace_.carry_out(); }
  Status apply(const ops::Operation& op) {
    Status status = plan(op);
    if (status) {
      carry_out();
    }
    return status;
  }
  /// Applies lines that must be legal.
  void build(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      if (const Status status = apply(operation(line)); !status) {
        FAIL(line << ": " << status.error().what);
      }
    }
  }
  /// Takes back all steps and all that queries made since a mark.
  void go_back_to(const StructureMark& mark) {
    const auto& steps = workspace_.steps();
    const auto first = std::find_if(steps.begin(), steps.end(),
                                    [&](const ops::Workspace::Step& step) { return step.begin >= mark.position; });
    const Status done = workspace_.take_back(static_cast<std::uint64_t>(steps.end() - first));
    REQUIRE(done);
    workspace_.forget_since(mark.position);
  }
  ops::CellId cell(const std::string& name) const {
    const auto found = structure().lookup(name);
    if (!found) {
      FAIL("no cell " << name);
    }
    return structure().find(*found);
  }

 private:
  ops::Workspace workspace_;
};

/// The sequence of a step that has one at most.
template <sparse::Ring R>
std::optional<ops::StepSequence<R>> only(std::vector<ops::StepSequence<R>> sequences) {
  REQUIRE(sequences.size() <= 1);
  return sequences.empty() ? std::nullopt : std::optional{std::move(sequences.front())};
}

/// What a step was that led from one moment to another, told from what there was: nothing here reads the journal.
inline ops::StepKind kind_between(const ops::Structure& structure, const ops::Moment& before,
                                  const ops::Moment& after) {
  if (after.families > before.families) {
    const bool is_cone = structure.lazy().family(before.families).kind == ops::FamilyKind::cone;
    return is_cone ? ops::StepKind::lazy_cone : ops::StepKind::product;
  }
  if (after.links > before.links) {
    const bool takes_away = structure.forest().deletions().contains(before.links);
    return !takes_away                      ? ops::StepKind::removal
           : after.created > before.created ? ops::StepKind::replacement
                                            : ops::StepKind::deletion;
  }
  if (after.copies > before.copies) {
    return ops::StepKind::split;
  }
  return after.created > before.created ? ops::StepKind::addition : ops::StepKind::nothing;
}
template <sparse::Ring R>
auto sequence_between(const ops::Structure& structure, const ops::Moment& before, const ops::Moment& after,
                      const R& ring) {
  return only(ops::step_sequences(structure, kind_between(structure, before, after), before, after, ring));
}

/// The sign with which a name denotes its node.
inline int sign_denoted(const ops::Structure& structure, std::string_view name) {
  return structure.maps().sign(structure.denoted(name).value().order);
}

/// A node degenerate from the start: no step removed it, and it has no name.
inline bool is_born_degenerate(const ops::Structure& structure, ops::CellId c) {
  return structure.forest().parent(c) == ops::none && structure.forest().link_of(c) == ops::none;
}

std::string text_of(const ops::Structure& structure, const ops::Value& v);

/// A node as text. Ids of nodes that queries make depend on the order of the queries: this does not.
inline std::string label(const ops::Structure& structure, ops::CellId c) {
  if (c == ops::none) {
    return "none";
  }
  if (is_born_degenerate(structure, c)) {
    return text_of(structure, structure.values().of(c));
  }
  const ops::LazyCell* lazy = structure.lazy().of(c);
  return std::string{structure.directory().own_name(c)} +
         (lazy == nullptr ? "" : "@" + std::to_string(lazy->key.family));
}

/// The collapsed directions of a value and its type, "^0,2 of a simplex of dimension 3"; empty for a cell itself.
inline std::string degeneracy_text(const ops::Structure& structure, const ops::Value& v) {
  std::string text;
  for (int d = 0; d <= ops::largest_dimension; ++d) {
    if ((v.collapsed >> d & 1) != 0) {
      text += (text.empty() ? "^" : ",") + std::to_string(d);
    }
  }
  return v.is_degenerate() ? text + " of a " + ops::describe(structure.types().info(v.type).type) : text;
}

/// A value by the label of the node that is its cell.
inline std::string text_of(const ops::Structure& structure, const ops::Value& v) {
  return "(" + label(structure, v.cell) + ")" + degeneracy_text(structure, v);
}

/// What a node is now, by the canonical name of the cell: "t.0", "t.0^0 of a simplex of dimension 1".
inline std::string meaning(const ops::Structure& structure, ops::CellId c) {
  const ops::Value v = structure.values().of(c);
  return std::string{structure.name(v.cell)} + degeneracy_text(structure, v);
}
inline std::string meaning(const ops::Structure& structure, const std::string& name) {
  const auto found = structure.lookup(name);
  return found ? meaning(structure, *found) : "nothing";
}

/// What the faces of a cell are now.
inline std::vector<std::string> face_texts(const ops::Structure& structure, ops::CellId c) {
  std::vector<std::string> texts;
  for (const ops::CellId face : structure.faces().of(c)) {
    texts.push_back(meaning(structure, face));
  }
  return texts;
}

/// All nodes but those degenerate from the start, in an order that no query changes: by increasing id, those of lazy
/// families (all of them) by label after the others.
inline std::vector<ops::CellId> nodes_of(const ops::Structure& structure) {
  structure.lazy().make_all();
  std::vector<ops::CellId> nodes;
  std::vector<std::pair<std::string, ops::CellId>> lazy;
  structure.cells().for_each_node([&](ops::CellId c) {
    if (structure.lazy().is_lazy(c)) {
      lazy.emplace_back(label(structure, c), c);
    } else if (!is_born_degenerate(structure, c)) {
      nodes.push_back(c);
    }
  });
  std::sort(lazy.begin(), lazy.end());
  for (const auto& [text, c] : lazy) {
    nodes.push_back(c);
  }
  return nodes;
}

inline std::string dump(const ops::Structure& structure, ops::CellId c) {
  std::string text = label(structure, c) + " " + ops::describe(structure.cells().type(c).type);
  for (const auto faces : {structure.cells().faces(c), structure.faces().of(c)}) {
    for (const ops::CellId face : faces) {
      text += " " + label(structure, face);
    }
    text += ";";
  }
  const ops::Value value = structure.values().of(c);
  text += " is " + text_of(structure, value) + " parent " + label(structure, structure.forest().parent(c)) + " link " +
          std::to_string(structure.forest().link_of(c)) + " of " +
          std::to_string(structure.forest().members(value.cell)) + " now " + std::string{structure.name(c)} +
          " oldest " + label(structure, structure.forest().oldest(c)) + " in " +
          std::string{structure.directory().name_of_body(structure.body_of(c))};
  if (structure.lazy().is_consumed(c)) {
    text += " consumed by " + std::to_string(structure.bodies().consumed_by(structure.body_of(c)));
  }
  if (const ops::SplitHistory::Copy* copy = structure.splits().copy(c)) {
    text += " copy of " + label(structure, copy->source);
  }
  structure.splits().for_each_copy_of(c, 0, [&](ops::CellId copy) { text += " copied as " + label(structure, copy); });
  if (structure.is_current(c) && !structure.lazy().is_consumed(c)) {
    text += " under";
    for (const ops::CellId coface : cofaces(structure, c)) {
      text += " " + label(structure, coface);
    }
  }
  const auto found = structure.lookup(structure.directory().own_name(c));
  return text + " found " + (found ? label(structure, *found) : "nothing") + "\n";
}

/// The darts of all maps, how they are sewn and what they see.
inline std::string dump(const ops::DartStore& darts, const ops::Structure& structure) {
  std::string text;
  for (std::uint32_t number = 0; number < darts.maps(); ++number) {
    const ops::DartStore::Made& map = darts.map(number);
    text += "map " + structure.directory().names()[map.name].text + (map.is_by_simplices ? " by simplices\n" : "\n");
    for (int i = 0; i <= map.dimension && map.has_levels(); ++i) {
      for (ops::Dart d = 0; d < map.cells->of[static_cast<std::size_t>(i)].size(); ++d) {
        const auto seen = ops::seen_from_dart(structure, map, i, d);
        text += " " + (seen ? text_of(structure, structure.values().normal_form(*seen)) : "nothing");
      }
      text += "\n";
    }
    for (ops::Dart d = map.first; d < map.first + map.count; ++d) {
      for (int i = 0; i <= map.dimension; ++i) {
        const auto seen = ops::seen_from_dart(structure, map, i, d);
        text += " " + std::to_string(darts.alpha(map.dimension, i, d)) + " ";
        text += seen ? text_of(structure, structure.values().normal_form(*seen)) : "nothing";
      }
      text += darts.taken_out_with(map.dimension, d) ? "taken out\n" : "\n";
    }
  }
  return text;
}

/// Everything that can be seen of a structure, as text. Two states are alike exactly when these are, whatever lazy
/// cells have been asked for. Makes all lazy cells.
inline std::string dump(const ops::Structure& structure) {
  const std::vector<ops::CellId> nodes = nodes_of(structure);
  std::string text = "nodes " + std::to_string(nodes.size()) + " links " + std::to_string(structure.forest().links());
  for (const std::uint64_t count : structure.counts()) {
    text += " " + std::to_string(count);
  }
  text += "\n";
  for (const ops::CellId c : nodes) {
    text += dump(structure, c);
  }
  for (const ops::BodyId body : structure.bodies().current()) {
    text += "body " + std::string{structure.directory().name_of_body(body)} + " with " +
            std::to_string(structure.bodies().simploids(body)) + " simploids";
    for (const ops::CellId c : structure.lazy().cells_of(body)) {
      text += " " + label(structure, c);
    }
    text += "\n";
  }
  for (std::uint32_t number = 0; number < structure.splits().moves(); ++number) {
    const ops::SplitHistory::MadeMove move = structure.splits().move(number);
    text += "move " + label(structure, move.cell) + " " + std::to_string(move.slot) + " from " +
            label(structure, structure.splits().face_before(number)) + " to " + label(structure, move.after) +
            " after " + std::to_string(move.links) + "\n";
  }
  for (ops::FamilyId f = 0; f < structure.lazy().families(); ++f) {
    const ops::LazyFamily& family = structure.lazy().family(f);
    text += "family " + family.name + (family.by_edges ? " by edges" : "") + " apex " + label(structure, family.apex);
    for (const std::uint64_t count : family.counts) {
      text += " " + std::to_string(count);
    }
    text += "\n";
  }
  return text + dump(structure.darts(), structure);
}

/// Where two texts first differ, a line of each; empty when they do not.
inline std::string first_difference(const std::string& one, const std::string& other) {
  if (one == other) {
    return "";
  }
  const auto differ = std::mismatch(one.begin(), one.end(), other.begin(), other.end());
  const auto line = [](const std::string& text, std::string::const_iterator at) {
    const auto offset = static_cast<std::size_t>(at - text.begin());
    const std::size_t begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;
    return text.substr(begin, text.find('\n', offset) - begin);
  };
  return line(one, differ.first) + "\n  instead of\n" + line(other, differ.second);
}

/// The error of an operation that must be refused. For objects too large to look at; else see `refused`.
inline Error error_of(Workshop& shop, const ops::Operation& op) {
  const Status status = shop.plan(op);
  if (status) {
    FAIL("not refused: " << to_text(op));
  }
  return status.error();
}

/// Tries an operation that must be refused, checks that nothing changed, and gives the error.
inline Error refused(Workshop& shop, const ops::Operation& op) {
  const std::string before = dump(shop.structure());
  const auto mark = [&] {
    StructureMark now = mark_of(shop.structure());
    if (now.moment.families > 0) {  // looking for a name may make lazy cells
      now.position = 0;
      now.moment.asked = ops::asked_node(0);
    }
    return now;
  };
  const StructureMark mark_before = mark();
  Error error = error_of(shop, op);
  CHECK(mark() == mark_before);
  CHECK(first_difference(dump(shop.structure()), before) == "");
  return error;
}
inline Error refused(Workshop& shop, const std::string& line) { return refused(shop, operation(line)); }

using Texts = std::vector<std::string>;
using Counts = std::vector<std::uint64_t>;

/// The number of current cells of each dimension.
inline Counts counts(const Workshop& shop) {
  const auto all = shop.structure().counts();
  return {all.begin(), all.end()};
}
/// What the faces of the cell of a name are.
inline Texts faces(const Workshop& shop, const std::string& name) {
  return face_texts(shop.structure(), shop.cell(name));
}

}  // namespace sesame::tests
