/// \file
/// The errors of models of cells, by a sentence.
#pragma once

#include <string>
#include <utility>

#include "sparse/result.hpp"

namespace sesame::ops {

/// Data that are no model.
[[nodiscard]] inline Error bad_cells(std::string what) { return {Errc::bad_input, std::move(what)}; }
/// A model that is not what is asked for.
[[nodiscard]] inline Error refused_cells(std::string what) { return {Errc::refused, std::move(what)}; }

}  // namespace sesame::ops
