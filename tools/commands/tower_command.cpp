#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "replay/barcode/barcode_files.hpp"
#include "replay/picture/barcode_drawing.hpp"
#include "replay/script/replay.hpp"
#include "replay/tower/group_sequence.hpp"
#include "replay/tower/tower_reader.hpp"
#include "replay/tower/tower_replay.hpp"
#include "replay/tower/tower_report.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/interrupt.hpp"
#include "tools/commands/options.hpp"
#include "tools/commands/output_file.hpp"

namespace sesame::tools {
namespace {

using engine::Bar;
using engine::Barcode;
using replay::Outcome;
using replay::TowerFormat;
using replay::TowerOperation;
using replay::TowerReader;
using replay::TowerResult;
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string file;
  TowerFormat format = TowerFormat::automatic;
  std::string ring;
  std::vector<std::string> rings;
  std::string pers, csv, svg, html;
  replay::BarSelection selection;
  std::optional<int> max_dimension;
  std::uint64_t until = 0, every = 0;
  std::size_t longest_line = replay::longest_line;
  std::optional<replay::GeneratorOptions> generators;
  bool json = false, add_faces = false, all_bars = false, partial = false, quiet = false;
};

int say(Outcome outcome, const std::string& what) {
  std::cerr << (outcome == Outcome::wrong_usage ? "sesame tower: " : "") << what << '\n';
  return static_cast<int>(outcome);
}

int wrong_usage(const std::string& what) { return say(Outcome::wrong_usage, what); }

Result<engine::Time> length_of(const std::string& text) {
  constexpr const char* what = "a length, from 0 on";
  Result<engine::Time> length = replay::TimeReader().read(text, what, "--min-length", 0);
  return !length || *length >= 0 ? length : Error{Errc::bad_input, replay::shown(text) + " should be " + what};
}

/// Streams to what is wanted; null for what is not.
struct Outputs {
  std::ostream *pers = nullptr, *csv = nullptr, *svg = nullptr, *html = nullptr;

  [[nodiscard]] bool need_barcode() const { return csv != nullptr || svg != nullptr || html != nullptr; }
};

/// Where the bars over one ring go.
class BarSink {
 public:
  /// Bars above the last of `dimensions` go nowhere.
  BarSink(const replay::BarSelection& selection, engine::Dimensions dimensions, bool keeps_bars,
          replay::PersWriter* pers)
      : dimensions_{dimensions}, pers_{pers} {
    result_.selection = selection;
    if (keeps_bars) {
      result_.barcode.emplace();
    }
  }

  void add(const Bar& bar) {
    if (!dimensions_.have(static_cast<std::size_t>(bar.dimension))) {
      return;
    }
    if (result_.barcode) {
      result_.barcode->bars.push_back(bar);
    }
    if (result_.selection.is_too_short(bar)) {
      ++result_.shorter;
      return;
    }
    if (result_.selection.is_left_out_as_open(bar)) {
      ++result_.open;
      return;
    }
    result_.statistics.add(bar);
    if (pers_ != nullptr) {
      pers_->add(bar);
    }
  }

  /// The result, once all bars have been added.
  TowerResult finish(replay::Provenance provenance, std::uint64_t hidden) {
    result_.provenance = std::move(provenance);
    result_.hidden = hidden;
    if (result_.barcode) {
      result_.barcode->hidden = hidden;
      std::ranges::sort(result_.barcode->bars);
    }
    return std::move(result_);
  }

 private:
  engine::Dimensions dimensions_;
  replay::PersWriter* pers_;
  TowerResult result_;
};

/// One run of the command.
class Run {
 public:
  explicit Run(const Arguments& arguments) : arguments_{arguments}, files_{{arguments.file}} {}

