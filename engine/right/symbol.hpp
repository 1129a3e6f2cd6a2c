/// \file
/// What the right reduction calls its generators, and its rules.
#pragma once

#include <cstdint>

#include "ops/ids.hpp"
#include "sparse/chain.hpp"

namespace sesame::engine {

using sparse::Index;
using sparse::RawTerms;
using sparse::Ring;
using sparse::Terms;

/// A generator that the right reduction knows: one of B, or a combination that a change of basis made.
using Symbol = sparse::Index;
inline constexpr Symbol no_symbol = UINT32_MAX;

/// Rules are counted from 0 in the order in which they were made; time t is the moment when t of them existed.
using RuleId = ops::Id<struct RuleOfRewriting>;
inline constexpr RuleId no_rule = ops::none;

}  // namespace sesame::engine
