#include "tools/commands/tower_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <utility>

#include "replay/barcode/barcode_files.hpp"

namespace sesame::tools {

using replay::Outcome;
using replay::TowerFormat;
using replay::TowerReader;
using replay::TowerResult;

Outcome TowerRun::wrong_usage(const Error& error) const {
  std::cerr << "sesame " << arguments_.command << ": " << error.what << '\n';
  return Outcome::wrong_usage;
}

Outcome TowerRun::open() {
  if (const Status rings = read_rings(); !rings) {
    return wrong_usage(rings.error());
  }
  catch_interrupt();
  Result<std::unique_ptr<TowerReader>> reader =
      TowerReader::open(arguments_.file, arguments_.format, &stop_requested(), arguments_.longest_line);
  if (!reader && stop_requested().load()) {
    return Outcome::interrupted;
  }
  if (!reader) {
    return reader.error().code == Errc::io ? wrong_usage(reader.error()) : fail(reader.error());
  }
  reader_ = std::move(*reader);
  source_ = reader_->name();
  if (const Status legal = check_arguments(); !legal) {
    return wrong_usage(legal.error());
  }
  if (const Status read = read_points(); !read) {
    return read.error().code == Errc::bad_input ? fail(read.error()) : wrong_usage(read.error());
  }
  if (const Status opened = open_outputs(); !opened) {
    return wrong_usage(opened.error());
  }
  if (!arguments_.quiet && isatty(STDERR_FILENO) == 1) {
    progress_.emplace(std::cerr, std::nullopt);
  }
  say_format();
  start_ = Clock::now();
  return Outcome::done;
}

Outcome TowerRun::finish(Outcome outcome) {
  if (is_reported(outcome)) {
    if (const Status written = files_.commit(); !written) {
      return wrong_usage(written.error());
    }
  }
  return outcome;
}

// ------------------------------------------------------------------------------------------------- before the loop

Status TowerRun::read_rings() {
  std::vector<std::string> names = arguments_.rings;
  if (names.empty()) {
    names.push_back(arguments_.ring.empty() ? "Z/2" : arguments_.ring);
  }
  for (const std::string& name : names) {
    const Result<sparse::AnyRing> ring = sparse::parse_ring(name);
    if (!ring) {
      return ring.error();
    }
    if (std::ranges::find(rings_, *ring) != rings_.end()) {
      return Error{Errc::refused, "--rings names " + name + " twice"};
    }
    rings_.push_back(*ring);
  }
  const auto is_z = [](const sparse::AnyRing& ring) { return std::holds_alternative<sparse::Integers>(ring); };
  if (rings_.size() > 1 && std::ranges::any_of(rings_, is_z)) {
    return Error{Errc::refused,
                 "a barcode is taken over a field: --rings takes Z/p and Q; --ring Z alone gives the sequence of "
                 "groups"};
  }
  return Done{};
}

/// Errors: what cannot be done with this input.
Status TowerRun::check_arguments() const {
  const TowerFormat format = this->format();
  const bool is_z2 = std::ranges::all_of(rings_, [](const auto& r) { return std::holds_alternative<sparse::Z2>(r); });
  const bool has_files =
      !arguments_.pers.empty() || !arguments_.csv.empty() || !arguments_.svg.empty() || !arguments_.html.empty();
  if (arguments_.command == "zigzag" && is_integral()) {
    return Error{Errc::refused, "the barcode of a zigzag is one over a field: --ring takes Z/p and Q"};
  }
  if (is_matrix() && !is_z2) {
    return Error{Errc::refused, "a boundary matrix of PHAT has no signs, so only Z/2 is possible"};
  }
  if (arguments_.add_faces && (is_matrix() || format == TowerFormat::script)) {
    return Error{Errc::refused,
                 "--add-faces is for simplices that are listed by their vertices; in a script `insert` adds faces by "
                 "itself"};
  }
  if (!arguments_.points.empty() && arguments_.html.empty()) {
    return Error{Errc::refused, "--points is for the page that --html writes"};
  }
  if (!arguments_.points.empty() && (is_matrix() || format == TowerFormat::script)) {
    return Error{Errc::refused,
                 is_matrix() ? "--points is for vertices that have numbers of their own: towers, lists of simplices or "
                               "facets; the cells of a boundary matrix have none"
                             : "--points is for towers; a script says by \"at\" where its vertices are, and sesame "
                               "replay --html draws it"};
  }
  if (arguments_.json && fills_standard_output()) {
    return Error{Errc::refused, "--json writes to standard output, and so would the output that is called -"};
  }
  if (rings_.size() > 1 && (has_files || arguments_.generators)) {
    return Error{Errc::refused, "--pers, --csv, --svg, --html and --generators take one ring; run them with --ring"};
  }
  if (is_integral() && (has_files || arguments_.generators || arguments_.every > 0)) {
    return Error{
        Errc::refused,
        "over Z there are no barcodes but a sequence of groups; --pers, --csv, --svg, --html, --generators and "
        "--every need a field"};
  }
  if (format == TowerFormat::script && arguments_.command == "tower" && (rings_.size() > 1 || arguments_.generators)) {
    return Error{Errc::refused,
                 "--rings and --generators are for towers; sesame zigzag --generators has the cycles of the bars of a "
                 "script"};
  }
  return Done{};
}

Status TowerRun::read_points() {
  if (arguments_.points.empty()) {
    return Done{};
  }
  if (arguments_.points == "-" && arguments_.file == "-") {
    return Error{Errc::refused, "FILE and --points cannot both be standard input"};
  }
  Result<replay::ByteSource> source = replay::ByteSource::open(arguments_.points);
  if (!source) {
    return source.error();
  }
  Result<replay::PointList> points = replay::read_points(std::move(*source));
  if (!points) {
    return points.error();
  }
  points_ = std::move(*points);
  if (points_->coordinates > 3 && !arguments_.quiet) {
    std::cerr << points_->name << ": points of " << points_->coordinates
              << " coordinates; the page draws the first three\n";
  }
  return Done{};
}

Status TowerRun::open_outputs() {
  for (const auto& [path, stream] :
       {std::pair{&arguments_.pers, &outputs_.pers}, std::pair{&arguments_.csv, &outputs_.csv},
        std::pair{&arguments_.svg, &outputs_.svg}, std::pair{&arguments_.html, &outputs_.html}}) {
    const Result<std::ostream*> opened = files_.open(*path);
    if (!opened) {
      return opened.error();
    }
    *stream = *opened;
  }
  return Done{};
}

/// What was found out from numbers alone is said; words and braces speak for themselves, and so does JSON.
void TowerRun::say_format() {
  faces_.adds_faces = arguments_.add_faces || format() == TowerFormat::facets;
  const bool is_obvious = format() == TowerFormat::tower || format() == TowerFormat::script;
  if (arguments_.format == TowerFormat::automatic && !is_obvious && !arguments_.json && !arguments_.quiet) {
    std::cerr << source_ << ": read as " << replay::format_description(format()) << '\n';
  }
}

bool TowerRun::fills_standard_output() const {
  const auto paths = {arguments_.pers, arguments_.csv, arguments_.svg, arguments_.html};
  return std::ranges::any_of(paths, is_standard_output);
}

engine::Dimensions TowerRun::dimensions() const {
  return arguments_.max_dimension ? engine::Dimensions{static_cast<std::size_t>(*arguments_.max_dimension)}
                                  : engine::all_dimensions;
}

replay::Provenance TowerRun::provenance(const sparse::AnyRing& ring, std::uint64_t operations) const {
  return {sparse::ring_name(ring),
          operations,
          source_,
          std::string{replay::format_name(format())},
          faces_.added,
          faces_.already,
          arguments_.max_dimension};
}

std::optional<replay::PersWriter> TowerRun::pers_writer() const {
  if (outputs_.pers == nullptr) {
    return std::nullopt;
  }
  return std::optional<replay::PersWriter>{std::in_place, *outputs_.pers, sparse::ring_name(rings_[0]), source_};
}

/// Says why the loop ends early.
Outcome TowerRun::fail(const Error& error) {
  progress_.reset();
  std::cerr << error.what << '\n';
  return replay::outcome_of(error.code);
}

// -------------------------------------------------------------------------------------------------- after the loop

replay::DrawingOptions TowerRun::drawing(const Drawn& drawn) const {
  const TowerFormat format = this->format();
  replay::DrawingOptions options{"", "time", arguments_.selection};
  options.walls = arguments_.all_bars ? replay::Walls::whole : replay::Walls::thin;
  // Facets and scripts are of objects that somebody means as they are.
  const bool may_be_cut_off = !drawn.has_contractions && !arguments_.max_dimension && format != TowerFormat::facets &&
                              format != TowerFormat::script;
  if (may_be_cut_off) {
    options.top_dimension = drawn.top_dimension;
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

void TowerRun::write(std::span<const TowerResult> results, const replay::ClassReport* classes,
                     const Drawn& drawn) const {
  if (outputs_.csv != nullptr) {
    replay::write_betti_csv(*outputs_.csv, *results[0].barcode);
  }
  if (outputs_.svg != nullptr) {
    replay::write_svg(*outputs_.svg, *results[0].barcode, results[0].provenance, drawing(drawn));
  }
  if (outputs_.html != nullptr) {
    replay::write_tower_page(*outputs_.html, {*results[0].barcode, results[0].provenance, drawing(drawn), drawn.classes,
                                              drawn.note, points(), drawn.operations});
  }
  if (arguments_.json) {
    replay::write_tower_json(std::cout, results, classes, start_);
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
  if (classes != nullptr) {
    classes->write_table(std::cout);
  }
}

void TowerRun::write_state(std::uint64_t operations, engine::Time time, std::span<const std::uint64_t> cells,
                           const sparse::AnyRing& ring, std::span<const std::uint64_t> betti) const {
  if (arguments_.json) {
    std::cout << fmt::format(R"({{"ops":{},"time":{},"ring":"{}","cells":[{}],"betti":[{}]}})", operations,
                             replay::json_number_text(time), sparse::ring_name(ring), fmt::join(cells, ","),
                             fmt::join(betti, ","))
              << '\n';
  } else {
    std::cout << fmt::format("{:>10}  {:<24}  Betti numbers over {}: {}\n", operations,
                             fmt::format("{} cells", fmt::join(cells, " ")), sparse::ring_name(ring),
                             fmt::join(betti, " "));
  }
}

void TowerRun::write_groups(replay::GroupSequence& groups, std::uint64_t operations) const {
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

}  // namespace sesame::tools
