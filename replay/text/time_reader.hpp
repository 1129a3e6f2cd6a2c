/// \file
/// Reading times: which texts are times, and that those of one input can be told apart.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/towers/time.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

/// Reads the times of one input, or of several that are compared.
///
/// What is written in digits alone is a whole number, kept exactly, of 64 bits at most, signed or not. A number with a
/// point or an exponent is the nearest double. Where whole numbers are no doubles, beyond 2^53, the two do not go
/// together: of two numbers of which only one was rounded nobody knows which is less.
class TimeReader {
 public:
  /// The time that a word is, which may be infinite. `what` says what the word should be, `name` and `line` where it
  /// is. Errors: bad_input, without the place.
  Result<engine::Time> read(std::string_view word, std::string_view what, const std::string& name, std::uint64_t line);

 private:
  /// "FILE:LINE has NUMBER" of the first whole number beyond 2^53, and of the first that may have been rounded; empty
  /// before there is one.
  std::string large_, rounded_;
};

}  // namespace sesame::replay
