/// \file
/// The vocabulary of construction steps, as plain values; and their text form, one JSON object a line.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "ops/maps/gmap.hpp"
#include "ops/vocabulary/cell_list.hpp"
#include "ops/vocabulary/name_lists.hpp"
#include "sparse/integer.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

using sparse::Integer;

/// A standard simplex with all its faces. `at`: empty, or a point per vertex.
struct MakeSimplex {
  std::string name;
  int dimension = 0;
  std::vector<Point> at;
};

/// A product of simplices with all its faces. `at`: a point per vertex, in lexicographic order of the vertices.
struct MakeSimploid {
  std::string name;
  CellType type;
  std::vector<Point> at;
};

/// An explicit complex; cells may be listed in any order.
struct MakeComplex {
  using Cell = ListedCell;
  std::string name;
  CellList cells;
};

/// An n-G-map: lists of images of its darts, under alpha_0 to alpha_n. `at`: empty, or a point per vertex, in the order
/// of their least darts.
struct MakeGMap {
  std::string name;
  std::vector<std::vector<Dart>> alpha;
  bool as_simplices = false;  ///< by the simplices of its simplicial analogue instead of its cells
  std::vector<Point> at = {};
};

/// An n-map, oriented: lists of images of its darts under beta_1 to beta_n, no_dart where they are free. It is the
/// G-map with two darts k and k' for each of its darts k.
struct MakeMap {
  std::string name;
  std::vector<std::vector<Dart>> beta;
  bool as_simplices = false;
  std::vector<Point> at = {};
};

/// A 2-G-map of one face, whose side s has the darts 2s and 2s + 1.
struct MakePolygon {
  std::string name;
  int sides = 0;
  bool as_simplices = false;
  std::vector<Point> at = {};
};

/// A closed CF-order, an incidence graph: cells with their faces and no jump in dimension.
struct MakeIncidence {
  std::string name;
  CellList cells;             ///< no types, no boundaries
  bool as_simplices = false;  ///< by the chains of its cells
};

/// A chain of maps. Level i: involutions alpha_0 to alpha_{i-1} of its darts, and their images under sigma_i, darts of
/// level i-1; of level 0, whose darts have no involution, only the number. `at`: empty, or a point per vertex.
struct MakeChainOfMaps {
  struct Level {
    std::vector<std::vector<Dart>> alpha;
    std::vector<Dart> sigma;  ///< of level 0: empty
  };
  std::string name;
  Dart points = 0;            ///< the darts of level 0
  std::vector<Level> levels;  ///< from level 1 on
  bool as_simplices = false;
  std::vector<Point> at = {};
};

/// Takes a cell of a map out: what it lay between becomes one cell.
struct RemoveCell {
  std::string cell;  ///< as a dart of it names it
};

/// Shrinks a cell of a map, the dual of removal: its ends become one cell.
struct ContractCell {
  std::string cell;
};

/// Puts a cell into a cell of one dimension more, which it cuts: what a removal of it would take back.
struct InsertCell {
  std::string name;  ///< of the map of the new darts
  int dimension = 0;
  std::vector<std::string> darts;
  std::optional<Point> at;  ///< of a new vertex
};

/// Draws a cell of a map apart, the dual of an insertion: what a contraction of the new cell would take back.
struct SplitCell {
  std::string name;  ///< of the map of the new darts
  int dimension = 0;
  std::vector<std::string> darts;
  std::optional<Point> at;  ///< of a new vertex
};

/// Makes pairs of free darts images of one another under an involution, each with its orbit.
struct Sew {
  int dimension = 0;
  std::vector<std::pair<std::string, std::string>> pairs;
};

/// Takes the sewing of darts under an involution back, of each with its orbit.
struct Unsew {
  int dimension = 0;
  std::vector<std::string> darts;
};

/// Makes maps with all that is sewn to them maps of one dimension more: each component gets the cell over it.
struct Extend {
  std::vector<std::string> maps;
};

/// What a cone or a suspension is taken over: everything, a body, or the closure of some cells.
using ConeBase = std::variant<std::monostate, std::string, std::vector<std::string>>;

struct MakeCone {
  std::string apex;
  ConeBase over;
  std::optional<Point> at;
};

/// Two cones over the same cells. `at`: empty, or a point per apex.
struct MakeSuspension {
  std::array<std::string, 2> apexes;
  ConeBase over;
  std::vector<Point> at;
};

