#include "replay/page/page_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <variant>

#include "ops/vocabulary/operation.hpp"

namespace sesame::replay {
namespace {

using ops::CellId;
using ops::Structure;

constexpr std::size_t most_listed = 200;

/// The text of an operation, or of its beginning. One that lists a mesh is not written out for that.
std::string text_for_page(const ops::Operation& operation, std::uint64_t most) {
  if (const auto* complex = std::get_if<ops::MakeComplex>(&operation);
      complex != nullptr && complex->cells.size() > most_listed) {
    return fmt::format("complex {} of {} cells", complex->name, complex->cells.size());
  }
  if (const auto* insert = std::get_if<ops::Insert>(&operation);
      insert != nullptr && insert->simplices.size() > most_listed) {
    return fmt::format("insert {} simplices", insert->simplices.size());
  }
  std::string text = ops::to_text(operation);
  if (text.size() > most) {
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
      --end;  // not within a character
    }
    text.resize(end);
    text += " …";
  }
  return text;
}

std::string text_of(const sparse::Rational& n) { return n.to_string(); }

bool is_degenerate_from_start(const Structure& structure, CellId node) {
  return ops::is_asked_for(node) && structure.cells().lazy(node) == ops::none;
}

}  // namespace

void PageHistory::take(engine::Engine& engine, const ops::Operation& operation, const engine::StepReport& report) {
  PageStep step;
  step.op = report.op;
  step.text = text_for_page(operation, limits_.bytes_of_operation);
  const Structure& structure = engine.structure();
  step.first = cells_.size();
  if (std::holds_alternative<ops::Undo>(operation)) {
    take_back(report.steps_undone, structure, step);
  } else {
    take_in(structure, step);
    places_.take(operation, report, structure, [this](CellId node) { return number(node); });
    undoable_.push_back(static_cast<std::uint32_t>(steps_.size()));
  }
  step.made = cells_.size() - step.first;
  const engine::Homology homology = engine.homology();
  step.cells.assign(engine.cells().begin(), engine.cells().end());
  step.euler = engine.euler_characteristic();
  step.betti = homology.betti;
  step.torsion = homology.torsion;
  add_answer(engine, operation, report, step);
  generators_.take(engine, place(steps_.size()), step.undone, writer(structure), step);
  if (steps_.size() == limits_.steps * stride_) {
    thin_out();
  }
  if (!steps_.empty() && steps_.size() % stride_ != 0) {
    steps_.back().keep_events_only();
  }
  steps_.push_back(std::move(step));
}

void PageHistory::take_last_generators(engine::Engine& engine, const std::atomic<bool>* stop) {
  if (!steps_.empty()) {
    generators_.take_last(engine, place(steps_.size() - 1), writer(engine.structure()), stop, steps_.back());
  }
}

GeneratorHistory::Place PageHistory::place(std::size_t step) const {
  return {static_cast<std::uint32_t>(step), undoable_.empty() ? 0 : undoable_.back()};
}

GeneratorHistory::Writer PageHistory::writer(const Structure& structure) const {
  return {[this](CellId node) { return number(node) != ops::none; },
          [this, &structure](const engine::CellChain& cells) { return chain(structure, cells); }};
}

void PageHistory::thin_out() {
  stride_ *= 2;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    if ((k + 1) % stride_ != 0) {
      steps_[k].keep_events_only();
    }
  }
}

void PageHistory::take_in(const Structure& structure, PageStep& step) {
  add_families(structure, step);
  number_nodes(structure);
  add_removals(structure, step);
  add_moves(structure, step);
}

void PageHistory::take_back(std::uint64_t steps, const Structure& structure, PageStep& step) {
  for (std::uint64_t k = 0; k < steps && !undoable_.empty(); ++k) {
    step.undone.push_back(undoable_.back());
    undoable_.pop_back();
  }
  const ops::Moment now = structure.now();
  numbers_[0].resize(std::min<std::size_t>(numbers_[0].size(), now.created));
  numbers_[1].resize(std::min<std::size_t>(numbers_[1].size(), ops::number_of(now.asked)));
  shown_.resize(std::min<std::size_t>(shown_.size(), now.families));
  links_ = now.links;
  moves_ = now.moves;
}

