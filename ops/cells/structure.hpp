/// \file
/// The cell structure under construction, put together from its parts, and how plans change it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ops/cells/bodies.hpp"
#include "ops/cells/cell_store.hpp"
#include "ops/cells/cell_type.hpp"
#include "ops/cells/coface_index.hpp"
#include "ops/cells/cones.hpp"
#include "ops/cells/dart_store.hpp"
#include "ops/cells/directory.hpp"
#include "ops/cells/faces.hpp"
#include "ops/cells/forest.hpp"
#include "ops/cells/journal.hpp"
#include "ops/cells/lazy_cells.hpp"
#include "ops/cells/moment.hpp"
#include "ops/cells/plan.hpp"
#include "ops/cells/split_history.hpp"
#include "ops/cells/value.hpp"
#include "ops/cells/values.hpp"
#include "ops/simplicial/abstract_complex.hpp"
#include "sparse/archive.hpp"

namespace sesame::ops {

/// The cells of all bodies.
///
/// A *node* is a cell as it was created; the *current cell* that it is now is `find(node)`, or none when it has become
/// degenerate or was taken away; its *value* is its normal form. Everything is append-only but for undo, which takes
/// events of the journal back, the last one first.
///
/// Each part says what it knows. Some of them make nodes when they are asked, of lazy and of degenerate cells: that is
/// knowledge, not state, and counts against no limit.
///
/// Threads: one at a time, for queries too.
class Structure {
 public:
  Structure() { cells_.set_face_source(lazy_); }
  Structure(const Structure&) = delete;
  Structure& operator=(const Structure&) = delete;
  ~Structure() = default;

  // ---- the parts
  /// Planning interns types and orders: these two change no state.
  [[nodiscard]] TypeTable& types() const { return knowledge_->types; }
  [[nodiscard]] VertexMaps& maps() const { return knowledge_->maps; }
  [[nodiscard]] const CellStore& cells() const { return cells_; }
  [[nodiscard]] const Forest& forest() const { return forest_; }
  [[nodiscard]] const SplitHistory& splits() const { return splits_; }
  [[nodiscard]] const Faces& faces() const { return faces_; }
  [[nodiscard]] const Values& values() const { return values_; }
  [[nodiscard]] const LazyCells& lazy() const { return lazy_; }
  [[nodiscard]] const Cones& cones() const { return cones_; }
  [[nodiscard]] const CofaceIndex& coface_index() const { return coface_index_; }
  [[nodiscard]] const Bodies& bodies() const { return bodies_; }
  [[nodiscard]] const Directory& directory() const { return directory_; }
  [[nodiscard]] const AbstractComplex& abstract() const { return abstract_; }
  [[nodiscard]] const DartStore& darts() const { return darts_; }
  /// All that has happened and is not undone, what queries made included.
  [[nodiscard]] const Journal& journal() const { return journal_; }

  // ---- what is asked most
  [[nodiscard]] int dimension(CellId c) const { return cells_.dimension(c); }
  [[nodiscard]] CellId find(CellId c) const { return forest_.find(c); }
  [[nodiscard]] bool is_current(CellId c) const { return forest_.is_current(c); }
  [[nodiscard]] std::string name(CellId c) const { return directory_.name(c); }
  [[nodiscard]] BodyId body_of(CellId c) const { return bodies_.find(cells_.body(c)); }

  // ---- what names denote
  /// The node of any name, or empty, with the order in which the name has its vertices: another one when it lists
  /// vertices or labels that are not in the order of the node's vertices, or has such a name in it. Cells of bodies
  /// that a cone was taken over are those of the cone. May make a node, for a degenerate cell that only the name
  /// describes. Cost: see NameReader.
  [[nodiscard]] std::optional<Incidence> denoted(std::string_view name) const;
  /// Its node.
  [[nodiscard]] std::optional<CellId> lookup(std::string_view name) const;
  [[nodiscard]] bool is_name_taken(std::string_view name) const;
  /// The current body of a name, or empty. A body that became part of a cone is that cone's body.
  [[nodiscard]] std::optional<BodyId> lookup_body(std::string_view name) const;

