/// \file
/// The simplices of simplicial analogues, as new cells.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ops/cells/structure.hpp"
#include "ops/maps/orbits.hpp"
#include "ops/plan/limits.hpp"

namespace sesame::ops {

/// What a simplicial analogue is made from, as in set_of_orbits.
struct Analogue {
  int dimension;
  std::function<Orbits(IndexSet)> family;     ///< the darts of the simplices numbered I
  std::function<Dart(Dart, int, int)> lower;  ///< of a dart, where the largest number falls
  std::function<std::string(Dart)> text;      ///< what a dart is called
};

/// Writes a simplex for each set of numbers I and each orbit of its family, called `name.<0-2>:k` after the least dart
/// of that. Face k is that of the set without its k-th number. They come by the size of I, then by I as a number.
/// Threads: one at a time, for queries too.
class AnalogueWriter {
 public:
  AnalogueWriter(const std::string& name, Analogue analogue, const Structure& structure, Plan& plan);

  /// Errors    refused: the limits. Cost: n 2^n times the darts.
  Status write(const Limits& limits);
  /// The simplex of a dart, once they are written.
  [[nodiscard]] CellId simplex(IndexSet set, Dart d) const { return first_[set] + orbits_[set].of[d]; }

 private:
  Status find_orbits(const Limits& limits);
  void write_simplices(IndexSet set);
  [[nodiscard]] CellId face(IndexSet set, int without, Dart d) const;

  const std::string& name_;
  Analogue analogue_;
  const Structure& structure_;
  Plan& plan_;
  IndexSet all_;
  std::vector<CellId> first_;   ///< per set of numbers: the first of its simplices
  std::vector<Orbits> orbits_;  ///< and which one each dart is in
};

}  // namespace sesame::ops
