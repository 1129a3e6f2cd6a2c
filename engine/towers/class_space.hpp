/// \file
/// The homology classes of one dimension along a tower of maps, over a field, or over Z as long as classes die by
/// units: who is alive, and what each cell's class has become.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/towers/time_list.hpp"
#include "sparse/growing_array.hpp"
#include "sparse/ring.hpp"

namespace sesame::engine {

using sparse::Ring;

/// A class that something refers to: 0, or plus or minus a node of a ClassSpace.
class ClassRef {
 public:
  static constexpr std::uint32_t most_nodes = 0x7fffffff;

  constexpr ClassRef() = default;
  constexpr explicit ClassRef(std::uint32_t node, bool is_negative = false)
      : word_{node | (is_negative ? sign : std::uint32_t{0})} {}
  [[nodiscard]] constexpr bool is_zero() const { return word_ == UINT32_MAX; }
  [[nodiscard]] constexpr std::uint32_t node() const { return word_ & ~sign; }
  [[nodiscard]] constexpr bool is_negative() const { return (word_ & sign) != 0; }
  [[nodiscard]] constexpr ClassRef operator-() const { return is_zero() ? *this : ClassRef{node(), !is_negative()}; }

 private:
  static constexpr std::uint32_t sign = 0x80000000U;
  std::uint32_t word_ = UINT32_MAX;
};

/// A term of a class in the classes alive. Over Z/2 the coefficient is 1.
template <Ring R>
struct ClassTerm {
  std::uint32_t node;
  typename R::Element coefficient;
};
template <>
struct ClassTerm<sparse::Z2> {
  std::uint32_t node;
};

/// Nodes are classes, numbered in the order of their births. A node is *alive*: one of the generators of the
/// present homology; or it is a sum of older ones, which it has become by the death of some class, or was made as.
/// Sums are written in nodes that were alive when the sum was last read; reading replaces those that have died since
/// by what they have become, and keeps the result. So the cost of reading is what has changed, and dimension 0 is a
/// union-find with path compression.
///
/// This is the image under f of the live form's rewriting rules (engine/LIVE_FORM.md), with fully rewritten results
/// kept and the rules forgotten. The values of all cells are the annotations of T. Dey, F. Fan and Y. Wang, "Computing
/// topological persistence for simplicial maps" (2014), brought up to date only where they are read.
template <Ring R>
class ClassSpace {
 public:
  using Node = std::uint32_t;
  using Element = typename R::Element;
  using TermType = ClassTerm<R>;
  static constexpr Node no_node = UINT32_MAX;

  explicit ClassSpace(R ring) : ring_{ring} {}

  /// A new class. It is younger than all others.
  Node add(Time birth);
  /// The number of classes alive.
  [[nodiscard]] std::size_t alive() const { return alive_; }
  [[nodiscard]] std::size_t nodes() const { return nodes_.size(); }
  [[nodiscard]] bool is_alive(Node node) const { return nodes_[node].size == alive_mark; }
  [[nodiscard]] Time birth(Node node) const { return births_[node]; }
  /// Begins to load what `add_to_sum` of this node will read first.
  void prefetch(Node node) const { __builtin_prefetch(nodes_.data() + node); }

  // ---- one sum at a time is under construction
  void clear_sum() { sum_.clear(); }
  /// sum += or -= a node's class. Cost: its terms and those of the sum; amortised, what has died since it was read.
  void add_to_sum(Node node, bool is_negative);
  [[nodiscard]] bool sum_is_zero() const { return sum_.empty(); }
  /// The sum becomes 0: the youngest class in it dies, and is from now on what makes the sum 0. Requires: it is not 0.
  /// Returns the node that died. Over Z it is the youngest with a unit; nothing dies, and this is no_node, when there
  /// is none, and when other terms are many and not small, which would grow where they are read.
  Node kill_sum();
  /// A node that stands for the sum. Requires: it is not 0.
  Node keep_sum();
  [[nodiscard]] std::span<const TermType> sum() const { return sum_; }

  /// Forgets all nodes that are neither alive nor referred to, and numbers the others anew; `refs` are all references
  /// that there are. Returns what number each node has now, in the same order, or no_node. Cost: the nodes, and the
  /// lengths of the sums that stay.
  std::vector<Node> retire(std::span<ClassRef> refs);

  /// The terms read or written while adding up: what all this has cost.
  [[nodiscard]] std::uint64_t terms_touched() const { return terms_touched_; }
  /// The terms that are held.
  [[nodiscard]] std::size_t terms_held() const { return pool_.size() - garbage_; }

 private:
  static constexpr std::uint32_t alive_mark = UINT32_MAX;
  static constexpr int largest_of_mild_sum = 3;  ///< over Z, as in Settling
  /// Over Z/2 a sum of one term is held in the record itself.
  struct Record {
    ClassTerm<sparse::Z2> at;  ///< that term; else its number is where the first term is in pool_
    std::uint32_t size;        ///< the number of terms, or alive_mark
  };
  static constexpr bool has_inline_terms = std::is_same_v<TermType, ClassTerm<sparse::Z2>>;

  [[nodiscard]] std::span<const TermType> terms(const Record& record) const;
  [[nodiscard]] bool is_fresh(Node node) const;
  void refresh(Node node);
  void rewrite(Node node);
  [[nodiscard]] bool rewrite_in_bits(std::span<const TermType> old);
  void store(Record& record, std::span<const TermType> terms);
  void add_alive(Node node, bool is_negative);
  void add_multiple(std::vector<TermType>& into, const Element& factor, std::span<const TermType> terms);
  void compact_pool();
  [[nodiscard]] Element coefficient(const TermType& term) const;
  [[nodiscard]] TermType term(Node node, Element coefficient) const;

  R ring_;
  sparse::GrowingArray<Record> nodes_;
  TimeList births_;
  std::vector<TermType> pool_;  ///< terms of sums, each sum by descending node
  std::size_t garbage_ = 0;     ///< terms of the pool that are no longer used
  std::size_t alive_ = 0;
  std::vector<TermType> sum_, rewritten_, scratch_;
  std::vector<Node> pending_;
  std::vector<std::uint64_t> bits_;  ///< memory of `rewrite_in_bits`, all 0 between calls
  std::uint64_t terms_touched_ = 0;
};

/// The numbers of classes alive, per dimension up to the largest that has one. `levels`: per dimension, with a
/// ClassSpace called `space`.
template <class Levels>
[[nodiscard]] std::vector<std::uint64_t> classes_alive(const Levels& levels) {
  std::vector<std::uint64_t> alive;
  for (const auto& level : levels) {
    alive.push_back(level.space.alive());
  }
  while (!alive.empty() && alive.back() == 0) {
    alive.pop_back();
  }
  return alive;
}

}  // namespace sesame::engine
