/// \file
/// The subcommands of the program. Each adds itself to the command line; when it is chosen, its callback sets `status`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sesame::tools {

void add_replay_command(CLI::App& app, int& status);
void add_import_command(CLI::App& app, int& status);
void add_mesh_command(CLI::App& app, int& status);
void add_generate_command(CLI::App& app, int& status);
void add_tower_command(CLI::App& app, int& status);
void add_distance_command(CLI::App& app, int& status);
void add_bench_command(CLI::App& app, int& status);

/// Accepts whole numbers from 1 on.
[[nodiscard]] CLI::Validator from_one_on();

/// True when two paths name one existing file: what is read must not be written over.
[[nodiscard]] bool is_same_file(const std::string& one, const std::string& other);

}  // namespace sesame::tools
