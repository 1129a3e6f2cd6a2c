/// \file
/// Which lifts have a generator.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/right/symbol.hpp"

namespace sesame::engine {

/// For each generator of B the symbols whose lift may have it; at least those that have. A lift that becomes that of
/// another symbol, but for a few terms, is not looked at again: entries are of *lineages*, and a lineage has a holder.
class LiftIndex {
 public:
  [[nodiscard]] bool has(Symbol x) const { return lineage_of_.contains(x); }
  /// The lift of x has these terms, too. Cost: their number.
  template <class Terms>
  void add(Symbol x, const Terms& terms) {
    const auto [at, is_new] = lineage_of_.try_emplace(x, static_cast<std::uint32_t>(holders_.size()));
    if (is_new) {
      holders_.push_back(x);
    }
    for (const auto& term : terms) {
      if (term.index >= last_.size()) {
        last_.resize(term.index + std::size_t{1}, no_entry);
      }
      entries_.push_back({at->second, last_[term.index]});
      last_[term.index] = static_cast<std::uint32_t>(entries_.size() - 1);
    }
  }
  /// From now on x has the terms of z, which is asked for no more. False: z is not known, or others have them already.
  bool inherit(Symbol x, Symbol z) {
    const auto at = lineage_of_.find(z);
    if (at == lineage_of_.end() || holders_[at->second] != z) {
      return false;
    }
    holders_[at->second] = x;
    lineage_of_.insert_or_assign(x, at->second);
    return true;
  }
  /// Calls visit(x) for the symbols whose lift may have a generator, some of them more than once.
  template <class Visit>
  void for_each_with(GeneratorId generator, Visit visit) const {
    if (generator < last_.size()) {
      for (std::uint32_t at = last_[generator]; at != no_entry; at = entries_[at].previous) {
        visit(holders_[entries_[at].lineage]);
      }
    }
  }

 private:
  static constexpr std::uint32_t no_entry = UINT32_MAX;
  struct Entry {
    std::uint32_t lineage, previous;
  };

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> last_;  ///< per generator: its last entry
  std::vector<Symbol> holders_;      ///< per lineage
  std::unordered_map<Symbol, std::uint32_t> lineage_of_;
};

}  // namespace sesame::engine
