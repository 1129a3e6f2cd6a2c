/// \file
/// The cell structure under construction: simploids with faces, names, bodies, and the union-find of identifications.
/// Append-only; undo is truncation.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ops/cell_type.hpp"
#include "ops/name_table.hpp"

namespace sesame::ops {

/// A cell as it was created; ids count creations from 0. The *current* cell that it is now is `Structure::find(id)`.
using CellId = std::uint32_t;
/// A removal of a cell in favour of another, counted from 0 in the order in which they happened.
using LinkId = std::uint32_t;
using BodyId = std::uint32_t;
inline constexpr std::uint32_t none = UINT32_MAX;

/// `removed` becomes the cell `survivor`; both are current cells of one type whose boundaries agree by then.
struct Merge {
  CellId removed;
  CellId survivor;
};

/// What an operation would do, as a value: worked out by the planner without touching the structure, then applied
/// whole. New cells have the ids that follow those in use. Reusable: `clear` keeps the memory.
struct Plan {
  struct NewCell {
    TypeId type;
    std::uint32_t first_face;  ///< in `faces`
    std::uint64_t name_end;    ///< its name ends here in `names` (and begins where the one before ends)
  };
  std::vector<NewCell> cells;
  std::vector<CellId> faces;
  std::string names;
  std::vector<std::pair<std::string, CellId>> aliases;  ///< further names of new cells
  std::vector<Merge> merges;            ///< by dimension, so that boundaries agree when their turn comes
  std::optional<std::string> new_body;  ///< the new cells make a body of this name
  std::optional<BodyId> into_body;      ///< the new cells join this body
  std::vector<BodyId> joined_bodies;    ///< become one with `into_body` (the older name stays)

  void clear();
  [[nodiscard]] bool changes_nothing() const { return cells.empty() && merges.empty(); }
};

/// How much of everything there was at some moment: all that undo needs.
struct StructureMark {
  CellId cells = 0;
  LinkId links = 0;
  std::uint32_t names = 0;
  std::uint32_t bodies = 0;
  std::uint32_t body_links = 0;
  friend bool operator==(const StructureMark&, const StructureMark&) = default;
};

/// The cells of all bodies. Cost of every lookup below: O(1) or O(log cells).
class Structure {
 public:
  Structure();

  // ---- cells
  [[nodiscard]] TypeTable& types() const { return *types_; }
  /// The number of cells ever created (and not undone).
  [[nodiscard]] CellId created() const { return static_cast<CellId>(type_.size()); }
  [[nodiscard]] TypeId type_id(CellId c) const { return type_[c]; }
  [[nodiscard]] const TypeInfo& type(CellId c) const { return types_->info(type_[c]); }
  [[nodiscard]] int dimension(CellId c) const { return type(c).dimension; }
  /// The faces as they were given at creation, in flattened order: not yet looked up by `find`.
  [[nodiscard]] std::span<const CellId> faces_as_created(CellId c) const {
    return {faces_.data() + first_face_[c], type(c).faces.size()};
  }
  /// The current cell that c is now.
  [[nodiscard]] CellId find(CellId c) const {
    while (parent_[c] != c) {
      c = parent_[c];
    }
    return c;
  }
  /// The cell that c was when there had been only `links` removals.
  [[nodiscard]] CellId find_at(CellId c, LinkId links) const {
    while (parent_[c] != c && link_of_[c] < links) {
      c = parent_[c];
    }
    return c;
  }
  [[nodiscard]] bool is_current(CellId c) const { return parent_[c] == c; }
  /// The number of current cells of each dimension, up to the largest that has one.
  [[nodiscard]] std::span<const std::uint32_t> counts() const;

  // ---- the union-find forest: one link per removed cell, each tree at most log2(cells) deep
  [[nodiscard]] LinkId links() const { return static_cast<LinkId>(removed_.size()); }
  [[nodiscard]] CellId removed(LinkId link) const { return removed_[link]; }
  [[nodiscard]] CellId parent(CellId c) const { return parent_[c]; }
  /// The link by which c was removed, or `none`.
  [[nodiscard]] LinkId link_of(CellId c) const { return link_of_[c]; }
  /// The number of created cells that a current cell stands for.
  [[nodiscard]] std::uint32_t members(CellId current) const { return size_[current]; }

  // ---- names
  /// The cell of a name (as created: see `find`), or empty.
  [[nodiscard]] std::optional<CellId> lookup(std::string_view name) const;
  /// The canonical name of the cell that c is now: that of its member created first.
  [[nodiscard]] std::string_view name(CellId c) const { return names_[name_of_[oldest(c)]].text; }
  /// The name that c was created with.
  [[nodiscard]] std::string_view own_name(CellId c) const { return names_[name_of_[c]].text; }
  /// The member created first of the cell that c is now.
  [[nodiscard]] CellId oldest(CellId c) const { return oldest_[find(c)]; }
  [[nodiscard]] bool is_name_taken(std::string_view name) const { return names_.find(name) != nullptr; }

  // ---- bodies
  [[nodiscard]] std::optional<BodyId> lookup_body(std::string_view name) const;
  [[nodiscard]] BodyId find_body(BodyId b) const;
  [[nodiscard]] BodyId body_of(CellId c) const { return find_body(body_[c]); }
  [[nodiscard]] std::string_view body_name(BodyId b) const {
    return names_[bodies_[bodies_[find_body(b)].oldest].name].text;
  }
  /// Current bodies, oldest name first.
  [[nodiscard]] std::vector<BodyId> current_bodies() const;
  /// The current cells of a body by increasing id. Cost: the cells ever created in it.
  [[nodiscard]] std::vector<CellId> cells_of(BodyId body) const;

  // ---- change
  [[nodiscard]] StructureMark mark() const;
  /// Carries a plan out. Requires: planned for the present state. Cost: the size of the plan.
  void apply(const Plan& plan);
  /// Goes back to a mark of the past. Cost: the size of what goes.
  void truncate(const StructureMark& mark);

 private:
  struct Range {
    CellId first, last;
  };
  struct Body {
    std::uint32_t name;  ///< its number among the names
    BodyId parent, oldest;
    std::vector<Range> made;       ///< creations that joined this very body
    std::vector<BodyId> children;  ///< bodies linked below it
    std::uint32_t size = 1;
  };

  void add_cells(const Plan& plan, BodyId new_body);
  void link(const Merge& merge);
  void join_bodies(BodyId a, BodyId b);
  void count(CellId c, int change);

  std::unique_ptr<TypeTable> types_;  // behind a pointer: planning interns types, and that changes no state
  std::vector<TypeId> type_;
  std::vector<std::uint64_t> first_face_;
  std::vector<CellId> faces_;
  std::vector<CellId> parent_, oldest_;
  std::vector<std::uint32_t> size_;
  std::vector<LinkId> link_of_;
  std::vector<CellId> removed_;
  std::vector<CellId> oldest_before_;  // of the survivor, per link: what undo restores
  std::vector<std::uint32_t> counts_;

  NameTable names_;
  std::vector<std::uint32_t> name_of_;

  std::deque<Body> bodies_;
  std::vector<BodyId> body_;
  struct BodyLink {
    BodyId child, oldest_before;
  };
  std::vector<BodyLink> body_links_;
};

}  // namespace sesame::ops
