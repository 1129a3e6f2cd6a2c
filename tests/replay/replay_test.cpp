#include "replay/script/replay.hpp"

#include "engine/homology_tracker.hpp"
#include "tests/replay/replay_support.hpp"
#include "tests/support/inputs.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::tests;
using Catch::Contains;
using Catch::Matchers::StartsWith;
using replay::Outcome;

namespace {

/// Keeps what was reported.
class Recorder : public replay::Reporter {
 public:
  void step(engine::Engine& engine, const replay::ReportedStep& reported) override {
    steps.push_back(reported.step.step);
    cells.assign(engine.cells().begin(), engine.cells().end());
    if (steps.size() == stop_after) {
      stop.store(true);
    }
  }
  void summary(engine::Engine& engine, const replay::Summary& summary) override {
    ++summaries;
    last = summary;
    cells.assign(engine.cells().begin(), engine.cells().end());
    betti = engine.homology().betti;
    ring = sparse::ring_name(engine.ring());
  }

  std::vector<std::uint64_t> steps;
  std::vector<std::uint32_t> cells;
  std::vector<std::int64_t> betti;
  std::string ring;
  int summaries = 0;
  replay::Summary last;
  std::size_t stop_after = 0;
  std::atomic<bool> stop{false};
};

using Steps = std::vector<std::uint64_t>;

/// Ten points and, as steps 4 and 9, a question.
std::string points_and_questions() {
  std::vector<std::string> lines{header_line};
  for (int k = 1; k <= 12; ++k) {
    lines.push_back(k == 4 || k == 9 ? R"({"op":"class","chain":[[1,"n1"]]})"
                                     : R"({"op":"simplex","name":"n)" + std::to_string(k) + R"(","dim":0})");
  }
  return joined(lines);
}

Steps reported_steps(const replay::ReplayOptions& options) {
  Recorder recorder;
  CHECK(replay_text(points_and_questions(), &recorder, options).outcome == Outcome::done);
  CHECK(recorder.summaries == 1);
  return recorder.steps;
}

const std::string triangle = R"({"op":"simplex","name":"t","dim":2})";
const std::string glue = R"({"op":"identify","pairs":[["t.0","t.1"]]})";

}  // namespace

