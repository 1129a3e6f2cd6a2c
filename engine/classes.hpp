/// \file
/// The classes of homology of a live equivalence, as cycles of cells.
#pragma once

#include "engine/chains.hpp"
#include "engine/groups.hpp"
#include "engine/homology_tracker.hpp"
#include "engine/left/big_complex.hpp"

namespace sesame::engine {

/// Answers questions about classes: what the algebra of S says (Groups), written in cells by F, G and K (Chains).
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

 private:
  R ring_;
  const BigComplex<R>& big_;
  Rewriter<R>& rewriter_;
  Chains<R>& chains_;
  Groups<R> groups_;
};

}  // namespace sesame::engine
