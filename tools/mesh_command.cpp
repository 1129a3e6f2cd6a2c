#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "replay/groups.hpp"
#include "replay/replay.hpp"
#include "sesame/version.hpp"
#include "tools/commands.hpp"
#include "tools/mesh/mesh_homology.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {
namespace {

using Json = nlohmann::ordered_json;
using replay::Outcome;
using sparse::Integer;

struct Arguments {
  std::string mesh;
  std::string ring = "Z";
  Format format = Format::automatic;
  double weld = -1;
  std::int64_t generators_limit = -1;
  bool json = false;
};

constexpr std::int64_t generators_shown_by_default = 20;

int fail(const std::string& what, Outcome outcome) {
  std::cerr << what << '\n';
  return static_cast<int>(outcome);
}

// ------------------------------------------------------------------------------------------------------- for programs

/// Integers beyond 64 bits are written as strings of digits, as everywhere in sesame's JSON.
Json number(const Integer& n) {
  const auto word = n.to_int64();
  return word ? Json(*word) : Json(n.to_string());
}

Json chain(const engine::CellChain& chain, const ops::Structure& structure) {
  Json out = Json::array();
  for (const auto& [coefficient, cell] : chain.terms) {
    out.push_back(Json::array({number(coefficient), structure.name(cell)}));
  }
  return out;
}

Json validity_object(const Validity& validity, const std::vector<std::string>& more_remarks) {
  Json components = Json::array();
  for (const Component& component : validity.components) {
    const auto genus = component.genus();
    components.push_back({{"vertices", component.vertices},
                          {"edges", component.edges},
                          {"faces", component.faces},
                          {"euler", component.euler()},
                          {"boundary_edges", component.boundary_edges},
                          {"boundary_loops", component.boundary_loops},
                          {"manifold", component.is_manifold},
                          {"orientable", component.is_orientable},
                          {"closed", component.is_closed()},
                          {"genus", genus ? Json(*genus) : Json(nullptr)}});
  }
  Json remarks = validity.remarks;
  for (const std::string& remark : more_remarks) remarks.push_back(remark);
  return {{"points_in_file", validity.points_in_file},
          {"faces_in_file", validity.faces_in_file},
          {"vertices", validity.vertices},
          {"edges", validity.edges},
          {"faces", validity.faces},
          {"lines", validity.lines},
          {"manifold", validity.is_manifold()},
          {"closed", validity.is_closed()},
          {"orientable", validity.is_orientable()},
          {"consistently_oriented", validity.is_consistently_oriented()},
          {"boundary_edges", validity.boundary_edges},
          {"boundary_loops", validity.boundary_loops},
          {"non_manifold_edges", validity.non_manifold_edges},
          {"non_manifold_vertices", validity.non_manifold_vertices},
          {"degenerate_faces", validity.cleaning.degenerate_faces},
          {"duplicate_faces", validity.cleaning.duplicate_faces},
          {"unused_points", validity.cleaning.unused_points},
          {"components", std::move(components)},
          {"remarks", std::move(remarks)}};
}

Json generator_object(const MeshGenerator& generator, const ops::Structure& structure) {
  Json out{{"dim", generator.degree}, {"order", number(generator.order)}};
  if (generator.degree < 2) out["vertices"] = generator.vertices;
  if (generator.degree == 1) {
    out["length"] = generator.length;
    out["closed"] = !generator.vertices.empty();
    out["short"] = generator.is_short;
  }
  if (generator.degree == 2) {
    out["triangles"] = generator.triangles;
    out["area"] = generator.area;
    out["volume"] = generator.volume ? Json(*generator.volume) : Json(nullptr);
  }
  out["centre"] = generator.centre;
  out["box"] = generator.box;
  out["chain"] = chain(generator.chain, structure);
  if (generator.bounding) out["bounds"] = chain(*generator.bounding, structure);
  return out;
}

void print_json(const Arguments& arguments, const MeshHomology& found, double seconds) {
  engine::Engine& engine = *found.engine;
  Json torsion = Json::array();
  for (const auto& factors : found.homology.torsion) {
    Json& degree = torsion.emplace_back(Json::array());
    for (const Integer& factor : factors) degree.push_back(number(factor));
  }
  Json generators = Json::array();
  for (const MeshGenerator& generator : found.generators) {
    if (arguments.generators_limit >= 0 && generators.size() == static_cast<std::size_t>(arguments.generators_limit)) {
      break;
    }
    generators.push_back(generator_object(generator, engine.structure()));
  }
  const Json object{{"mesh", arguments.mesh},
                    {"ring", sparse::ring_name(engine.ring())},
                    {"version", SESAME_VERSION},
                    {"validity", validity_object(found.validity, found.remarks)},
                    {"cells", engine.cells()},
                    {"euler", engine.euler_characteristic()},
                    {"betti", found.homology.betti},
                    {"torsion", std::move(torsion)},
                    {"loops_tried", found.loops_tried},
                    {"generators", std::move(generators)},
                    {"seconds", seconds}};
  // The path of the mesh may be no UTF-8.
  std::cout << object.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
}

// --------------------------------------------------------------------------------------------------------- for people

std::string point_text(const Point& point) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", point[0], point[1], point[2]);
}

