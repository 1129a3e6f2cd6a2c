#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <variant>

#include "replay/script/replay.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/filtrations.hpp"
#include "tools/bench/towers.hpp"
#include "tools/bench/zigzags.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/options.hpp"
#include "tools/commands/output_file.hpp"

namespace sesame::tools {
namespace {

using replay::Outcome;

struct Arguments {
  std::string name;
  std::string out = "-";
  std::string format;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> size;
};

/// A workload: what `--size` means for it, and how to make one.
struct FiltrationWorkload {
  std::uint64_t size, smallest, largest;
  std::function<Filtration(std::uint32_t size, std::uint64_t seed)> make;
};
struct TowerWorkload {
  TowerOptions options;  ///< the size is the number of operations
};
struct ZigzagWorkload {
  std::uint64_t size, smallest, largest;
  std::function<void(std::ostream& out, std::uint64_t size, std::uint64_t seed)> write;
};
struct ScriptWorkload {
  std::uint64_t size, smallest, largest;
  std::function<Operations(std::uint32_t size)> make;  ///< over Z
};
using Workload = std::variant<FiltrationWorkload, TowerWorkload, ZigzagWorkload, ScriptWorkload>;

const std::map<std::string, Workload>& workloads() {
  const auto torus = [](std::uint32_t n, std::uint64_t) { return torus_filtration(n); };
  const auto rips = [](std::uint32_t n, std::uint64_t seed) { return rips_filtration(n, std::size_t{2000} * n, seed); };
  const auto random = [](std::uint32_t n, std::uint64_t seed) { return cubical_filtration(n, 0, seed); };
  const auto smooth = [](std::uint32_t n, std::uint64_t seed) { return cubical_filtration(n, 4, seed); };
  const auto triangles = [](std::uint32_t n, std::uint64_t seed) { return random_two_complex(n, 100'000, seed); };
  const auto network = [](std::ostream& out, std::uint64_t operations, std::uint64_t seed) {
    write_temporal_network(out, operations, 500, 1000, seed);
  };
  const auto oscillating_rips = [](std::ostream& out, std::uint64_t points, std::uint64_t seed) {
    write_oscillating_rips(out, static_cast<std::uint32_t>(points), 1.6, 2, seed);
  };
  const auto sponge = [](std::uint32_t level) { return menger_sponge(static_cast<int>(level)); };
  const auto sponge_of_maps = [](std::uint32_t level) { return menger_sponge_of_maps(static_cast<int>(level)); };
  const auto simplified = [](std::uint32_t level) { return simplified_menger_sponge(static_cast<int>(level)); };
  static const std::map<std::string, Workload> all{
      {"torus", FiltrationWorkload{700, 3, 5000, torus}},
      {"torus-300", FiltrationWorkload{300, 3, 5000, torus}},
      {"rips", FiltrationWorkload{700, 1, 5000, rips}},
      {"cubical", FiltrationWorkload{80, 1, 300, random}},
      {"cubical-smooth", FiltrationWorkload{80, 1, 300, smooth}},
      {"random-2-complex", FiltrationWorkload{140, 1, 500, triangles}},
      {"tower-A", TowerWorkload{{20'000, 100, 2, 0.1, true, 0}}},
      {"tower-B", TowerWorkload{{20'000, 1000, 3, 0.05, true, 0}}},
      {"tower-C", TowerWorkload{{20'000, 300, 3, 0.05, false, 0}}},
      {"tower-D", TowerWorkload{{200'000, 300, 3, 0.05, true, 0}}},
      {"tower-stream", TowerWorkload{{10'000'000, 900, 3, 0.05, true, 0}}},
      {"zigzag-growing", TowerWorkload{{200'000, 5'000, 3, 0, true, 0, 0.3, 0}}},
      {"zigzag-oscillating", TowerWorkload{{200'000, 300, 3, 0, true, 0, 0.25, 10'000}}},
      {"zigzag-stream", TowerWorkload{{10'000'000, 4'000, 3, 0, true, 0, 0.25, 7'500}}},
      {"temporal-network", ZigzagWorkload{300'000, 1, UINT64_MAX, network}},
      {"torus-of-polygons", ScriptWorkload{700, 1, 5'000, torus_of_polygons}},
      {"menger-of-cubes", ScriptWorkload{3, 1, 4, sponge}},
      {"menger-of-maps", ScriptWorkload{3, 1, 4, sponge_of_maps}},
      {"menger-simplified", ScriptWorkload{2, 1, 3, simplified}},
      {"oscillating-rips", ZigzagWorkload{1'000, 1, 65'535, oscillating_rips}},
  };
  return all;
}

int wrong_usage(const std::string& what) {
  std::cerr << "sesame generate: " << what << '\n';
  return static_cast<int>(Outcome::wrong_usage);
}

std::string names() {
  std::string text;
  for (const auto& [name, workload] : workloads()) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

/// What is wrong with the size for this workload, or an empty string.
template <class Kind>
std::string objection_to_size(const Arguments& arguments, const Kind& workload) {
  if (arguments.size.value_or(workload.size) < workload.smallest || arguments.size > workload.largest) {
    return "--size of " + arguments.name + " goes from " + std::to_string(workload.smallest) + " to " +
           std::to_string(workload.largest);
  }
  return {};
}

/// What is wrong with the arguments for this workload, or an empty string.
std::string objection(const Arguments& arguments, const FiltrationWorkload& workload) {
  if (std::string objected = objection_to_size(arguments, workload); !objected.empty()) {
    return objected;
  }
  if (arguments.format == "script") {
    return "the format script is that of constructions: use phat-binary, phat, gudhi or tower";
  }
  const bool is_cubical = arguments.name.starts_with("cubical");
  if (is_cubical && (arguments.format == "gudhi" || arguments.format == "tower")) {
    return "the format " + arguments.format + " lists simplices, and cubes are none: use phat-binary or phat";
  }
  return {};
}

std::string objection(const Arguments& arguments, const TowerWorkload&) {
  return arguments.format.empty() || arguments.format == "tower" ? "" : "a tower has the format tower only";
}

std::string objection(const Arguments& arguments, const ZigzagWorkload& workload) {
  const bool is_tower = arguments.format.empty() || arguments.format == "tower";
  return is_tower ? objection_to_size(arguments, workload) : "a zigzag has the format of towers only";
}

std::string objection(const Arguments& arguments, const ScriptWorkload& workload) {
  const bool is_script = arguments.format.empty() || arguments.format == "script";
  return is_script ? objection_to_size(arguments, workload) : "a construction has the format script only";
}

void write(std::ostream& out, const Arguments& arguments, const ScriptWorkload& workload) {
  const auto size = static_cast<std::uint32_t>(arguments.size.value_or(workload.size));
  out << ops::to_text(ops::Header{1, "Z", arguments.name + ", size " + std::to_string(size)}) << '\n';
  for (const ops::Operation& operation : workload.make(size)) {
    out << ops::to_text(operation) << '\n';
  }
}

void write(std::ostream& out, const Arguments& arguments, const ZigzagWorkload& workload) {
  workload.write(out, arguments.size.value_or(workload.size), arguments.seed);
}

void write(std::ostream& out, const Arguments& arguments, const FiltrationWorkload& workload) {
  const auto size = static_cast<std::uint32_t>(arguments.size.value_or(workload.size));
  const Filtration filtration = workload.make(size, arguments.seed);
  if (arguments.format == "phat") {
    return write_phat(out, filtration);
  }
  if (arguments.format == "gudhi") {
    return write_gudhi(out, filtration);
  }
  if (arguments.format == "tower") {
    return write_tower(out, filtration);
  }
  write_phat_binary(out, filtration);
}

void write(std::ostream& out, const Arguments& arguments, const TowerWorkload& workload) {
  TowerOptions options = workload.options;
  options.operations = arguments.size.value_or(options.operations);
  options.seed = arguments.seed;
  write_random_tower(out, options);
}

int run_generate(const Arguments& arguments) {
  const auto found = workloads().find(arguments.name);
  if (found == workloads().end()) {
    return wrong_usage("there is no \"" + arguments.name + "\"; there are " + names());
  }
  const std::string objected = std::visit([&](const auto& kind) { return objection(arguments, kind); }, found->second);
  if (!objected.empty()) {
    return wrong_usage(objected);
  }
  OutputFiles outputs({});
  const Result<std::ostream*> out = outputs.open(arguments.out);
  if (!out) {
    return wrong_usage(out.error().what);
  }
  std::visit([&](const auto& kind) { write(**out, arguments, kind); }, found->second);
  const Status written = outputs.commit();
  return written ? 0 : wrong_usage(written.error().what);
}

}  // namespace

void add_generate_command(CLI::App& app, int& status) {
  CLI::App* command =
      app.add_subcommand("generate", "Make a filtration, a random tower, a zigzag or a construction to measure with");
  auto arguments = std::make_shared<Arguments>();
  const std::vector<std::string> formats{"phat-binary", "phat", "gudhi", "tower", "script"};
  command->add_option("NAME", arguments->name, "One of " + names())->required();
  command->add_option("-o,--output", arguments->out, "The file; - for standard output")->capture_default_str();
  command
      ->add_option("--format", arguments->format,
                   "Default: phat-binary, a boundary matrix, for a filtration, tower for a tower, and script for "
                   "a construction, one step a line")
      ->check(one_of(formats))
      ->type_name(alternatives(formats));
  command->add_option("--seed", arguments->seed, "What the random choices depend on")
      ->check(from_zero_on())
      ->capture_default_str();
  command
      ->add_option(
          "--size", arguments->size,
          "Vertices a side of torus and grid, points, vertices of the complete graph, operations of a tower, zigzag or "
          "network, squares a side of a torus of polygons, level of a sponge")
      ->check(from_one_on());
  command->footer(
      "The same name, size and seed give the same bytes on every machine.\n"
      "Exit status: 0 done, 1 wrong usage or a file that cannot be written.");
  command->callback([arguments, &status] { status = run_generate(*arguments); });
}

}  // namespace sesame::tools
