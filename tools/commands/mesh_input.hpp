/// \file
/// The mesh that a subcommand takes: its file and how to read it, with one spelling for all subcommands.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

struct MeshInput {
  std::string file;  ///< "-": standard input
  Format format = Format::automatic;
  std::string weld;  ///< a distance, or empty
};

/// What messages, scripts and reports call the file.
[[nodiscard]] std::string name_of(const MeshInput& input);

/// Adds MESH, --format and --weld. `takes_facets`: it may be a list of facets, a map or a mesh of solids, too.
void add_mesh_input(CLI::App& command, MeshInput& input, bool takes_facets = false);

/// Reads it. Errors: those of read_mesh; io, which is wrong usage here, for a distance that is none.
[[nodiscard]] Result<Mesh> read(const MeshInput& input);

/// Writes an error to standard error. The exit status: 1 for what cannot be read or written, 2 for a wrong mesh.
int refuse(const Error& error);

}  // namespace sesame::tools
