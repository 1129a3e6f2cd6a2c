#include "tools/bench/towers.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "replay/text/text_buffer.hpp"
#include "sparse/contract.hpp"
#include "sparse/hash_index.hpp"
#include "tools/bench/draws.hpp"

namespace sesame::tools {
namespace {

using Label = std::uint64_t;
using CellId = std::uint32_t;

constexpr std::size_t most_corners = 4;
constexpr Label no_label = std::numeric_limits<Label>::max();

/// Labels ascending; behind the last one `no_label`.
using Corners = std::array<Label, most_corners>;

/// A sum over the vertices, so that it follows when one is replaced.
std::uint64_t hash_of(const Corners& corners) {
  std::uint64_t hash = 0;
  for (const Label label : corners) {
    hash += sparse::spread_bits(label);
  }
  return hash;
}

std::size_t size_of(const Corners& corners) {
  return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), no_label) - corners.begin());
}

bool has(const Corners& corners, Label label) {
  return std::find(corners.begin(), corners.end(), label) != corners.end();
}

/// `corners` with `to` in the place of one `from`.
Corners replaced(Corners corners, Label from, Label to) {
  *std::find(corners.begin(), corners.end(), from) = to;
  std::sort(corners.begin(), corners.end());
  return corners;
}

Corners extended(const Corners& corners, Label vertex) { return replaced(corners, no_label, vertex); }

/// The live complex, with what random choices need: its simplices by dimension, and the star of every vertex.
class LiveComplex {
 public:
  [[nodiscard]] std::size_t count(std::size_t dimension) const { return by_dimension_[dimension].size(); }
  [[nodiscard]] const Corners& simplex(std::size_t dimension, std::size_t i) const {
    return cells_[by_dimension_[dimension][i]].corners;
  }
  [[nodiscard]] bool contains(const Corners& corners) const {
    return ids_.find(hash_of(corners), [&](CellId id) { return cells_[id].corners == corners; }) != ids_.nothing;
  }

  void insert(const Corners& corners) {
    const CellId id = new_cell();
    Cell& cell = cells_[id];
    cell.corners = corners;
    auto& peers = by_dimension_[size_of(corners) - 1];
    cell.place = static_cast<std::uint32_t>(peers.size());
    peers.push_back(id);
    ids_.insert(hash_of(corners), id);
    for (std::size_t i = 0; i < size_of(corners); ++i) {
      push_to_star(corners[i], id);
    }
  }

  /// The simplicial map that sends u to v.
  void contract(Label u, Label v) {
    const Star star = std::move(stars_.at(u));
    stars_.erase(u);
    std::vector<Corners> moved;
    for (const auto& [id, size, birth] : star.entries) {
      if (cells_[id].birth == birth) {
        moved.push_back(cells_[id].corners);
        remove(id);
      }
    }
    for (const Corners& corners : moved) {
      if (has(corners, v)) {
        continue;
      }
      if (const Corners image = replaced(corners, u, v); !contains(image)) {
        insert(image);
      }
    }
  }

  /// A simplex that is no face of another, the given one or one over it.
  [[nodiscard]] Corners maximal_over(Corners corners) const {
    for (bool climbs = true; climbs;) {
      climbs = false;
      for (const auto& [id, size, birth] : stars_.at(corners[0]).entries) {
        const Corners& other = cells_[id].corners;
        if (cells_[id].birth == birth && size > size_of(corners) &&
            std::includes(other.begin(), other.begin() + size, corners.begin(), corners.begin() + size_of(corners))) {
          corners = other;
          climbs = true;
          break;
        }
      }
    }
    return corners;
  }

  /// Requires: it is no face of another one.
  void erase(const Corners& corners) {
    remove(ids_.find(hash_of(corners), [&](CellId id) { return cells_[id].corners == corners; }));
    if (size_of(corners) == 1) {
      stars_.erase(corners[0]);
    }
  }

