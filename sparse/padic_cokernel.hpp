/// \file
/// The cokernel of a nonsingular integer matrix that has few summands, by p-adic lifting.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sparse/chain.hpp"

namespace sesame::sparse {

/// Z^n modulo the columns of a square matrix A, det A not 0, as a sum of k cyclic groups of orders s_1 | ... | s_k.
///
/// 1. *A map.* Solutions W of W A = right sides at random, modulo 1, are a homomorphism of Z^n / A Z^n to (Q/Z)^k;
///    nearly always it is injective.
/// 2. *Generators.* Few vectors at random with one to three entries, whose images generate a group as large as all,
///    that is of the product of the invariant factors, which are known and proved (see padic_smith.hpp).
/// 3. *Coordinates.* Small Smith forms say how the images of the unit vectors are written in those, and how those are
///    related.
/// 4. *Proof.* The coordinates of the columns of A are 0 modulo the orders, those of the generators are unit vectors.
///    So they are an isomorphism onto the group of that order. A failure of this is a broken contract.
///
/// What bounds is the solution of a system of equations, J. Dixon 1982, each time. So a generator is as short as it can
/// be, and what bounds its multiple has entries of the size of its order; transforms have larger ones.
class PadicCokernel {
 public:
  using Vector = Terms<Integers>;

  /// Nothing when det A is 0, when there are many summands, or when chance does not help: elimination is the way then.
  /// Cost: some fifty products of matrices of that size in machine words, when det A has some hundred digits.
  static std::optional<PadicCokernel> of(const std::vector<Vector>& columns);

  [[nodiscard]] const std::vector<Integer>& orders() const;

  struct Generator {
    Vector vector;
    Vector bounding;  ///< A bounding = order * vector
  };
  /// Cost: a system of equations.
  [[nodiscard]] Generator generator(std::size_t k) const;

  struct Class {
    std::vector<Integer> coefficients;  ///< between 0 and the orders
    Vector bounding;                    ///< v = sum of coefficients times generators + A bounding
  };
  /// Cost: a system of equations.
  [[nodiscard]] Class class_of(const Vector& v) const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

/// Whether the columns of a matrix are independent modulo a certain large prime, hence over Z. When not, they may be
/// still, but hardly are.
[[nodiscard]] bool is_independent_modulo_a_prime(Index rows, const std::vector<Terms<Integers>>& columns);

}  // namespace sesame::sparse
