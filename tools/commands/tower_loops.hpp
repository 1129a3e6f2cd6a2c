/// \file
/// What `sesame tower` and `sesame zigzag` do with an input, one loop for each kind of input and of what is asked for.
#pragma once

#include "tools/commands/tower_run.hpp"

namespace sesame::tools {

// Each reads the input of an opened run to its end and writes the results. Returns how that went.

/// The barcodes of a tower or filtration over fields.
replay::Outcome run_barcodes(TowerRun& run);
/// Its groups over Z.
replay::Outcome run_groups(TowerRun& run);
/// The barcode of a script, or over Z its groups.
replay::Outcome run_script_as_tower(TowerRun& run);
/// The barcode of a zigzag over a field.
replay::Outcome run_zigzag(TowerRun& run);

}  // namespace sesame::tools