TEST_CASE("steps are reported as often as asked, answers to class always", "[replay]") {
  replay::ReplayOptions options;
  CHECK(reported_steps(options) == Steps{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  options.every = 5;
  CHECK(reported_steps(options) == Steps{4, 5, 9, 10});
  options.every = 0;
  CHECK(reported_steps(options) == Steps{4, 9});
  options.every = 1;
  options.report_at_most = 2;
  CHECK(reported_steps(options) == Steps{1, 2, 4, 9});
  options.report_at_most = 0;
  CHECK(reported_steps(options) == Steps{4, 9});
}

TEST_CASE("a replay stops after as many steps as asked", "[replay]") {
  for (const std::uint64_t until : {0U, 1U, 5U, 12U, 100U}) {
    CAPTURE(until);
    replay::ReplayOptions options;
    options.until = until;
    Recorder recorder;
    const Replayed replayed = replay_text(points_and_questions(), &recorder, options);
    CHECK(replayed.outcome == Outcome::done);
    CHECK(recorder.last.steps == std::min<std::uint64_t>(until, 12));
    CHECK(lines_of(replayed.log).size() == 1 + recorder.last.steps);
    CHECK_FALSE(recorder.last.interrupted);
  }
  replay::ReplayOptions options;
  options.until = 1;
  CHECK(replay_text(joined({header_line, triangle, "not read any more"}), nullptr, options).outcome == Outcome::done);
}

TEST_CASE("the ring of the options goes before that of the header, in the log as well", "[replay]") {
  const std::string text = joined({R"({"sesame":1,"ring":"Z/3"})", triangle});
  Recorder recorder;
  CHECK(replay_text(text, &recorder).outcome == Outcome::done);
  CHECK(recorder.ring == "Z/3");
  const auto ring = sparse::parse_ring("Z/7");
  REQUIRE(ring);
  replay::ReplayOptions options;
  options.ring = *ring;
  const Replayed replayed = replay_text(text, &recorder, options);
  CHECK(recorder.ring == "Z/7");
  CHECK_THAT(lines_of(replayed.log).at(0), Contains(R"("ring":"Z/7")"));
}

TEST_CASE("a wrong header is a wrong script, of which nothing is reported or logged", "[replay]") {
  for (const std::string wrong : {R"({"sesame":1,"ring":"Z/6"})", R"({"sesame":2})", "[]", "{"}) {
    CAPTURE(wrong);
    Recorder recorder;
    const Replayed replayed = replay_text(joined({"# comment", wrong, triangle}), &recorder);
    CHECK(replayed.outcome == Outcome::wrong_script);
    CHECK(replayed.errors.starts_with("script:2: "));
    CHECK(lines_of(replayed.errors).size() == 1);
    CHECK(replayed.log.empty());
    CHECK(recorder.summaries == 0);
  }
}

TEST_CASE("of a refused step nothing happens and all before it did", "[replay]") {
  const std::vector<std::string> refused{
      "not JSON",
      R"({"op":"simplexx"})",
      R"({"op":"simplex","name":"t","dim":1})",
      R"({"op":"identify","pairs":[["t.1","t.2"],["t","t.0"]]})",
      R"({"op":"identify","pairs":[["t.1","t.2"],["t.1","nobody"]]})",
      R"({"op":"complex","name":"K","cells":[{"id":"a"},{"id":"e","faces":["a","b"]}]})",
      R"({"op":"cone","apex":"t"})",
      R"({"op":"class","chain":[[1,"nobody"]]})",
      R"({"op":"undo","steps":3})"};
  Recorder before;
  const Replayed good = replay_text(joined({header_line, triangle, glue}), &before);
  CHECK(good.outcome == Outcome::done);
  for (const std::string& line : refused) {
    CAPTURE(line);
    Recorder recorder;
    const Replayed replayed = replay_text(joined({header_line, triangle, "", glue, line, triangle}), &recorder);
    CHECK(replayed.outcome == Outcome::wrong_script);
    CHECK(replayed.errors.starts_with("script:5: "));
    CHECK(lines_of(replayed.errors).size() == 1);
    CHECK(recorder.steps == Steps{1, 2});
    CHECK(recorder.cells == before.cells);
    CHECK(replayed.log == good.log);
  }
}

TEST_CASE("with a limit on undo what goes back further is refused, with its place", "[replay]") {
  const std::string text =
      joined({header_line, R"({"op":"simplex","name":"a","dim":0})", R"({"op":"simplex","name":"b","dim":0})",
              R"({"op":"simplex","name":"c","dim":0})", R"({"op":"undo","steps":2})"});
  replay::ReplayOptions options;
  options.undoable = 2;
  Recorder recorder;
  CHECK(replay_text(text, &recorder, options).outcome == Outcome::done);
  CHECK(recorder.betti == std::vector<std::int64_t>{1});
  options.undoable = 1;
  const auto refused = replay_text(text, nullptr, options);
  CHECK(refused.outcome == Outcome::wrong_script);
  CHECK_THAT(refused.errors, Contains("cannot undo 2 steps: only 1 can be undone, as older ones are not kept"));
  CHECK_THAT(refused.errors, StartsWith("script:5: "));
}

TEST_CASE("a failed expectation ends the replay with both values", "[replay]") {
  Recorder recorder;
  const Replayed replayed =
      replay_text(joined({header_line, triangle, R"({"op":"expect","betti":[1],"euler":5})", glue}), &recorder);
  CHECK(replayed.outcome == Outcome::expectation_failed);
  CHECK(replayed.errors.starts_with("script:3: "));
  CHECK_THAT(replayed.errors, Contains("euler should be 5 but is 1"));
  CHECK_THAT(replayed.errors, !Contains("betti"));
  CHECK(lines_of(replayed.log).size() == 2);
  CHECK(recorder.steps == Steps{1});
}

TEST_CASE("the replay is interrupted after the current step", "[replay]") {
  for (const std::size_t stop_after : {1U, 4U, 12U}) {
    CAPTURE(stop_after);
    Recorder recorder;
    recorder.stop_after = stop_after;
    replay::ReplayOptions options;
    options.stop = &recorder.stop;
    const Replayed replayed = replay_text(points_and_questions(), &recorder, options);
    CHECK(replayed.outcome == Outcome::interrupted);
    CHECK(replayed.errors.empty());
    CHECK(recorder.summaries == 1);
    CHECK(recorder.last.interrupted);
    CHECK(recorder.last.steps == stop_after);
    CHECK(lines_of(replayed.log).size() == 1 + stop_after);
  }
}

TEST_CASE("an interrupt while a followed script waits leaves the unfinished line out", "[replay]") {
  /// Sets the stop when there is nothing more to read.
  class Stopper final : public replay::ByteInput {
   public:
    Stopper(std::string text, std::atomic<bool>& stop) : text_{std::move(text)}, stop_{stop} {}
    Result<std::size_t> read(std::span<char> to) override {
      stop_.store(text_.empty());
      return std::exchange(text_, {}).copy(to.data(), to.size());
    }
    [[nodiscard]] bool is_stopped() const override { return stop_.load(); }

   private:
    std::string text_;
    std::atomic<bool>& stop_;
  };
  std::atomic<bool> stop{false};
  auto input = std::make_unique<Stopper>(joined({header_line, triangle}) + R"({"op":)", stop);
  replay::ScriptReader script(replay::ByteSource::from(std::move(input), "script").value());
  replay::ReplayOptions options;
  options.stop = &stop;
  Recorder recorder;
  std::ostringstream errors;
  CHECK(replay::replay(script, options, &recorder, errors, nullptr) == Outcome::interrupted);
  CHECK(errors.str().empty());
  CHECK(recorder.last.steps == 1);
}

TEST_CASE("verification passes for what is right, and ends the replay where a law is broken", "[replay]") {
  /// Takes the structure, behind the engine's back, to before the gluing; its equivalence knows nothing of it.
  class Saboteur final : public Recorder {
   public:
    void step(engine::Engine& engine, const replay::ReportedStep& reported) override {
      Recorder::step(engine, reported);
      auto& structure = const_cast<ops::Structure&>(engine.structure());
      if (reported.step.op == "identify") {
        structure.truncate(before_);
      }
      before_ = structure.journal().end();
    }

   private:
    ops::Journal::Position before_ = 0;
  };
  const std::string text = joined({header_line, triangle, "# now", glue, triangle});
  replay::ReplayOptions options;
  options.verify = true;
  CHECK(replay_text(joined({header_line, triangle, glue}), nullptr, options).outcome == Outcome::done);
  Saboteur saboteur;
  const Replayed replayed = replay_text(text, &saboteur, options);
  CHECK(replayed.outcome == Outcome::law_failed);
  CHECK(replayed.errors.starts_with("script:4: after step 2 (identify) a law does not hold: "));
  CHECK(saboteur.summaries == 0);
}

TEST_CASE("the log is the same script in canonical text, and replays to the same state", "[replay]") {
  const std::vector<std::string> operations{triangle,
                                            R"({"op":"simploid","name":"q","type":[1,1]})",
                                            glue,
                                            R"({"op":"note","text":"é"})",
                                            R"({"op":"class","chain":[[1,"t.0-1"]]})",
                                            R"({"op":"cone","apex":"v","over":["t.2"]})",
                                            R"({"op":"undo","steps":2})",
                                            R"({"op":"expect","euler":1})"};
  std::vector<std::string> spaced{"\xEF\xBB\xBF# comment\r", " { \"ring\":\"Z\", \"sesame\":1 } \r", ""};
  for (const std::string& line : operations) {
    spaced.push_back("  " + line + " \r");
    spaced.emplace_back("# comment");
  }
  Recorder first;
  const Replayed once = replay_text(joined(spaced), &first);
  CHECK(once.errors.empty());
  REQUIRE(once.outcome == Outcome::done);
  const auto logged = lines_of(once.log);
  CHECK(std::vector<std::string>(logged.begin() + 1, logged.end()) == operations);

  Recorder second;
  const Replayed twice = replay_text(once.log, &second);
  CHECK(twice.outcome == Outcome::done);
  CHECK(twice.log == once.log);
  CHECK(second.steps == first.steps);
  CHECK(second.cells == first.cells);
  CHECK(second.betti == first.betti);
}

TEST_CASE("the log of every kind of example replays to the same log", "[replay]") {
  for (const std::string name : {"undo", "klein_bottle", "sphere_by_cones", "class_queries", "two_bodies"}) {
    CAPTURE(name);
    Recorder first;
    Recorder second;
    const Replayed once = replay_text(example(name), &first);
    const Replayed twice = replay_text(once.log, &second);
    CHECK(once.outcome == Outcome::done);
    CHECK(twice.log == once.log);
    CHECK(second.cells == first.cells);
    CHECK(second.betti == first.betti);
    CHECK(second.last.steps == first.last.steps);
  }
}

TEST_CASE("a replay needs neither reporter nor progress", "[replay]") {
  replay::ScriptReader script(replay::ByteSource::of_text(points_and_questions(), "script"));
  std::ostringstream errors;
  CHECK(replay::replay(script, {}, nullptr, errors, nullptr) == Outcome::done);
  CHECK(errors.str().empty());
}

TEST_CASE("an error wipes the progress first", "[replay]") {
  std::ostringstream terminal;
  replay::ScriptReader script(replay::ByteSource::of_text(joined({header_line, "nonsense"}), "script"));
  replay::Progress progress(terminal, 1);
  while (terminal.str().empty()) {
    progress.update(1);
  }
  CHECK(replay::replay(script, {}, nullptr, terminal, &progress) == Outcome::wrong_script);
  CHECK_THAT(terminal.str(), Contains("\r\033[Kscript:2: "));
}

namespace {

/// Takes the steps and the barcode of the summary.
class SummaryReporter final : public replay::Reporter {
 public:
  void step(engine::Engine&, const replay::ReportedStep&) override {}
  void summary(engine::Engine& engine, const replay::Summary& summary) override {
    steps = summary.steps;
    barcode = engine.barcode();
  }
  std::uint64_t steps = 0;
  std::optional<Result<engine::Barcode>> barcode;
};

const std::string two_points =
    "{\"sesame\":1}\n{\"op\":\"insert\",\"simplex\":[0]}\n{\"op\":\"insert\",\"simplex\":[1]}\n";

}  // namespace

TEST_CASE("what was before an error is summarised when that is asked for", "[replay]") {
  replay::ReplayOptions options;
  options.ring = sparse::AnyRing{sparse::Z2{}};
  const std::string script = two_points + "{\"op\":\"insert\",\"simplex\":[1]}\n";
  SummaryReporter silent, told;
  CHECK(replay_text(script, &silent, options).outcome == replay::Outcome::wrong_script);
  CHECK(!silent.barcode);
  options.partial = true;
  CHECK(replay_text(script, &told, options).outcome == replay::Outcome::wrong_script);
  CHECK(told.steps == 2);
  CHECK(told.barcode.value().value().bars.size() == 2);
}

TEST_CASE("when a barcode is needed, a step that is no map forwards is refused with its place", "[replay]") {
  replay::ReplayOptions options;
  options.ring = sparse::AnyRing{sparse::Z2{}};
  options.needs_barcode = replay::NeededBarcode::of_tower;
  options.partial = true;
  SummaryReporter reporter;
  const Replayed replayed = replay_text(two_points + R"({"op":"product","name":"P","left":"{0}","right":"{1}"})"
                                                     "\n"
                                                     R"({"op":"undo"})"
                                                     "\n",
                                        &reporter, options);
  CHECK(replayed.outcome == replay::Outcome::wrong_script);
  CHECK(replayed.errors == "script:4: there is no barcode: step 3 is a product, which consumes the bodies before it\n");
  CHECK(reporter.steps == 2);
  CHECK(reporter.barcode.value().value().bars.size() == 2);
}

TEST_CASE("groups that are expected over the ring of the header are not checked over another one", "[replay]") {
  const std::string script = two_points + R"({"op":"expect","betti":[5],"torsion":[[2]],"cells":[2],"euler":2})"
                                          "\n"
                                          R"({"op":"expect","betti":[5]})"
                                          "\n";
  std::ostringstream notes;
  replay::ReplayOptions options;
  options.notes = &notes;
  CHECK(replay_text(script, nullptr, options).outcome == Outcome::expectation_failed);
  options.ring = sparse::AnyRing{sparse::Integers{}};
  CHECK(replay_text(script, nullptr, options).outcome == Outcome::expectation_failed);
  CHECK(notes.str().empty());
  options.ring = sparse::AnyRing{sparse::Z2{}};
  CHECK(replay_text(script, nullptr, options).outcome == Outcome::done);
  CHECK(notes.str() ==
        "script:4: note: this script expects groups over its own ring, Z; over another one they are not checked\n");
  for (const std::string wrong : {R"("cells":[3])", R"("euler":3)"}) {
    CHECK(replay_text(two_points + R"({"op":"expect",)" + wrong + "}\n", nullptr, options).outcome ==
          Outcome::expectation_failed);
  }
}

TEST_CASE("what is not checked over another ring is not in the log either, so that it can be replayed", "[replay]") {
  replay::ReplayOptions options;
  options.ring = sparse::AnyRing{sparse::Z2{}};
  const Replayed once = replay_text(two_points + R"({"op":"expect","betti":[5]})"
                                                 "\n",
                                    nullptr, options);
  CHECK(once.outcome == Outcome::done);
  const Replayed again = replay_text(once.log);
  CHECK(again.outcome == Outcome::done);
  CHECK(again.log == once.log);
}

namespace {

/// Notes the steps that were refused.
class Refusals final : public Recorder {
 public:
  void refused(const replay::RefusedStep& step) override {
    seen.push_back(std::to_string(step.step) + " line " + std::to_string(step.line) + ": " + step.what);
  }
  std::vector<std::string> seen;
};

}  // namespace

TEST_CASE("a replay that keeps going reports what is refused, and nothing of it happens", "[replay]") {
  const std::vector<std::string> refused{"no JSON", R"({"op":"insert","simplex":[1]})", R"({"op":"dance"})",
                                         R"({"op":"undo","steps":9})"};
  const std::string rest = R"({"op":"insert","simplex":[0,1]})"
                           "\n";
  replay::ReplayOptions options;
  options.keep_going = true;
  Refusals clean, recorder;
  const Replayed right = replay_text(two_points + rest, &clean, options);
  CHECK(right.outcome == Outcome::done);
  const Replayed kept = replay_text(two_points + joined(refused) + rest, &recorder, options);
  CHECK(kept.outcome == Outcome::wrong_script);
  CHECK(kept.log == right.log);
  CHECK(recorder.last.steps == 3);
  CHECK(recorder.betti == clean.betti);
  CHECK(clean.seen.empty());
  REQUIRE(recorder.seen.size() == refused.size());
  const std::vector<std::string> errors = lines_of(kept.errors);
  REQUIRE(errors.size() == refused.size());
  for (std::size_t k = 0; k < refused.size(); ++k) {
    const std::string number = std::to_string(4 + k);
    CHECK_THAT(recorder.seen[k], StartsWith("3 line " + number + ": "));
    CHECK(errors[k] == "script:" + number + recorder.seen[k].substr(recorder.seen[k].find(": ")));
  }
}

TEST_CASE("a failed expect is passed over too, and is what the outcome says when nothing worse happened", "[replay]") {
  const std::string wrong = R"({"op":"expect","betti":[5]})"
                            "\n",
                    right = R"({"op":"expect","betti":[2]})"
                            "\n";
  replay::ReplayOptions options;
  options.keep_going = true;
  CHECK(replay_text(two_points + wrong + right, nullptr, options).outcome == Outcome::expectation_failed);
  CHECK(replay_text(two_points + wrong + "nonsense\n" + wrong, nullptr, options).outcome == Outcome::wrong_script);
}

TEST_CASE("an input that breaks ends the replay without a summary, wherever it breaks, even one that keeps going",
          "[replay]") {
  const std::string text = points_and_questions();
  for (const bool keeps_going : {false, true}) {
    for (std::size_t broken_at = 1; broken_at <= text.size(); ++broken_at) {
      replay::ScriptReader script(source_of({text.substr(0, broken_at)}, End::failed, "script"));
      replay::ReplayOptions options;
      options.keep_going = keeps_going;
      Recorder recorder;
      std::ostringstream errors;
      CAPTURE(broken_at);
      CHECK(replay::replay(script, options, &recorder, errors, nullptr) == Outcome::wrong_usage);
      CHECK(errors.str() == "cannot read the input: it broke\n");
      CHECK(recorder.summaries == 0);
    }
  }
}

TEST_CASE("a replay that is stopped before its header is complete is interrupted", "[replay]") {
  std::atomic<bool> stop{true};
  replay::ReplayOptions options;
  options.stop = &stop;
  CHECK(replay_text("{\"sesa", nullptr, options).outcome == replay::Outcome::interrupted);
}
