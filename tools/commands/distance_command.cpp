#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "replay/barcode/barcode_files.hpp"
#include "replay/barcode/bars.hpp"
#include "replay/distance/diagram_distance.hpp"
#include "replay/script/replay.hpp"
#include "replay/text/text_buffer.hpp"
#include "sesame/version.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/options.hpp"

namespace sesame::tools {
namespace {

using engine::Bar;
using engine::Time;
using replay::DiagramDistance;
using replay::GroundMetric;
using replay::number_text;
using replay::Outcome;
using replay::PersFile;
using Json = nlohmann::ordered_json;

struct Arguments {
  std::string left, right;
  CLI::Option* wasserstein = nullptr;
  double q = 1;
  GroundMetric ground = GroundMetric::maximum;
  std::optional<int> dimension;
  bool json = false;
  bool matching = false;
};

/// The distance in one dimension, and of what.
struct Row {
  int dimension;
  std::vector<Bar> left, right;
  DiagramDistance distance;
};

struct Comparison {
  bool has_dimensions;
  std::vector<Row> rows;
  Time value = 0;  ///< of all dimensions together
};

int fail(const std::string& what, Outcome outcome) {
  std::cerr << what << '\n';
  return static_cast<int>(outcome);
}

Result<PersFile> read_file(const std::string& name, replay::TimeReader& times) {
  Result<replay::ByteSource> source = replay::ByteSource::open(name);
  if (!source) {
    return source.error();
  }
  return replay::read_pers(std::move(*source), times);
}

std::vector<Bar> bars_of(const PersFile& file, int dimension) {
  std::vector<Bar> bars;
  std::copy_if(file.barcode.bars.begin(), file.barcode.bars.end(), std::back_inserter(bars),
               [&](const Bar& bar) { return bar.dimension == dimension; });
  return bars;
}

int largest_dimension(const PersFile& file) {
  return file.barcode.bars.empty() ? -1 : file.barcode.bars.back().dimension;
}

/// The largest of two, or the q-th root of the sum of their q-th powers.
Time together(Time x, Time y, const Arguments& arguments) {
  const auto [less, more] = std::minmax(x, y);
  if (arguments.wasserstein->count() == 0 || less == 0 || more == engine::never) {
    return more;
  }
  const double ratio = less.nearest() / more.nearest();
  return arguments.q == 1 ? x.nearest() + y.nearest()
                          : more.nearest() * std::pow(1 + std::pow(ratio, arguments.q), 1 / arguments.q);
}

Comparison compare(const PersFile& left, const PersFile& right, const Arguments& arguments) {
  Comparison comparison{left.has_dimensions, {}};
  const int first = arguments.dimension.value_or(0);
  const int last = arguments.dimension.value_or(std::max(largest_dimension(left), largest_dimension(right)));
  for (int p = first; p <= last; ++p) {
    Row row{p, bars_of(left, p), bars_of(right, p), {}};
    if (row.left.empty() && row.right.empty() && !arguments.dimension) {
      continue;
    }
    row.distance = arguments.wasserstein->count() > 0
                       ? replay::wasserstein_distance(row.left, row.right, arguments.q, arguments.ground)
                       : replay::bottleneck_distance(row.left, row.right);
    comparison.value = together(comparison.value, row.distance.value, arguments);
    comparison.rows.push_back(std::move(row));
  }
  return comparison;
}

std::ptrdiff_t essential(const std::vector<Bar>& bars) {
  return std::count_if(bars.begin(), bars.end(), [](const Bar& bar) { return bar.death == engine::never; });
}

// ------------------------------------------------------------------------------------------------------- for programs

Json number(Time x) {
  if (x.is_large()) {
    return number_text(x);
  }
  return x == engine::never ? Json(nullptr) : Json(x.nearest());
}

Json matching_array(const Row& row) {
  const auto interval = [](const std::vector<Bar>& bars, const std::optional<std::size_t>& place) {
    return place ? Json::array({number(bars[*place].birth), number(bars[*place].death)}) : Json(nullptr);
  };
  Json out = Json::array();
  for (const replay::Match& match : row.distance.matching) {
    out.push_back({{"left", interval(row.left, match.left)},
                   {"right", interval(row.right, match.right)},
                   {"cost", number(match.cost)}});
  }
  return out;
}

void write_json(std::ostream& out, const Comparison& comparison, const Arguments& arguments) {
  const bool is_wasserstein = arguments.wasserstein->count() > 0;
  Json object{{"left", arguments.left},
              {"right", arguments.right},
              {"version", SESAME_VERSION},
              {"distance", is_wasserstein ? "wasserstein" : "bottleneck"}};
  if (is_wasserstein) {
    object["q"] = arguments.q;
  }
  object["internal_p"] = arguments.ground == GroundMetric::maximum ? Json("inf") : Json(2);
  Json rows = Json::array();
  for (const Row& row : comparison.rows) {
    Json& item = rows.emplace_back(Json{{"dim", comparison.has_dimensions ? Json(row.dimension) : Json(nullptr)},
                                        {"bars", {row.left.size(), row.right.size()}},
                                        {"essential", {essential(row.left), essential(row.right)}},
                                        {"value", number(row.distance.value)}});
    if (arguments.matching) {
      item["matching"] = matching_array(row);
    }
  }
  object["dims"] = std::move(rows);
  object["value"] = number(comparison.value);
  // The paths may be no UTF-8.
  out << object.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
}

// --------------------------------------------------------------------------------------------------------- for people

std::string partner_text(const std::vector<Bar>& bars, const std::optional<std::size_t>& place) {
  return place ? replay::interval_text(bars[*place]) : "diagonal";
}

std::string name_of(const Row& row, const Comparison& comparison) {
  return comparison.has_dimensions ? fmt::format("H{}", row.dimension) : "any";
}

void write_text(std::ostream& out, const Comparison& comparison, const Arguments& arguments) {
  const char* const metric = arguments.ground == GroundMetric::maximum ? "maximum" : "Euclidean";
  out << (arguments.wasserstein->count() > 0 ? fmt::format("{}-Wasserstein", number_text(arguments.q)) : "bottleneck")
      << " distance, " << metric << " metric: " << arguments.left << " against " << arguments.right << "\n\n";
  out << fmt::format("{:>4} {:>19} {:>19}  {}\n", "", "bars", "essential", "distance");
  for (const Row& row : comparison.rows) {
    out << fmt::format("{:>4} {:>19} {:>19}  {}\n", name_of(row, comparison),
                       fmt::format("{} and {}", row.left.size(), row.right.size()),
                       fmt::format("{} and {}", essential(row.left), essential(row.right)),
                       number_text(row.distance.value));
  }
  out << fmt::format("{:>4} {:>19} {:>19}  {}\n", "all", "", "", number_text(comparison.value));
  if (!arguments.matching) {
    return;
  }
  for (const Row& row : comparison.rows) {
    out << '\n' << name_of(row, comparison) << '\n';
    for (const replay::Match& match : row.distance.matching) {
      const bool is_impossible = match.cost == engine::never;
      out << fmt::format(
          "    {} - {}: {}\n", is_impossible && !match.left ? "nothing" : partner_text(row.left, match.left),
          is_impossible && !match.right ? "nothing" : partner_text(row.right, match.right), number_text(match.cost));
    }
  }
}

int run_distance(const Arguments& arguments) {
  if (arguments.wasserstein->count() == 0 && arguments.ground != GroundMetric::maximum) {
    return fail(
        "sesame distance: --internal-p 2 needs --wasserstein: the bottleneck distance is that of the maximum metric",
        Outcome::wrong_usage);
  }
  if (arguments.left == "-" && arguments.right == "-") {
    return fail("sesame distance: standard input can be one of the two barcodes, not both", Outcome::wrong_usage);
  }
  std::vector<PersFile> files;
  replay::TimeReader times;
  for (const std::string& name : {arguments.left, arguments.right}) {
    Result<PersFile> file = read_file(name, times);
    if (!file) {
      return fail(file.error().what, replay::outcome_of(file.error().code));
    }
    files.push_back(std::move(*file));
  }
  const auto has_bars = [](const PersFile& file) { return !file.barcode.bars.empty(); };
  if (has_bars(files[0]) && has_bars(files[1]) && files[0].has_dimensions != files[1].has_dimensions) {
    return fail(fmt::format("{}: the bars have no dimensions, those of {} have; give both or neither",
                            files[0].has_dimensions ? arguments.right : arguments.left,
                            files[0].has_dimensions ? arguments.left : arguments.right),
                Outcome::wrong_script);
  }
  files[0].has_dimensions = files[has_bars(files[0]) ? 0 : 1].has_dimensions;
  if (arguments.dimension && !files[0].has_dimensions) {
    return fail("sesame distance: --dim: the files say nothing of dimensions", Outcome::wrong_usage);
  }
  const auto write = arguments.json ? write_json : write_text;
  write(std::cout, compare(files[0], files[1], arguments), arguments);
  return 0;
}

/// Accepts finite numbers from 1 on.
CLI::Validator exponent() {
  return CLI::Validator(
      [](const std::string& text) {
        double q = 0;
        return CLI::detail::lexical_cast(text, q) && std::isfinite(q) && q >= 1
                   ? std::string{}
                   : "\"" + text + "\" should be a number from 1 on";
      },
      "");
}

}  // namespace

void add_distance_command(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("distance", "How far two barcodes are apart: bottleneck or Wasserstein");
  auto arguments = std::make_shared<Arguments>();
  command
      ->add_option(
          "A", arguments->left,
          "A barcode, gzip or not: lines [[field] dimension] birth death, or what sesame tower --json or Ripser "
          "prints; - for standard input")
      ->required();
  command->add_option("B", arguments->right, "Another one")->required();
  arguments->wasserstein =
      command
          ->add_option("--wasserstein", arguments->q,
                       "The Q-Wasserstein distance, the least (sum of cost^Q)^(1/Q), instead of the bottleneck "
                       "distance; Q >= 1, default 1")
          ->check(exponent())
          ->expected(0, 1)
          ->default_str("1");
  add_choice<GroundMetric>(
      *command, "--internal-p", arguments->ground, {{"inf", GroundMetric::maximum}, {"2", GroundMetric::euclidean}},
      "The metric of the plane for --wasserstein: inf (the larger of the two differences; default) or 2");
  command->add_option("--dim", arguments->dimension, "Compare only the bars of this dimension")
      ->check(CLI::Range(0, replay::largest_dimension_read));
  command->add_flag("--matching", arguments->matching, "Also the pairs of a best matching");
  command->add_flag("--json", arguments->json,
                    "One JSON object on standard output; null for an infinite distance, for the death of an essential "
                    "class, and for the diagonal");
  command->footer(
      "Essential bars are matched among themselves; different numbers of them are infinitely far apart.\n"
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 a file is wrong.");
  command->callback([arguments, &status] { status = run_distance(*arguments); });
}

}  // namespace sesame::tools
