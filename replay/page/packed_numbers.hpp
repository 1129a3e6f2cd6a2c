/// \file
/// Long lists of numbers in the data of pages.
#pragma once

#include <cstdint>
#include <span>

#include "ops/vocabulary/json_text.hpp"

namespace sesame::replay {

/// Writes a list of numbers as {"kind":K,"data":D}: D is the base64 of their bytes, lowest first, K is "f32" for
/// floats, "u16" for whole numbers below 2^16, else "u32". That is a fifth to a half of what digits take, and browsers
/// read it ten times as fast (replay/page/src/packed.ts).
void write_packed(std::span<const float> numbers, ops::JsonText& out);
void write_packed(std::span<const std::uint32_t> numbers, ops::JsonText& out);

}  // namespace sesame::replay
