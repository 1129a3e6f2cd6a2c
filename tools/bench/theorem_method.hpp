/// \file
/// The published theorem as it is written: each step's exact sequence, and the equivalence that follows from it.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ops/plan/step_sequence.hpp"
#include "tools/bench/method.hpp"

namespace sesame::tools {

/// Keeps the equivalence of the object as whole matrices. A step writes its short exact sequence out, takes the theorem
/// on effective exact sequences (`reductions::forward`, `reductions::backward`) with the trivial equivalence of the
/// small end, and eliminates all unit pairs of the new small complex.
///
/// It takes what the eager method takes, and is what that one does in place: a step here costs the size of the object.
/// All equivalences are kept, for undo.
/// Source: S. Peltier, habilitation (2023), theorem 4 and section 3.3.3.
template <sparse::Ring R>
class TheoremMethod final : public Method {
 public:
  explicit TheoremMethod(R ring);

  Status apply(const ops::Operation& operation) override;
  engine::Homology homology() override;
  std::uint64_t generators() override;
  /// `entries_held` by the matrices of the present equivalence.
  [[nodiscard]] std::vector<std::pair<std::string, std::uint64_t>> counts() const override;

  [[nodiscard]] const reductions::Equivalence<R>& equivalence() const { return states_.back().equivalence; }

 private:
  /// After a step: the generators of the object are the cells of the basis.
  struct State {
    reductions::Equivalence<R> equivalence;
    ops::CellBasis cells;
  };

  [[nodiscard]] Result<State> next(const ops::StepSequence<R>& step, ops::StepKind kind) const;

  R ring_;
  ops::Workspace object_{written_out};
  std::vector<State> states_;  ///< before the first step, and after each
};

[[nodiscard]] std::unique_ptr<Method> make_theorem_method(const sparse::AnyRing& ring);

}  // namespace sesame::tools
