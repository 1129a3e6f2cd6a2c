#include "engine/engine.hpp"

#include <fmt/format.h>
#include <spdlog/logger.h>

#include <exception>
#include <new>
#include <stdexcept>

#include "engine/answer_hash.hpp"
#include "engine/history_zigzag.hpp"
#include "engine/live_equivalence.hpp"
#include "engine/log.hpp"
#include "engine/log_snapshots.hpp"
#include "engine/renewal.hpp"
#include "engine/step_account.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {

Engine::Engine(sparse::AnyRing ring, ops::Limits limits, const RebasePolicy& rebases, const HistoryPolicy& history,
               const Resources& resources)
    : ring_{ring},
      limits_{limits},
      rebases_{rebases},
      history_{history},
      resources_{resources},
      object_{std::make_unique<LiveObject>(ring, limits, rebases, history.undoable)} {
  // Made now if need be, so that memory running out in a step is the step's own affair.
  step_log();
  rebase_log();
  refusal_log();
  object_->watch(resources_);
  if (history_.forgets_cells && history_.undoable < UINT64_MAX / 16) {
    renewal_ = std::make_unique<Renewal>(history_.undoable, [this] {
      return std::make_unique<LiveObject>(ring_, limits_, rebases_, history_.undoable);
    });
  }
}

Engine::~Engine() = default;

// ---------------------------------------------------------------------------------------------- after an exception

LiveObject& Engine::object() const {
  if (is_void_) [[unlikely]] {
    make_anew();
  }
  return *object_;
}

LiveObject& Engine::object_with_all_steps() const {
  if (object().undoable_here() < object().undoable()) {
    make_anew();
  }
  return *object_;
}

void Engine::give_up() const {
  is_void_ = true;
  if (questions_ == 0) {
    object_.reset();  // whose memory may be what is wanting
  }
}

/// Takes a step out of the log that stands in it and has not happened.
Status Engine::settle_log() const {
  Status settled = Done{};
  if (is_ahead_) {
    settled = written_to_->take_back();
    is_ahead_ = !settled.has_value();
  }
  return settled;
}

/// Asks the object; what is cut off by an exception gives it up.
template <class Question>
auto Engine::ask(Question&& question) const {
  struct Asking {
    explicit Asking(std::uint32_t& count) : count_{count} { ++count_; }
    Asking(const Asking&) = delete;
    Asking& operator=(const Asking&) = delete;
    ~Asking() { --count_; }
    std::uint32_t& count_;
  };
  LiveObject& asked = object();
  try {
    const Asking asking(questions_);
    return question(asked);
  } catch (...) {
    give_up();
    throw;
  }
}

Status Engine::for_each_logged(const std::function<Status(const ops::Operation&)>& visit) const {
  if (!history_.keeps_log) {
    return written_to_->read_back(visit);
  }
  Status status = Done{};
  for (auto operation = log_.begin(); status && operation != log_.end(); ++operation) {
    status = visit(*operation);
  }
  return status;
}

void Engine::make_anew() const {
  sparse::expects(questions_ == 0, "an answer was cut off by an exception: nothing more can be asked within it");
  if (const Status settled = settle_log(); !settled) {
    throw std::runtime_error(settled.error().what);
  }
  is_void_ = true;
  object_.reset();
  sparse::expects(has_log(), "a step was cut off by an exception, and there is no log to make the object anew from");
  auto anew = std::make_unique<LiveObject>(ring_, limits_, rebases_, history_.undoable);
  const LiveObject::WriteAhead is_written = [](const ops::Operation&) { return Done{}; };
  const auto apply = [&](const ops::Operation& operation) -> Status {
    const Result<StepReport> report = anew->apply(operation, is_written);
    return report ? Status{Done{}} : report.error();
  };
  if (const Status status = for_each_logged(apply); !status) {
    throw std::runtime_error("the object cannot be made anew from its log: " + status.error().what);
  }
  sparse::expects(anew->applied() == applied_, "the log has the steps that were applied, and no other");
  anew->watch(resources_);
  object_ = std::move(anew);
  is_void_ = false;
  step_log().info("made anew from the {} steps of its log", applied_);
}