  int run() {
    if (std::string problem = read_rings(); !problem.empty()) {
      return wrong_usage(problem);
    }
    catch_interrupt();
    Result<std::unique_ptr<TowerReader>> reader =
        TowerReader::open(arguments_.file, arguments_.format, &stop_requested(), arguments_.longest_line);
    if (!reader && stop_requested().load()) {
      return static_cast<int>(Outcome::interrupted);
    }
    if (!reader) {
      const bool is_io = reader.error().code == Errc::io;
      return say(is_io ? Outcome::wrong_usage : Outcome::wrong_script, reader.error().what);
    }
    reader_ = std::move(*reader);
    source_ = reader_->name();
    if (std::string problem = objection(); !problem.empty()) {
      return wrong_usage(problem);
    }
    if (std::string problem = open_outputs(); !problem.empty()) {
      return wrong_usage(problem);
    }
    if (!arguments_.quiet && isatty(STDERR_FILENO) == 1) {
      progress_.emplace(std::cerr, std::nullopt);
    }
    say_format();
    start_ = Clock::now();
    const Outcome outcome = reader_->format() == TowerFormat::script ? run_script()
                            : is_integral()                          ? run_groups()
                                                                     : run_barcode();
    if (is_reported(outcome)) {
      if (const Status written = files_.commit(); !written) {
        return wrong_usage(written.error().what);
      }
    }
    return static_cast<int>(outcome);
  }

 private:
  [[nodiscard]] bool is_integral() const { return std::holds_alternative<sparse::Integers>(rings_[0]); }
  [[nodiscard]] bool is_matrix() const {
    return reader_->format() == TowerFormat::phat || reader_->format() == TowerFormat::phat_binary;
  }

  /// Those that are asked for.
  [[nodiscard]] engine::Dimensions dimensions() const {
    return arguments_.max_dimension ? engine::Dimensions{static_cast<std::size_t>(*arguments_.max_dimension)}
                                    : engine::all_dimensions;
  }

  /// Whether the table and the states of `--every` are printed: not into an output that standard output has become.
  [[nodiscard]] bool prints() const { return !arguments_.json && !arguments_.quiet && !fills_standard_output(); }
  [[nodiscard]] bool fills_standard_output() const {
    const auto paths = {arguments_.pers, arguments_.csv, arguments_.svg, arguments_.html};
    return std::ranges::any_of(paths, is_standard_output);
  }

  /// What was found out from numbers alone is said; words and braces speak for themselves, and so does JSON.
  void say_format() {
    const TowerFormat format = reader_->format();
    faces_.adds_faces = arguments_.add_faces || format == TowerFormat::facets;
    const bool is_obvious = format == TowerFormat::tower || format == TowerFormat::script;
    if (arguments_.format == TowerFormat::automatic && !is_obvious && !arguments_.json && !arguments_.quiet) {
      std::cerr << source_ << ": read as " << replay::format_description(format) << '\n';
    }
  }

  [[nodiscard]] replay::Provenance provenance(const sparse::AnyRing& ring, std::uint64_t operations) const {
    return {sparse::ring_name(ring),
            operations,
            source_,
            std::string{replay::format_name(reader_->format())},
            faces_.added,
            faces_.already,
            arguments_.max_dimension};
  }

  std::string read_rings() {
    std::vector<std::string> names = arguments_.rings;
    if (names.empty()) {
      names.push_back(arguments_.ring.empty() ? "Z/2" : arguments_.ring);
    }
    for (const std::string& name : names) {
      const Result<sparse::AnyRing> ring = sparse::parse_ring(name);
      if (!ring) {
        return ring.error().what;
      }
      if (std::ranges::find(rings_, *ring) != rings_.end()) {
        return "--rings names " + name + " twice";
      }
      rings_.push_back(*ring);
    }
    const auto is_z = [](const sparse::AnyRing& ring) { return std::holds_alternative<sparse::Integers>(ring); };
    return rings_.size() > 1 && std::ranges::any_of(rings_, is_z)
               ? "a barcode is taken over a field: --rings takes Z/p and Q; --ring Z alone gives the sequence of groups"
               : "";
  }

