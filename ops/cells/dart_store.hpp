/// \file
/// The darts of all maps that were made: how they are sewn, and which cells they belong to.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ops/cells/cell_store.hpp"
#include "ops/cells/cell_type.hpp"
#include "ops/cells/dart_cells.hpp"
#include "ops/ids.hpp"
#include "ops/maps/gmap.hpp"
#include "sparse/archive.hpp"
#include "sparse/growing_array.hpp"

namespace sesame::ops {

/// Darts are numbered through all maps of a dimension n, in the order in which they were made. Sewing and what undoes
/// it change their involutions; cells are those that were made with them, whatever has become of these since. The darts
/// of a chain of maps are numbered for each level of it alone, and only name cells. A dart
/// that was taken out of its map keeps its number.
///
/// Everything that happens is an event, and events are undone in reverse order. Cost: O(1), or as said.
class DartStore {
 public:
  /// A map as it was made.
  struct Made {
    std::uint32_t name;  ///< its number among all names
    int dimension;
    Dart first;   ///< of its darts
    Dart count;   ///< 0: it is a chain of maps; the number of darts of a level is that of cells in `cells`
    CellId node;  ///< the first of the nodes that were made for it
    std::shared_ptr<const DartCells> cells;
    bool is_by_simplices;  ///< then what has a dimension is what sewing in it glues
    /// Of an n-map so many darts, after which those come that are called k' for the dart k of these; else 0.
    Dart halves = 0;
    [[nodiscard]] bool has_levels() const { return count == 0; }
  };

  [[nodiscard]] std::uint32_t maps() const { return static_cast<std::uint32_t>(maps_.size()); }
  [[nodiscard]] const Made& map(std::uint32_t number) const { return maps_[number]; }
  /// The map of a name, the last one that has been made under it, or null. Cost: the logarithm of the number of maps.
  [[nodiscard]] const Made* named(std::uint32_t name) const;
  /// The map that a dart was made with. Cost: the same.
  [[nodiscard]] const Made& map_of(int dimension, Dart dart) const { return maps_[number_of_map(dimension, dart)]; }
  [[nodiscard]] std::uint32_t number_of_map(int dimension, Dart dart) const;
  /// How many darts there are in maps of a dimension.
  [[nodiscard]] Dart darts(int dimension) const;
  [[nodiscard]] Dart alpha(int dimension, int i, Dart dart) const {
    return by_dimension_[static_cast<std::size_t>(dimension)].alpha[static_cast<std::size_t>(i)][dart];
  }

  /// The node of the i-cell of a dart, as it was made or as `see` said last, and which dart of it that is; the node is
  /// UINT32_MAX when it is gone for good.
  [[nodiscard]] DartCells::Seen seen(const Made& map, int i, Dart dart) const;
  /// The dimension of the cell that a dart was taken out of its map with, or nothing: it is there.
  [[nodiscard]] std::optional<int> taken_out_with(int dimension, Dart dart) const;
  /// Whether `see` has said something.
  [[nodiscard]] bool has_seen_others() const { return !sees_.empty(); }

  // ---- change
  [[nodiscard]] std::uint32_t events() const { return static_cast<std::uint32_t>(events_.size()); }
  /// The next map, with a name.
  void add(std::uint32_t name, const GMap& map, CellId node, std::shared_ptr<const DartCells> cells,
           bool is_by_simplices, Dart halves);
  /// The next one, a chain of maps: which cells the darts of each level belong to.
  void add_chain(std::uint32_t name, CellId node, std::shared_ptr<const DartCells> cells);
  /// Maps of one dimension, with all that is sewn to them, as maps of one dimension more, under the same names: the new
  /// involution fixes all darts.
  struct Extension {
    std::uint32_t map;                       ///< its number
    std::shared_ptr<const DartCells> cells;  ///< of the new map, whose offsets are nodes
  };
  void extend(std::span<const Extension> extensions);
  /// Two free darts become images of one another, or, with the same two again, free.
  void sew(int dimension, int i, Dart a, Dart b);
  void unsew(int dimension, int i, Dart a, Dart b);
  /// The i-cell of a dart is, from now on, a certain node as seen from a dart of it.
  void see(int dimension, int i, Dart dart, const DartCells::Seen& node);
  /// A dart that is free of all indices is one of the map no more, since a cell of dimension i went with it. What it
  /// saw it goes on seeing.
  void take_out(int dimension, int i, Dart dart);
  void undo_last_event();
  /// Forgets what happened: it can be undone no more.
  void forget_events() {
    events_.truncate(0);
    saw_.clear();
  }

  // ---- to an archive, without the events, and into a new store from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  /// Names are not looked at.
  void load(sparse::ArchiveReader& from, const CellStore& nodes, const TypeTable& types);
  /// How the maps of another store are taken over, of whose cells others have become.
  struct Renewed {
    std::function<std::uint32_t(std::uint32_t)> name;  ///< of a name there, here
    std::function<DartCells::Seen(const Made&, int, Dart)>
        seen;  ///< the node of a cell and which dart of it, or nothing
    std::function<bool(const Made&, int, Dart)> is_called_after;  ///< is a cell of dimension i called after this dart?
  };
  /// The maps of another store, to begin with, as far as there is something left of them: a dart that sees a cell which
  /// is there, or after which one is called, in the map itself or in one that is sewn to it. Darts are numbered anew.
  /// Cost: the darts of the other one, times the dimension.
  void begin_with(const DartStore& other, const Renewed& renewed);

 private:
  struct Dimension {
    std::vector<sparse::GrowingArray<Dart>> alpha;
    std::vector<std::uint32_t> maps;  ///< numbers
  };
  enum class What : std::uint8_t { made, sewn, unsewn, seen, taken_out };
  struct Event {
    What what;
    std::int8_t dimension, index;
    Dart a, b;  ///< darts; of what a dart sees, the dart and the number of what it saw
  };
  using Place = std::array<std::uint32_t, 3>;      ///< dimension, dimension of the cell, dart
  using DartPlace = std::array<std::uint32_t, 2>;  ///< dimension, dart
  void join(const Event& event, bool are_sewn);
  [[nodiscard]] std::vector<bool> maps_left(const Renewed& renewed) const;
  void note_map(Made map);
  void list_map(std::uint32_t number);
  [[nodiscard]] bool is_sound(const Made& map, const CellStore& nodes, const TypeTable& types) const;

  std::deque<Made> maps_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_name_;  ///< name and map, ascending
  std::array<Dimension, largest_map_dimension + 1> by_dimension_;
  sparse::GrowingArray<Event> events_;
  std::map<Place, DartCells::Seen> sees_;            ///< nodes, where they are not those that were made with the map
  std::vector<std::optional<DartCells::Seen>> saw_;  ///< before, per event of that kind
  std::map<DartPlace, std::uint32_t> taken_out_;     ///< the dimension of the cell
};

/// "3", or "3'" of an n-map: what a dart of a map is called after its name, and which one it is, or no_dart. A chain of
/// maps has no such darts.
[[nodiscard]] std::string dart_text(const DartStore::Made& map, Dart local);
[[nodiscard]] Dart dart_of_text(const DartStore::Made& map, std::string_view text);
/// The same of what is called m.i:3, in a chain of maps a dart of level i.
[[nodiscard]] Dart dart_of_text(const DartStore::Made& map, int i, std::string_view text);

}  // namespace sesame::ops
