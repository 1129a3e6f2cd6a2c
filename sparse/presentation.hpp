/// \file
/// A finitely generated abelian group to which generators and relations are added one after the other.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "sparse/chain.hpp"
#include "sparse/matrix.hpp"
#include "sparse/rational_span.hpp"

namespace sesame::sparse {

/// The group Z^generators / relations as a sum of cyclic groups, with the images of the generators in it.
///
/// Each cyclic summand is a *coordinate*: free, or of a finite order > 1. A relation is written in coordinates, as w.
/// If a free coordinate has a unit in w, it is expressed by the others. If a free coordinate has an entry g that
/// divides all others, w is g times a new coordinate in its place, of order g. If w has finite coordinates only, a
/// small Smith form says what they become. Any other relation *waits*: later ones may give it a unit, and until then
/// the torsion is read off the matrix of those that wait. (Euclid's algorithm would find their divisors at once, but
/// the changes of basis that it makes soon have coefficients of hundreds of digits.)
///
/// So a relation that holds already costs itself, one with a unit the images that change, and the torsion is computed
/// anew only from what waits, after it has changed. A relation that follows from those that wait holds already, too:
/// where they leave no torsion, that is in their span, once the group has been asked for.
class Presentation {
 public:
  using Vector = Terms<Integers>;

  [[nodiscard]] bool contains(Index generator) const { return images_.contains(generator); }
  /// Adds a generator that is the combination of others, or, what is in none of the relations so far, a free one.
  /// Requires: it is not there.
  void add_generator(Index generator);
  void add_combination(Index generator, const Vector& combination);
  /// Generators that are not there are added.
  void add_relation(const Vector& relation);

  /// Generators that were added and are no combinations.
  [[nodiscard]] std::size_t generators() const { return generators_; }
  struct Group {
    std::size_t free_rank = 0;
    std::vector<Integer> torsion;  ///< invariant factors > 1, each dividing the next
  };
  /// Cost: none when it is what it was when asked last; else the relations that wait, as a matrix, and the torsion.
  [[nodiscard]] const Group& group();

 private:
  struct Coordinate {
    Integer order;             ///< 0: free; 1: there is no such coordinate any more
    std::vector<Index> users;  ///< the generators whose images have it; perhaps repeated, perhaps no longer
  };

  [[nodiscard]] Vector image_of(const Vector& combination);
  Index add_coordinate(Integer order);
  void set_image(Index generator, Vector image);
  [[nodiscard]] std::vector<Index> take_users(Index coordinate);
  void substitute(Index coordinate, const Vector& value);
  [[nodiscard]] bool follows(const Vector& relation);
  void find_implied();
  bool settle(const Vector& relation);
  void substitute_divisor(const Vector& relation, Index coordinate, const Integer& divisor);
  void relate_finite(const Vector& relation);
  void reduce(Vector& vector) const;
  [[nodiscard]] Matrix<Integers> matrix_of_waiting(std::unordered_map<Index, Index>& rows) const;
  void compute_group();

  std::unordered_map<Index, Vector> images_;  // unordered: looked up only
  std::vector<Coordinate> coordinates_;
  std::vector<Vector> waiting_;  ///< relations, in coordinates
  /// Of what waits, when it leaves no torsion: its coordinates as rows, and its span.
  struct Waiting {
    std::unordered_map<Index, Index> rows;
    std::optional<RationalSpan> span;
  };
  std::optional<Waiting> implied_;  ///< nothing: not looked for since what waits has changed
  bool leaves_torsion_ = false;     ///< what waits, when the group was computed last
  std::size_t generators_ = 0, free_coordinates_ = 0;
  Group group_;
  bool is_current_ = true;
};

}  // namespace sesame::sparse
