/// \file
/// Graded linear maps between finite graded modules: one matrix per degree of the source.
#pragma once

#include <optional>
#include <vector>

#include "reductions/chain_complex.hpp"

namespace sesame::reductions {

/// Where two graded maps differ: the degree of the source generator, then row and column of that degree's matrix.
struct Place {
  int degree;
  Index row;
  Index column;
};

/// A linear map of degree k between graded modules C and D: matrices at(p): C_p -> D_{p+k}.
///
/// Chain maps have k = 0, homotopies k = 1, differentials k = -1. Identities stay implicit (Rest::identity) as long as
/// nothing but the identity is asked of them.
template <Ring R>
class GradedMap {
 public:
  using Element = typename R::Element;

  /// The map whose matrices are `parts`, for p = 0, 1, ..., source.size() - 1; parts[p] is |D_{p+k}| x |C_p|.
  GradedMap(R ring, int degree, Sizes source, Sizes target, std::vector<Matrix<R>> parts);
  static GradedMap zero(R ring, int degree, Sizes source, Sizes target);
  static GradedMap identity(R ring, const Sizes& sizes);

  [[nodiscard]] const R& ring() const { return ring_; }
  /// The shift k of degrees.
  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] const Sizes& source() const { return source_; }
  [[nodiscard]] const Sizes& target() const { return target_; }
  /// The matrix C_p -> D_{p+k}, for every p: an empty one of the right shape where a side is empty.
  [[nodiscard]] const Matrix<R>& at(int p) const;
  /// Replaces at(p). Requires: the same shape, p a degree of the source.
  void set(int p, Matrix<R> part);
  /// The image of a chain. Requires: a chain of the source's generators.
  [[nodiscard]] Chain<R> apply(const Chain<R>& chain) const;

  [[nodiscard]] bool is_zero() const;
  /// this += a * other. Requires: same ring, degree, source and target.
  void add(const Element& a, const GradedMap& other);
  /// The same matrices between the modules with all degrees raised: source by `source_up`, target by `target_up`; both
  /// at least 0. The degree becomes k + target_up - source_up. (Suspensions, of which cones are made.)
  [[nodiscard]] GradedMap raised(int source_up, int target_up) const;

  /// Composition: first b, then a. Requires: target of b = source of a.
  friend GradedMap operator*(const GradedMap& a, const GradedMap& b) { return a.after(b); }
  friend GradedMap operator+(GradedMap a, const GradedMap& b) {
    a.add(a.ring_.one(), b);
    return a;
  }
  friend GradedMap operator-(GradedMap a, const GradedMap& b) {
    a.add(a.ring_.negate(a.ring_.one()), b);
    return a;
  }
  friend GradedMap operator-(GradedMap a) {
    a.negate();
    return a;
  }
  /// Same degree, modules and matrices, whatever those store.
  friend bool operator==(const GradedMap& a, const GradedMap& b) { return a.equals(b); }

 private:
  GradedMap(R ring, int degree, Sizes source, Sizes target);

  [[nodiscard]] GradedMap after(const GradedMap& first) const;
  void negate();
  [[nodiscard]] bool equals(const GradedMap& other) const;
  /// The degrees p for which C_p or D_{p+k} may be nonzero: the range of parts_.
  [[nodiscard]] int lowest() const { return std::min(0, -degree_); }
  [[nodiscard]] int highest() const;

  R ring_;
  int degree_;
  Sizes source_;
  Sizes target_;
  std::vector<Matrix<R>> parts_;  // for lowest()..highest(), then the empty matrix
};

/// The first place, by degree, then column, where two maps of the same shape differ.
template <Ring R>
[[nodiscard]] std::optional<Place> first_difference(const GradedMap<R>& a, const GradedMap<R>& b);

/// d of a complex as a map of degree -1.
template <Ring R>
[[nodiscard]] GradedMap<R> differential(const ChainComplex<R>& complex);
/// The complex with this differential. Requires: degree -1, source = target.
template <Ring R>
[[nodiscard]] ChainComplex<R> complex_with(const GradedMap<R>& differential);
template <Ring R>
[[nodiscard]] GradedMap<R> identity_of(const ChainComplex<R>& complex);

/// d phi - phi d: zero exactly when phi: C -> D commutes with the differentials.
template <Ring R>
[[nodiscard]] GradedMap<R> commutator(const GradedMap<R>& phi, const ChainComplex<R>& source,
                                      const ChainComplex<R>& target);

/// The modules side by side, degree by degree.
[[nodiscard]] Sizes sum(const Sizes& a, const Sizes& b);
/// [[a, b], [c, d]] : X + Y -> U + V, for a: X -> U, b: Y -> U, c: X -> V, d: Y -> V of one degree.
/// An identity block matrix of identities stays implicit.
template <Ring R>
[[nodiscard]] GradedMap<R> block_map(const GradedMap<R>& a, const GradedMap<R>& b, const GradedMap<R>& c,
                                     const GradedMap<R>& d);
/// [[a, 0], [0, d]].
template <Ring R>
[[nodiscard]] GradedMap<R> diagonal(const GradedMap<R>& a, const GradedMap<R>& d);
/// [a, b] : X + Y -> U.
template <Ring R>
[[nodiscard]] GradedMap<R> beside(const GradedMap<R>& a, const GradedMap<R>& b);
/// [a ; c] : X -> U + V.
template <Ring R>
[[nodiscard]] GradedMap<R> stacked(const GradedMap<R>& a, const GradedMap<R>& c);

}  // namespace sesame::reductions
