/// \file
/// What an operation would do to a cell structure, as a value.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ops/cells/dart_cells.hpp"
#include "ops/cells/lazy_family.hpp"
#include "ops/cells/value.hpp"
#include "ops/ids.hpp"
#include "ops/maps/gmap.hpp"

namespace sesame::ops {

/// A node as a face: vertex k of the face is vertex order(k) of the node.
struct Incidence {
  CellId node;
  OrderId order = same_order;
};

/// `removed` becomes the cell `survivor`, vertex k of it vertex order(k): two current cells of one type whose
/// boundaries agree by then, up to the sign of the order. Or, with survivor = none, it becomes degenerate: the value
/// `becomes`, whose boundary is 0 by then.
struct Merge {
  CellId removed;
  CellId survivor;
  Value becomes;
  OrderId order = same_order;
};

/// Face number `slot` of a current cell becomes the cell `to`, in an order.
struct Move {
  CellId cell;
  std::uint32_t slot;
  CellId to;
  OrderId order;
};

/// What an insertion, a collapse or a removal of cells changes in the abstract simplicial complexes.
struct AbstractChange {
  struct Collapse {
    LabelId from, to;
    VertexId gone, kept;
  };
  std::vector<std::string> labels;  ///< of new vertices, whose numbers follow those in use
  /// The vertices of the new cells in their orders, one cell after the other.
  std::vector<VertexId> vertices;
  std::optional<Collapse> collapse;
  std::vector<CellId> renamed;   ///< cells that have the vertex `gone` and will have `kept` in its place
  std::vector<CellId> excluded;  ///< simplices that are taken away
};

/// What the darts of a factor see, by dimension and dart: values in normal form, or none where that is gone. Of a chain
/// of maps these are the darts of each level.
struct FactorDarts {
  std::vector<std::vector<Value>> seen;
};

/// A map that the new cells are made for. See DartStore.
struct NewMap {
  GMap map;                                ///< without darts: a chain of maps, whose darts of each level see cells
  std::shared_ptr<const DartCells> cells;  ///< of a product null: those are known when its family is made
  bool is_by_simplices = false;
  Dart halves = 0;                                                          ///< as in DartStore
  std::shared_ptr<const std::pair<FactorDarts, FactorDarts>> factors = {};  ///< of a product, else null
};

/// Maps that become maps of one dimension more. The offsets of cells are nodes, those of new cells their ids.
struct ExtendedMap {
  std::uint32_t map;
  std::shared_ptr<const DartCells> cells;
};

/// Two darts that become images of one another, or free again.
struct Sewing {
  int dimension, index;
  Dart a, b;
  bool is_unsewn = false;
};

/// The i-cell of a dart is from now on another one, as seen from a dart of it: a node, of a new cell its id.
struct NewlySeen {
  int dimension, of;
  Dart dart;
  DartCells::Seen node;
};

/// A dart that is taken out of its map with a cell of some dimension. Requires: by then it is free of all indices.
struct DartTakenOut {
  int dimension, with;
  Dart dart;
};

/// What a step is to the object.
enum class StepKind : std::uint8_t {
  nothing,      ///< no cell has changed
  addition,     ///< cells were made
  removal,      ///< cells became others, or degenerate: an identification, a degeneracy, a collapse
  deletion,     ///< cells were taken away
  replacement,  ///< cells were made, then others were taken away
  split,        ///< cells got copies, and incidences moved to them: a de-identification
  product,      ///< bodies became a product
  lazy_cone,    ///< bodies went under a cone that is not written out
};

/// What an operation would do, as a value: worked out by the planner without touching the structure, then applied
/// whole. New cells have the ids that follow those in use. Reusable: `clear` keeps the memory.
struct Plan {
  struct NewCell {
    TypeId type;
    std::uint32_t first_face;  ///< in `faces`
    std::uint64_t name_end;    ///< its name ends here in `names` (and begins where the one before ends), if it has one
  };
  std::vector<NewCell> cells;
  std::vector<CellId> faces;
  std::vector<std::pair<std::uint32_t, OrderId>> face_orders;  ///< of those faces, by position, that have another order
  CellId first = none;                                         ///< the id of the first new cell
  std::string names;
  /// The new cells are those of the standard simploid of this type, in its order: they are named after `new_body`, not
  /// by `names`. See Directory::add_standard.
  TypeId standard = none;
  std::vector<Merge> merges;  ///< by dimension, so that boundaries agree when their turn comes
  /// Current cells that are taken away, each after those that have it as a face.
  std::vector<CellId> deletions;
  /// Degenerate nodes to be asked for before new cells, by the position of these. Nobody has asked for them yet.
  std::vector<std::pair<std::uint32_t, Value>> degenerate;
  std::vector<CellId> sources;  ///< empty, or per new cell: the cell that it is a copy of
  /// New cells, by position, whose names stand for their vertices in another order: of a copy that of the name of the
  /// cell split, of a cell of a map the one that a dart sees.
  std::vector<std::pair<std::uint32_t, OrderId>> name_orders;
  std::vector<Move> moves;  ///< incidences that go to a copy
  /// Cones among the new cells, by position: the apex, then the cells of the cone, whose last faces are what is coned.
  struct WrittenCone {
    std::uint32_t apex, end;
    bool by_edges;
  };
  std::vector<WrittenCone> cones;
  std::optional<NewFamily> family;         ///< bodies become a product or a cone
  std::optional<AbstractChange> abstract;  ///< of an insertion or a collapse
  std::optional<std::string> new_body;     ///< the new cells make a body of this name
  std::optional<BodyId> into_body;         ///< the new cells join this body
  std::vector<BodyId> joined_bodies;       ///< become one with `into_body` (the older name stays)
  std::optional<NewMap> map;               ///< that the new body is
  std::vector<ExtendedMap> extended;
  std::vector<Sewing> sewings;
  std::vector<NewlySeen> newly_seen;
  std::vector<DartTakenOut> darts_taken_out;  ///< after the sewings
  std::uint64_t already = 0;  ///< simplices of an insertion that are there, or stand in its list more than once

  void clear();
  [[nodiscard]] bool changes_nothing() const { return cells.empty() && merges.empty() && deletions.empty() && !family; }
  [[nodiscard]] StepKind kind() const;
};

}  // namespace sesame::ops
