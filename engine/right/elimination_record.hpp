/// \file
/// What a right reduction has come to, to be done again without the rewriting.
#pragma once

#include <cstdint>
#include <vector>

#include "sparse/archive.hpp"

namespace sesame::engine {

/// The eliminations of a reduction that has no other rules, and the core, with small coefficients. Generators of B are
/// numbers.
struct EliminationRecord {
  struct Elimination {
    std::uint32_t a, b;
    std::uint32_t generators;  ///< that there were when it was made
    std::uint32_t terms;       ///< of the boundary of b, rewritten: how many follow
  };
  struct Column {
    std::uint32_t x;  ///< in the core
    std::uint32_t owns_pivot, terms;
  };
  std::vector<Elimination> eliminations;
  std::vector<Column> core;
  // The terms of the ones, then of the others.
  std::vector<std::uint32_t> index;
  std::vector<std::int32_t> coefficient;  ///< the representative that is printed

  void save(sparse::ArchiveWriter& to) const {
    to.put_list(eliminations);
    to.put_list(core);
    to.put_list(index);
    to.put_list(coefficient);
  }
  /// Without a look at it.
  void load(sparse::ArchiveReader& from) {
    eliminations = from.get_list<std::vector<Elimination>>();
    core = from.get_list<std::vector<Column>>();
    index = from.get_list<std::vector<std::uint32_t>>();
    coefficient = from.get_list<std::vector<std::int32_t>>();
  }
};

}  // namespace sesame::engine
