/// \file
/// The method without memory: the homology of the present object, from scratch whenever it is asked for.
#pragma once

#include <memory>

#include "tools/bench/method.hpp"

namespace sesame::tools {

/// Writes the boundary matrices and reduces them: unit pairs are eliminated, which over a field is all; over Z, what is
/// left goes through the Smith form. Takes construction steps and undo. Cost: the object at each question; after an
/// undo also the cells ever created.
///
/// Counts    `cells_read` to see which are there, `matrix_entries` of all boundary matrices written.
[[nodiscard]] std::unique_ptr<Method> make_recompute_method(const sparse::AnyRing& ring);

}  // namespace sesame::tools
