/// \file
/// Bodies: the connected parts of a workspace as its users see them, each with a name, and what is counted of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "ops/ids.hpp"
#include "sparse/archive.hpp"

namespace sesame::ops {

/// What is known of all cells of a body.
struct BodyKind {
  bool is_abstract = false;  ///< it is an abstract simplicial complex, made by insertions and collapses only
  bool keeps_orders = true;  ///< faces have their vertices in the order of the cells whose faces they are
  bool has_others = false;   ///< it has, or had, cells that are no simploids
  friend bool operator==(const BodyKind&, const BodyKind&) = default;
};

/// A union-find over the bodies that were made: the current body of one is `find(b)`. Everything but `find` and `made`
/// is said of current bodies, whichever body of theirs is asked with.
/// Cost of what is not said: O(log bodies).
class Bodies {
 public:
  /// Cells made in a row, [first, last).
  struct Range {
    CellId first, last;
  };
  /// A body as it was made.
  struct Made {
    std::vector<Range> cells;      ///< creations that joined this very body, lazy cells apart
    std::vector<BodyId> children;  ///< bodies linked below it
    FamilyId family = none;        ///< that it was made as
  };

  [[nodiscard]] BodyId size() const { return static_cast<BodyId>(bodies_.size()); }
  [[nodiscard]] BodyId find(BodyId b) const {
    while (bodies_[b].parent != b) {
      b = bodies_[b].parent;
    }
    return b;
  }
  [[nodiscard]] const Made& made(BodyId b) const { return bodies_[b].made; }
  /// The number of its name among all names: the oldest that any body of it had.
  [[nodiscard]] std::uint32_t name(BodyId b) const { return bodies_[bodies_[find(b)].oldest].name; }
  /// Whether it has been given one itself.
  [[nodiscard]] bool is_named(BodyId b) const { return bodies_[b].name != none; }
  /// The family whose factor it has become, or none: its cells are no longer cells of the object.
  [[nodiscard]] FamilyId consumed_by(BodyId b) const { return bodies_[find(b)].consumed_by; }
  /// The number of its current cells, by dimension.
  [[nodiscard]] std::span<const std::uint64_t> counts(BodyId b) const { return bodies_[find(b)].counts; }
  /// The number of its current cells that are no simplices: of a type longer than one.
  [[nodiscard]] std::uint64_t simploids(BodyId b) const { return bodies_[find(b)].simploids; }
  [[nodiscard]] bool has_only_simplices(BodyId b) const { return simploids(b) == 0; }
  /// How many lazy families are made of one another to make its cells.
  [[nodiscard]] std::uint32_t nesting(BodyId b) const { return bodies_[find(b)].nesting; }
  /// The current parts of cells that are no balls, of all bodies, by dimension: generators that count as no cells.
  [[nodiscard]] std::span<const std::uint64_t> parts() const { return parts_; }
  [[nodiscard]] BodyKind kind(BodyId b) const { return bodies_[find(b)].kind; }
  /// Those that are current and not consumed, oldest name first. Cost: the bodies ever made.
  [[nodiscard]] std::vector<BodyId> current() const;

  // ---- change; each has its opposite, to be called in reverse order
  BodyId add(BodyKind kind);
  void undo_last() { bodies_.pop_back(); }

  void set_name(BodyId b, std::uint32_t name) { bodies_[b].name = name; }
  void add_cells(BodyId b, Range range) { bodies_[b].made.cells.push_back(range); }
  /// Forgets a cell, the last one that was made in the body, if it is listed there.
  void drop_cell(BodyId b, CellId cell);
  /// A cell of a body has come or, with -1, has gone.
  void count(BodyId b, std::size_t dimension, bool is_simplex, int change);
  void count_part(std::size_t dimension, int change);

  /// Makes two bodies one. Returns whether they were two.
  bool join(BodyId a, BodyId b);
  [[nodiscard]] std::uint32_t unions() const { return static_cast<std::uint32_t>(unions_.size()); }
  void undo_last_union();

  /// Returns whether anything has changed.
  bool lower_kind(BodyId b, BodyKind kind);
  [[nodiscard]] std::uint32_t kind_changes() const { return static_cast<std::uint32_t>(kind_changes_.size()); }
  void undo_last_kind_change();

  /// A body has been made as a family of others, current ones, which it consumes. Calls removed(counts) for each of
  /// these that was not consumed before. With `keeps_names` it goes by the oldest name of theirs, too.
  template <class Removed>
  void become_family(BodyId b, FamilyId family, std::span<const BodyId> of, std::span<const std::uint64_t> counts,
                     std::uint64_t simploids, bool keeps_names, Removed&& removed);
  /// Calls restored(counts) for each body that is there again.
  template <class Restored>
  void undo_family(BodyId b, std::span<const BodyId> of, std::span<const std::uint64_t> counts, Restored&& restored);

  // ---- to an archive, and into new bodies from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  /// Without a look at numbers of names, cells and families.
  void load(sparse::ArchiveReader& from);

 private:
  struct Body {
    std::uint32_t name = none;
    BodyId parent = none, oldest = none;
    std::uint32_t size = 1;
    FamilyId consumed_by = none;
    std::uint32_t nesting = 0;
    BodyKind kind;
    std::uint64_t simploids = 0;
    std::vector<std::uint64_t> counts;  ///< those of the bodies below it included
    Made made;
  };
  struct Union {
    BodyId child, oldest_before;
    BodyKind kind_before;
    std::uint32_t nesting_before;
  };
  struct KindChange {
    BodyId body;
    BodyKind before;
  };

  std::deque<Body> bodies_;
  std::vector<Union> unions_;
  std::vector<KindChange> kind_changes_;
  std::vector<std::uint64_t> parts_;
};

/// Adds numbers of cells by dimension to others, or takes them away.
void add_counts(std::span<const std::uint64_t> from, std::vector<std::uint64_t>& to, bool subtract);

template <class Removed>
void Bodies::become_family(BodyId b, FamilyId family, std::span<const BodyId> of, std::span<const std::uint64_t> counts,
                           std::uint64_t simploids, bool keeps_names, Removed&& removed) {
  Body& body = bodies_[b];
  body.made.family = family;
  for (const BodyId part : of) {
    Body& consumed = bodies_[part];
    if (consumed.consumed_by == none) {  // a factor may be there twice
      consumed.consumed_by = family;
      removed(std::span<const std::uint64_t>{consumed.counts});
    }
    body.nesting = std::max(body.nesting, consumed.nesting + 1);
    if (keeps_names) {
      body.oldest = std::min(body.oldest, consumed.oldest);
    }
  }
  body.simploids = simploids;
  add_counts(counts, body.counts, false);
}

template <class Restored>
void Bodies::undo_family(BodyId b, std::span<const BodyId> of, std::span<const std::uint64_t> counts,
                         Restored&& restored) {
  bodies_[b].simploids = 0;
  add_counts(counts, bodies_[b].counts, true);
  for (const BodyId part : of) {
    if (bodies_[part].consumed_by != none) {
      bodies_[part].consumed_by = none;
      restored(std::span<const std::uint64_t>{bodies_[part].counts});
    }
  }
}

}  // namespace sesame::ops
