/// \file
/// What the targets of the fuzzer have in common. Each is a program of its own: libFuzzer calls its one function again
/// and again in the preset `fuzz`, elsewhere plain_main.cpp calls it once for each file that it is given.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "sparse/result.hpp"

/// Takes one input. What it finds wrong ends the program; it returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace sesame::tests {

/// Ends the program in a way that the fuzzer takes for a crash.
[[noreturn]] inline void violation(std::string_view what) {
  std::fprintf(stderr, "violated: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

inline void demand(bool holds, std::string_view what) {
  if (!holds) {
    violation(what);
  }
}

/// Two texts that should be one; says where they part.
inline void demand_equal(std::string_view one, std::string_view other, std::string_view what) {
  if (one != other) {
    violation(std::string{what} + "\n--- one\n" + std::string{one} + "\n--- other\n" + std::string{other});
  }
}

/// What is refused is refused with a sentence, on one line that a terminal can show.
inline void demand_sentence(const Error& error) {
  demand(!error.what.empty(), "an error says what is wrong");
  for (const char c : error.what) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7F') {
      violation("an error has control characters: " + error.what);
    }
  }
}
template <class T>
bool went_well(const Result<T>& result) {
  if (!result) {
    demand_sentence(result.error());
  }
  return result.has_value();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace sesame::tests