  /// What cannot be done with this input, or nothing.
  [[nodiscard]] std::string objection() const {
    const TowerFormat format = reader_->format();
    const bool is_z2 = std::ranges::all_of(rings_, [](const auto& r) { return std::holds_alternative<sparse::Z2>(r); });
    const bool has_files =
        !arguments_.pers.empty() || !arguments_.csv.empty() || !arguments_.svg.empty() || !arguments_.html.empty();
    if (is_matrix() && !is_z2) {
      return "a boundary matrix of PHAT has no signs, so only Z/2 is possible";
    }
    if (arguments_.add_faces && (is_matrix() || format == TowerFormat::script)) {
      return "--add-faces is for simplices that are listed by their vertices; in a script `insert` adds faces by "
             "itself";
    }
    if (arguments_.json && fills_standard_output()) {
      return "--json writes to standard output, and so would the output that is called -";
    }
    if (rings_.size() > 1 && (has_files || arguments_.generators)) {
      return "--pers, --csv, --svg, --html and --generators take one ring; run them with --ring";
    }
    if (is_integral() && (has_files || arguments_.generators || arguments_.every > 0)) {
      return "over Z there are no barcodes but a sequence of groups; --pers, --csv, --svg, --html, --generators and "
             "--every need a field";
    }
    if (format == TowerFormat::script && (rings_.size() > 1 || arguments_.generators || arguments_.every > 0)) {
      return "--rings, --generators and --every are for towers; sesame replay has the generators of a script";
    }
    return "";
  }

  std::string open_outputs() {
    for (const auto& [path, stream] :
         {std::pair{&arguments_.pers, &outputs_.pers}, std::pair{&arguments_.csv, &outputs_.csv},
          std::pair{&arguments_.svg, &outputs_.svg}, std::pair{&arguments_.html, &outputs_.html}}) {
      const Result<std::ostream*> opened = files_.open(*path);
      if (!opened) {
        return opened.error().what;
      }
      *stream = *opened;
    }
    return "";
  }

  // ---- the loop

  /// Reads to the end, until --until, Ctrl-C or an error; apply(operation) -> Status, after(operation).
  template <class Apply, class After>
  Outcome read_all(Apply&& apply, After&& after) {
    TowerOperation operation;
    while (!stop_requested().load() && (arguments_.until == 0 || operations_ < arguments_.until)) {
      const Result<bool> got = reader_->next(operation);
      if (!got) {
        return fail(got.error());
      }
      if (!*got) {
        break;
      }
      const Status status = apply(operation);
      if (!status) {
        const bool lacks_face = status.error().code == Errc::unknown_name;
        return fail({Errc::bad_input, reader_->place() + status.error().what +
                                          (lacks_face ? ", or let --add-faces add them at that time" : "")});
      }
      ++operations_;
      after(operation);
      if (progress_ && operations_ % 1024 == 0) {
        progress_->update(operations_);
      }
    }
    progress_.reset();
    return stop_requested().load() ? Outcome::interrupted : Outcome::done;
  }

  Outcome fail(const Error& error) {
    progress_.reset();
    std::cerr << error.what << '\n';
    return error.code == Errc::io ? Outcome::wrong_usage : Outcome::wrong_script;
  }

  /// Whether there is something to report after the loop.
  [[nodiscard]] bool is_reported(Outcome outcome) const {
    return outcome == Outcome::done || outcome == Outcome::interrupted || arguments_.partial;
  }

  // ---- barcodes

