/// \file
/// The live form of the homological equivalence C <= B => S over one ring.
#pragma once

#include <memory>
#include <vector>

#include "engine/groups.hpp"
#include "engine/homology_tracker.hpp"
#include "engine/left/big_complex.hpp"
#include "engine/left/frozen_maps.hpp"
#include "engine/right/rewriter.hpp"
#include "reductions/equivalence.hpp"

namespace sesame::engine {

/// C <= B => S: the left reduction is BigComplex, the right one Rewriter; the groups are read off S.
template <Ring R>
class LiveEquivalence final : public HomologyTracker {
 public:
  /// The equivalence of a window's present object. Cost: that of its cells and of what has happened in it.
  LiveEquivalence(R ring, Window window);

  [[nodiscard]] bool extend(std::uint64_t budget) override;
  void push_mark() override;
  void undo_to_mark() override;
  [[nodiscard]] std::unique_ptr<HomologyTracker> afresh() const override;
  [[nodiscard]] std::uint32_t copies() const override { return window_.copies(); }

  [[nodiscard]] Homology homology(std::size_t dimensions) override;
  [[nodiscard]] std::uint64_t small_of(ops::BodyId body) const override;
  void visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit) override;
  [[nodiscard]] ClassAnswer classify(const CellChain& chain) override;
  [[nodiscard]] SmallChain apply_F(const CellChain& chain) override;
  [[nodiscard]] CellChain apply_G(const SmallChain& chain) override;
  [[nodiscard]] CellChain apply_K(const CellChain& chain) override;
  [[nodiscard]] CellChain boundary(const CellChain& chain) const override;
  [[nodiscard]] SmallChain boundary(const SmallChain& chain) override;
  [[nodiscard]] std::vector<Lifetime> lifetimes() const override;
  [[nodiscard]] Work work() const override {
    return {big_.entries_appended(), rewriter_.terms_read(), rewriter_.rule_terms(), big_.maps().links_followed()};
  }
  [[nodiscard]] std::optional<std::string> first_defect(ops::StepKind last_step, ops::Moment before_it) override;

  /// See matrices_of.
  [[nodiscard]] reductions::Equivalence<R> matrices();
  [[nodiscard]] const BigComplex<R>& big() const { return big_; }
  /// The boundary of S on a chain of its generators.
  [[nodiscard]] Terms<R> core_boundary(std::span<const sparse::Term<R>> chain_of_s) const;
  /// The right reduction; its queries memoise.
  [[nodiscard]] Rewriter<R>& rewriter() { return rewriter_; }
  [[nodiscard]] const Window& window() const { return window_; }

 private:
  struct Mark {
    ops::Journal::Position position;
    typename BigComplex<R>::Mark big;
    typename FrozenMaps<R>::Mark frozen;
    typename Rewriter<R>::Mark rewriter;
  };
  void take_in_step();
  void go_back_to(const Mark& mark);
  [[nodiscard]] std::vector<CellId> current_cells() const;
  [[nodiscard]] Terms<R> g(const CellChain& chain) const;
  [[nodiscard]] typename R::Element in_own_orientation(CellId cell, const Rational& coefficient) const;
  /// K z for the chain of B g z, plus f of a lift; with the trace of g z this is K, with a chain of S on top G y + K z.
  [[nodiscard]] CellChain bounding(const CellChain& z, const Terms<R>& chain_of_s, const Trace<R>& trace);
  [[nodiscard]] CellChain to_cells(int degree, const Terms<R>& chain_of_b) const;
  [[nodiscard]] CellChain to_chain(int degree, const Terms<R>& cells) const;
  [[nodiscard]] SmallChain to_small(int degree, const Terms<R>& chain_of_s) const;
  [[nodiscard]] Terms<R> to_symbols(const SmallChain& chain) const;

  R ring_;
  Window window_;
  const Structure& structure_;
  BigComplex<R> big_;
  Rewriter<R> rewriter_;
  Groups<R> groups_;
  FrozenMaps<R> frozen_;
  ops::Journal::Position position_;  ///< of the journal: what has been taken in
  std::vector<Mark> marks_;
};

/// A live equivalence over a ring chosen at run time.
[[nodiscard]] std::unique_ptr<HomologyTracker> make_tracker(const sparse::AnyRing& ring, const Structure& structure);
/// One that knows only the present object: see HomologyTracker::afresh. Cost: also a look at all cells ever made.
[[nodiscard]] std::unique_ptr<HomologyTracker> make_tracker_afresh(const sparse::AnyRing& ring,
                                                                   const Structure& structure);

}  // namespace sesame::engine