// ------------------------------------------------------------------------------------------------------------ steps

Result<StepReport> Engine::apply(ops::Operation operation) {
  sparse::expects(questions_ == 0, "no step is applied while a question is being answered");
  const StepAccount account(*this);
  Result<StepReport> result = attempt(operation);
  if (!result) {
    refusal_log().debug("step {} ({}) did not happen: {}", applied_ + 1, ops::keyword(operation), result.error().what);
    return result;
  }
  try {
    account.say(*result);
    bind_now_and_then();
  } catch (const std::exception& e) {  // the step has happened: what is wrong, the next one will meet
    step_log().warn("after step {}: {}", applied_, e.what());
  }
  result->renewed = renew();
  call_observers(*result);
  return result;
}

/// After a step. Whether another object has taken the place of the one before. Where there is a log none does: an
/// object that has forgotten nothing would have to do all its steps again, and might refuse some.
bool Engine::renew() {
  if (renewal_ == nullptr || has_log()) {
    return false;
  }
  std::unique_ptr<LiveObject> next;
  try {
    if (!renewal_->after_step(object(), log_.back())) {
      return false;
    }
    next = renewal_->successor(object(), homology());
  } catch (const std::bad_alloc&) {  // which is no matter to the step, that has happened
    renewal_->drop();
    if (is_void_ || object_->structure().lazy().families() > 0) {
      give_up();
      throw;
    }
    renewal_->end(*object_);
  }
  if (next == nullptr) {
    return false;
  }
  rebases_of_others_ += object_->equivalences().rebases() + 1;
  work_of_others_ += object_->equivalences().work();
  object_ = std::move(next);
  object_->watch(resources_);
  return true;
}

Result<StepReport> Engine::attempt(ops::Operation& operation) {
  try {
    LiveObject& object = this->object().needs_earlier_steps(operation) ? object_with_all_steps() : this->object();
    Result<StepReport> result =
        object.apply(operation, [this](const ops::Operation& step) { return write_ahead(step); });
    if (result) {
      keep(std::move(operation));
    }
    return result;
  } catch (const std::bad_alloc&) {
    give_up();
    if (!has_log()) {
      throw;
    }
    (void)settle_log();  // or else before the next step
  } catch (...) {
    give_up();
    (void)settle_log();
    throw;
  }
  return Error{Errc::limit, fmt::format("out of memory in step {}, \"{}\": nothing of it has happened", applied_ + 1,
                                        ops::keyword(operation))};
}

Status Engine::write_ahead(const ops::Operation& operation) {
  if (written_to_ == nullptr) {
    return Done{};
  }
  is_ahead_ = true;  // before anything can be cut off
  Status written = written_to_->append(operation);
  is_ahead_ = written.has_value();
  return written;
}

/// What the policy says, of a step that was applied.
void Engine::keep(ops::Operation&& operation) {
  if (!history_.keeps_log) {
    log_.clear();
  }
  log_.push_back(std::move(operation));
  ++applied_;
  is_ahead_ = false;
  if (written_to_ != nullptr) {
    written_to_->confirm();
  }
}

void Engine::write_to(std::shared_ptr<StepLog> log, std::shared_ptr<LogSnapshots> snapshots) {
  written_to_ = std::move(log);
  snapshots_ = std::move(snapshots);
  if (renewal_ != nullptr) {
    renewal_->drop();  // it would miss steps
  }
}

void Engine::resume(std::unique_ptr<LiveObject> object) {
  sparse::expects(applied_ == 0, "only a new engine goes on with an object");
  applied_ = object->applied();
  object_ = std::move(object);
  object_->watch(resources_);
}

Status Engine::bind(bool syncs) {
  return written_to_ == nullptr ? Status{Done{}} : written_to_->bind(answer_hash(cells(), homology()), syncs);
}

Status Engine::bind_log() {
  Status bound = bind(true);
  if (bound && snapshots_ != nullptr) {
    snapshots_->at_end(object());
  }
  return bound;
}

