/// \file
/// Which cells a rewiring of darts replaces by others.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "ops/maps/cell_boundary.hpp"
#include "ops/plan/cone_cells.hpp"
#include "ops/plan/naming_darts.hpp"
#include "ops/plan/rewired_map.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// Goes through the cells that rewired darts belong to, by dimension. A cell stays if its darts will still see the same
/// canonical boundary and the same faces, though some of them may be others: then these see it from now on. Where a
/// cell falls apart one part keeps it, that with the dart that it is called by; where several come together one of them
/// stays, that of most darts. All others are replaced, and with them what has them as faces.
///
/// Threads: one at a time, for queries too.
class RewiredCells {
 public:
  /// `name(i, dart)`: that of a new cell after a dart.
  RewiredCells(const RewiredMap& map, const Structure& structure, std::function<std::string(int, Dart)> name,
               Plan& plan)
      : map_{map}, structure_{structure}, naming_{structure}, name_{std::move(name)}, plan_{plan} {}

  /// New cells, what darts see newly, and deletions, into the plan.
  /// Errors    refused, naming a dart: a new cell is no ball, and should be one; cells have been split, or glued to
  ///           others, and not by sewing.
  /// Cost      The darts of the cells that are looked at, times the dimension, and what new types cost.
  Status run();

 private:
  struct OldCell {
    std::vector<Dart> darts;
    CellId cell;
    Dart naming = no_dart;  ///< the dart that it is called by, if it is one of these
    bool is_kept = false;
  };
  /// A cell as a dart sees it: which dart of the cell that is, of one that is no ball 0. A value would say as much, and
  /// have a type for each dart of a cell.
  struct SeenCell {
    CellId cell = none;
    Dart place = 0;
    bool is_degenerate = false;
    friend bool operator==(const SeenCell&, const SeenCell&) = default;
  };
  using Seen = std::unordered_map<Dart, SeenCell>;

  Status add_level(int i);
  Status add_old_cell(int i, Dart d);
  Status check_seen(int i, const OldCell& old) const;
  Status add_cell(int i, Dart d);
  bool keep(int i, const CellBoundary& boundary, const std::vector<Dart>& darts, OldCell& old);
  Status make(int i, const CellBoundary& boundary, const std::vector<Dart>& darts);
  Status make_cone(const CellBoundary& boundary, const std::vector<Dart>& darts);
  void take(const OldCell& old);
  Status finish();
  Status check_alone(int i, const OldCell& old) const;

  [[nodiscard]] Result<SeenCell> seen_before(int i, Dart d) const;
  [[nodiscard]] SeenCell seen_after(int i, Dart d) const;
  [[nodiscard]] Value value_of(const SeenCell& seen) const;
  [[nodiscard]] Result<Value> value_before(int i, Dart d) const;
  [[nodiscard]] Result<Value> value_after(int i, Dart d) const;
  [[nodiscard]] bool is_face(const std::vector<Value>& faces, const SeenCell& cell, int i, Dart d,
                             const SeenCell& below) const;
  [[nodiscard]] SeenFace face_seen_after(int i, Dart d) const;
  [[nodiscard]] std::vector<Value> faces_of(CellId cell) const;
  [[nodiscard]] SeenCell face_at(const std::vector<Value>& faces, TypeId type, Dart place) const;
  void see(int i, Dart d, CellId cell, Dart place);
  [[nodiscard]] std::string text(Dart d) const;

  const RewiredMap& map_;
  const Structure& structure_;
  NamingDarts naming_;
  std::function<std::string(int, Dart)> name_;
  Plan& plan_;

  // Of one dimension.
  std::vector<OldCell> old_;
  std::unordered_map<Dart, std::size_t> old_of_;
  Seen before_, after_;
  std::set<Dart> sees_others_;
  std::vector<Seen> levels_;  // what darts see newly, or again, in the dimensions below
  std::set<Dart> rewired_;

  std::vector<CellId> taken_;
  std::unordered_set<CellId> kept_;
  std::set<BodyId> bodies_;
};

}  // namespace sesame::ops
