#include "engine/engine.hpp"

#include <spdlog/logger.h>

#include <algorithm>
#include <numeric>

#include "engine/live_equivalence.hpp"
#include "engine/log.hpp"
#include "engine/step_account.hpp"
#include "ops/cells/cell_order.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;  // clang 14 does not deduce aggregates

std::string to_text(const std::vector<Integer>& numbers) {
  std::string text = "[";
  for (const Integer& n : numbers) {
    text += (text.size() > 1 ? "," : "") + n.to_string();
  }
  return text + "]";
}

std::string to_text(const std::vector<std::vector<Integer>>& lists) {
  std::string text = "[";
  for (const auto& list : lists) {
    text += (text.size() > 1 ? "," : "") + to_text(list);
  }
  return text + "]";
}

std::string to_text(const Integer& n) { return n.to_string(); }

bool is_void(const Integer& n) { return n.is_zero(); }
bool is_void(const std::vector<Integer>& list) { return list.empty(); }

/// Without trailing zeros or empty lists: they may be left out of an expectation.
template <class T>
std::vector<T> trimmed(std::vector<T> list) {
  while (!list.empty() && is_void(list.back())) {
    list.pop_back();
  }
  return list;
}
Integer trimmed(const Integer& n) { return n; }

/// Adds "betti should be [1,2,1] but is [1,1]" to `differences` when the two differ.
template <class T>
void compare(const char* what, const std::optional<T>& expected, const T& found, std::string& differences) {
  if (expected && trimmed(*expected) != trimmed(found)) {
    differences += std::string{differences.empty() ? "" : "; "} + what + " should be " + to_text(*expected) +
                   " but is " + to_text(found);
  }
}

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

template <class From>
std::vector<Integer> integers(const From& numbers) {
  std::vector<Integer> out;
  for (const auto n : numbers) {
    out.emplace_back(static_cast<std::int64_t>(n));
  }
  return out;
}

/// Why a step is no map of the object before it to that after it, as the end of a sentence; null when it is one.
const char* why_no_map(ops::StepKind kind) {
  switch (kind) {
    case ops::StepKind::split:
      return "splits cells, and so maps the object before it nowhere";
    case ops::StepKind::lazy_cone:
      return "is a cone over more cells than are written out, whose base's classes are no longer told apart";
    case ops::StepKind::product:
      return "is a product, which consumes the bodies before it";
    case ops::StepKind::nothing:
    case ops::StepKind::addition:
    case ops::StepKind::removal:
      break;
  }
  return nullptr;
}

std::uint64_t total(std::span<const std::uint64_t> counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

}  // namespace

Engine::Engine(sparse::AnyRing ring, ops::Limits limits, const RebasePolicy& rebases, const HistoryPolicy& history)
    : ring_{ring}, workspace_{limits}, equivalences_{ring, workspace_.structure(), rebases}, history_{history} {
  // Made now if need be, so that memory running out in a step is the step's own affair.
  step_log();
  rebase_log();
  refusal_log();
}

Engine::~Engine() = default;

Result<StepReport> Engine::apply(ops::Operation operation) {
  sparse::expects(!is_broken_, "a step was cut off by an exception: the log is intact, make a new engine from it");
  is_broken_ = true;  // until this has come to its end
  const StepAccount account(*this);
  Result<StepReport> result = carry_out(operation);
  if (result) {
    keep(std::move(operation));
  }
  is_broken_ = false;
  if (!result) {
    refusal_log().debug("step {} ({}) did not happen: {}", applied_ + 1, ops::keyword(operation), result.error().what);
    return result;
  }
  account.say(*result);
  for (const Observer& observer : observers_) {
    observer(log_.back(), *result);
  }
  return result;
}

/// What the policy says, of a step that was applied.
void Engine::keep(ops::Operation&& operation) {
  ++applied_;
  if (!history_.keeps_log) {
    log_.clear();
  }
  log_.push_back(std::move(operation));
  for (; undoable() > history_.undoable; has_forgotten_ = true) {
    workspace_.forget_oldest_step();
    equivalences_.forget_oldest_mark();
    numbers_.pop_front();
  }
}

Result<StepReport> Engine::carry_out(const ops::Operation& operation) {
  return std::visit(Overloaded{[&](const ops::Undo& undo) { return take_back(undo); },
                               [&](const ops::Expect& expected) -> Result<StepReport> {
                                 if (Status status = check(expected); !status) {
                                   return status.error();
                                 }
                                 return pass(operation);
                               },
                               [&](const ops::AskClass& question) -> Result<StepReport> {
                                 const Result<CellChain> asked = chain(question.chain);
                                 if (!asked) {
                                   return asked.error();
                                 }
                                 ClassAnswer answer = classify(*asked);
                                 StepReport report = pass(operation);
                                 report.answer = std::move(answer);
                                 return report;
                               },
                               [&](const ops::Note&) -> Result<StepReport> { return pass(operation); },
                               [&](const auto&) { return construct(operation); }},
                    operation);
}

