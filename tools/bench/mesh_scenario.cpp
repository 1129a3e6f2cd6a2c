#include "tools/bench/mesh_scenario.hpp"

#include <algorithm>
#include <sstream>

#include "replay/script/script.hpp"
#include "sparse/contract.hpp"
#include "tools/bench/surface_count.hpp"
#include "tools/mesh/script.hpp"
#include "tools/mesh/validity.hpp"

namespace sesame::tools {
namespace {

/// The homology of a mesh whose components are surfaces, by their classification; nothing for another one.
std::optional<Answer> answer_of(const Validity& validity) {
  Answer answer{{0, 0, 0}, {{}, {}}};
  for (const Component& component : validity.components) {
    if (!component.is_manifold) {
      return std::nullopt;
    }
    const std::int64_t top = component.is_closed() && component.is_orientable ? 1 : 0;
    answer.betti[0] += 1;
    answer.betti[1] += 1 + top - component.euler();
    answer.betti[2] += top;
    if (component.is_closed() && !component.is_orientable) {
      answer.torsion[1].push_back(2);
    }
  }
  return answer;
}

std::vector<ops::Operation> assembly_of(const std::string& path) {
  const Result<Mesh> mesh = read_mesh(path);
  sparse::expects(mesh.has_value(), "the file of a mesh stays as it was");
  std::stringstream text;
  const auto written = write_assembled_script(*mesh, text, {.source = path, .expect = false});
  sparse::expects(written.has_value(), "a mesh that was read can be assembled");
  std::vector<ops::Operation> operations;
  replay::ScriptReader script(replay::ByteSource::of_text(text.view(), path));
  sparse::expects(script.header().has_value(), "a script that was written has a header");
  while (true) {
    Result<std::optional<ops::Operation>> operation = script.next();
    sparse::expects(operation.has_value(), "a script that was written can be read");
    if (!*operation) {
      return operations;
    }
    operations.push_back(*std::move(*operation));
  }
}

}  // namespace

Result<Scenario> mesh_scenario(const std::string& path) {
  const Result<Mesh> mesh = read_mesh(path);
  if (!mesh) {
    return mesh.error();
  }
  const Validity validity = validate(*mesh);
  if (validity.vertices == 0) {
    return Error{Errc::bad_input, path + ": there are no points"};
  }
  const std::uint64_t size = std::max<std::uint64_t>(validity.faces, 1);
  return Scenario{.name = "mesh-" + name_of_source(path),
                  .family = "meshes",
                  .what = path + ", triangle by triangle",
                  .size_name = "faces",
                  .size = size,
                  .quick_size = size,
                  .input = Construction{[path](std::uint64_t) { return assembly_of(path); },
                                        [path](std::uint64_t) { return counted(assembly_of(path)); }},
                  .answer = [answer = answer_of(validity)](std::uint64_t) { return answer; }};
}

}  // namespace sesame::tools
