#include "replay/script/replay.hpp"

#include <fmt/format.h>
#include <spdlog/logger.h>

#include <chrono>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/history_zigzag.hpp"
#include "engine/open.hpp"
#include "replay/text/log.hpp"

namespace sesame::replay {
namespace {

using Clock = std::chrono::steady_clock;

std::uint32_t characteristic(const sparse::AnyRing& ring) {
  return std::visit([](const auto& k) { return k.characteristic(); }, ring);
}

/// One replay: the engine with the means to report on it.
class Run {
 public:
  Run(ScriptReader& script, const ReplayOptions& options, Reporter* reporter, std::ostream& errors, Progress* progress)
      : script_{script}, options_{options}, reporter_{reporter}, errors_{errors}, progress_{progress} {}

  Outcome run() {
    const auto start = Clock::now();
    const Result<ops::Header> header = script_.header();
    if (!header && is_stopped()) {
      return Outcome::interrupted;  // before there was anything to summarise
    }
    if (!header) {
      return fail(header.error().what, outcome_of(header.error().code));
    }
    const Result<sparse::AnyRing> own_ring = sparse::parse_ring(header->ring);
    const Result<sparse::AnyRing> ring = options_.ring ? *options_.ring : own_ring;
    if (!ring) {
      return fail(script_.place() + ring.error().what, Outcome::wrong_script);
    }
    header_ring_ = header->ring;
    if (options_.header != nullptr) {
      *options_.header = *header;
    }
    expects_torsion_ = own_ring && *own_ring == *ring;
    expects_betti_ = own_ring && characteristic(*own_ring) == characteristic(*ring);
    replay_log().info("{}a script over {}, taken over {}", script_.place(), header->ring, sparse::ring_name(*ring));
    std::unique_ptr<engine::Engine> own;
    std::unique_ptr<engine::Engine>& owner = options_.engine != nullptr ? *options_.engine : own;
    const bool keeps_log = options_.needs_barcode == NeededBarcode::of_zigzag;
    const engine::HistoryPolicy kept{options_.undoable, keeps_log, options_.forgets_cells};
    owner = std::make_unique<engine::Engine>(*ring, options_.limits, engine::RebasePolicy{}, kept, options_.resources);
    engine::Engine& engine = *owner;
    if (options_.observer) {
      engine.observe(options_.observer);
    }
    start_ = start;
    Outcome outcome = begin_log(engine, *header);
    if (outcome == Outcome::done) {
      const OpenReplay open(options_.shared, engine, [this, &engine](ops::Operation operation) -> Status {
        replay_log().trace("from outside: {}", ops::keyword(operation));
        return is_time_up() ? time_is_up() : take(engine, std::move(operation));
      });
      outcome = all_steps(engine);
      if (outcome == Outcome::done || outcome == refused_) {
        wait_for_others();
      }
    }
    if (outcome == refused_ && is_stopped()) {
      outcome = Outcome::interrupted;
    }
    replay_log().info("{}{} steps, of which {} from an older log, {} begun afresh", script_.place(), steps_, older_,
                      engine.rebases());
    const bool is_summarised = outcome == Outcome::done || outcome == Outcome::interrupted ||
                               outcome == Outcome::limit_reached ||
                               (options_.partial && outcome != Outcome::law_failed) ||
                               (options_.keep_going && outcome == refused_ && !script_.is_broken());
    if (const Status bound = engine.bind_log(); !bound && outcome == Outcome::done) {
      outcome = fail(bound.error().what, Outcome::wrong_usage);
    }
    if (!is_summarised) {
      return outcome;
    }
    clear_progress();
    if (reporter_ != nullptr) {
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      const bool is_interrupted = outcome == Outcome::interrupted;
      // What was interrupted once writes its generators, since a second interrupt ends it at once.
      reporter_->summary(engine, {steps_, already_, seconds, options_.generators ? &*options_.generators : nullptr,
                                  is_interrupted, is_interrupted ? nullptr : options_.stop});
      if (outcome == Outcome::done && is_stopped()) {
        outcome = Outcome::interrupted;
      }
    }
    return outcome;
  }

