/// \file
/// Where a replay's reports go: a table for people, JSON Lines for programs.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>

#include "engine/engine.hpp"
#include "replay/script/generators.hpp"

namespace sesame::replay {

/// One applied step, as reported.
struct ReportedStep {
  const engine::StepReport& step;
  const engine::Homology& homology;
  double microseconds;  ///< of the step and of its Betti numbers and torsion
};

/// A step that did not happen.
struct RefusedStep {
  std::uint64_t step;  ///< the number that it would have had
  std::uint64_t line;  ///< of the script, counted from 1
  std::string what;
};

/// The end of a replay.
struct Summary {
  std::uint64_t steps = 0;
  std::uint64_t already = 0;  ///< simplices of insertions that were there; see StepReport
  double seconds = 0;
  const GeneratorOptions* generators = nullptr;  ///< which are to be written; null: none
  bool interrupted = false;
  const std::atomic<bool>* stop = nullptr;  ///< set from outside: no more generators after the one at hand

  [[nodiscard]] bool is_stopped() const { return stop != nullptr && stop->load(); }
};

class Reporter {
 public:
  Reporter() = default;
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;
  virtual ~Reporter() = default;

  virtual void step(engine::Engine& engine, const ReportedStep& reported) = 0;
  /// Of a replay that keeps going; the error itself is told elsewhere too.
  virtual void refused(const RefusedStep& /*refused*/) {}
  virtual void summary(engine::Engine& engine, const Summary& summary) = 0;
};

/// One object a line, as the documentation of `sesame replay --json` says.
[[nodiscard]] std::unique_ptr<Reporter> json_reporter(std::ostream& out);
/// The same, with chains of cells of maps in simplices: see ops::in_analogue.
[[nodiscard]] std::unique_ptr<Reporter> json_reporter_in_simplices(std::ostream& out);

/// An aligned table; `colour` marks with ANSI colours what changed since the step reported before.
[[nodiscard]] std::unique_ptr<Reporter> table_reporter(std::ostream& out, bool colour);

}  // namespace sesame::replay
