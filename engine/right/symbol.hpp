/// \file
/// What the generators of the big complex, the symbols of the right reduction and its rules are called.
#pragma once

#include <cstdint>

#include "ops/ids.hpp"
#include "sparse/chain.hpp"

namespace sesame::engine {

using ops::CellId;
using sparse::Index;
using sparse::RawTerms;
using sparse::Ring;
using sparse::Terms;

// Chains say by their ids what they are chains of: Terms<R, CellId> of C, Terms<R, GeneratorId> of B, Terms<R, Symbol>
// of S; Terms<R> are coordinates in some basis, rows of a matrix.

/// A generator of the big complex B, counted from 0 in the order in which they were appended, over all degrees.
using GeneratorId = ops::Id<struct GeneratorOfBigComplex>;

/// A generator that the right reduction knows: one of B, or a combination that a change of basis made.
using Symbol = ops::Id<struct SymbolOfRewriting>;
inline constexpr Symbol no_symbol = ops::none;

/// Rules are counted from 0 in the order in which they were made; time t is the moment when t of them existed.
using RuleId = ops::Id<struct RuleOfRewriting>;
inline constexpr RuleId no_rule = ops::none;

}  // namespace sesame::engine
