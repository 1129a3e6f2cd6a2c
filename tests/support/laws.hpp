/// \file
/// `defect_of(x) == ""`: the law checks in a form whose failure prints what is broken and where.
#pragma once

#include <string>

#include "reductions/defect.hpp"

namespace sesame::tests {

/// The first defect as a sentence; empty when every law holds.
template <class... Args>
std::string defect_of(const Args&... args) {
  const auto defect = reductions::first_defect(args...);
  return defect ? defect->to_string() : "";
}

}  // namespace sesame::tests
