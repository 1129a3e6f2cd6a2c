/// \file
/// Chains of simplices by their labels, and how they are written.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/history_zigzag.hpp"
#include "ops/simplicial/tower_complex.hpp"
#include "replay/text/text_buffer.hpp"
#include "sparse/rational_chain.hpp"

namespace sesame::replay {

/// Simplices by their labels, ascending, which orient them; cells of a boundary matrix by their numbers.
using NamedChain = sparse::RationalChain<std::vector<ops::Label>>;

/// The residue of least size modulo p, or n itself when p is 0: -1 is easier to read than p - 1.
[[nodiscard]] sparse::Rational smallest_residue(const sparse::Rational& n, std::uint32_t p);

/// "{0 1} - {0 2} + 2 {1 2}", or "0"; "a chain of 12 terms" when these are more than `most_terms`. Of cells that have
/// names: "t.0-1 - t.0-2 + 2 t.1-2".
[[nodiscard]] std::string chain_line(const NamedChain& chain, std::uint64_t most_terms);
[[nodiscard]] std::string chain_line(const engine::NameChain& chain, std::uint64_t most_terms);

/// ,"cycle":[[coefficient,[label,...]],...] as JSON; a coefficient that is no whole number of 64 bits is a string. Of a
/// chain of more than `most_terms` there is their number: ,"cycle_terms":12. Names of cells are strings:
/// [coefficient,name].
void add_chain_member(TextBuffer& text, std::string_view name, const NamedChain& chain, std::uint64_t most_terms);
void add_chain_member(TextBuffer& text, std::string_view name, const engine::NameChain& chain,
                      std::uint64_t most_terms);

}  // namespace sesame::replay