  Outcome run_barcode() {
    const bool keeps_bars = arguments_.json || rings_.size() > 1 || outputs_.need_barcode();
    std::optional<replay::PersWriter> pers;
    if (outputs_.pers != nullptr) {
      pers.emplace(*outputs_.pers, sparse::ring_name(rings_[0]), source_);
    }
    std::vector<BarSink> sinks;
    std::vector<std::unique_ptr<engine::BarcodeTracker>> trackers;
    std::vector<engine::BarcodeTracker*> told;
    engine::CycleTracker* cycles = nullptr;
    const engine::Slots slots = is_matrix() ? engine::Slots::shared : engine::Slots::by_dimension;
    sinks.reserve(rings_.size());
    for (const sparse::AnyRing& ring : rings_) {
      sinks.emplace_back(arguments_.selection, dimensions(), keeps_bars, pers ? &*pers : nullptr);
      const auto add = [sink = &sinks.back()](const Bar& bar) { sink->add(bar); };
      if (arguments_.generators) {
        auto tracker = engine::make_cycle_tracker(ring, add, dimensions());
        cycles = tracker.get();
        trackers.push_back(std::move(tracker));
      } else {
        trackers.push_back(engine::make_barcode_tracker(ring, add, slots, dimensions()));
      }
      told.push_back(trackers.back().get());
    }
    replay::TowerHistory history;
    replay::TowerReplay tower(told, cycles != nullptr ? &history : nullptr);
    const Outcome outcome = read_all([&](const TowerOperation& operation) { return faces_.apply(tower, operation); },
                                     [&](const TowerOperation& operation) {
                                       has_contractions_ |= operation.kind == TowerOperation::Kind::contract;
                                       report_state(operation, tower, told);
                                     });
    top_dimension_ = static_cast<int>(tower.cells().size()) - 1;
    if (!is_reported(outcome)) {
      return outcome;
    }
    std::vector<TowerResult> results;
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      trackers[r]->for_each_open_bar([&](const Bar& bar) { sinks[r].add(bar); });
      results.push_back(sinks[r].finish(provenance(rings_[r], operations_), trackers[r]->hidden()));
    }
    if (pers) {
      pers->finish(operations_, results[0].hidden);
    }
    std::optional<replay::CycleReport> report;
    if (cycles != nullptr) {
      // What was interrupted once writes its cycles, since a second interrupt ends it at once.
      const std::atomic<bool>* stop = outcome == Outcome::interrupted ? nullptr : &stop_requested();
      report.emplace(*cycles, history, tower.operations(), arguments_.selection, *arguments_.generators, stop);
    }
    write(results, report ? &*report : nullptr);
    return outcome == Outcome::done && stop_requested().load() ? Outcome::interrupted : outcome;
  }

  /// With --every: cells and Betti numbers now and then.
  void report_state(const TowerOperation& operation, const replay::TowerReplay& tower,
                    std::span<engine::BarcodeTracker* const> trackers) const {
    if (arguments_.every == 0 || operations_ % arguments_.every != 0 || !(prints() || arguments_.json)) {
      return;
    }
    for (const engine::BarcodeTracker* tracker : trackers) {
      if (arguments_.json) {
        std::cout << fmt::format(R"({{"ops":{},"time":{},"ring":"{}","cells":[{}],"betti":[{}]}})", operations_,
                                 replay::json_number_text(operation.time), sparse::ring_name(tracker->ring()),
                                 fmt::join(tower.cells(), ","), fmt::join(tracker->betti(), ","))
                  << '\n';
      } else {
        std::cout << fmt::format("{:>10}  {:<24}  Betti numbers over {}: {}\n", operations_,
                                 fmt::format("{} cells", fmt::join(tower.cells(), " ")),
                                 sparse::ring_name(tracker->ring()), fmt::join(tracker->betti(), " "));
      }
    }
    std::cout << std::flush;  // somebody may be waiting at the end of a pipe
  }

  [[nodiscard]] replay::DrawingOptions drawing() const {
    const TowerFormat format = reader_->format();
    replay::DrawingOptions options{"", "time", arguments_.selection};
    options.walls = arguments_.all_bars ? replay::Walls::whole : replay::Walls::thin;
    // Facets and scripts are of objects that somebody means as they are.
    const bool may_be_cut_off = !has_contractions_ && !arguments_.max_dimension && format != TowerFormat::facets &&
                                format != TowerFormat::script;
    if (may_be_cut_off) {
      options.top_dimension = top_dimension_;
    }
    if (format == TowerFormat::gudhi) {
      options.time_name = "filtration value";
    } else if (is_matrix()) {
      options.time_name = "column";
    } else if (format == TowerFormat::script) {
      options.time_name = "step";
    } else if (format == TowerFormat::facets) {
      options.time_name = "facet";
    }
    return options;
  }

