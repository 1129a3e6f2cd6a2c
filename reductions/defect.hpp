/// \file
/// Law checks: the first identity that an object breaks, and where. What `--verify` and the tests run.
#pragma once

#include <optional>
#include <string>

#include "reductions/equivalence.hpp"
#include "reductions/exact_sequence.hpp"

namespace sesame::reductions {

/// A broken identity: its text ("f g = 1"), the degree of the generator on which it fails, and the entry: the column is
/// that generator, the row the generator in whose coefficient the two sides differ.
struct Defect {
  std::string law;
  int degree;
  Index row;
  Index column;

  /// "f g = 1 fails on generator 3 of degree 1 (entry 0)".
  [[nodiscard]] std::string to_string() const;
};

// Each first_defect checks shapes, then the complexes, then the maps, in the order in which its documentation lists the
// laws. Shape problems are reported like laws ("f: big -> small, degree 0"), never thrown: whatever is checked here may
// come from anywhere. Cost: that of the sparse products.

/// d d = 0.
template <Ring R>
[[nodiscard]] std::optional<Defect> first_defect(const ChainComplex<R>& complex);

/// d phi = phi d, for a map of degree 0; `name` is what the law calls the map.
template <Ring R>
[[nodiscard]] std::optional<Defect> first_defect(const GradedMap<R>& phi, const ChainComplex<R>& source,
                                                 const ChainComplex<R>& target, const std::string& name = "phi");

/// Both complexes; f and g chain maps; f g = 1; g f + d h + h d = 1; f h = 0; h g = 0; h h = 0.
template <Ring R>
[[nodiscard]] std::optional<Defect> first_defect(const Reduction<R>& reduction);

/// Both reductions (laws prefixed "left: ", "right: "), and that they share the big complex.
template <Ring R>
[[nodiscard]] std::optional<Defect> first_defect(const Equivalence<R>& equivalence);

/// The three complexes; i and j chain maps; r i = 1; j s = 1; i r + s j = 1.
template <Ring R>
[[nodiscard]] std::optional<Defect> first_defect(const ExactSequence<R>& sequence);

/// The first nonzero entry of a residual that `law` says is zero.
template <Ring R>
[[nodiscard]] std::optional<Defect> first_nonzero(std::string law, const GradedMap<R>& residual);

}  // namespace sesame::reductions
