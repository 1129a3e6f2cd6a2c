#include <chrono>
#include <iostream>
#include <memory>
#include <optional>

#include "replay/script/replay.hpp"
#include "sparse/ring.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/mesh_input.hpp"
#include "tools/commands/mesh_report.hpp"
#include "tools/commands/options.hpp"

namespace sesame::tools {
namespace {

using replay::Outcome;

struct Arguments {
  MeshInput mesh;
  std::string ring = "Z";
  std::optional<std::size_t> generators_limit;
  bool json = false;
};

int fail(const std::string& what, Outcome outcome) {
  std::cerr << what << '\n';
  return static_cast<int>(outcome);
}

int run_mesh(const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const Result<sparse::AnyRing> ring = sparse::parse_ring(arguments.ring);
  if (!ring) {
    return fail("sesame mesh: --ring: " + ring.error().what, Outcome::wrong_usage);
  }
  const Result<Mesh> mesh = read(arguments.mesh);
  if (!mesh) {
    return refuse(mesh.error());
  }
  const std::string name = name_of(arguments.mesh);
  const auto found = mesh_homology(*mesh, {name, *ring, arguments.generators_limit != std::size_t{0}});
  if (!found) {
    return refuse(found.error());
  }
  if (const std::string left_out = found->validity.left_out_faces(); !left_out.empty()) {
    std::cerr << name << ": " << left_out << '\n';
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  const auto write = arguments.json ? write_json : write_text;
  write(std::cout, *found, {name, arguments.generators_limit, took.count()});
  return 0;
}

}  // namespace

void add_mesh_command(CLI::App& app, int& status) {
  CLI::App* command =
      app.add_subcommand("mesh", "Where are the tunnels? Validity, homology and short generators of a mesh");
  auto arguments = std::make_shared<Arguments>();
  add_mesh_input(*command, arguments->mesh);
  command->add_flag("--json", arguments->json, "One JSON object on standard output");
  command->add_option("--ring", arguments->ring, "Compute over Z, Q or Z/p")->capture_default_str();
  command
      ->add_option("--generators-limit", arguments->generators_limit,
                   "How many generators to list: of each group (default 20), or in all with --json (default: all); 0 "
                   "saves looking for them")
      ->check(from_zero_on());
  command->footer(
      "Chains in the JSON name cells as `sesame import` does, so that `class` and other steps can be appended there.\n"
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 the mesh is wrong.");
  command->callback([arguments, &status] { status = run_mesh(*arguments); });
}

}  // namespace sesame::tools