std::string place_text(const MeshGenerator& generator) {
  return fmt::format("centre {}, box {} to {}", point_text(generator.centre), point_text(generator.box[0]),
                     point_text(generator.box[1]));
}

/// One sentence for each group.
std::string meaning(const MeshHomology& found, std::size_t degree) {
  const std::int64_t betti = found.homology.betti[degree];
  const auto n = static_cast<std::size_t>(betti);
  if (degree == 0) return counted(n, "connected piece", "connected pieces");
  if (degree == 2) {
    return betti == 0 ? "no closed surface: nothing is enclosed"
                      : counted(n, "cavity: a closed surface that encloses space",
                                "cavities: closed surfaces that enclose space");
  }
  std::string text = betti == 0 ? "no tunnels: every loop, or a multiple of it, is filled in"
                                : counted(n, "tunnel: an independent loop that nothing fills in",
                                          "tunnels: independent loops that nothing fills in");
  if (found.homology.torsion[1].empty() && betti == 0) text = "no tunnels: every loop is filled in";
  const Validity& validity = found.validity;
  if (betti > 0 && validity.is_manifold() && validity.is_closed() && validity.is_orientable()) {
    text += fmt::format("; {}, and each has a loop around it and one along it", counted(n / 2, "handle", "handles"));
  }
  if (!found.homology.torsion[1].empty()) text += "; torsion: loops that are filled in only when run several times";
  return text;
}

void print_groups(const MeshHomology& found) {
  const std::vector<std::string> groups = replay::group_names(found.homology, found.engine->ring());
  std::size_t width = 0;
  for (const std::string& group : groups) width = std::max(width, group.size());
  std::cout << "\nhomology over " << sparse::ring_name(found.engine->ring()) << '\n';
  for (std::size_t degree = 0; degree < groups.size(); ++degree) {
    std::cout << fmt::format("  H{} = {:<{}}  {}\n", degree, groups[degree], width, meaning(found, degree));
  }
}

void print_generator(const MeshGenerator& generator, std::size_t number, const ops::Structure& structure) {
  constexpr std::size_t most_terms = 12;
  if (generator.degree == 0) {
    std::cout << fmt::format("  {:>4}  vertex {}; {}\n", number, generator.vertices.front(), place_text(generator));
    return;
  }
  if (generator.degree == 2) {
    std::cout << fmt::format("  {:>4}  {}, area {:.6g}", number, counted(generator.triangles, "triangle", "triangles"),
                             generator.area);
    if (generator.volume) {
      std::cout << fmt::format(", volume {:.6g}{}", *generator.volume,
                               *generator.volume < 0 ? " (the faces point inwards)" : "");
    }
    std::cout << "; " << place_text(generator) << '\n';
    return;
  }
  std::cout << fmt::format("  {:>4}  length {:.6g}, {}{}; {}\n", number, generator.length,
                           counted(generator.chain.terms.size(), "edge", "edges"),
                           generator.order.is_zero() ? "" : ", of order " + generator.order.to_string(),
                           place_text(generator));
  if (generator.vertices.empty()) {
    std::cout << "        not one loop: " << replay::chain_text(generator.chain, structure, most_terms) << '\n';
  } else {
    std::cout << fmt::format("        vertices {}\n", fmt::join(generator.vertices, " "));
  }
}

void print_notes(const MeshHomology& found, bool is_welded) {
  const auto degree_one = [](const MeshGenerator& g) { return g.degree == 1; };
  const auto engine_own = [](const MeshGenerator& g) { return g.degree == 1 && !g.is_short; };
  const auto& all = found.generators;
  std::cout << fmt::format(
      "\nVertices are counted from 0{}.\n",
      is_welded ? ", welded: in the order in which points first occur in the file" : " in the file");
  if (std::none_of(all.begin(), all.end(), degree_one)) return;
  std::cout << fmt::format(
      "Generators are not unique: other loops around the same tunnels, or sums of them, do as well. These are short:\n"
      "the shortest of the {} loops along edges that were compared which together generate H1 - not proven to be the\n"
      "shortest of all.\n",
      found.loops_tried);
  if (const auto own = std::count_if(all.begin(), all.end(), engine_own); own > 0) {
    std::cout << fmt::format("{} of H1 {} no short loop: what is listed is any cycle of that class.\n",
                             counted(static_cast<std::size_t>(own), "generator", "generators"),
                             own == 1 ? "has" : "have");
  }
}