  Outcome fail(const std::string& what, Outcome outcome) {
    clear_progress();
    errors_ << what << '\n';
    replay_log().debug("error: {}", what);
    return outcome;
  }

 private:
  [[nodiscard]] bool is_stopped() const { return options_.stop != nullptr && options_.stop->load(); }

  [[nodiscard]] bool is_time_up() const { return options_.most_time && Clock::now() - start_ > *options_.most_time; }

  Outcome begin_log(engine::Engine& engine, ops::Header header) {
    if (options_.log == nullptr) {
      return Outcome::done;
    }
    if (options_.older_steps != nullptr) {
      const Result<std::optional<ops::Header>> older = options_.older_steps->header();
      if (!older) {
        return fail(older.error().what, outcome_of(older.error().code));
      }
      if (*older) {
        return go_on_with_log(engine, **older);
      }
      note_what_is_torn(0);
    }
    header.ring = sparse::ring_name(engine.ring());
    Status begun = options_.older_steps != nullptr ? options_.log->go_on(options_.older_steps->position()) : Done{};
    begun = begun ? options_.log->begin(header) : begun;
    if (!begun) {
      return fail(begun.error().what, Outcome::wrong_usage);
    }
    engine.write_to(options_.log, options_.has_snapshots
                                      ? std::make_unique<engine::LogSnapshots>(options_.log, terms_of(engine))
                                      : nullptr);
    return Outcome::done;
  }

  Outcome go_on_with_log(engine::Engine& engine, const ops::Header& header) {
    const std::string ring = sparse::ring_name(engine.ring());
    if (header.ring != ring) {
      return fail(options_.older_steps->place() + "this log is over " + header.ring +
                      ", and what is to go on from it over " + ring + "; --ring " + header.ring +
                      " would take it over the same",
                  Outcome::wrong_script);
    }
    std::unique_ptr<engine::LogSnapshots> snapshots;
    if (options_.has_snapshots) {
      Result<std::unique_ptr<engine::LogSnapshots>> resumed = engine::resume_from_snapshot(
          engine, *options_.older_steps, options_.log, terms_of(engine), engine::RebasePolicy{});
      if (!resumed) {
        return fail(resumed.error().what, outcome_of(resumed.error().code));
      }
      snapshots = std::move(*resumed);
      older_ = steps_ = options_.older_steps->position().steps();
    }
    if (const Outcome taken = take_older_steps(engine); taken != Outcome::done || is_stopped()) {
      return taken;
    }
    if (const Status gone_on = options_.log->go_on(options_.older_steps->position()); !gone_on) {
      return fail(gone_on.error().what, Outcome::wrong_usage);
    }
    engine.write_to(options_.log, std::move(snapshots));
    return Outcome::done;
  }

  [[nodiscard]] engine::ObjectTerms terms_of(const engine::Engine& engine) const {
    return {engine.ring(), options_.limits, options_.undoable};
  }

  Outcome take_older_steps(engine::Engine& engine) {
    engine::LogReader& older = *options_.older_steps;
    if (is_stopped()) {
      return Outcome::done;
    }
    const Status taken = engine::take_steps(engine, older, [this] {
      older_ = ++steps_;
      if (progress_ != nullptr) {
        progress_->update(steps_);
      }
      return !is_stopped();
    });
    if (!taken) {
      return fail(taken.error().what, outcome_of(taken.error().code));
    }
    if (!is_stopped()) {
      note_what_is_torn(older.position().steps());
    }
    return Outcome::done;
  }

  void note_what_is_torn(std::uint64_t step) {
    const engine::LogReader& older = *options_.older_steps;
    if (older.torn() > 0 && options_.notes != nullptr) {
      clear_progress();
      *options_.notes << older.name() << ": the last " << older.torn() << " bytes, behind step " << step
                      << ", are no whole record, and are cut off\n";
    }
  }

