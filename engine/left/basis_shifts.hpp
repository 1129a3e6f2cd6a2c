/// \file
/// Changes of basis of the big complex: a generator G of a node becomes G + e, for e that of a copy.
#pragma once

#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/left/generators.hpp"

namespace sesame::engine {

using sparse::RawTerms;
using sparse::Ring;
using sparse::Terms;

/// When all incidences of a node go to a copy of it, its generators go with them: each G of the node is replaced by
/// G + e, e the generator of the copy. Then the boundaries of the node's cofaces need no change (see
/// BigComplex::split). Here it is remembered what the generators are since, and how those that there were are written
/// in them.
///
/// Invariants: a generator as created is itself minus the e that were added to it, each e again as it was created. A
/// generator belongs to one node at a time. Without splits nothing is stored, and queries cost O(1).
template <Ring R>
class BasisShifts {
 public:
  /// `generators` must outlive it.
  BasisShifts(R ring, const Generators& generators) : ring_{ring}, generators_{generators} {}

  /// A generator as it was when it was appended, in the present basis, times a factor, added to `out`.
  void add_as_created(Index generator, const typename R::Element& factor, RawTerms<R>& out) const;
  /// The e that were added to a generator, in that order.
  [[nodiscard]] std::span<const Index> added_to(Index generator) const { return find(added_to_, generator); }
  /// The generators that an e was added to.
  [[nodiscard]] std::span<const Index> with(Index e) const { return find(with_, e); }
  /// The generators that belong to a node now: the one made for it, unless there were shifts.
  [[nodiscard]] std::vector<Index> generators_of(CellId node) const;

  /// The generators of a node become those of a copy. Cost: their number, and how often they have been shifted before.
  void shift(CellId node, CellId copy);

  [[nodiscard]] std::size_t mark() const { return shifts_.size(); }
  /// Takes back the shifts since a mark, and forgets the generators from `first` on, which are to go. Requires: they
  /// are still there. Cost: the shifts taken back and the generators that go.
  void truncate(std::size_t mark, Index first);

 private:
  struct Shift {
    CellId node, copy;
    std::vector<Index> generators;  ///< that were the node's and are the copy's since
  };
  using Lists = std::unordered_map<Index, std::vector<Index>>;

  [[nodiscard]] static std::span<const Index> find(const Lists& lists, Index key) {
    if (lists.empty()) {
      return {};
    }
    const auto at = lists.find(key);
    return at == lists.end() ? std::span<const Index>{} : std::span<const Index>{at->second};
  }
  void substitute(Index key, Index generator, Index e);
  void take_back_last();

  R ring_;
  const Generators& generators_;
  std::vector<Shift> shifts_;
  Lists added_to_;
  Lists with_;
  std::unordered_map<Index, Terms<R>> as_created_;                ///< where not the generator itself
  std::unordered_map<Index, std::set<Index>> in_as_created_;      ///< the keys above whose chain has a generator
  std::unordered_map<CellId, std::vector<Index>> generators_of_;  ///< of nodes, where not the node's own alone
};

}  // namespace sesame::engine
