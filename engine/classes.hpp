/// \file
/// The classes of homology of a live equivalence, as cycles of cells.
#pragma once

#include <map>
#include <memory>

#include "engine/chains.hpp"
#include "engine/groups.hpp"
#include "engine/homology_tracker.hpp"
#include "engine/left/big_complex.hpp"

namespace sesame::engine {

/// Answers questions about classes: what the algebra of S says (Groups), written in cells by F, G and K (Chains).
/// Threads: one at a time, for queries too.
template <Ring R>
class Classes {
 public:
  /// All of them must outlive it.
  Classes(R ring, const BigComplex<R>& big, Rewriter<R>& rewriter, Chains<R>& chains)
      : ring_{ring}, big_{big}, rewriter_{rewriter}, chains_{chains}, groups_{ring, rewriter} {}

  /// See HomologyTracker for all three.
  [[nodiscard]] Homology homology(std::size_t dimensions);
  void visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit);
  [[nodiscard]] ClassAnswer classify(const CellChain& chain);
  /// To be called before S changes.
  void forget_groups() { known_.clear(); }

 private:
  /// Shared, as a visitor may have what was asked for meanwhile taken back, and the groups with it.
  [[nodiscard]] std::shared_ptr<const Group<R>> group(int degree);

  R ring_;
  const BigComplex<R>& big_;
  Rewriter<R>& rewriter_;
  Chains<R>& chains_;
  Groups<R> groups_;
  std::map<int, std::shared_ptr<const Group<R>>> known_;  ///< that were asked for since S has changed, by degree
};

}  // namespace sesame::engine