  Outcome all_steps(engine::Engine& engine) {
    while (!is_stopped() && (!options_.until || steps_ - older_ < *options_.until)) {
      Result<std::optional<ops::Operation>> operation = script_.next();
      const std::optional<engine::Binding> binding = script_.binding();
      // Where the script is the log of another ring, or goes on from other steps, it says nothing of these.
      if (binding && expects_torsion_ && older_ == 0 && refused_ == Outcome::done && binding->steps == steps_) {
        if (const Status bound = engine::check_binding(engine, *binding); !bound) {
          return fail(script_.place() + bound.error().what, outcome_of(bound.error().code));
        }
      }
      if (operation ? !*operation : is_stopped()) {
        break;  // at the end; what a stop cut off is no line of the script
      }
      const std::unique_lock<std::mutex> turn = options_.shared != nullptr ? options_.shared->turn() : no_turn();
      if (is_time_up()) {
        return fail(script_.place() + time_is_up().what, Outcome::limit_reached);
      }
      const Outcome outcome = operation ? step(engine, std::move(**operation)) : refuse(operation.error());
      if (outcome != Outcome::done) {
        return outcome;
      }
    }
    return refused_;
  }

  static std::unique_lock<std::mutex> no_turn() { return {}; }

  [[nodiscard]] Error time_is_up() const {
    return {Errc::limit, "time is up before this step, the " + std::to_string(steps_ + 1) +
                             ". one, as the limit was set; those before it have happened"};
  }

  void wait_for_others() {
    constexpr std::chrono::milliseconds a_while{50};  // a signal does not end a wait
    while (options_.shared != nullptr && !is_stopped()) {
      (void)options_.shared->wait_for_other(options_.shared->revision(), a_while);
    }
  }

  Outcome step(engine::Engine& engine, ops::Operation operation) {
    replay_log().trace("line {}: {}", script_.line(), ops::keyword(operation));
    if (const Status taken = take(engine, std::move(operation)); !taken) {
      const bool is_of_log = taken.error().code == Errc::io;
      return refuse({taken.error().code, (is_of_log ? "" : script_.place()) + taken.error().what});
    }
    if (options_.verify) {
      if (const auto defect = engine.first_defect()) {
        return fail(script_.place() + "after step " + std::to_string(steps_) + " (" + std::string{last_} +
                        ") a law does not hold: " + *defect,
                    Outcome::law_failed);
      }
    }
    return Outcome::done;
  }

  /// Carries a step out and reports on it. Errors: those of the engine; bad_input when it would end the barcode that is
  /// needed, and then it has not happened.
  Status take(engine::Engine& engine, ops::Operation operation) {
    const auto start = Clock::now();
    if (auto* expected = std::get_if<ops::Expect>(&operation)) {
      leave_out_other_groups(*expected);
    }
    const Result<engine::StepReport> report = engine.apply(std::move(operation));
    if (!report) {
      return report.error();
    }
    if (const std::optional<std::string> reason = why_no_barcode(*report)) {
      (void)engine.apply(ops::Undo{1});
      return Error{Errc::bad_input, *reason};
    }
    ++steps_;
    last_ = report->op;
    already_ += report->already;
    const bool is_due = options_.every > 0 && steps_ % options_.every == 0 &&
                        (!options_.report_at_most || reported_ < *options_.report_at_most);
    if (reporter_ != nullptr && (is_due || report->answer)) {
      ++reported_;
      const engine::Homology homology = engine.homology();
      const double microseconds = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
      clear_progress();
      reporter_->step(engine, {*report, homology, microseconds});
    }
    if (progress_ != nullptr) {
      progress_->update(steps_);
    }
    if (options_.shared != nullptr) {
      options_.shared->note_step();
    }
    return Done{};
  }

