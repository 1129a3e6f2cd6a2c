/// \file
/// The subcommands of the program. Each adds itself to the command line; when it is chosen, its callback sets `status`.
#pragma once

#include <CLI/CLI.hpp>

namespace sesame::tools {

void add_replay_command(CLI::App& app, int& status);
void add_import_command(CLI::App& app, int& status);
void add_export_command(CLI::App& app, int& status);
void add_mesh_command(CLI::App& app, int& status);
void add_generate_command(CLI::App& app, int& status);
void add_tower_command(CLI::App& app, int& status);
void add_zigzag_command(CLI::App& app, int& status);
void add_distance_command(CLI::App& app, int& status);
void add_verify_command(CLI::App& app, int& status);
void add_info_command(CLI::App& app, int& status);
void add_bench_command(CLI::App& app, int& status);

}  // namespace sesame::tools