/// Glues pairs of cells, and all that this entails on their faces.
struct Identify {
  /// For each component of the type, to which vertex of the second cell each vertex of the first is glued.
  using Map = std::vector<std::vector<int>>;
  std::vector<std::pair<std::string, std::string>> pairs;
  std::map<std::size_t, Map> maps = {};  ///< of those pairs, by position, that are not glued in order
};

/// Squashes a cell so that it becomes the degenerate s^i_j of its face d^i_j, and all that this entails.
struct Degenerate {
  std::string cell;
  std::optional<int> component;  ///< i, counted from 1; may be left out for a simplex
  int index = 0;                 ///< j
};

/// Splits cells: each gets a copy, to which the incidences listed go (face number k, in flattened order, of a cell).
struct Deidentify {
  struct Split {
    std::string cell, copy;
    std::vector<std::pair<std::string, std::int64_t>> moves;
  };
  std::vector<Split> splits;
};

/// Consumes two bodies, or one twice, and makes their product: of simploids, or triangulated.
struct MakeProduct {
  std::string name, left, right;
  bool simplicial = false;
};

/// Adds simplices, each a list of vertices, and their faces as far as they are missing, to an abstract simplicial
/// complex. A label is a text; an integer is written in decimal, so 3 and "3" are the same label.
struct Insert {
  NameLists simplices;    ///< by their labels
  bool exist_ok = false;  ///< simplices that are there already, or stand in the list twice, are counted, not refused
};

/// The simplicial map of an abstract complex that sends one vertex to another.
struct Collapse {
  std::string from, to;
};

/// Takes cells out of the object: those that nothing else has as a face, or whole open stars.
struct Remove {
  std::vector<std::string> cells;
  bool cofaces = false;  ///< also takes all that has one of them as a face
};

/// One of the moves by which triangulations of one space are turned into one another, as one step. The first two add
/// the new cells and take the open star of a cell away. On abstract complexes new simplices are known by their labels.
struct Replace {
  /// Bistellar: a simplex A whose link is the boundary of a simplex B that is not there goes, and A * dB becomes dA *
  /// B. `by`: the name of B, or on an abstract complex its label when it is a vertex; else empty.
  struct Flip {
    std::string cell, by;
    std::optional<Point> at;  ///< of B, when it is a vertex
  };
  /// Stellar: a simplex A goes, and its star becomes the cone over the boundary of that.
  struct Subdivision {
    std::string cell, by;     ///< the new vertex
    std::optional<Point> at;  ///< of it
  };
  /// The collapse of a vertex along an edge of an abstract complex.
  struct Contraction {
    std::string from, to;
    bool link_condition = true;  ///< refused where the links of the ends meet outside of that of the edge
  };
  std::variant<Flip, Subdivision, Contraction> move;
  /// Only adds, and besides the new cells what lies between them and the old ones: A * B, or the cone over the closed
  /// star. What was and what would be are deformation retracts of that: for those who follow classes. Not of a
  /// contraction.
  bool fills = false;
};

/// What the state should be; a field that is absent is not looked at.
struct Expect {
  std::optional<std::vector<Integer>> betti;
  std::optional<std::vector<std::vector<Integer>>> torsion;
  std::optional<Integer> euler;
  std::optional<std::vector<Integer>> cells;
};

/// Asks for the class of a chain.
struct AskClass {
  std::vector<std::pair<Integer, std::string>> chain;
};

/// Takes back the last steps.
struct Undo {
  std::uint64_t steps = 1;
};

struct Note {
  std::string text;
};

using Operation = std::variant<MakeSimplex, MakeSimploid, MakeComplex, MakeIncidence, MakeGMap, MakeMap, MakePolygon,
                               MakeChainOfMaps, MakeCone, MakeSuspension, MakeProduct, Identify, Sew, Unsew, Extend,
                               RemoveCell, ContractCell, InsertCell, SplitCell, Degenerate, Deidentify, Insert,
                               Collapse, Remove, Replace, Expect, AskClass, Undo, Note>;

/// The word that stands for an operation in a log: "simplex", "identify", ...
[[nodiscard]] std::string_view keyword(const Operation& operation);

/// The first line of a log.
struct Header {
  int version = 1;
  std::string ring = "Z";
  std::string title;
};

/// Reads one line of a log. Errors: bad_input, naming the unknown op or field, or what a field should be.
Result<Operation> parse_operation(std::string_view line);
Result<Header> parse_header(std::string_view line);
/// The same line again, in canonical form (fields in the order of the documentation, no spaces, no newline).
[[nodiscard]] std::string to_text(const Operation& operation);
[[nodiscard]] std::string to_text(const Header& header);

}  // namespace sesame::ops
