/// \file
/// Options that the commands for barcodes have in common.
#pragma once

#include <CLI/CLI.hpp>

#include "tools/commands/tower_arguments.hpp"

namespace sesame::tools {

// `arguments` must outlive the command.

/// Adds --pers, --csv, --svg, --all-bars and --html.
void add_barcode_outputs(CLI::App& command, TowerArguments& arguments);

/// Adds which bars and how many operations: --min-length, --no-open, --max-dim, --until, --every, --max-line; and
/// --partial and --quiet.
void add_bar_choices(CLI::App& command, TowerArguments& arguments);

}  // namespace sesame::tools