  // ---- the object as a whole
  /// The number of current cells of each dimension, up to the largest that has one. Parts of cells that are no balls
  /// are none; see Bodies::parts.
  [[nodiscard]] std::span<const std::uint64_t> counts() const;
  [[nodiscard]] Moment now() const {
    return {cells_.size(), forest_.links(), splits_.moves(), lazy_.families(), splits_.copies(), cells_.asked()};
  }

  // ---- change
  /// Carries a plan out. Requires: planned for the present state. Cost: the size of the plan.
  void apply(const Plan& plan);
  /// Takes back the events from a position on. Requires: none of them is forgotten. Cost: the size of what goes.
  void truncate(Journal::Position position);
  /// Nobody will ask for events before a position, or take them back.
  void forget_events_before(Journal::Position position) { journal_.forget_before(position); }

 private:
  struct Knowledge {
    TypeTable types;
    VertexMaps maps{types};
  };

  class Renewal;
  friend class Workspace;  // which saves and loads, and begins
  /// Writes down all but the journal: what can be undone is not kept. Changes nothing.
  void save(sparse::ArchiveWriter& to) const;
  /// Into a new structure, whose journal then begins; fails what is unsound. Cost: what was made, with faces and names.
  void load(sparse::ArchiveReader& from);
  /// Into an empty structure, whose journal then begins: the present object of another one, and nothing of how it came
  /// about. Lazy cells are written out. Cells keep the names that they are called by, and bodies theirs; so do cells
  /// that became others after so many removals. Everything has other numbers. Cost: that of all nodes of the other one.
  void begin_with(const Structure& other, LinkId names_since);

  void note(EventKind kind, std::size_t number) { journal_.append(kind, static_cast<std::uint32_t>(number)); }
  void add_cells(const Plan& plan, BodyId new_body);
  void add_family(const NewFamily& family, BodyId body);
  void link(const Merge& merge);
  void take_away(CellId cell);
  void make_move(const Move& move);
  void join_bodies(BodyId a, BodyId b);
  void change_abstract(const Plan& plan, CellId first);
  void leave_abstract(const Plan& plan);
  void change_darts(const Plan& plan, CellId first);
  void note_orders(const Plan& plan, CellId first);
  void lower_kind(BodyId body, BodyKind kind);
  void count(CellId c, int change);
  [[nodiscard]] bool has_sound_bodies() const;
  [[nodiscard]] bool has_sound_families() const;
  [[nodiscard]] bool has_sound_factors(const LazyFamily& family) const;
  [[nodiscard]] bool has_sound_count(const LazyFamily& family) const;
  [[nodiscard]] bool has_sound_counts() const;

  void undo_last_event();
  void undo_last_cell();
  void undo_last_copy();
  void undo_last_removal();
  void undo_last_move();
  void undo_last_family();
  void undo_last_asked();

  std::unique_ptr<Knowledge> knowledge_ = std::make_unique<Knowledge>();
  Journal journal_;
  CellStore cells_{types()};
  Forest forest_;
  SplitHistory splits_;
  Faces faces_{cells_, forest_, splits_, maps()};
  Values values_{maps(), cells_, forest_, faces_, journal_};
  Bodies bodies_;
  LazyCells lazy_{types(), maps(), cells_, forest_, values_, bodies_, journal_};
  Cones cones_;
  CofaceIndex coface_index_{cells_, forest_, faces_, values_, cones_};
  Directory directory_{maps(), cells_, forest_, values_, lazy_, cones_, bodies_};
  AbstractComplex abstract_;
  DartStore darts_;
  std::vector<std::uint64_t> counts_;  ///< of current cells, by dimension
};

/// Whether c was a current cell of the object at a moment.
[[nodiscard]] bool was_current(const Structure& structure, CellId c, const Moment& moment);
/// The Euler characteristic of the object, that of its generators: parts of cells count there. Cost: the dimension.
[[nodiscard]] std::int64_t euler_characteristic(const Structure& structure);
/// The map of a name, or null.
[[nodiscard]] const DartStore::Made* map_named(const Structure& structure, std::string_view name);
/// The i-cell of a dart of a map as it was made, or as `DartStore::see` said last, as the dart sees it; for a map by
/// simplices what i-sewing the dart glues. Not in normal form. Empty when that is gone for good.
[[nodiscard]] std::optional<Value> seen_from_dart(const Structure& structure, const DartStore::Made& map, int i,
                                                  Dart dart);

}  // namespace sesame::ops