  void write(std::span<const TowerResult> results, const replay::CycleReport* cycles) {
    if (outputs_.csv != nullptr) {
      replay::write_betti_csv(*outputs_.csv, *results[0].barcode);
    }
    if (outputs_.svg != nullptr) {
      replay::write_svg(*outputs_.svg, *results[0].barcode, results[0].provenance, drawing());
    }
    if (outputs_.html != nullptr) {
      replay::write_html(*outputs_.html, *results[0].barcode, results[0].provenance, drawing());
    }
    if (arguments_.json) {
      replay::write_tower_json(std::cout, results, cycles, start_);
      return;
    }
    if (!prints()) {
      return;
    }
    for (const TowerResult& result : results) {
      replay::write_tower_table(std::cout, result);
    }
    if (results.size() > 1) {
      replay::write_differences(std::cout, results);
    }
    if (cycles != nullptr) {
      cycles->write_table(std::cout);
    }
  }

  // ---- groups over Z

  Outcome run_groups() {
    replay::GroupSequence groups(prints() ? &std::cout : nullptr, dimensions());
    replay::EngineTower tower(rings_[0]);
    std::uint64_t operations = 0;
    const Outcome outcome = read_all([&](const TowerOperation& operation) { return faces_.apply(tower, operation); },
                                     [&](const TowerOperation& operation) {
                                       ++operations;
                                       groups.add(operation.time, tower.engine().homology(), rings_[0]);
                                     });
    if (is_reported(outcome)) {
      write_groups(groups, operations);
    }
    return outcome;
  }

  void write_groups(replay::GroupSequence& groups, std::uint64_t operations) const {
    groups.finish();
    if (arguments_.json) {
      replay::TextBuffer text(std::cout);
      text.add(R"({"ring":"Z","ops":)").add_integer(operations).add(R"(,"groups":)");
      groups.add_json(text);
      replay::add_reading_fields(text, provenance(rings_[0], operations));
      const std::chrono::duration<double> seconds = Clock::now() - start_;
      text.add(R"(,"seconds":)").add_number(seconds.count()).add("}\n");
    }
  }

  // ---- scripts

  /// Takes the barcode, or the groups, from the engine of a replay.
  class ScriptListener final : public replay::Reporter {
   public:
    explicit ScriptListener(replay::GroupSequence* groups) : groups_{groups} {}
    void step(engine::Engine& engine, const replay::ReportedStep& reported) override {
      steps = reported.step.step;
      if (groups_ != nullptr) {
        groups_->add(steps, reported.homology, engine.ring());
      }
    }
    void summary(engine::Engine& engine, const replay::Summary& summary) override {
      steps = summary.steps;
      if (groups_ == nullptr) {
        barcode = engine.barcode().value();  // since the replay needs one
      }
    }

    std::uint64_t steps = 0;
    Barcode barcode;

   private:
    replay::GroupSequence* groups_;
  };

  Outcome run_script() {
    replay::GroupSequence groups(prints() ? &std::cout : nullptr, dimensions());
    ScriptListener listener(is_integral() ? &groups : nullptr);
    replay::ReplayOptions options;
    options.ring = rings_[0];
    options.every = is_integral() ? 1 : 0;
    options.stop = &stop_requested();
    options.needs_barcode = !is_integral();
    options.partial = arguments_.partial;
    if (arguments_.until > 0) {
      options.until = arguments_.until;
    }
    replay::ScriptReader script = reader_->take_script();
    const Outcome outcome = replay::replay(script, options, &listener, std::cerr, progress_ ? &*progress_ : nullptr);
    progress_.reset();
    if (!is_reported(outcome)) {
      return outcome;
    }
    if (is_integral()) {
      write_groups(groups, listener.steps);
    } else {
      write_script(listener.steps, listener.barcode);
    }
    return outcome;
  }

  void write_script(std::uint64_t steps, const Barcode& barcode) {
    std::optional<replay::PersWriter> pers;
    if (outputs_.pers != nullptr) {
      pers.emplace(*outputs_.pers, sparse::ring_name(rings_[0]), source_);
    }
    BarSink sink(arguments_.selection, dimensions(), true, pers ? &*pers : nullptr);
    std::ranges::for_each(barcode.bars, [&](const Bar& bar) { sink.add(bar); });
    const TowerResult result = sink.finish(provenance(rings_[0], steps), barcode.hidden);
    if (pers) {
      pers->finish(steps, result.hidden);
    }
    write({&result, 1}, nullptr);
  }