Result<ops::Plan> Engine::plan(const ops::Operation& operation) {
  if (!ops::Workspace::is_construction(operation)) {
    return ops::Plan{};
  }
  if (Status status = workspace_.plan(operation); !status) {
    return status.error();
  }
  return workspace_.planned();
}

Result<StepReport> Engine::construct(const ops::Operation& operation) {
  if (Status status = workspace_.plan(operation); !status) {
    return status.error();
  }
  if (Status status = check_room(operation); !status) {
    return status.error();
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

/// A product has a small generator for each pair of those of its factors: not too many of them.
Status Engine::check_room(const ops::Operation& operation) const {
  const auto* product = std::get_if<ops::MakeProduct>(&operation);
  if (product == nullptr) {
    return Done{};
  }
  const std::uint64_t left = equivalences_.now().small_of(workspace_.planned().family->bodies[0]);
  const std::uint64_t right = equivalences_.now().small_of(workspace_.planned().family->bodies[1]);
  const auto limit = static_cast<std::uint64_t>(workspace_.planner().limits().cells_per_step);
  if (right != 0 && left > limit / right) {
    return Error{Errc::refused, "the small complexes of \"" + product->left + "\" and \"" + product->right +
                                    "\" have " + std::to_string(left) + " and " + std::to_string(right) +
                                    " generators: their product would have more than " + std::to_string(limit) +
                                    ", the limit for one step"};
  }
  return Done{};
}

Result<Barcode> Engine::barcode() const {
  if (std::holds_alternative<sparse::Integers>(ring_)) {
    return Error{Errc::refused, "barcodes need a field: compute over Q or Z/p, such as Z/2, instead of Z"};
  }
  if (has_forgotten_) {
    return Error{Errc::refused,
                 "there is no barcode: only the last " + std::to_string(history_.undoable) + " steps are kept"};
  }
  const std::vector<std::uint64_t> numbers = numbers_.all();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (const char* reason = why_no_map(workspace_.steps()[k].kind); reason != nullptr) {
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

Status Engine::check(const ops::Expect& expected) {
  std::string differences;
  compare("cells", expected.cells, integers(cells()), differences);
  compare("euler", expected.euler, Integer{euler_characteristic()}, differences);
  if (expected.betti || expected.torsion) {
    const Homology found = homology();
    compare("betti", expected.betti, integers(found.betti), differences);
    compare("torsion", expected.torsion, found.torsion, differences);
  }
  if (!differences.empty()) {
    return Error{Errc::expectation, differences};
  }
  return Done{};
}

Result<StepReport> Engine::take_back(const ops::Undo& operation) {
  StepReport report = begin_report(operation);
  report.steps_undone = operation.steps;
  if (operation.steps > 0 && operation.steps <= undoable()) {
    report.events = structure().journal().counts_since(workspace_.steps()[undoable() - operation.steps].begin);
  }
  if (Status status = workspace_.take_back(operation.steps); !status) {
    return status.error();
  }
  numbers_.pop_back(operation.steps);
  equivalences_.undo(operation.steps);
  report.after = ops::now(structure());
  return report;
}

StepReport Engine::begin_report(const ops::Operation& operation) const {
  StepReport report;
  report.step = applied_ + 1;
  report.op = ops::keyword(operation);
  report.before = report.after = ops::now(structure());
  return report;
}

/// A step that does nothing to the object.
StepReport Engine::pass(const ops::Operation& operation) {
  StepReport report = begin_report(operation);
  remember();
  workspace_.pass();
  return report;
}

/// Before a step.
void Engine::remember() {
  numbers_.push_back(applied_ + 1);
  equivalences_.push_mark();
}

void Engine::visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit) {
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

std::int64_t Engine::euler_characteristic() const {
  std::int64_t sum = 0;
  std::int64_t sign = 1;
  for (const std::uint64_t count : cells()) {
    sum += sign * static_cast<std::int64_t>(count);
    sign = -sign;
  }
  return sum;
}

Result<CellChain> Engine::chain(const std::vector<std::pair<Integer, std::string>>& terms) const {
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

ops::Moment Engine::before_step(std::uint64_t n) const {
  sparse::expects(n >= 1 && n <= undoable(), "a step is one of those that are not undone");
  return workspace_.before(n - 1);
}

std::optional<std::string> Engine::first_defect() {
  const std::deque<ops::Workspace::Step>& steps = workspace_.steps();
  return steps.empty() ? equivalences_.now().first_defect(ops::StepKind::nothing, {})
                       : equivalences_.now().first_defect(steps.back().kind, workspace_.before(steps.size() - 1));
}

}  // namespace sesame::engine
