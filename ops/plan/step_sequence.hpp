/// \file
/// A step as a short exact sequence: i, j, r, s as sparse matrices with implicit identity. And the chain complex of the
/// cells at any moment of the history.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ops/cells/structure.hpp"
#include "reductions/by_columns.hpp"
#include "reductions/exact_sequence.hpp"

namespace sesame::ops {

[[nodiscard]] inline Moment now(const Structure& structure) { return structure.now(); }

/// The cells that generate a chain complex.
using CellBasis = reductions::Basis<CellId>;

/// The cells that were current at a moment, by increasing id. Cost O(cells created by then).
[[nodiscard]] CellBasis cells_at(const Structure& structure, Moment moment);

/// The chain complex of the cells of a basis at a moment: each boundary is the signed sum of the faces as they were
/// then. Faces outside the basis count as 0 (a quotient). Cost: the size of the complex.
template <sparse::Ring R>
[[nodiscard]] reductions::ChainComplex<R> chain_complex(const Structure& structure, const CellBasis& basis,
                                                        Moment moment, const R& ring);

/// The first face law that a cell of the basis breaks now, as a sentence; nothing when all hold. Abstract simplices
/// should have the faces that their vertices say, too. Cost: the laws.
[[nodiscard]] std::optional<std::string> first_broken_face_law(const Structure& structure, const CellBasis& basis);

/// Which of its three complexes a sequence makes from the other two.
enum class Direction : std::uint8_t {
  forward,   ///< C2 from C0 and C1: identification, degeneracy
  backward,  ///< C1 from C0 and C2: adding cells, cones, de-identification
  kernel,    ///< C0 from C1 and C2: removing cells
};

/// A step as an effective short exact sequence 0 -> C0 -i-> C1 -j-> C2 -> 0 with retractions r and s.
///
/// Identification and degeneracy (forward): C1 is the object before, C2 after, C0 = the removed cells; for a cell x
/// removed in favour of y, or of y = 0 when it became degenerate (y is -1 times a cell when orientations differ): i(x)
/// = y - x, r(x) = -x, j(x) = y, s(y) = y, and d0 = r d1 i. C1 lists the cells that stay first, in the order of C2: so
/// s and the rest of j are implicit identities, and only the removed cells have stored columns.
///
/// Adding cells, cones (backward): C0 is the object before, C1 after, C2 = the new cells modulo the old ones; i and r
/// are implicit identities, and only the new cells have stored columns.
///
/// De-identification (backward): C2 is the object before, C1 after, C0 is spanned by the copies as differences; for a
/// copy y of x: i(y) = y - x, r(y) = y, j(y) = x, s the identity of the old cells, d0 = r d1 i.
///
/// Removing cells (kernel): C1 is the object before, C0 after, C2 = the cells that go, modulo those that stay; i and r
/// are implicit identities, and only the cells that go have stored columns.
///
/// A replacement is two of these: the new cells are added, then those that they replace are removed.
///
/// Source: S. Peltier's habilitation (2023), section 3.3.3; W. Rharbaoui's thesis (2022).
template <sparse::Ring R>
struct StepSequence {
  Direction direction;
  reductions::ExactSequence<R> sequence;
  CellBasis basis0, basis1, basis2;
};

/// The sequences of a step of some kind that led from one moment to the next, in their order: one; two for a
/// replacement; none for a step that changed no cells, and for a product, which is a tensor product and no sequence.
/// Cost: the size of the object (the complexes are written out); the maps store only what the step touched.
template <sparse::Ring R>
[[nodiscard]] std::vector<StepSequence<R>> step_sequences(const Structure& structure, StepKind kind, Moment before,
                                                          Moment after, const R& ring);

}  // namespace sesame::ops