void Engine::bind_now_and_then() {
  constexpr std::uint64_t steps_for_each = 1000;
  if (written_to_ == nullptr || applied_ % steps_for_each != 0) {
    return;
  }
  if (const Status bound = bind(false); !bound) {
    step_log().warn("{}", bound.error().what);
  }
  if (snapshots_ != nullptr) {
    snapshots_->now_and_then(object());
  }
}

void Engine::call_observers(const StepReport& report) const {
  std::exception_ptr first;
  for (const Observer& observer : observers_) {
    try {
      observer(log_.back(), report);
    } catch (...) {
      if (!first) {
        first = std::current_exception();
      }
    }
  }
  if (first) {
    std::rethrow_exception(first);
  }
}

// -------------------------------------------------------------------------------------------------------- questions

Result<ops::Plan> Engine::plan(const ops::Operation& operation) {
  return ask([&](LiveObject& object) { return object.plan(operation); });
}

Homology Engine::homology() {
  return ask([](LiveObject& object) { return object.homology(); });
}

Result<CellChain> Engine::chain(const std::vector<std::pair<Integer, std::string>>& terms) const {
  return ask([&](LiveObject& object) { return object.chain(terms); });
}

std::vector<Generator> Engine::generators(int degree) {
  return ask([&](LiveObject& object) { return object.tracker().generators(degree); });
}

void Engine::visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit) {
  std::exception_ptr thrown;
  ask([&](LiveObject& object) {
    object.visit_generators(degree, most_terms, [&](Generator generator) {
      bool goes_on = false;
      try {
        goes_on = visit(std::move(generator));
      } catch (...) {
        thrown = std::current_exception();
      }
      if (is_void_) {  // a question within the visit was cut off: nothing more is to be done with this object
        throw std::bad_alloc();
      }
      return goes_on;
    });
  });
  if (thrown) {
    std::rethrow_exception(thrown);
  }
}

ClassAnswer Engine::classify(const CellChain& chain) {
  return ask([&](LiveObject& object) { return object.tracker().classify(chain); });
}

Result<Barcode> Engine::barcode(const HistoryOptions& options) const {
  if (object().barcode_needs_earlier_steps()) {
    (void)object_with_all_steps();
  }
  const bool is_zigzag = ask([](LiveObject& object) { return object.is_zigzag(); });
  if (!options.want_cycles() && (!has_log() || !is_zigzag)) {
    return ask([](LiveObject& object) { return object.barcode(); });
  }
  if (!has_log()) {
    return Error{Errc::refused, "there are no cycles of bars: the steps are not kept"};
  }
  std::vector<NumberedStep> steps;  // that are not undone
  std::uint64_t number = 0;
  const Status read = for_each_logged([&](const ops::Operation& operation) -> Status {
    ++number;
    if (const auto* undo = std::get_if<ops::Undo>(&operation)) {
      steps.resize(steps.size() - undo->steps, NumberedStep{0, ops::Note{}});
    } else {
      steps.push_back({number, operation});
    }
    return Done{};
  });
  if (!read) {
    return read.error();
  }
  Result<Barcode> barcode = barcode_of_history(ring_, limits_, rebases_, steps, options);
  const bool is_stopped = options.stop != nullptr && options.stop->load();
  if (barcode && options.verifies && !is_zigzag && !is_stopped) {
    const Result<Barcode> other = ask([](LiveObject& object) { return object.barcode(); });
    if (other && other->bars != barcode->bars) {
      return Error{Errc::law_broken, "the two ways of computing the barcode differ; this is a bug"};
    }
  }
  return barcode;
}

ops::Moment Engine::before_step(std::uint64_t n) const {
  sparse::expects(n >= 1 && n <= undoable(), "a step is one of those that are not undone");
  const std::uint64_t below = object().workspace().steps_below();
  return n > below ? object().workspace().before(n - 1 - below) : object_with_all_steps().workspace().before(n - 1);
}

std::optional<std::string> Engine::first_defect() {
  return ask([](LiveObject& object) { return object.first_defect(); });
}

}  // namespace sesame::engine
