/// \file
/// A script or log as a plain script: a header and one operation a line, without comments.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <ostream>

#include "replay/script/script.hpp"

namespace sesame::replay {

struct PlainScriptOptions {
  bool without_undone = false;              ///< leave out what is taken back later, and the undos
  std::optional<std::uint64_t> until = {};  ///< stop after that many operations have been read
  const std::atomic<bool>* stop = nullptr;
};

/// Writes the operations in canonical form, read and not carried out. One after another; with `without_undone` all are
/// kept until the end, as texts. Returns whether that was all, and not stopped from outside.
/// Errors: those of the reader; bad_input, an undo of more steps than there are, when undone steps are left out.
[[nodiscard]] Result<bool> write_plain_script(ScriptReader& script, const PlainScriptOptions& options,
                                              std::ostream& out);

}  // namespace sesame::replay