  /// The vertices by which a simplex, of one vertex or more, can be extended.
  [[nodiscard]] std::vector<Label> extensions(const Corners& simplex) const {
    std::vector<Label> found;
    for (const auto& [id, size, birth] : stars_.at(simplex[0]).entries) {
      if (size != 2 || cells_[id].birth != birth) {
        continue;
      }
      const Corners& edge = cells_[id].corners;
      const Label other = edge[0] == simplex[0] ? edge[1] : edge[0];
      if (!has(simplex, other) && extends(simplex, other)) {
        found.push_back(other);
      }
    }
    return found;
  }

 private:
  static constexpr std::uint64_t dead = std::numeric_limits<std::uint64_t>::max();

  struct Cell {
    Corners corners;
    std::uint64_t birth;  ///< tells the cells apart that have had this id one after another
    std::uint32_t place;  ///< among those of its dimension
  };
  struct StarEntry {
    CellId id;
    std::uint32_t size;  ///< the number of its corners
    std::uint64_t birth;
  };
  /// May list dead cells too, but not many more than live ones.
  struct Star {
    std::vector<StarEntry> entries;
    std::size_t limit = 8;
  };

  CellId new_cell() {
    if (free_.empty()) {
      free_.push_back(static_cast<CellId>(cells_.size()));
      cells_.push_back({});
    }
    const CellId id = free_.back();
    free_.pop_back();
    cells_[id].birth = births_++;
    return id;
  }

  void remove(CellId id) {
    Cell& cell = cells_[id];
    auto& peers = by_dimension_[size_of(cell.corners) - 1];
    peers[cell.place] = peers.back();
    cells_[peers.back()].place = cell.place;
    peers.pop_back();
    ids_.erase(hash_of(cell.corners), id);
    cell.birth = dead;
    free_.push_back(id);
  }

  void push_to_star(Label vertex, CellId id) {
    Star& star = stars_[vertex];
    if (star.entries.size() >= star.limit) {
      std::erase_if(star.entries, [this](const StarEntry& entry) { return cells_[entry.id].birth != entry.birth; });
      star.limit = 2 * star.entries.size() + 8;
    }
    star.entries.push_back({id, static_cast<std::uint32_t>(size_of(cells_[id].corners)), cells_[id].birth});
  }

  [[nodiscard]] bool extends(const Corners& simplex, Label vertex) const {
    for (std::size_t i = 0; i < size_of(simplex); ++i) {
      if (!contains_replaced(simplex, simplex[i], vertex)) {
        return false;
      }
    }
    return !contains_replaced(simplex, no_label, vertex);
  }

  /// contains(replaced(simplex, from, to)), but quick to say no.
  [[nodiscard]] bool contains_replaced(const Corners& simplex, Label from, Label to) const {
    const std::uint64_t hash = hash_of(simplex) - sparse::spread_bits(from) + sparse::spread_bits(to);
    return ids_.find(hash, [&](CellId id) { return cells_[id].corners == replaced(simplex, from, to); }) !=
           ids_.nothing;
  }

  std::vector<Cell> cells_;
  std::vector<CellId> free_;
  std::uint64_t births_ = 0;
  std::array<std::vector<CellId>, most_corners> by_dimension_;
  sparse::HashIndex ids_;
  std::unordered_map<Label, Star> stars_;
};

class RandomTower {
 public:
  RandomTower(std::ostream& out, const TowerOptions& options) : text_{out}, options_{options}, draws_{options.seed} {}

  /// Does one operation; false when there is none left to do.
  bool step() {
    const double draw = draws_.unit();
    const bool is_down = options_.half_wave > 0 && operations_++ / options_.half_wave % 2 == 1;
    const double deletions = is_down ? 1 - options_.deletion_probability : options_.deletion_probability;
    if (options_.deletion_probability > 0 && draw < deletions) {
      return erase() || insert();
    }
    if (options_.deletion_probability > 0) {
      return insert() || erase();
    }
    const bool contract_first = draw < options_.contraction_probability;
    return contract_first ? contract() || insert() : insert() || contract();
  }

