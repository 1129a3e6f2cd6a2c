#include "engine/live_object.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "engine/expectation.hpp"
#include "engine/history_zigzag.hpp"
#include "engine/left/saturating.hpp"
#include "ops/cells/cell_order.hpp"

namespace sesame::engine {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;  // clang 14 does not deduce aggregates

/// Adds up the terms of each cell, and drops what comes to nothing.
void add_up(std::vector<CellChain::Term>& terms) {
  std::sort(terms.begin(), terms.end(), [](const auto& a, const auto& b) { return a.generator < b.generator; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < terms.size();) {
    CellChain::Term sum = std::move(terms[i]);
    for (++i; i < terms.size() && terms[i].generator == sum.generator; ++i) {
      sum.coefficient += terms[i].coefficient;
    }
    if (!sum.coefficient.is_zero()) {
      terms[kept++] = std::move(sum);
    }
  }
  terms.resize(kept);
}

std::uint64_t total(std::span<const std::uint64_t> counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

}  // namespace

LiveObject::LiveObject(const sparse::AnyRing& ring, const ops::Limits& limits, const RebasePolicy& rebases,
                       std::uint64_t undoable)
    : ring_{ring}, workspace_{limits}, equivalences_{ring, workspace_.structure(), rebases}, most_undoable_{undoable} {}

Result<StepReport> LiveObject::apply(const ops::Operation& operation, const WriteAhead& write_ahead) {
  Result<StepReport> report = carry_out(operation, write_ahead);
  if (report) {
    ++applied_;
    forget_old_steps();
  }
  return report;
}

Result<StepReport> LiveObject::carry_out(const ops::Operation& operation, const WriteAhead& write_ahead) {
  return std::visit(Overloaded{[&](const ops::Undo& undo) { return take_back(undo, write_ahead); },
                               [&](const ops::Expect& expected) -> Result<StepReport> {
                                 if (Status status = check_expectation(expected, cells(), euler_characteristic(),
                                                                       [&] { return homology(); });
                                     !status) {
                                   return status.error();
                                 }
                                 return pass(operation, write_ahead);
                               },
                               [&](const ops::AskClass& question) -> Result<StepReport> {
                                 const Result<CellChain> asked = chain(question.chain);
                                 if (!asked) {
                                   return asked.error();
                                 }
                                 ClassAnswer answer = tracker().classify(*asked);
                                 Result<StepReport> report = pass(operation, write_ahead);
                                 if (report) {
                                   report->answer = std::move(answer);
                                 }
                                 return report;
                               },
                               [&](const ops::Note&) -> Result<StepReport> { return pass(operation, write_ahead); },
                               [&](const auto&) { return construct(operation, write_ahead); }},
                    operation);
}

Result<ops::Plan> LiveObject::plan(const ops::Operation& operation) {
  if (!ops::Workspace::is_construction(operation)) {
    return ops::Plan{};
  }
  if (Status status = workspace_.plan(operation); !status) {
    return status.error();
  }
  return workspace_.planned();
}

Result<StepReport> LiveObject::construct(const ops::Operation& operation, const WriteAhead& write_ahead) {
  if (Status status = workspace_.plan(operation); !status) {
    return status.error();
  }
  if (Status status = check_room(operation); !status) {
    return status.error();
  }
  if (Status written = write_ahead(operation); !written) {
    return written.error();
  }
  StepReport report = begin_report(operation);
  report.already = workspace_.planned().already;
  report.kind = workspace_.planned().kind();
  const std::uint64_t before = total(cells());
  const ops::Journal& journal = structure().journal();
  const ops::Journal::Position begin = journal.end();
  remember();
  workspace_.carry_out();
  report.events = journal.counts_since(begin);
  report.rebased = equivalences_.extend(report.events[ops::EventKind::move]);
  report.after = ops::now(structure());
  const std::uint64_t after = total(cells());
  switch (report.kind) {
    case ops::StepKind::removal:
      report.sequence = SequenceSizes{ops::Direction::forward, before - after, before, after};
      break;
    case ops::StepKind::deletion:
      report.sequence = SequenceSizes{ops::Direction::kernel, after, before, before - after};
      break;
    case ops::StepKind::replacement: {
      const std::uint64_t gone = report.events[ops::EventKind::deletion];
      report.sequence = SequenceSizes{ops::Direction::kernel, after, after + gone, gone};
      break;
    }
    case ops::StepKind::split:
      report.sequence = SequenceSizes{ops::Direction::backward, after - before, after, before};
      break;
    case ops::StepKind::addition:
    case ops::StepKind::lazy_cone:
      report.sequence = SequenceSizes{ops::Direction::backward, before, after, after - before};
      break;
    case ops::StepKind::nothing:
    case ops::StepKind::product:
      break;
  }
  return report;
}

/// What the step would take. A product has a small generator for each pair of those of its factors.
Status LiveObject::check_room(const ops::Operation& operation) {
  constexpr std::uint64_t bytes_of_cell = 330;
  constexpr std::uint64_t bytes_of_small_generator = 75;
  const ops::Plan& plan = workspace_.planned();
  std::uint64_t cells_made = plan.cells.size();
  std::uint64_t bytes = bytes_of_cell * plan.cells.size();
  if (plan.family) {
    for (const std::uint64_t count : plan.family->counts) {
      cells_made = saturating_sum(cells_made, count);
    }
  }
  if (const auto* product = std::get_if<ops::MakeProduct>(&operation)) {
    const std::uint64_t left = equivalences_.now().small_of(plan.family->bodies[0]);
    const std::uint64_t right = equivalences_.now().small_of(plan.family->bodies[1]);
    const std::uint64_t small = saturating_product(left, right);
    bytes = saturating_sum(bytes, saturating_product(small, bytes_of_small_generator));
    const auto limit = static_cast<std::uint64_t>(workspace_.planner().limits().cells_per_step);
    if (small > limit) {
      return Error{
          Errc::limit,
          fmt::format("the product of \"{}\" and \"{}\", whose small complexes have {} and {} generators, would "
                      "have {:.2g} of them, and take about {}; the limit for one step is {}",
                      product->left, product->right, left, right, static_cast<double>(small), size_text(bytes), limit)};
    }
  }
  const std::optional<std::string> objection =
      resources_ ? resources_->objection(saturating_sum(total(cells()), cells_made), bytes) : std::nullopt;
  if (objection) {
    return Error{Errc::limit, fmt::format("this step ({}) {}", ops::keyword(operation), *objection)};
  }
  return Done{};
}

bool LiveObject::is_zigzag() const {
  return std::any_of(workspace_.steps().begin(), workspace_.steps().end(),
                     [](const auto& step) { return maps_backward(step.kind); });
}

Result<Barcode> LiveObject::barcode() const {
  if (std::holds_alternative<sparse::Integers>(ring_)) {
    return Error{Errc::refused, "barcodes need a field: compute over Q or Z/p, such as Z/2, instead of Z"};
  }
  if (has_forgotten_) {
    return Error{Errc::refused,
                 "there is no barcode: only the last " + std::to_string(most_undoable_) + " steps are kept"};
  }
  if (workspace_.steps_below() > 0) {
    return Error{Errc::refused, "there is no barcode: this was read from a snapshot, which has no history"};
  }
  const std::vector<std::uint64_t> numbers = numbers_.all();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (const char* reason = why_no_map_forward(workspace_.steps()[k].kind); reason != nullptr) {
      return Error{Errc::refused, "there is no barcode: step " + std::to_string(numbers[k]) + " " + reason};
    }
  }
  Barcode barcode;
  for (const Lifetime& life : equivalences_.now().lifetimes()) {
    if (life.born == life.died) {
      continue;  // born and dead within one step: no class of any space; two steps never have one time
    }
    const Time death = life.died == Lifetime::never ? never : Time{numbers[life.died]};
    barcode.bars.push_back({life.degree, numbers[life.born], death});
  }
  std::sort(barcode.bars.begin(), barcode.bars.end());
  return barcode;
}

Result<StepReport> LiveObject::take_back(const ops::Undo& operation, const WriteAhead& write_ahead) {
  if (Status possible = workspace_.can_take_back(operation.steps); !possible) {
    return possible.error();
  }
  if (Status written = write_ahead(operation); !written) {
    return written.error();
  }
  StepReport report = begin_report(operation);
  report.steps_undone = operation.steps;
  if (operation.steps > 0) {
    report.events = structure().journal().counts_since(workspace_.steps()[undoable_here() - operation.steps].begin);
  }
  (void)workspace_.take_back(operation.steps).value();
  numbers_.pop_back(operation.steps);
  equivalences_.undo(operation.steps);
  report.after = ops::now(structure());
  return report;
}

StepReport LiveObject::begin_report(const ops::Operation& operation) const {
  StepReport report;
  report.step = applied_ + 1;
  report.op = ops::keyword(operation);
  report.before = report.after = ops::now(structure());
  return report;
}

Result<StepReport> LiveObject::pass(const ops::Operation& operation, const WriteAhead& write_ahead) {
  if (Status written = write_ahead(operation); !written) {
    return written.error();
  }
  StepReport report = begin_report(operation);
  remember();
  workspace_.pass();
  return report;
}

/// Before a step.
void LiveObject::remember() {
  numbers_.push_back(applied_ + 1);
  equivalences_.push_mark();
}

void LiveObject::forget_old_steps() {
  for (; undoable() > most_undoable_; has_forgotten_ = true) {
    if (workspace_.steps_below() == 0) {
      equivalences_.forget_oldest_mark();
    }
    workspace_.forget_oldest_step();
    numbers_.pop_front();
  }
}

// -------------------------------------------------------------------------------------------------------- snapshots

void LiveObject::save(sparse::ArchiveWriter& to, Reduction reduction) const {
  to.put(applied_);
  numbers_.save(to);
  to.put(has_forgotten_);
  workspace_.save(to);
  const std::optional<EliminationRecord> record =
      reduction == Reduction::recorded ? equivalences_.record_afresh() : std::nullopt;
  to.put(record.has_value());
  if (record) {
    record->save(to);
  }
}

void LiveObject::load(sparse::ArchiveReader& from) {
  applied_ = from.get<std::uint64_t>();
  numbers_.load(from, applied_);
  has_forgotten_ = from.get_bool();
  workspace_.load(from);
  if (from.get_bool()) {
    record_.emplace().load(from);
  }
  from.check(undoable() == numbers_.size() && undoable() <= most_undoable_,
             "the steps that can be undone have numbers");
}

void LiveObject::begin_with(const LiveObject& other) {
  workspace_.begin_with(other.workspace_);
  applied_ = other.applied_;
  has_forgotten_ = true;
  equivalences_.begin_afresh();
}

void LiveObject::begin_equivalence() {
  sparse::expects(!record_ || structure().lazy().families() == 0, "a record is one of an object that is written out");
  equivalences_.begin_afresh(record_ ? &*record_ : nullptr);
  record_.reset();
}

bool LiveObject::needs_earlier_steps(const ops::Operation& operation) const {
  const auto* undo = std::get_if<ops::Undo>(&operation);
  return undo != nullptr && undo->steps > undoable_here() && undo->steps <= undoable();
}

bool LiveObject::barcode_needs_earlier_steps() const {
  return workspace_.steps_below() > 0 && !has_forgotten_ && !std::holds_alternative<sparse::Integers>(ring_);
}

void LiveObject::visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit) {
  HomologyTracker& tracker = equivalences_.now();
  if (structure().lazy().families() == 0) {
    tracker.visit_generators(degree, most_terms, visit);
    return;
  }
  const ops::Journal::Position mark = structure().journal().end();
  tracker.push_mark();
  tracker.visit_generators(degree, most_terms, [&](Generator generator) {
    const bool goes_on = visit(std::move(generator));
    workspace_.forget_since(mark);
    tracker.undo_to_mark();
    tracker.push_mark();
    return goes_on;
  });
  tracker.undo_to_mark();
}

