// Map files and meshes of solids: what is read comes to a script that the engine takes, with the cells that it expects.
#include <sstream>

#include "replay/script/script.hpp"
#include "tests/fuzz/engines.hpp"
#include "tools/mesh/map_file.hpp"
#include "tools/mesh/solids.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

constexpr std::size_t most_darts = 200;     ///< of a map that is built by the engine
constexpr std::size_t most_simplices = 24;  ///< and by simplices

/// Takes all steps of a script.
void build(const std::string& script) {
  replay::ScriptReader reader(replay::ByteSource::of_text(script, "script"));
  demand(went_well(reader.header()), "a script that is written has a header");
  Engine engine(sparse::parse_ring("Z/2").value());
  while (true) {
    const auto next = reader.next();
    if (!next) {
      violation("a script that is written is read: " + next.error().what + "\n" + script);
    }
    if (!*next) {
      return;
    }
    if (const auto report = engine.apply(**next); !report) {
      violation("a script that is written is taken: " + report.error().what + "\n" + script);
    }
  }
}

void read_map(std::string_view bytes, std::optional<int> dimension) {
  const Result<tools::MapFile> file = tools::parse_map_file(bytes, "map", dimension);
  if (!went_well(file)) {
    return;
  }
  const auto* nmap = std::get_if<ops::NMap>(&file->map);
  const std::size_t darts = nmap != nullptr ? 2 * nmap->size() : std::get<ops::GMap>(file->map).size();
  const int n = nmap != nullptr ? nmap->dimension() : std::get<ops::GMap>(file->map).dimension();
  demand(!dimension || n == *dimension, "a map has the dimension that was said");
  for (const bool as_simplices : {false, true}) {
    if (n > 4 || darts > (as_simplices ? most_simplices : most_darts)) {
      return;
    }
    std::ostringstream out;
    if (went_well(tools::write_script_of_map_file(*file, out, {"map", "Z/2", as_simplices}))) {
      build(out.str());
    }
  }
}

void read_solids(std::string_view bytes, tools::Format format) {
  const Result<tools::Solids> solids = tools::parse_solids(bytes, "solids", format);
  if (!went_well(solids)) {
    return;
  }
  for (const std::uint32_t corner : solids->faces.corners()) {
    demand(corner < solids->points.size(), "every corner is the number of a point");
  }
  const Result<ops::GMap> map = tools::map_of_solids(*solids, "solids");
  if (!went_well(map) || map->size() > most_darts) {
    return;
  }
  demand(map->dimension() == 3 && map->size() == 2 * solids->faces.corners().size(), "each corner has two darts");
  std::ostringstream out;
  if (went_well(tools::write_solid_script(*solids, out, {"solids", "Z/2"}))) {
    build(out.str());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = text_of(data, size);
  for (const std::optional<int> dimension : {std::optional<int>{}, {2}, {3}}) {
    read_map(bytes, dimension);
  }
  read_solids(bytes, tools::Format::medit);
  read_solids(bytes, tools::Format::vtk);
  return 0;
}