  /// Why a step would end the barcode that is needed.
  [[nodiscard]] std::optional<std::string> why_no_barcode(const engine::StepReport& report) const {
    if (options_.needs_barcode == NeededBarcode::none) {
      return std::nullopt;
    }
    const bool is_of_tower = options_.needs_barcode == NeededBarcode::of_tower;
    const char* reason = is_of_tower ? engine::why_no_map_forward(report.kind) : engine::why_no_map(report.kind);
    if (reason == nullptr) {
      return std::nullopt;
    }
    return fmt::format("there is no barcode: step {} {}{}", report.step, reason,
                       engine::maps_backward(report.kind) ? "; `sesame zigzag` has the barcode of such a script" : "");
  }

  /// Drops from an expectation what holds over another ring only. Betti numbers are those of the characteristic.
  void leave_out_other_groups(ops::Expect& expected) {
    const bool drops = (expected.betti && !expects_betti_) || (expected.torsion && !expects_torsion_);
    if (!expects_betti_) {
      expected.betti.reset();
    }
    if (!expects_torsion_) {
      expected.torsion.reset();
    }
    if (drops && options_.notes != nullptr && !std::exchange(is_noted_, true)) {
      clear_progress();
      *options_.notes << script_.place() << "note: this script expects groups over its own ring, " << header_ring_
                      << "; over another one they are not checked\n";
    }
  }

  /// Of a step that did not happen: whether the replay goes on all the same. The error has its place.
  Outcome refuse(const Error& error) {
    const Outcome outcome = fail(error.what, outcome_of(error.code));
    if (!options_.keep_going || script_.is_broken()) {
      return outcome;
    }
    if (reporter_ != nullptr) {
      const std::string place = script_.place();
      const bool has_place = error.what.starts_with(place);
      reporter_->refused({steps_ + 1, script_.line(), error.what.substr(has_place ? place.size() : 0)});
    }
    const auto severity = [](Outcome of) {
      return of == Outcome::wrong_script    ? 4
             : of == Outcome::wrong_usage   ? 3
             : of == Outcome::limit_reached ? 2
             : of == Outcome::done          ? 0
                                            : 1;
    };
    if (severity(outcome) > severity(refused_)) {
      refused_ = outcome;
    }
    return Outcome::done;
  }

  void clear_progress() {
    if (progress_ != nullptr) {
      progress_->clear();
    }
  }

  ScriptReader& script_;
  const ReplayOptions& options_;
  Reporter* reporter_;
  std::ostream& errors_;
  Progress* progress_;
  Clock::time_point start_;
  std::string header_ring_;
  bool expects_betti_ = true, expects_torsion_ = true;  ///< whether those of the header's ring are those of this one
  bool is_noted_ = false;
  Outcome refused_ = Outcome::done;  ///< the worst of the steps that were refused and passed over
  std::uint64_t steps_ = 0;
  std::string_view last_;      ///< what the last of them was
  std::uint64_t older_ = 0;    ///< of these, from the log that is gone on from
  std::uint64_t already_ = 0;  ///< simplices of insertions that were there
  std::uint64_t reported_ = 0;
};

}  // namespace

Outcome outcome_of(Errc code) {
  switch (code) {
    case Errc::io:
      return Outcome::wrong_usage;
    case Errc::expectation:
      return Outcome::expectation_failed;
    case Errc::law_broken:
      return Outcome::law_failed;
    case Errc::limit:
      return Outcome::limit_reached;
    default:
      return Outcome::wrong_script;
  }
}

Outcome replay(ScriptReader& script, const ReplayOptions& options, Reporter* reporter, std::ostream& errors,
               Progress* progress) {
  Run run(script, options, reporter, errors, progress);
  try {
    return run.run();
  } catch (const std::bad_alloc&) {
    return run.fail(script.place() + "out of memory; every step before this line has happened", Outcome::limit_reached);
  }
}

}  // namespace sesame::replay
