/// \file
/// Which lifts have a generator.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/right/symbol.hpp"

namespace sesame::engine {

/// For each generator of B the symbols whose lift may have it; at least those that have. A lift that becomes part of
/// that of another symbol is not looked at again: entries are of *lineages*, of which one may become part of another,
/// and one that has not has a holder. So they are a forest, as of a union-find.
class LiftIndex {
 public:
  [[nodiscard]] bool has(Symbol x) const { return lineage_of_.contains(x); }
  /// The lift of x has these terms, too. Cost: their number.
  template <class Terms>
  void add(Symbol x, const Terms& terms) {
    const LineageId own = lineage_of(x);
    for (const auto& term : terms) {
      if (term.index >= last_.size()) {
        last_.resize(term.index + std::size_t{1}, no_entry);
      }
      entries_.push_back({own, last_[term.index]});
      last_[term.index] = static_cast<std::uint32_t>(entries_.size() - 1);
    }
  }
  /// From now on x has the terms of z, which is asked for no more, with its own. False: z is not known, or another one
  /// has them already.
  bool inherit(Symbol x, Symbol z) {
    const auto at = lineage_of_.find(z);
    if (at == lineage_of_.end() || lineages_[at->second].holder != z || x == z) {
      return false;
    }
    const LineageId of_z = at->second;
    if (const auto [own, is_new] = lineage_of_.try_emplace(x, of_z); is_new) {
      lineages_[of_z].holder = x;
    } else {
      lineages_[of_z] = {no_symbol, own->second};
    }
    return true;
  }
  /// Calls visit(x) for the symbols whose lift may have a generator, some of them more than once.
  template <class Visit>
  void for_each_with(GeneratorId generator, Visit visit) {
    if (generator < last_.size()) {
      for (std::uint32_t at = last_[generator]; at != no_entry; at = entries_[at].previous) {
        visit(holder(entries_[at].lineage));
      }
    }
  }

 private:
  using LineageId = std::uint32_t;
  static constexpr std::uint32_t no_entry = UINT32_MAX;
  struct Entry {
    LineageId lineage;
    std::uint32_t previous;
  };
  struct Node {
    Symbol holder;  ///< none once it is part of another one
    LineageId part_of;
  };

  LineageId lineage_of(Symbol x) {
    const auto [at, is_new] = lineage_of_.try_emplace(x, static_cast<LineageId>(lineages_.size()));
    if (is_new) {
      lineages_.push_back({x, at->second});
    }
    return at->second;
  }
  Symbol holder(LineageId lineage) {
    while (lineages_[lineage].holder == no_symbol) {
      Node& node = lineages_[lineage];
      if (const Node& above = lineages_[node.part_of]; above.holder == no_symbol) {
        node.part_of = above.part_of;  // ways are halved as they are gone
      }
      lineage = node.part_of;
    }
    return lineages_[lineage].holder;
  }

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> last_;  ///< per generator: its last entry
  std::vector<Node> lineages_;
  std::unordered_map<Symbol, LineageId> lineage_of_;  ///< of one that holds none any more: that which it held
};

}  // namespace sesame::engine