std::int64_t LiveObject::euler_characteristic() const { return ops::euler_characteristic(structure()); }

Result<CellChain> LiveObject::chain(const std::vector<std::pair<Integer, std::string>>& terms) const {
  CellChain chain;
  bool is_first = true;
  for (const auto& [coefficient, name] : terms) {
    const Result<ops::Value> value = workspace_.planner().resolve(name);
    if (!value) {
      return value.error();
    }
    const int dimension = structure().types().info(value->type).dimension;
    if (std::exchange(is_first, false)) {
      chain.degree = dimension;
    } else if (chain.degree != dimension) {
      return Error{Errc::bad_input, "a chain is made of cells of one dimension, but \"" + terms.front().second +
                                        "\" has dimension " + std::to_string(chain.degree) + " and \"" + name +
                                        "\" has dimension " + std::to_string(dimension)};
    }
    if (!value->is_degenerate()) {  // which counts as 0
      const bool agrees = structure().maps().sign(value->order) * structure().directory().sign_of_name(value->cell) > 0;
      chain.terms.push_back({agrees ? coefficient : -coefficient, value->cell});
    }
  }
  add_up(chain.terms);
  ops::sort_by_age(structure(), chain.terms, [](const CellChain::Term& term) { return term.generator; });
  return chain;
}

std::optional<std::string> LiveObject::first_defect() {
  const std::deque<ops::Workspace::Step>& steps = workspace_.steps();
  return steps.empty() ? equivalences_.now().first_defect(ops::StepKind::nothing, {})
                       : equivalences_.now().first_defect(steps.back().kind, workspace_.before(steps.size() - 1));
}

}  // namespace sesame::engine