  const Arguments& arguments_;
  std::vector<sparse::AnyRing> rings_;
  std::unique_ptr<TowerReader> reader_;
  replay::FaceAdder faces_;
  std::string source_;  ///< what outputs and messages call the input
  OutputFiles files_;
  Outputs outputs_;
  bool has_contractions_ = false;
  std::optional<int> top_dimension_;  ///< of the cells of a tower
  std::uint64_t operations_ = 0;      ///< of the input, that were carried out; added faces are none
  std::optional<replay::Progress> progress_;
  Clock::time_point start_;
};

}  // namespace

void add_tower_command(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("tower", "The barcode of a tower or a filtration, computed online");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("FILE", arguments->file, "The tower, gzip or not; - for standard input")->required();
  add_choice<TowerFormat>(*command, "--format", arguments->format,
                          {{"auto", TowerFormat::automatic},
                           {"tower", TowerFormat::tower},
                           {"phat", TowerFormat::phat},
                           {"phat-binary", TowerFormat::phat_binary},
                           {"gudhi", TowerFormat::gudhi},
                           {"facets", TowerFormat::facets},
                           {"script", TowerFormat::script}},
                          "What the file is; default: by content");
  CLI::Option* ring = command->add_option(
      "--ring", arguments->ring, "Coefficients Z/p (default Z/2) or Q; Z gives the sequence of groups instead");
  command->add_option("--rings", arguments->rings, "Several of them side by side, Z/2,Z/3,...: where do they differ?")
      ->delimiter(',')
      ->excludes(ring);
  command->add_flag("--json", arguments->json,
                    "One JSON object on standard output; with --every more of them before it");
  command->add_option("--pers", arguments->pers,
                      "Write the bars, a line `dim birth death` for each as it ends; - for standard output, instead of "
                      "the table");
  command->add_option("--csv", arguments->csv, "Write the Betti numbers, a row for each time at which they change");
  command->add_option("--svg", arguments->svg, "Draw barcode, persistence diagram and Betti curves");
  command->add_option("--html", arguments->html, "A page with the drawings and the longest bars");
  command->add_flag("--all-bars", arguments->all_bars,
                    "Draw each bar by itself, also where many of a dimension have one length");
  add_generator_options(*command, arguments->generators,
                        "For each bar the cycle that is born, and the chain that it comes to bound; =1 or =0-2,4: of "
                        "these dimensions only");
  command->add_flag("--add-faces", arguments->add_faces,
                    "Add the faces that a simplex lacks, at its time; those that are there already are counted");
  command
      ->add_option_function<std::string>(
          "--min-length",
          [arguments](const std::string& text) { arguments->selection.min_length = length_of(text).value(); },
          "Leave out bars that are shorter (not from --csv and Betti curves)")
      ->check([](const std::string& text) {
        const Result<engine::Time> length = length_of(text);
        return length ? std::string{} : length.error().what;
      })
      ->option_text("LENGTH");
  command->add_flag("--no-open", arguments->selection.leaves_out_open,
                    "Leave out bars that never end (not from --csv and Betti curves)");
  command->add_option("--max-dim", arguments->max_dimension, "Nothing above dimension D: bars, Betti numbers, groups")
      ->check(from_zero_on())
      ->option_text("D");
  command->add_option("--until", arguments->until, "Stop after that many operations")->check(from_one_on());
  command->add_option("--every", arguments->every, "Report cells and Betti numbers every N operations")
      ->check(from_one_on());
  command->add_option("--max-line", arguments->longest_line, "Refuse lines of more bytes")
      ->capture_default_str()
      ->check(from_one_on());
  command->add_flag("--partial", arguments->partial, "After an error, report what there was before it");
  command->add_flag("--quiet", arguments->quiet, "No table and no progress: errors only (and what --json prints)");
  command->footer(
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 the input is wrong, 3 an expect of a script failed,\n"
      "4 internal error,\n"
      "130 interrupted by Ctrl-C (what was read until then is reported).");
  command->callback([arguments, &status] { status = Run(*arguments).run(); });
}

}  // namespace sesame::tools