void print_text(const Arguments& arguments, const MeshHomology& found, bool is_welded, double seconds) {
  std::cout << arguments.mesh << '\n' << to_text(found.validity);
  for (const std::string& remark : found.remarks) std::cout << "remark                " << remark << '\n';
  print_groups(found);
  const auto limit = static_cast<std::size_t>(arguments.generators_limit < 0 ? generators_shown_by_default
                                                                             : arguments.generators_limit);
  const std::array<const char*, 3> titles{"one vertex per piece", "short loops, a basis of the tunnels",
                                          "closed surfaces"};
  for (int degree = 0; degree < 3; ++degree) {
    std::size_t number = 0;
    for (const MeshGenerator& generator : found.generators) {
      if (generator.degree != degree) continue;
      if (number == 0 && limit > 0) {
        std::cout << fmt::format("\ngenerators of H{}: {}\n", degree, titles[static_cast<std::size_t>(degree)]);
      }
      if (number++ < limit) print_generator(generator, number, found.engine->structure());
    }
    if (limit > 0 && number > limit) {
      std::cout << fmt::format("        and {} more; --generators-limit {} shows all\n", number - limit, number);
    }
  }
  if (limit > 0) print_notes(found, is_welded);
  std::cout << fmt::format("{:.2f} s\n", seconds);
}

// --------------------------------------------------------------------------------------------------------- the command

int run_mesh(const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const Result<sparse::AnyRing> ring = sparse::parse_ring(arguments.ring);
  if (!ring) return fail("sesame mesh: --ring: " + ring.error().what, Outcome::wrong_usage);
  ReadOptions reading{arguments.format, {}};
  if (arguments.weld >= 0) reading.weld = arguments.weld;
  const auto refused = [](const Error& error) {
    return fail(error.what, error.code == Errc::io ? Outcome::wrong_usage : Outcome::wrong_script);
  };
  const Result<Mesh> mesh = read_mesh(arguments.mesh, reading);
  if (!mesh) return refused(mesh.error());
  const auto found = mesh_homology(*mesh, {arguments.mesh, *ring, arguments.generators_limit != 0});
  if (!found) return refused(found.error());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (arguments.json) {
    print_json(arguments, *found, seconds);
  } else {
    const bool is_welded = std::any_of(mesh->remarks.begin(), mesh->remarks.end(), [](const std::string& remark) {
      return remark.find("weld") != std::string::npos;
    });
    print_text(arguments, *found, is_welded, seconds);
  }
  std::cout << std::flush;
  return std::cout ? 0 : fail("sesame mesh: cannot write to standard output", Outcome::wrong_usage);
}

}  // namespace

void add_mesh_command(CLI::App& app, int& status) {
  CLI::App* command =
      app.add_subcommand("mesh", "Where are the tunnels? Validity, homology and short generators of a mesh");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("MESH", arguments->mesh, "The mesh file (OFF, OBJ, PLY, STL)")->required();
  command->add_flag("--json", arguments->json, "One JSON object on standard output");
  command->add_option("--ring", arguments->ring, "Compute over Z or Z/p")->capture_default_str();
  command->add_option("--format", arguments->format, "The mesh format; default: by extension, else by content")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Format>{{"auto", Format::automatic},
                                                                        {"off", Format::off},
                                                                        {"obj", Format::obj},
                                                                        {"ply", Format::ply},
                                                                        {"stl", Format::stl}}));
  command
      ->add_option("--weld", arguments->weld,
                   "Make one of points within this distance (STL: equal points are always welded)")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--generators-limit", arguments->generators_limit,
                   "How many generators to list: of each group (default 20), or in all with --json (default: all); 0 "
                   "saves looking for them")
      ->check(CLI::NonNegativeNumber);
  command->footer(
      "Chains in the JSON name cells as `sesame import` does, so that `class` and other steps can be appended there.\n"
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 the mesh is wrong.");
  command->callback([arguments, &status] { status = run_mesh(*arguments); });
}

}  // namespace sesame::tools
