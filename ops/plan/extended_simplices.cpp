#include "ops/plan/extended_simplices.hpp"

#include <fmt/format.h>

#include <bit>
#include <memory>
#include <utility>

#include "ops/cells/dart_simplices.hpp"
#include "ops/maps/orbits.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/sewing.hpp"
#include "ops/plan/simplices_of_darts.hpp"

namespace sesame::ops {
namespace {

class SimplexExtension {
 public:
  SimplexExtension(const GatheredMaps& gathered, const Structure& structure, Plan& plan)
      : gathered_{gathered},
        map_{gathered.map},
        structure_{structure},
        plan_{plan},
        below_{structure, gathered.dimension},
        apex_{IndexSet{1} << (gathered.dimension + 1)} {}

  Status run(const Limits& limits) {
    if (Status s = find_orbits(limits); !s) {
      return s;
    }
    if (Status s = check_names(); !s) {
      return s;
    }
    plan_.first = structure_.cells().size();
    for (int size = 0; size <= gathered_.dimension + 1; ++size) {
      for (IndexSet set = 0; set <= map_.indices(); ++set) {
        if (Status s = std::popcount(set) == size ? add_cones(set) : Status{Done{}}; !s) {
          return s;
        }
      }
    }
    join_bodies(bodies_, plan_);
    return write_darts();
  }

 private:
  [[nodiscard]] Dart dart(Dart local) const { return gathered_.darts[local]; }
  [[nodiscard]] std::string name(IndexSet set, Dart local) const { return below_.name(set | apex_, dart(local)); }

  Status find_orbits(const Limits& limits) {
    if (Status s = check_room(static_cast<std::int64_t>(apex_), structure_, limits); !s) {  // one for each set
      return s;
    }
    std::int64_t count = 0;
    for (IndexSet set = 0; set <= map_.indices(); ++set) {
      orbits_.push_back(orbits(map_, map_.indices() & ~set));
      count += orbits_.back().count();
    }
    first_.resize(orbits_.size());
    return check_room(count, structure_, limits);
  }

  /// The new simplices are called after the least darts of their orbits.
  Status check_names() const {
    for (IndexSet set = 0; set < orbits_.size(); ++set) {
      for (const Dart first : orbits_[set].first) {
        if (const std::string cell = name(set, first); structure_.is_name_taken(cell)) {
          return Error{Errc::bad_input,
                       fmt::format("the name \"{}\" is in use, and would be one of a new simplex", cell)};
        }
      }
    }
    return Done{};
  }

  [[nodiscard]] CellId cone(IndexSet set, Dart local) const { return first_[set] + orbits_[set].of[local]; }

  /// What all darts of each orbit see.
  Result<std::vector<Value>> bases(IndexSet set) {
    const Orbits& of_set = orbits_[set];
    std::vector<Value> found(of_set.count());
    for (Dart local = 0; local < map_.size(); ++local) {
      const Result<Value> value = below_.seen(set, dart(local));
      if (!value) {
        return value.error();
      }
      const std::uint32_t orbit = of_set.of[local];
      const Dart first = of_set.first[orbit];
      if (local == first) {
        found[orbit] = *value;
        bodies_.insert(structure_.body_of(value->cell));
      } else if (!(found[orbit] == *value)) {
        return Error{Errc::refused,
                     fmt::format("what \"{}\" belongs to has been split, and not by unsewing: \"{}\" and \"{}\" should "
                                 "see one simplex {}",
                                 name_of_dart(gathered_.dimension, dart(first), structure_),
                                 name_of_dart(gathered_.dimension, dart(first), structure_),
                                 name_of_dart(gathered_.dimension, dart(local), structure_), text_of_numbers(set))};
      }
    }
    return found;
  }

  Status add_cones(IndexSet set) {
    const Result<std::vector<Value>> base = set != 0 ? bases(set) : std::vector<Value>(orbits_[0].count());
    if (!base) {
      return base.error();
    }
    first_[set] = plan_.first + static_cast<std::uint32_t>(plan_.cells.size());
    const TypeId type = structure_.types().simplex(std::popcount(set));
    for (std::uint32_t orbit = 0; orbit < orbits_[set].count(); ++orbit) {
      const Dart first = orbits_[set].first[orbit];
      const std::size_t first_face = plan_.faces.size();
      for (IndexSet rest = set; rest != 0; rest &= rest - 1) {
        add_face({cone(set & ~(IndexSet{1} << std::countr_zero(rest)), first), same_order}, plan_);
      }
      if (set != 0) {
        add_face(structure_.values().incidence_of((*base)[orbit]), plan_);
      }
      plan_.names += name(set, first);
      add_cell(type, first_face, plan_);
    }
    return Done{};
  }

  /// What (n+1)-sewing glues are the n-simplices that there were, what i-sewing does the new ones without i.
  Status write_darts() {
    const int n = gathered_.dimension;
    Dart local = 0;
    for (const std::uint32_t number : gathered_.maps) {
      const DartStore::Made& map = structure_.darts().map(number);
      auto cells = std::make_shared<DartCells>();
      cells->of.resize(static_cast<std::size_t>(n) + 2);
      for (Dart d = map.first; d < map.first + map.count; ++d, ++local) {  // none of these is ever taken out
        for (int i = 0; i <= n; ++i) {
          const CellId side = cone(map_.indices() & ~(IndexSet{1} << i), local);
          cells->of[static_cast<std::size_t>(i)].push_back({side, 0});
        }
        const Result<CellId> largest = below_.made(d);
        if (!largest) {
          return largest.error();
        }
        cells->of.back().push_back({*largest, 0});
      }
      plan_.extended.push_back({number, std::move(cells)});
    }
    return Done{};
  }

  const GatheredMaps& gathered_;
  const GMap& map_;
  const Structure& structure_;
  Plan& plan_;
  SimplicesOfDarts below_;
  IndexSet apex_;
  std::vector<Orbits> orbits_;  // per set of numbers
  std::vector<CellId> first_;   // and the first of its cones
  std::set<BodyId> bodies_;
};

}  // namespace

Status extend_simplices(const GatheredMaps& gathered, const Structure& structure, const Limits& limits, Plan& plan) {
  return SimplexExtension(gathered, structure, plan).run(limits);
}

}  // namespace sesame::ops