void PageHistory::add_families(const Structure& structure, PageStep& step) {
  const ops::LazyCells& lazy = structure.lazy();
  if (shown_.size() < lazy.families()) {
    note_consumed(structure, step);
  }
  while (shown_.size() < lazy.families()) {
    const ops::LazyFamily& family = lazy.family(ops::FamilyId{shown_.size()});
    std::uint64_t size = 0;
    for (const std::uint64_t count : family.counts) {
      size = count > limits_.cells_of_family ? limits_.cells_of_family + 1 : size + count;
      if (size > limits_.cells_of_family) {
        break;
      }
    }
    shown_.push_back(size <= limits_.cells_of_family);
    if (shown_.back()) {
      (void)lazy.cells_of(family.body);  // they are there from now on
    } else {
      ++families_left_out_;
    }
  }
}

void PageHistory::note_consumed(const Structure& structure, PageStep& step) {
  for (std::uint32_t cell = 0; cell < cells_.size(); ++cell) {
    const CellId node = nodes_[cell];
    if (number(node) == cell && structure.is_current(node) &&
        structure.lazy().consumed_by(node) >= ops::FamilyId{shown_.size()} && structure.lazy().is_consumed(node)) {
      step.consumed.push_back(cell);
    }
  }
}

/// Numbers first, then faces: a lazy cell may have been asked for before its faces.
void PageHistory::number_nodes(const Structure& structure) {
  const std::uint32_t first = cells_.size();
  const auto take = [&](CellId node, bool is_shown) {
    auto& list = numbers_[ops::is_asked_for(node) ? 1 : 0];
    const bool has_room = nodes_.size() < limits_.cells;
    left_out_ += is_shown && !has_room ? 1U : 0U;
    list.push_back(is_shown && has_room ? static_cast<std::uint32_t>(nodes_.size()) : std::uint32_t{ops::none});
    if (is_shown && has_room) {
      nodes_.push_back(node);
    }
  };
  for (CellId node{numbers_[0].size()}; node < structure.cells().size(); ++node) {
    take(node, true);
  }
  for (CellId node = ops::asked_node(static_cast<std::uint32_t>(numbers_[1].size())); node < structure.cells().asked();
       ++node) {
    const ops::LazyCell* lazy = structure.lazy().of(node);
    take(node, lazy != nullptr && lazy->key.family < shown_.size() && shown_[lazy->key.family]);
  }
  for (std::uint32_t cell = first; cell < nodes_.size(); ++cell) {
    add_node(structure, nodes_[cell]);
  }
}

void PageHistory::add_node(const Structure& structure, CellId node) {
  const std::uint32_t cell = cells_.size();
  cells_.names.push_back(structure.directory().own_name(node));
  const ops::TypeInfo& type = structure.cells().type(node);
  cells_.type_of.push_back(type_number(type.type, static_cast<int>(type.faces.size())));
  const bool has_edges = structure.dimension(node) == 2;
  const auto faces = structure.faces().of(node);
  for (std::uint32_t k = 0; k < faces.size(); ++k) {
    const bool is_turned = has_edges && structure.maps().sign(structure.faces().order(node, k)) < 0;
    cells_.faces.push_back(face(structure, faces[k], is_turned));
  }
  cells_.first_face.push_back(static_cast<std::uint32_t>(cells_.faces.size()));
  if (structure.dimension(node) == 0) {
    place(structure, node, cell);
  }
}

/// What is known of where a vertex is from how it came about. What an operation gives comes later.
void PageHistory::place(const Structure& structure, CellId node, std::uint32_t cell) {
  places_.add_vertex(cell);
  if (const ops::LazyCell* lazy = structure.lazy().of(node)) {
    const std::uint32_t left = number(structure.forest().oldest(lazy->key.left.cell));
    if (lazy->key.part == ops::LazyPart::base) {
      places_.put_at(cell, left);
    } else if (lazy->key.part == ops::LazyPart::pair) {
      places_.put_at_sum(cell, left, number(structure.forest().oldest(lazy->key.right.cell)), lazy->key.family);
    }
  } else if (const auto* copy = structure.splits().copy(node)) {
    places_.put_beside(cell, number(structure.forest().oldest(copy->source)));
  }
}

