/// \file
/// Maps in engines, sewn and unsewn at random, beside what they should be: others by simplices, and lists of darts.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ops/maps/orbits.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/groups.hpp"
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

/// Maps as lists of involutions, sewn and unsewn the plain way, beside an engine by cells.
class PlainMaps {
 public:
  PlainMaps(const AnyRing& ring, int dimension) : engine_{ring}, ring_{ring}, n_{dimension} {
    alpha_.resize(static_cast<std::size_t>(n_) + 1);
  }

  Engine& engine() { return engine_; }
  void make(const std::string& name, const GMap& map) {
    carry_out(engine_, make_map(name, map));
    const auto first = static_cast<Dart>(names_.size());
    for (std::size_t i = 0; i < alpha_.size(); ++i) {
      for (const Dart image : map.involutions()[i]) {
        alpha_[i].push_back(first + image);
      }
    }
    for (Dart d = 0; d < map.size(); ++d) {
      names_.push_back(dart_name(name, d));
    }
  }
  /// Whether something has happened.
  bool step(Random& random) {
    const auto any = [&] { return static_cast<Dart>(random.in(0, static_cast<int>(names_.size()) - 1)); };
    const Dart a = any(), b = any();
    if (top()[a] != a && random.one_in(2)) {
      carry_out(engine_, ops::Unsew{n_, {names_[a]}});
      for (const auto& [x, y] : pairs(a, top()[a])) {
        top()[x] = x;
        top()[y] = y;
      }
      return true;
    }
    if (!engine_.apply(sew_darts(n_, names_[a], names_[b]))) {
      return false;
    }
    for (const auto& [x, y] : pairs(a, b)) {
      top()[x] = y;
      top()[y] = x;
    }
    return true;
  }
  void check() {
    const GMap map = *GMap::make(alpha_);
    for (int i = 0; i <= n_; ++i) {
      REQUIRE(engine_.cells()[static_cast<std::size_t>(i)] == ops::cells(map, i).count());
    }
    Engine plain(ring_);
    carry_out(plain, make_map("m", map, true));
    REQUIRE(live_groups(engine_) == live_groups(plain));
    REQUIRE(engine_.first_defect().value_or("") == "");
    for (int i = 0; i <= n_; ++i) {  // darts see one cell if and only if they are in one orbit
      const ops::Orbits orbits = ops::cells(map, i);
      std::map<ops::CellId, std::uint32_t> orbit_of;
      for (Dart d = 0; d < map.size(); ++d) {
        std::string name = names_[d];
        name.replace(name.find(':'), 1, "." + std::to_string(i) + ":");
        const ops::CellId cell = engine_.structure().find(engine_.structure().lookup(name).value());
        REQUIRE(orbit_of.emplace(cell, orbits.of[d]).first->second == orbits.of[d]);
      }
      REQUIRE(orbit_of.size() == orbits.count());
      for (const auto& [cell, orbit] : orbit_of) {  // and what a cell is called is read as that cell
        REQUIRE(engine_.structure().find(engine_.structure().lookup(engine_.structure().name(cell)).value()) == cell);
      }
    }
  }

 private:
  std::vector<Dart>& top() { return alpha_.back(); }
  /// What is sewn with two darts.
  std::vector<std::pair<Dart, Dart>> pairs(Dart a, Dart b) {
    std::vector<std::pair<Dart, Dart>> found{{a, b}};
    std::set<Dart> met{a};
    for (std::size_t at = 0; at < found.size(); ++at) {
      for (int j = 0; j + 2 <= n_; ++j) {
        const auto& alpha = alpha_[static_cast<std::size_t>(j)];
        if (met.insert(alpha[found[at].first]).second) {
          found.emplace_back(alpha[found[at].first], alpha[found[at].second]);
        }
      }
    }
    return found;
  }

  Engine engine_;
  AnyRing ring_;
  int n_;
  std::vector<std::vector<Dart>> alpha_;
  std::vector<std::string> names_;
};

inline void sew_and_unsew(PlainMaps& maps, Random& random, int tries) {
  int since_undo = 0;
  for (int k = 0; k < tries; ++k) {
    if (maps.step(random)) {
      ++since_undo;
      maps.check();
    }
  }
  REQUIRE(since_undo > 3);
  for (int k = 0; k < since_undo; ++k) {
    carry_out(maps.engine(), ops::Undo{1});
  }
  REQUIRE(maps.engine().first_defect().value_or("") == "");
}

}  // namespace sesame::tests
