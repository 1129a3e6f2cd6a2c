#include "replay/script/replay.hpp"

#include <spdlog/logger.h>

#include <chrono>
#include <new>
#include <utility>

#include "replay/text/log.hpp"

namespace sesame::replay {
namespace {

using Clock = std::chrono::steady_clock;

Outcome outcome_of(Errc code) {
  switch (code) {
    case Errc::io:
      return Outcome::wrong_usage;
    case Errc::expectation:
      return Outcome::expectation_failed;
    default:
      return Outcome::wrong_script;
  }
}

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
    expects_torsion_ = own_ring && *own_ring == *ring;
    expects_betti_ = own_ring && characteristic(*own_ring) == characteristic(*ring);
    replay_log().info("{}a script over {}, taken over {}", script_.place(), header->ring, sparse::ring_name(*ring));
    std::unique_ptr<engine::Engine> own;
    std::unique_ptr<engine::Engine>& owner = options_.engine != nullptr ? *options_.engine : own;
    owner = std::make_unique<engine::Engine>(*ring, options_.limits, engine::RebasePolicy{},
                                             engine::HistoryPolicy{options_.undoable, false});
    engine::Engine& engine = *owner;
    if (options_.observer) {
      engine.observe(options_.observer);
    }
    Outcome outcome = options_.older_steps != nullptr ? take_older_steps(engine) : begin_log(*header, *ring);
    if (outcome == Outcome::done) {
      outcome = all_steps(engine);
    }
    if (outcome == refused_ && is_stopped()) {
      outcome = Outcome::interrupted;
    }
    replay_log().info("{}{} steps, of which {} from an older log, {} begun afresh", script_.place(), steps_, older_,
                      engine.rebases());
    const bool is_summarised = outcome == Outcome::done || outcome == Outcome::interrupted ||
                               (options_.partial && outcome != Outcome::law_failed) ||
                               (options_.keep_going && outcome == refused_ && !script_.is_broken());
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

  Outcome begin_log(ops::Header header, const sparse::AnyRing& ring) {
    header.ring = sparse::ring_name(ring);
    return write_to_log(header);
  }

  /// A header or an operation.
  template <class Said>
  Outcome write_to_log(const Said& said) {
    if (options_.log == nullptr) {
      return Outcome::done;
    }
    *options_.log << ops::to_text(said) << '\n' << std::flush;
    return *options_.log ? Outcome::done : Outcome::wrong_usage;
  }

  Outcome take_older_steps(engine::Engine& engine) {
    ScriptReader& older = *options_.older_steps;
    const Result<ops::Header> header = older.header();
    if (!header) {
      return fail(header.error().what, outcome_of(header.error().code));
    }
    const std::string ring = sparse::ring_name(engine.ring());
    if (header->ring != ring) {
      return fail(older.place() + "this log is over " + header->ring + ", and what is to go on from it over " + ring +
                      "; --ring " + header->ring + " would take it over the same",
                  Outcome::wrong_script);
    }
    while (!is_stopped()) {
      Result<std::optional<ops::Operation>> operation = older.next();
      if (!operation && is_stopped()) {
        break;
      }
      if (!operation) {
        return fail(operation.error().what, outcome_of(operation.error().code));
      }
      if (!*operation) {
        break;
      }
      if (const auto report = engine.apply(std::move(**operation)); !report) {
        return fail(older.place() + report.error().what, outcome_of(report.error().code));
      }
      older_ = ++steps_;
      if (progress_ != nullptr) {
        progress_->update(steps_);
      }
    }
    return Outcome::done;
  }

  Outcome all_steps(engine::Engine& engine) {
    while (!is_stopped() && (!options_.until || steps_ - older_ < *options_.until)) {
      Result<std::optional<ops::Operation>> operation = script_.next();
      if (operation ? !*operation : is_stopped()) {
        break;  // at the end; what a stop cut off is no line of the script
      }
      const Outcome outcome = operation ? step(engine, std::move(**operation)) : refuse(operation.error());
      if (outcome != Outcome::done) {
        return outcome;
      }
    }
    return refused_;
  }

  Outcome step(engine::Engine& engine, ops::Operation operation) {
    const auto start = Clock::now();
    replay_log().trace("line {}: {}", script_.line(), ops::keyword(operation));
    if (auto* expected = std::get_if<ops::Expect>(&operation)) {
      leave_out_other_groups(*expected);
    }
    const Result<engine::StepReport> report = engine.apply(std::move(operation));
    if (!report) {
      return refuse({report.error().code, script_.place() + report.error().what});
    }
    if (options_.needs_barcode && may_end_barcode(*report)) {
      if (const Result<engine::Barcode> barcode = engine.barcode(); !barcode) {
        (void)engine.apply(ops::Undo{1}).value();
        return fail(script_.place() + barcode.error().what, Outcome::wrong_script);
      }
    }
    ++steps_;
    already_ += report->already;
    if (const Outcome logged = write_to_log(engine.log().back()); logged != Outcome::done) {
      return logged;
    }
    const bool is_due = options_.every > 0 && steps_ % options_.every == 0 &&
                        (!options_.report_at_most || reported_ < *options_.report_at_most);
    if (reporter_ != nullptr && (is_due || report->answer)) {
      ++reported_;
      const engine::Homology homology = engine.homology();
      const double microseconds = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
      clear_progress();
      reporter_->step(engine, {*report, homology, microseconds});
    }
    if (options_.verify) {
      if (const auto defect = engine.first_defect()) {
        return fail(script_.place() + "after step " + std::to_string(steps_) + " (" + std::string{report->op} +
                        ") a law does not hold: " + *defect,
                    Outcome::law_failed);
      }
    }
    if (progress_ != nullptr) {
      progress_->update(steps_);
    }
    return Outcome::done;
  }

  /// Only then it is worth to ask.
  static bool may_end_barcode(const engine::StepReport& report) {
    return report.kind == ops::StepKind::split || report.kind == ops::StepKind::product ||
           report.kind == ops::StepKind::lazy_cone;
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
    if (refused_ != Outcome::wrong_script) {
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
  std::string header_ring_;
  bool expects_betti_ = true, expects_torsion_ = true;  ///< whether those of the header's ring are those of this one
  bool is_noted_ = false;
  Outcome refused_ = Outcome::done;  ///< the worst of the steps that were refused and passed over
  std::uint64_t steps_ = 0;
  std::uint64_t older_ = 0;    ///< of these, from the log that is gone on from
  std::uint64_t already_ = 0;  ///< simplices of insertions that were there
  std::uint64_t reported_ = 0;
};

}  // namespace

Outcome replay(ScriptReader& script, const ReplayOptions& options, Reporter* reporter, std::ostream& errors,
               Progress* progress) {
  Run run(script, options, reporter, errors, progress);
  try {
    return run.run();
  } catch (const std::bad_alloc&) {
    return run.fail(script.place() + "out of memory; every step before this line has happened", Outcome::wrong_usage);
  }
}

}  // namespace sesame::replay
