/// \file
/// Maps in engines, sewn at random, beside others by simplices.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ops/cells/analogue_chain.hpp"
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
    if (sparse::ring_name(by_cells_.ring()) == "Z") {
      check_subdivisions();
    }
  }

 private:
  /// The chain in the other engine, by name.
  [[nodiscard]] CellChain subdivided(const CellChain& chain) const {
    std::vector<std::pair<Integer, std::string>> terms;
    for (const auto& [coefficient, cell] : chain.terms) {
      const auto simplices = ops::in_analogue(by_cells_.structure(), cell);
      REQUIRE(simplices.has_value());
      for (const auto& [times, name] : *simplices) {
        terms.emplace_back(coefficient.numerator() * Integer{times}, name);
      }
    }
    const auto found = by_simplices_.chain(terms);
    REQUIRE(found.has_value());
    return *found;
  }
  /// Do boundaries of cells, parts of such as are no balls among them, and subdivisions commute?
  void check_subdivisions() {
    const ops::Structure& structure = by_cells_.structure();
    for (ops::CellId cell{0}; cell < structure.cells().size(); ++cell) {
      if (!structure.is_current(cell) || is_deleted(structure.forest(), cell)) {
        continue;
      }
      CAPTURE(structure.name(cell));
      const CellChain alone{structure.dimension(cell), {{1, cell}}};
      const CellChain one = by_simplices_.maps().boundary(subdivided(alone));
      const CellChain other = subdivided(by_cells_.maps().boundary(alone));
      REQUIRE(as_map(one) == as_map(other));
    }
  }
  [[nodiscard]] static std::map<ops::CellId, sparse::Rational> as_map(const CellChain& chain) {
    std::map<ops::CellId, sparse::Rational> terms;
    for (const auto& [coefficient, cell] : chain.terms) {
      terms.emplace(cell, coefficient);
    }
    return terms;
  }

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
