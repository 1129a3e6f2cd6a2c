/// \file
/// The live form of the homological equivalence C <= B => S over one ring.
#pragma once

#include <memory>
#include <vector>

#include "engine/chains.hpp"
#include "engine/classes.hpp"
#include "engine/homology_tracker.hpp"
#include "engine/left/big_complex.hpp"
#include "engine/left/frozen_maps.hpp"
#include "engine/mark_stack.hpp"
#include "engine/right/rewriter.hpp"
#include "reductions/equivalence.hpp"

namespace sesame::engine {

/// C <= B => S: the left reduction is BigComplex, the right one Rewriter. This class keeps them current, by what the
/// journal says, and takes them back; questions about chains are answered by Chains, those about classes by Classes.
///
/// Threads: one at a time, for queries too.
template <Ring R>
class LiveEquivalence final : public HomologyTracker {
 public:
  /// The equivalence of a window's present object. Cost: that of its cells and of what has happened in it. `record`: of
  /// one of the same object at its beginning.
  LiveEquivalence(R ring, Window window, const EliminationRecord* record = nullptr);

  [[nodiscard]] bool extend(std::uint64_t budget) override;
  void push_mark() override;
  void undo_to_mark() override;
  void forget_oldest_mark() override;
  [[nodiscard]] std::unique_ptr<HomologyTracker> afresh() const override;
  [[nodiscard]] std::optional<EliminationRecord> record() const override { return rewriter_.record(); }
  [[nodiscard]] std::uint32_t copies() const override { return window_.copies(); }
  [[nodiscard]] std::uint32_t deletions() const override { return window_.deletions(); }

  [[nodiscard]] Homology homology(std::size_t dimensions) override { return classes_.homology(dimensions); }
  [[nodiscard]] std::uint64_t small_of(ops::BodyId body) const override;
  void visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit) override {
    classes_.visit_generators(degree, most_terms, visit);
  }
  [[nodiscard]] ClassAnswer classify(const CellChain& chain) override { return classes_.classify(chain); }
  [[nodiscard]] SmallChain apply_F(const CellChain& chain) override { return chains_.F(chain); }
  [[nodiscard]] CellChain apply_G(const SmallChain& chain) override { return chains_.G(chain); }
  [[nodiscard]] CellChain apply_K(const CellChain& chain) override { return chains_.K(chain); }
  [[nodiscard]] CellChain boundary(const CellChain& chain) const override { return chains_.boundary(chain); }
  [[nodiscard]] SmallChain boundary(const SmallChain& chain) override { return chains_.boundary(chain); }
  [[nodiscard]] std::vector<Lifetime> lifetimes() const override;
  [[nodiscard]] Work work() const override {
    return {big_.entries_appended(), rewriter_.terms_read(), rewriter_.rule_terms(), big_.maps().links_followed()};
  }
  [[nodiscard]] std::optional<std::string> first_defect(ops::StepKind last_step, ops::Moment before_it) override;

  /// See matrices_of.
  [[nodiscard]] reductions::Equivalence<R> matrices();
  [[nodiscard]] const BigComplex<R>& big() const { return big_; }
  [[nodiscard]] const Chains<R>& chains() const { return chains_; }
  /// The right reduction; its queries memoise.
  [[nodiscard]] Rewriter<R>& rewriter() { return rewriter_; }
  [[nodiscard]] const Window& window() const override { return window_; }

 private:
  struct Mark {
    ops::Journal::Position position;
    typename BigComplex<R>::Mark big;
    typename FrozenMaps<R>::Mark frozen;
    typename Rewriter<R>::Mark rewriter;
  };
  [[nodiscard]] Mark mark();
  using PackedMark = MarkStack<16>::Mark;
  [[nodiscard]] static PackedMark packed(const Mark& mark);
  [[nodiscard]] static Mark unpacked(const PackedMark& mark);
  void take_in_step();
  void take_away(LinkId link);
  void go_back_to(const Mark& mark);

  R ring_;
  Window window_;
  const Structure& structure_;
  BigComplex<R> big_;
  Rewriter<R> rewriter_;
  FrozenMaps<R> frozen_;
  Chains<R> chains_;
  Classes<R> classes_;
  ops::Journal::Position position_;  ///< of the journal: what has been taken in
  MarkStack<16> marks_;
};

/// A live equivalence over a ring chosen at run time.
[[nodiscard]] std::unique_ptr<HomologyTracker> make_tracker(const sparse::AnyRing& ring, const Structure& structure);
/// One that knows only the present object: see HomologyTracker::afresh. Cost: also a look at the cells among which it
/// is.
[[nodiscard]] std::unique_ptr<HomologyTracker> make_tracker_afresh(const sparse::AnyRing& ring,
                                                                   const Structure& structure,
                                                                   const CellsToLookAt& among,
                                                                   const EliminationRecord* record = nullptr);

}  // namespace sesame::engine