PageRef PageHistory::face(const Structure& structure, CellId node, bool is_turned) const {
  if (is_degenerate_from_start(structure, node)) {
    const std::uint32_t onto = number(structure.values().of(node).cell);
    return onto == ops::none ? ref_to_unshown : ref_squashed_onto(onto);
  }
  const std::uint32_t cell = number(node);
  return cell == ops::none ? ref_to_unshown : ref_to(cell, is_turned);
}

void PageHistory::add_removals(const Structure& structure, PageStep& step) {
  const ops::Forest& forest = structure.forest();
  for (; links_ < forest.links(); ++links_) {
    const CellId removed = forest.removed(links_);
    const std::uint32_t cell = number(removed);
    if (cell == ops::none) {
      continue;
    }
    if (forest.deletions().contains(links_)) {  // it is not shown from now on, as what became a factor is not
      step.consumed.push_back(cell);
      continue;
    }
    const ops::OrientedCell became = forest.find_oriented_at(removed, links_ + 1);
    const CellId onto = became.cell != ops::none ? became.cell : forest.squashed(removed).cell;
    const std::uint32_t other = number(onto);
    step.removed.push_back(cell);
    step.removed.push_back(other == ops::none         ? ref_to_unshown
                           : became.cell == ops::none ? ref_squashed_onto(other)
                                                      : ref_to(other, became.sign < 0));
    if (cells_.dimension(cell) == 0 && other != ops::none) {
      places_.glue(cell, other);
    }
  }
}

void PageHistory::add_moves(const Structure& structure, PageStep& step) {
  for (; moves_ < structure.splits().moves(); ++moves_) {
    const ops::SplitHistory::MadeMove move = structure.splits().move(moves_);
    const std::uint32_t cell = number(move.cell);
    if (cell == ops::none) {
      continue;
    }
    const int dimension = structure.dimension(move.cell);
    const bool is_turned = dimension == 2 && structure.maps().sign(move.order_after) < 0;
    const PageRef after = face(structure, move.after, is_turned);
    step.moved.insert(step.moved.end(), {PageRef{cell}, PageRef{move.slot}, after});
    const PageRef other = dimension == 1 ? cells_.faces[cells_.first_face[cell] + 1 - move.slot] : ref_to_unshown;
    if (after >= 0 && other >= 0) {
      places_.join(static_cast<std::uint32_t>(after / 2), static_cast<std::uint32_t>(other / 2));
    }
  }
}

void PageHistory::add_answer(engine::Engine& engine, const ops::Operation& operation, const engine::StepReport& report,
                             PageStep& step) const {
  const auto* asked = std::get_if<ops::AskClass>(&operation);
  if (asked == nullptr || !report.answer) {
    return;
  }
  PageAnswer answer;
  answer.is_cycle = report.answer->is_cycle;
  answer.is_zero = report.answer->is_zero;
  for (const sparse::Rational& coefficient : report.answer->coefficients) {
    answer.coefficients.push_back(text_of(coefficient));
  }
  if (const Result<engine::CellChain> found = engine.chain(asked->chain)) {
    answer.asked = chain(engine.structure(), *found);
  }
  if (report.answer->bounds) {
    answer.bounds = chain(engine.structure(), *report.answer->bounds);
  }
  step.answer = std::make_unique<PageAnswer>(std::move(answer));
}

PageChain PageHistory::chain(const Structure& structure, const engine::CellChain& chain) const {
  PageChain written;
  if (chain.terms.size() > limits_.terms) {
    written.length = chain.terms.size();
    return written;
  }
  for (const auto& [coefficient, cell] : chain.terms) {
    const std::uint32_t found = number(cell);
    written.terms.push_back({text_of(coefficient), found == ops::none ? std::int64_t{-1} : std::int64_t{found},
                             found == ops::none ? structure.name(cell) : ""});
  }
  return written;
}

std::uint32_t PageHistory::type_number(const ops::CellType& type, int faces) {
  const auto [known, is_new] = types_.emplace(type, static_cast<std::uint32_t>(cells_.types.size()));
  if (is_new) {
    // Of others than simploids the kind, the dimension and the number of faces say enough.
    cells_.types.push_back(ops::is_simploid(type) ? type : ops::CellType{type[0], type[1], faces});
  }
  return known->second;
}

}  // namespace sesame::replay
