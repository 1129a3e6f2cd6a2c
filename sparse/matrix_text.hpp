/// \file
/// Matrices as text, for people.
#pragma once

#include <string>

#include "sparse/matrix.hpp"

namespace sesame::sparse {

/// A table with aligned columns for small matrices; larger ones as a list of columns `j: 2 e0 - e3`.
template <Ring R>
[[nodiscard]] std::string to_string(const Matrix<R>& matrix);

}  // namespace sesame::sparse
