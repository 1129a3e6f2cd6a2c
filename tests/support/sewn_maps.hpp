/// \file
/// Maps in engines, sewn at random, beside others by simplices.
#pragma once

#include <string>
#include <vector>

#include "ops/maps/orbits.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/groups.hpp"
#include "tests/support/plain_maps.hpp"
#include "tests/support/random_complexes.hpp"
#include "tests/support/solids.hpp"

namespace sesame::tests {

/// Makes maps and sews random free darts of their largest dimension, in one engine by cells and in one by simplices.
class Sewn {
 public:
  Sewn(const AnyRing& ring, int dimension) : by_cells_{ring}, by_simplices_{ring}, dimension_{dimension} {}

  Engine& by_cells() { return by_cells_; }
  void make(const std::string& name, const GMap& map) {
    carry_out(by_cells_, make_map(name, map));
    carry_out(by_simplices_, make_map(name, map, true));
    for (Dart d = 0; d < map.size(); ++d) {
      darts_.push_back(dart_name(name, d));
    }
  }
  /// Whether two random darts could be sewn: they were free, alike, and of different cells.
  bool sew_at_random(Random& random) {
    const auto any = [&] {
      return darts_[static_cast<std::size_t>(random.in(0, static_cast<int>(darts_.size()) - 1))];
    };
    const ops::Sew op = sew_darts(dimension_, any(), any());
    const auto cells = by_cells_.apply(op);
    if (!cells) {
      if (cells.error().what.find("fold") == std::string::npos) {
        CHECK_FALSE(by_simplices_.apply(op).has_value());
      }
      return false;
    }
    carry_out(by_simplices_, op);
    return true;
  }
  void undo() {
    carry_out(by_cells_, ops::Undo{1});
    carry_out(by_simplices_, ops::Undo{1});
  }
  void check() {
    REQUIRE(live_groups(by_cells_) == live_groups(by_simplices_));
    REQUIRE(by_cells_.euler_characteristic() == by_simplices_.euler_characteristic());
    REQUIRE(by_cells_.first_defect().value_or("") == "");
  }

 private:
  Engine by_cells_, by_simplices_;
  int dimension_;
  std::vector<std::string> darts_;
};

inline void sew_at_random(Sewn& sewn, Random& random, int tries) {
  int done = 0;
  for (int k = 0; k < tries; ++k) {
    if (done > 0 && random.one_in(12)) {
      sewn.undo();
      --done;
    } else if (sewn.sew_at_random(random)) {
      ++done;
    } else {
      continue;
    }
    sewn.check();
  }
}

}  // namespace sesame::tests
