/// \file
/// g of the cells of a tower as chains of generators, and the reduction of their boundaries.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/towers/bar_cycles.hpp"
#include "engine/towers/barcode_tracker.hpp"
#include "engine/towers/class_space.hpp"
#include "engine/towers/time_list.hpp"
#include "ops/simplicial/tower_complex.hpp"
#include "sparse/chain.hpp"
#include "sparse/descending_sum.hpp"
#include "sparse/ring.hpp"

namespace sesame::engine {

/// The whole history of a tower, for its cycles. A tracker that keeps them has this next to the classes of its cells:
/// it says what becomes of the cells, and which generator bears a class and which kills one.
///
/// A generator b of the big complex is reduced by older ones until the youngest generator of its boundary is alive, a,
/// or nothing is left: V(b) = b + sum of multiples of V(b'), R(b) = dV(b). Then a is the birth and b the death of a
/// bar: R(b) is a cycle that is there at the birth, and V(b) what it bounds at the death. When nothing is left V(b) is
/// a cycle that is born with b. Source: the standard algorithm of H. Edelsbrunner, D. Letscher and A. Zomorodian
/// (2002), here on the big complex of a tower. Only what kills is reduced, and its pair is that of the tracker; which
/// cycle a class is born as is worked out when somebody asks.
template <Ring R>
class ChainImages final : public BarCycles {
 public:
  using Slot = ops::TowerComplex::Slot;
  using Node = typename ClassSpace<R>::Node;
  using Element = typename R::Element;

  ChainImages(R ring, Slots slots) : ring_{ring}, has_shared_slots_{slots == Slots::shared}, sum_{ring} {}

  void begin_inclusion(Time time) {
    times_.push_back(time);
    ++inclusions_;
  }
  void begin_contraction(Time time) { times_.push_back(time); }

  // ---- the next generator; if it bears a class or kills one, that is said next
  [[nodiscard]] std::uint32_t next_generator() const { return static_cast<Generator>(generators_.size()); }
  /// The generator of a cell that is included now.
  void include(std::size_t dimension, Slot slot, std::span<const Slot> facets);
  /// The generator of a simplex that is merged or squashed, after its corrections.
  void contract(std::size_t dimension, const ops::TowerComplex::Change& change);
  /// The generator bears the class `node` of its dimension.
  void bear(std::size_t dimension, Node node);
  /// The generator, of one dimension more, kills the class `node`.
  void kill(std::size_t dimension, Node node);

  /// g of a simplex gains plus or minus a generator.
  void correct(std::size_t dimension, Slot slot, std::uint32_t generator, bool is_negative);
  void reverse(std::size_t dimension, Slot slot);
  /// The nodes of a dimension have other numbers: see ClassSpace::retire.
  void renumber(std::size_t dimension, std::span<const Node> number);

  [[nodiscard]] BarcodeTracker::Work work() const {
    return {terms_touched_, terms_.size() + additions_.size(), generators_.size()};
  }

  [[nodiscard]] std::vector<TracedBar> bars() const override;
  [[nodiscard]] std::uint64_t last_operation_with(std::uint64_t operation) const override {
    return times_.last_equal(operation);
  }
  [[nodiscard]] InclusionChain cycle(const TracedBar& bar) override;
  [[nodiscard]] InclusionChain bounded_chain(const TracedBar& bar) override;

 private:
  using Generator = std::uint32_t;
  using TermType = sparse::Term<R>;
  using TermRange = std::pair<std::uint64_t, std::uint32_t>;  ///< the first one, how many
  static constexpr std::uint32_t alive_mark = UINT32_MAX;
  static constexpr std::uint32_t negative_mark = UINT32_MAX - 1;
  static constexpr std::uint32_t no_inclusion = UINT32_MAX;
  static constexpr std::uint32_t no_terms = UINT32_MAX;

  /// A generator of the big complex.
  struct Cell {
    std::uint64_t first_term;  ///< in terms_: of its boundary while it is alive, of R(partner) once it is dead
    std::uint32_t terms;
    Generator partner;  ///< what killed it, or alive_mark, or negative_mark: it killed another one
    std::uint32_t operation;
    std::uint32_t inclusion;  ///< no_inclusion when it is that of a merged or squashed simplex
    std::uint8_t dimension;
  };
  /// g of a current cell: plus or minus a generator, and corrections.
  struct Image {
    Generator generator = 0;
    bool is_negative = false;
    std::uint32_t corrections = no_terms;  ///< in corrections_
  };
  struct Addition {
    Generator killer;
    Element factor;
  };

  [[nodiscard]] std::vector<Image>& images_of(std::size_t dimension);
  void add_cell(std::size_t dimension, Slot slot, const Element& factor);
  Generator append(std::size_t dimension);
  template <class Note>
  void reduce(std::span<const TermType> boundary, Note&& note);
  void add_term(Generator generator, const Element& factor, const Element& coefficient);
  [[nodiscard]] std::span<const TermType> kept_terms(const Cell& cell) const {
    return {terms_.data() + cell.first_term, cell.terms};
  }
  [[nodiscard]] InclusionChain inclusions(int degree, std::span<const TermType> terms) const;
  [[nodiscard]] InclusionChain expand(int degree, std::span<const Addition> sum);

  R ring_;
  bool has_shared_slots_;
  std::vector<Cell> generators_;
  TimeList times_;  ///< per operation
  std::uint64_t terms_touched_ = 0;
  std::uint32_t inclusions_ = 0;
  // Per generator b that killed a class: V(b) = scale (b + sum factor V(killer)). R(b) = dV(b) has the youngest term
  // last, coefficient 1.
  std::vector<TermRange> added_;
  std::vector<Element> scale_;
  sparse::Terms<R> terms_;
  std::vector<Addition> additions_;
  std::vector<std::vector<Image>> images_;  ///< per dimension and slot
  std::vector<sparse::Terms<R>> corrections_;
  std::vector<std::vector<Generator>> bearers_;  ///< per dimension and node that is alive
  sparse::DescendingSum<R> sum_;
  sparse::RawTerms<R> gathered_;            ///< the boundary of the next generator
  sparse::Terms<R> boundary_;               ///< the same in normal form
  std::uint32_t inclusion_ = no_inclusion;  ///< of the next generator
  sparse::Terms<R> column_;
};

}  // namespace sesame::engine
