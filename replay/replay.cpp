#include "replay/replay.hpp"

#include <chrono>

namespace sesame::replay {
namespace {

using Clock = std::chrono::steady_clock;

Outcome outcome_of(Errc code) {
  return code == Errc::expectation ? Outcome::expectation_failed : Outcome::wrong_script;
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
      return fail(header.error().what, Outcome::wrong_script);
    }
    const Result<sparse::AnyRing> ring = options_.ring ? *options_.ring : sparse::parse_ring(header->ring);
    if (!ring) {
      return fail(script_.place() + ring.error().what, Outcome::wrong_script);
    }
    is_ring_of_header_ = sparse::ring_name(*ring) == header->ring;
    engine::Engine engine(*ring, options_.limits);
    Outcome outcome = options_.older_steps != nullptr ? take_older_steps(engine) : begin_log(*header, *ring);
    if (outcome == Outcome::done) {
      outcome = all_steps(engine);
    }
    if (outcome == Outcome::done && is_stopped()) {
      outcome = Outcome::interrupted;
    }
    const bool is_summarised = outcome == Outcome::done || outcome == Outcome::interrupted ||
                               (options_.partial && outcome != Outcome::law_failed);
    if (!is_summarised) {
      return outcome;
    }
    if (progress_ != nullptr) {
      progress_->clear();
    }
    if (reporter_ != nullptr) {
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      reporter_->summary(engine, {steps_, seconds, options_.generators, outcome == Outcome::interrupted});
    }
    return outcome;
  }

 private:
  [[nodiscard]] bool is_stopped() const { return options_.stop != nullptr && options_.stop->load(); }

  Outcome begin_log(ops::Header header, const sparse::AnyRing& ring) {
    header.ring = sparse::ring_name(ring);
    return write_to_log(ops::to_text(header));
  }

  Outcome write_to_log(const std::string& line) {
    if (options_.log == nullptr) {
      return Outcome::done;
    }
    *options_.log << line << '\n' << std::flush;
    return *options_.log ? Outcome::done : Outcome::wrong_usage;
  }

  Outcome take_older_steps(engine::Engine& engine) {
    ScriptReader& older = *options_.older_steps;
    const Result<ops::Header> header = older.header();
    if (!header) {
      return fail(header.error().what, Outcome::wrong_script);
    }
    const std::string ring = sparse::ring_name(engine.ring());
    if (header->ring != ring) {
      return fail(older.place() + "this log is over " + header->ring + ", and what is to go on from it over " + ring +
                      "; --ring " + header->ring + " would take it over the same",
                  Outcome::wrong_script);
    }
    while (!is_stopped()) {
      Result<std::optional<ops::Operation>> operation = older.next();
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
      if (!operation && is_stopped()) {
        break;  // what was cut off is no line of the script
      }
      if (!operation) {
        return fail(operation.error().what, outcome_of(operation.error().code));
      }
      if (!*operation) {
        break;
      }
      if (const Outcome outcome = step(engine, std::move(**operation)); outcome != Outcome::done) {
        return outcome;
      }
    }
    return Outcome::done;
  }

  Outcome step(engine::Engine& engine, ops::Operation operation) {
    const auto start = Clock::now();
    if (auto* expected = std::get_if<ops::Expect>(&operation);
        expected != nullptr && !is_ring_of_header_ && !options_.checks_groups_over_other_rings) {
      expected->betti.reset();
      expected->torsion.reset();
    }
    const Result<engine::StepReport> report = engine.apply(std::move(operation));
    if (!report) {
      return fail(script_.place() + report.error().what, outcome_of(report.error().code));
    }
    if (options_.needs_barcode && may_end_barcode(*report)) {
      if (const Result<engine::Barcode> barcode = engine.barcode(); !barcode) {
        (void)engine.apply(ops::Undo{1}).value();
        return fail(script_.place() + barcode.error().what, Outcome::wrong_script);
      }
    }
    ++steps_;
    if (const Outcome logged = write_to_log(ops::to_text(engine.log().back())); logged != Outcome::done) {
      return logged;
    }
    const bool is_due = options_.every > 0 && steps_ % options_.every == 0 &&
                        (!options_.report_at_most || reported_ < *options_.report_at_most);
    if (reporter_ != nullptr && (is_due || report->answer)) {
      ++reported_;
      const engine::Homology homology = engine.homology();
      const double microseconds = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
      if (progress_ != nullptr) {
        progress_->clear();
      }
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
    return report.after.copies > report.before.copies || report.after.families > report.before.families;
  }

  Outcome fail(const std::string& what, Outcome outcome) {
    if (progress_ != nullptr) {
      progress_->clear();
    }
    errors_ << what << '\n';
    return outcome;
  }

  ScriptReader& script_;
  const ReplayOptions& options_;
  Reporter* reporter_;
  std::ostream& errors_;
  Progress* progress_;
  bool is_ring_of_header_ = true;
  std::uint64_t steps_ = 0;
  std::uint64_t older_ = 0;  ///< of these, from the log that is gone on from
  std::uint64_t reported_ = 0;
};

}  // namespace

Outcome replay(ScriptReader& script, const ReplayOptions& options, Reporter* reporter, std::ostream& errors,
               Progress* progress) {
  return Run(script, options, reporter, errors, progress).run();
}

}  // namespace sesame::replay
