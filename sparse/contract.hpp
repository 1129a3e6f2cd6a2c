/// \file
/// Contract checks: what a caller must have made true. A broken contract is a bug of the calling code, never a
/// property of user data (data problems are `Result` errors, see result.hpp).
#pragma once

#include <stdexcept>

namespace sesame::sparse {

/// Thrown when a contract of sesame's own code is broken. `main` reports it as an internal error.
class ContractViolation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Requires `holds`; `sentence` says what should have been true. Stays on in release builds: keep the condition cheap.
inline void expects(bool holds, const char* sentence) {
  if (!holds) [[unlikely]] {
    throw ContractViolation(sentence);
  }
}

}  // namespace sesame::sparse
