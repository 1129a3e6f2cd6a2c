// Menger's sponge with fewer cells: what lies between two different cells is taken out of its map.
#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "ops/plan/sewing.hpp"
#include "ops/plan/workspace.hpp"
#include "sparse/contract.hpp"
#include "tools/bench/constructions.hpp"

namespace sesame::tools {
namespace {

/// Which of the cells that there were at first have become one.
class Unions {
 public:
  explicit Unions(std::size_t count) : parent_(count), size_(count, 1) {
    for (std::size_t k = 0; k < count; ++k) {
      parent_[k] = static_cast<ops::Dart>(k);
    }
  }
  ops::Dart find(ops::Dart d) {
    while (parent_[d] != d) {
      d = parent_[d] = parent_[parent_[d]];
    }
    return d;
  }
  void join(ops::Dart a, ops::Dart b) {
    a = find(a);
    b = find(b);
    if (a != b) {
      parent_[b] = a;
      size_[a] += size_[b];
    }
  }
  [[nodiscard]] std::uint32_t size(ops::Dart root) const { return size_[root]; }

 private:
  std::vector<ops::Dart> parent_;
  std::vector<std::uint32_t> size_;
};

/// Simplifies the 3-G-maps of a workspace without touching the homotopy type: faces between two volumes go, the
/// smallest volumes first, so that what a step replaces stays small; then edges between two faces, vertices between two
/// edges, and what hangs loose: faces in a volume, edges in a face. What is left of each component is one volume.
class Simplifier {
 public:
  explicit Simplifier(ops::Workspace& workspace)
      : workspace_{workspace},
        cells_{Unions(darts().darts(3)), Unions(darts().darts(3)), Unions(darts().darts(3)), Unions(darts().darts(3))} {
  }

  Operations run() {
    const ops::Dart count = darts().darts(3);
    for (ops::Dart d = 0; d < count; ++d) {
      for (int i = 1; i <= 3; ++i) {
        for (int j = 0; j <= 3; ++j) {
          if (j != i) {
            cells_[static_cast<std::size_t>(i)].join(d, alpha(j, d));
          }
        }
      }
    }
    sides_.resize(count);
    for (ops::Dart d = 0; d < count; ++d) {
      sides_[cell(3, d)].push_back(d);
      push(0, d);
      push(1, d);
    }
    follow_up();
    for (ops::Dart d = 0; d < count; ++d) {
      if (cell(3, d) == d) {
        volumes_.emplace(cells_[3].size(d), d);
      }
    }
    while (!volumes_.empty()) {
      const auto [size, volume] = volumes_.top();
      volumes_.pop();
      if (cell(3, volume) == volume && cells_[3].size(volume) == size) {
        merge(volume);
        follow_up();
      }
    }
    return std::move(steps_);
  }

 private:
  [[nodiscard]] const ops::DartStore& darts() const { return workspace_.structure().darts(); }
  [[nodiscard]] ops::Dart alpha(int i, ops::Dart d) const { return darts().alpha(3, i, d); }
  [[nodiscard]] bool is_there(ops::Dart d) const { return !darts().taken_out_with(3, d); }
  ops::Dart cell(int i, ops::Dart d) { return cells_[static_cast<std::size_t>(i)].find(d); }
  void push(int i, ops::Dart d) { waiting_[static_cast<std::size_t>(i)].push_back(d); }

  /// The darts that two involutions, or more, reach.
  [[nodiscard]] std::vector<ops::Dart> orbit(ops::Dart d, std::initializer_list<int> indices) const {
    std::vector<ops::Dart> found{d};
    for (std::size_t at = 0; at < found.size(); ++at) {
      for (const int i : indices) {
        const ops::Dart next = alpha(i, found[at]);
        if (std::ranges::find(found, next) == found.end()) {
          found.push_back(next);
        }
      }
    }
    return found;
  }

  /// Takes the cell out and joins what it lay between, unless the workspace refuses.
  bool remove(int i, ops::Dart d) {
    std::string name = ops::name_of_dart(3, d, workspace_.structure());
    name.insert(name.rfind(':'), "." + std::to_string(i));
    ops::Operation operation = ops::RemoveCell{std::move(name)};
    if (!workspace_.plan(operation)) {
      return false;
    }
    const ops::Dart other = alpha(i + 1, d);
    workspace_.carry_out();
    steps_.push_back(std::move(operation));
    cells_[static_cast<std::size_t>(i) + 1].join(d, other);
    return true;
  }

