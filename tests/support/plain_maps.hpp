/// \file
/// Maps as lists of involutions, beside an engine that has them by their cells.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ops/maps/cell_surgery.hpp"
#include "ops/maps/map_product.hpp"
#include "ops/maps/orbits.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/groups.hpp"
#include "tests/support/maps.hpp"
#include "tests/support/random_complexes.hpp"
#include "tests/support/solids.hpp"

namespace sesame::tests {

/// Maps as lists of involutions, sewn and unsewn the plain way, beside an engine by cells.
class PlainMaps {
 public:
  PlainMaps(const AnyRing& ring, int dimension) : engine_{ring}, ring_{ring}, n_{dimension} {
    alpha_.resize(static_cast<std::size_t>(n_) + 1);
  }

  Engine& engine() { return engine_; }
  void make(const std::string& name, const GMap& map) {
    (void)apply(make_map(name, map)).value();
    add(name, map);
  }
  /// The product of two maps that are made for it.
  void make_product(const std::string& name, const GMap& left, const GMap& right) {
    (void)apply(make_map(name + "l", left)).value();
    (void)apply(make_map(name + "r", right)).value();
    (void)apply(ops::MakeProduct{name, name + "l", name + "r"}).value();
    add(name, ops::product(left, right));
  }
  /// Whether something has happened.
  bool step(Random& random) {
    const auto any = [&] { return static_cast<Dart>(random.in(0, static_cast<int>(names_.size()) - 1)); };
    const Dart a = any(), b = any();
    if (top()[a] != a && random.one_in(2)) {
      (void)apply(ops::Unsew{n_, {names_[a]}}).value();
      for (const auto& [x, y] : pairs(a, top()[a])) {
        top()[x] = x;
        top()[y] = y;
      }
      return true;
    }
    if (!apply(sew_darts(n_, names_[a], names_[b]))) {
      return false;
    }
    for (const auto& [x, y] : pairs(a, b)) {
      top()[x] = y;
      top()[y] = x;
    }
    return true;
  }
  /// A random local operation. Whether something has happened.
  bool operate(Random& random) {
    const auto any = [&] { return static_cast<Dart>(random.in(0, static_cast<int>(names_.size()) - 1)); };
    const GMap map = *GMap::make(alpha_);
    const Dart d = any();
    const int i = random.in(0, n_);
    const int kind = random.in(1, 6);
    if (kind <= 4) {
      const std::string cell = cell_of(i, d);
      const ops::Operation op = kind <= 3 ? ops::Operation{ops::RemoveCell{cell}} : ops::ContractCell{cell};
      const auto report = apply(op);
      const auto surgery =
          kind <= 3 ? ops::removal_of_cell(ops::view_of(map), i, d) : ops::contraction_of_cell(ops::view_of(map), i, d);
      return take(report.has_value(), surgery, map, "");
    }
    const std::string name = "n" + std::to_string(++inserted_);
    const int of = random.in(0, 1);
    std::vector<Dart> darts{d};
    if (of == 1 && random.one_in(2)) {
      darts.push_back(any());
    }
    std::vector<std::string> texts;
    for (const Dart dart : darts) {
      texts.push_back(names_[dart]);
    }
    if (kind == 5) {
      const auto report = apply(ops::InsertCell{name, of, texts, {}});
      return take(report.has_value(), ops::insertion_of_cell(ops::view_of(map), of, darts), map, name);
    }
    const auto report = apply(ops::SplitCell{name, n_ - of, texts, {}});
    return take(report.has_value(), ops::splitting_of_cell(ops::view_of(map), n_ - of, darts), map, name);
  }
  void check() {
    CAPTURE(done_);
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
        const std::string name = cell_of(i, d);
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
  void add(const std::string& name, const GMap& map) {
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

  [[nodiscard]] std::string cell_of(int i, Dart d) const {
    std::string name = names_[d];
    return name.replace(name.find(':'), 1, "." + std::to_string(i) + ":");
  }

  Result<engine::StepReport> apply(const ops::Operation& op) {
    auto report = engine_.apply(op);
    if (report) {
      done_ += ops::to_text(op) + "\n";
    }
    return report;
  }

  /// What an operation that the engine has carried out, or not, does to the plain maps.
  bool take(bool is_done, const Result<ops::CellSurgery>& surgery, const GMap& map, const std::string& name) {
    if (!is_done) {
      return false;  // a cell would be no ball, say
    }
    REQUIRE(surgery.has_value());
    alpha_ = ops::after_surgery(map, *surgery).involutions();
    std::vector<std::string> names;
    for (Dart d = 0; d < map.size(); ++d) {
      if (std::find(surgery->gone.begin(), surgery->gone.end(), d) == surgery->gone.end()) {
        names.push_back(names_[d]);
      }
    }
    for (Dart d = 0; d < surgery->made; ++d) {
      names.push_back(dart_name(name, d));
    }
    names_ = std::move(names);
    return true;
  }

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
  std::string done_;  // all steps, as a script
  int inserted_ = 0;
};

/// Also, if asked for, with local operations.
inline void sew_and_unsew(PlainMaps& maps, Random& random, int tries, bool operates = false) {
  int since_undo = 0;
  for (int k = 0; k < tries; ++k) {
    if (operates && random.one_in(2) ? maps.operate(random) : maps.step(random)) {
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