 private:
  bool contract() {
    Corners pair{no_label, no_label, no_label, no_label};
    if (options_.along_edges) {
      if (complex_.count(1) == 0) {
        return false;
      }
      pair = complex_.simplex(1, draws_.below(complex_.count(1)));
    } else {
      const auto vertices = complex_.count(0);
      if (vertices < 2) {
        return false;
      }
      const std::uint32_t one = draws_.below(vertices), other = draws_.below(vertices - 1);
      pair[0] = complex_.simplex(0, one)[0];
      pair[1] = complex_.simplex(0, other < one ? other : other + 1)[0];
    }
    if (draws_.below(2) == 1) {
      std::swap(pair[0], pair[1]);
    }
    complex_.contract(pair[0], pair[1]);
    write('c', {pair.data(), 2});
    return true;
  }

  bool erase() {
    std::size_t dimensions = 0;
    while (dimensions < most_corners && complex_.count(dimensions) > 0) {
      ++dimensions;
    }
    if (dimensions == 0) {
      return false;
    }
    const std::size_t dimension = draws_.below(dimensions);
    const Corners corners = complex_.maximal_over(complex_.simplex(dimension, draws_.below(complex_.count(dimension))));
    complex_.erase(corners);
    write('d', {corners.data(), size_of(corners)});
    return true;
  }

  bool insert() {
    const bool has_room = complex_.count(0) < options_.most_vertices;
    const auto largest = static_cast<std::size_t>(options_.largest_dimension);
    const std::size_t lowest = has_room ? 0 : 1;
    if (largest < lowest) {
      return false;
    }
    for (std::size_t dimension = lowest + draws_.below(largest - lowest + 1); dimension > 0; --dimension) {
      for (int attempt = 0; attempt < 4; ++attempt) {
        if (extend_simplex(dimension - 1)) {
          return true;
        }
      }
    }
    if (has_room) {
      insert({next_label_++, no_label, no_label, no_label});
    }
    return has_room;
  }

  bool extend_simplex(std::size_t dimension) {
    if (complex_.count(dimension) == 0) {
      return false;
    }
    const Corners& simplex = complex_.simplex(dimension, draws_.below(complex_.count(dimension)));
    if (dimension == 0) {
      return join(simplex, complex_.simplex(0, draws_.below(complex_.count(0)))[0]);
    }
    const std::vector<Label> found = complex_.extensions(simplex);
    return !found.empty() && join(simplex, found[draws_.below(found.size())]);
  }

  /// Inserts the simplex with one vertex more, unless it is there.
  bool join(const Corners& simplex, Label vertex) {
    if (has(simplex, vertex)) {
      return false;
    }
    const Corners joined = extended(simplex, vertex);
    if (complex_.contains(joined)) {
      return false;
    }
    insert(joined);
    return true;
  }

  void insert(const Corners& corners) {
    complex_.insert(corners);
    write('i', {corners.data(), size_of(corners)});
  }

  void write(char operation, std::span<const Label> labels) {
    text_.add(operation);
    for (const Label label : labels) {
      text_.add(' ').add_integer(label);
    }
    text_.add('\n');
  }

  replay::TextBuffer text_;
  TowerOptions options_;
  Draws draws_;
  LiveComplex complex_;
  Label next_label_ = 0;
  std::uint64_t operations_ = 0;
};

}  // namespace

void write_random_tower(std::ostream& out, const TowerOptions& options) {
  sparse::expects(options.largest_dimension >= 0 && options.largest_dimension < static_cast<int>(most_corners),
                  "a random tower has dimension 0 to 3");
  RandomTower tower(out, options);
  for (std::uint64_t i = 0; i < options.operations && out && tower.step(); ++i) {
  }
}

}  // namespace sesame::tools