  /// With the smallest of its neighbours.
  void merge(ops::Dart volume) {
    std::vector<ops::Dart>& sides = sides_[volume];
    std::erase_if(sides, [&](ops::Dart d) { return !is_there(d) || cell(3, alpha(3, d)) == volume; });
    const auto neighbour_size = [&](ops::Dart d) { return cells_[3].size(cell(3, alpha(3, d))); };
    const auto least = std::ranges::min_element(sides, {}, neighbour_size);
    if (least == sides.end()) {
      return;
    }
    const ops::Dart face = *least, neighbour = cell(3, alpha(3, face));
    const std::vector<ops::Dart> around = orbit(face, {0, 1});
    std::vector<ops::Dart> edges;
    for (const ops::Dart d : around) {
      edges.push_back(alpha(2, d));
    }
    const bool is_done = remove(2, face);
    sparse::expects(is_done, "a face between two balls can go");
    const ops::Dart both = cell(3, face);
    std::vector<ops::Dart> all = std::exchange(sides_[volume], {});
    all.insert(all.end(), sides_[neighbour].begin(), sides_[neighbour].end());
    sides_[neighbour].clear();
    sides_[both] = std::move(all);
    volumes_.emplace(cells_[3].size(both), both);
    waiting_[1].insert(waiting_[1].end(), edges.begin(), edges.end());
  }

  void follow_up() {
    while (!waiting_[0].empty() || !waiting_[1].empty()) {
      const int i = waiting_[1].empty() ? 0 : 1;
      const ops::Dart d = waiting_[static_cast<std::size_t>(i)].back();
      waiting_[static_cast<std::size_t>(i)].pop_back();
      if (is_there(d)) {
        i == 1 ? look_at_edge(d) : look_at_vertex(d);
      }
    }
  }

  void look_at_edge(ops::Dart d) {
    const std::vector<ops::Dart> around = orbit(d, {2, 3});
    const ops::Dart one = cell(2, d);
    const auto is_turn = [&](ops::Dart a) { return alpha(2, a) == alpha(3, a) && alpha(2, a) != a; };
    if (around.size() == 2 && is_turn(d)) {
      take_hanging_face(d);
      return;
    }
    const bool has_two =
        std::ranges::all_of(around, [&](ops::Dart a) { return alpha(2, alpha(3, a)) == alpha(3, alpha(2, a)); });
    const ops::Dart other = cell(2, alpha(2, d));
    if (!has_two || one == other) {
      return;
    }
    std::vector<ops::Dart> ends;
    for (const ops::Dart a : orbit(d, {0, 2, 3})) {
      ends.push_back(alpha(1, a));
    }
    if (remove(1, d)) {
      waiting_[0].insert(waiting_[0].end(), ends.begin(), ends.end());
    }
  }

  /// A face with the same volume on both sides, which meets itself across an edge.
  void take_hanging_face(ops::Dart d) {
    std::vector<ops::Dart> edges;
    for (const ops::Dart a : orbit(d, {0, 1})) {
      edges.push_back(alpha(2, a));
    }
    if (remove(2, d)) {
      waiting_[1].insert(waiting_[1].end(), edges.begin(), edges.end());
    }
  }

  /// An edge within a face with an end at which there is no other.
  void take_loose_edge(ops::Dart d) {
    const ops::Dart other_end = alpha(1, alpha(0, d));
    if (other_end != alpha(2, alpha(0, d)) && remove(1, d)) {
      push(0, other_end);
    }
  }

  void look_at_vertex(ops::Dart d) {
    const std::vector<ops::Dart> around = orbit(d, {1, 2, 3});
    if (std::ranges::all_of(around, [&](ops::Dart a) { return alpha(1, a) == alpha(2, a); })) {
      take_loose_edge(d);
      return;
    }
    if (cell(1, d) != cell(1, alpha(1, d)) &&
        std::ranges::all_of(around, [&](ops::Dart a) { return alpha(1, alpha(2, a)) == alpha(2, alpha(1, a)); })) {
      (void)remove(0, d);
    }
  }

  ops::Workspace& workspace_;
  std::array<Unions, 4> cells_;
  std::vector<std::vector<ops::Dart>> sides_;  ///< of a volume, its darts where others lie beyond; some are gone
  std::priority_queue<std::pair<std::uint32_t, ops::Dart>, std::vector<std::pair<std::uint32_t, ops::Dart>>,
                      std::greater<>>
      volumes_;                                    ///< by size; some have become others
  std::array<std::vector<ops::Dart>, 2> waiting_;  ///< vertices and edges to look at
  Operations steps_;
};

}  // namespace

Operations simplified_menger_sponge(int level) {
  Operations operations = menger_sponge_of_maps(level);
  ops::Workspace workspace;
  for (const ops::Operation& operation : operations) {
    const bool is_planned = workspace.plan(operation).has_value();
    sparse::expects(is_planned, "the sponge can be sewn");
    workspace.carry_out();
  }
  Operations steps = Simplifier(workspace).run();
  operations.insert(operations.end(), std::make_move_iterator(steps.begin()), std::make_move_iterator(steps.end()));
  return operations;
}

}  // namespace sesame::tools
