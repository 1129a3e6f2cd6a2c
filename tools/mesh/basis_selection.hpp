/// \file
/// Choosing a basis of a free module from a sequence of vectors, one after the other.
#pragma once

#include <vector>

#include "sparse/chain.hpp"
#include "sparse/ring.hpp"

namespace sesame::tools {

/// Takes vectors of R^n for as long as those taken can be completed to a basis of R^n. Over a field that means
/// independent; over Z that the quotient by what is taken is free, so (2, 0) is refused, and (1, 1) is refused after
/// (1, -1).
///
/// Kept as the map from R^n onto that quotient: the image of each unit vector, sparse. A vector can be taken when its
/// image is primitive; the quotient then loses the coordinate of a unit entry of it.
/// Cost of a vector: its image; of one that is taken: n, plus the images that have the coordinate that goes.
template <sparse::Ring R>
class BasisSelection {
 public:
  using Vector = sparse::Terms<R>;

  BasisSelection(R ring, sparse::Index rank);

  /// Takes a vector (in normal form), or changes nothing and returns false.
  bool take(const Vector& vector);
  /// The number of vectors that a basis still needs.
  [[nodiscard]] sparse::Index missing() const { return missing_; }
  /// `missing()` vectors that complete what was taken to a basis; unit vectors, as far as that can be.
  [[nodiscard]] std::vector<Vector> completion() const;

 private:
  [[nodiscard]] Vector image(const Vector& vector) const;
  void make_unit(Vector& image);
  void change_basis(Vector& image, sparse::Index reduced, sparse::Index by);

  R ring_;
  sparse::Index missing_;
  std::vector<Vector> images_;       ///< of the unit vectors of R^n, in the coordinates of the quotient
  std::vector<Vector> lifts_;        ///< per coordinate of the quotient: a vector of R^n with that image
  std::vector<bool> is_coordinate_;  ///< coordinates of the quotient are those of R^n that are left
};

#define SESAME_EXTERN(R) extern template class BasisSelection<R>;
SESAME_FOR_EACH_RING(SESAME_EXTERN)
#undef SESAME_EXTERN

}  // namespace sesame::tools
