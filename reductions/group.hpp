/// \file
/// Finitely generated abelian groups: canonical form, sums, products, Künneth and universal coefficients.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sparse/chain.hpp"

namespace sesame::reductions {

/// Z^rank + Z/t_1 + ... + Z/t_k with 1 < t_1 | t_2 | ... | t_k: two are isomorphic exactly when they are equal.
/// Over a field: a vector space, rank its dimension, without torsion.
struct AbelianGroup {
  sparse::Index rank = 0;
  std::vector<sparse::Integer> torsion;

  [[nodiscard]] bool is_trivial() const { return rank == 0 && torsion.empty(); }
  /// "0", "Z", "Z^2 + Z/2", "Z + (Z/2)^2 + Z/4"; with a field's name as `ring`: "Z/2", "(Z/2)^3".
  [[nodiscard]] std::string to_string(const std::string& ring = "Z") const;

  friend bool operator==(const AbelianGroup&, const AbelianGroup&) = default;
};

/// The direct sum of cyclic groups Z/n, one for each order n, in any order: 0 stands for Z, 1 and -1 for the trivial
/// group. Cost: O(orders^2) greatest common divisors.
[[nodiscard]] AbelianGroup group_of(std::span<const sparse::Integer> orders);

[[nodiscard]] AbelianGroup direct_sum(const AbelianGroup& a, const AbelianGroup& b);
/// A (x) B over Z; over a field, with its dimensions, likewise.
[[nodiscard]] AbelianGroup tensor(const AbelianGroup& a, const AbelianGroup& b);
/// Tor(A, B) over Z.
[[nodiscard]] AbelianGroup tor(const AbelianGroup& a, const AbelianGroup& b);

/// The homology of a product from that of its factors, degrees 0, 1, ...:
/// H_n = sum of H_p (x) H'_{n-p}  +  sum of Tor(H_p, H'_{n-1-p}).
/// The answer goes up to the sum of the top degrees, and one further when a Tor is left there.
[[nodiscard]] std::vector<AbelianGroup> kunneth(std::span<const AbelianGroup> a, std::span<const AbelianGroup> b);

/// Betti numbers over Z/p from integral homology: rank of H_n, plus the p-torsion of H_n and of H_{n-1}.
/// Goes one degree further than `groups` when the last of them has p-torsion. Requires: p a prime.
[[nodiscard]] std::vector<sparse::Index> betti_numbers_modulo(std::span<const AbelianGroup> groups, std::uint32_t p);

}  // namespace sesame::reductions
