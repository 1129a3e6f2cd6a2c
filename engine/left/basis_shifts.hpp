/// \file
/// Changes of basis of the big complex: a generator G of a node becomes G + e, for e that of a copy.
#pragma once

#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/left/generators.hpp"

namespace sesame::engine {

/// When all incidences of a node go to a copy of it, its generators go with them: each G of the node is replaced by
/// G + e, e the generator of the copy. Then the boundaries of the node's cofaces need no change (see
/// BigComplex::split). Here it is remembered what the generators are since, and how those that there were are written
/// in them.
///
/// Invariants: a generator as created is itself minus the e that were added to it, each e again as it was created. A
/// generator belongs to one node at a time. Without splits nothing is stored, and queries cost O(1).
///
/// Threads: one at a time, for queries too.
template <Ring R>
class BasisShifts {
 public:
  /// `generators` must outlive it.
  BasisShifts(R ring, const Generators& generators) : ring_{ring}, generators_{generators} {}

  /// A generator as it was when it was appended, in the present basis, times a factor, added to `out`.
  void add_as_created(GeneratorId generator, const typename R::Element& factor, RawTerms<R, GeneratorId>& out) const;
  /// The e that were added to a generator, in that order.
  [[nodiscard]] std::span<const GeneratorId> added_to(GeneratorId generator) const {
    return find(added_to_, generator);
  }
  /// The generators that an e was added to.
  [[nodiscard]] std::span<const GeneratorId> with(GeneratorId e) const { return find(with_, e); }
  /// The generators that belong to a node now: the one made for it, unless there were shifts.
  [[nodiscard]] std::vector<GeneratorId> generators_of(CellId node) const;

  /// The generators of a node become those of a copy. Cost: their number, and how often they have been shifted before.
  void shift(CellId node, CellId copy);

  [[nodiscard]] std::size_t mark() const { return shifts_.size(); }
  /// Takes back the shifts since a mark, and forgets the generators from `first` on, which are to go. Requires: they
  /// are still there. Cost: the shifts taken back and the generators that go.
  void truncate(std::size_t mark, GeneratorId first);

 private:
  struct Shift {
    CellId node, copy;
    std::vector<GeneratorId> generators;  ///< that were the node's and are the copy's since
  };
  using Lists = std::unordered_map<GeneratorId, std::vector<GeneratorId>>;

  [[nodiscard]] static std::span<const GeneratorId> find(const Lists& lists, GeneratorId key) {
    if (lists.empty()) {
      return {};
    }
    const auto at = lists.find(key);
    return at == lists.end() ? std::span<const GeneratorId>{} : std::span<const GeneratorId>{at->second};
  }
  void substitute(GeneratorId key, GeneratorId generator, GeneratorId e);
  void take_back_last();

  R ring_;
  const Generators& generators_;
  std::vector<Shift> shifts_;
  Lists added_to_;
  Lists with_;
  /// Where that is not the generator itself; and the keys of those whose chain has a generator.
  std::unordered_map<GeneratorId, Terms<R, GeneratorId>> as_created_;
  std::unordered_map<GeneratorId, std::set<GeneratorId>> in_as_created_;
  std::unordered_map<CellId, std::vector<GeneratorId>> generators_of_;  ///< of nodes, where not the node's own alone
};

}  // namespace sesame::engine
