/// \file
/// Editing sessions on graphs: vertices are glued, and split with a random half of the ends that meet there.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ops/vocabulary/operation.hpp"
#include "tests/support/random_complexes.hpp"

namespace sesame::tests {

/// Draws the steps of a session on some edges; each is legal. Knows the graph, and so its homology, by itself.
class GraphSession {
 public:
  GraphSession(unsigned seed, int edges, bool undoes) : random_{seed}, edges_{edges}, undoes_{undoes} {}

  ops::Operation next() {
    if (made_ < edges_) {
      const std::string name = "e" + std::to_string(made_);
      for (const int side : {0, 1}) {
        now_.vertices.push_back({name + "." + std::to_string(side), {{made_, side}}});
      }
      ++made_;
      return ops::MakeSimplex{name, 1, {}};
    }
    if (undoes_ && before_.size() > 30 && random_.one_in(60)) {
      return undo();
    }
    for (;;) {
      const std::size_t a = any();
      if (random_.one_in(2)) {
        if (const std::size_t b = any(); a != b) {
          return glue(a, b);
        }
      } else if (auto moved = half_of(a); !moved.empty() && moved.size() < now_.vertices[a].ends.size()) {
        return split(a, std::move(moved));
      }
    }
  }

  /// The ranks of H0 and H1, both free.
  [[nodiscard]] std::vector<std::int64_t> betti() const {
    std::vector<std::size_t> component(now_.vertices.size());
    std::vector<std::size_t> at_end(2 * static_cast<std::size_t>(made_));
    for (std::size_t v = 0; v < component.size(); ++v) {
      component[v] = v;
      for (const End& end : now_.vertices[v].ends) {
        at_end[2 * static_cast<std::size_t>(end.edge) + static_cast<std::size_t>(end.side)] = v;
      }
    }
    const auto root = [&](std::size_t v) {
      while (component[v] != v) {
        v = component[v] = component[component[v]];
      }
      return v;
    };
    auto components = static_cast<std::int64_t>(component.size());
    for (std::size_t e = 0; e < at_end.size(); e += 2) {
      const std::size_t a = root(at_end[e]);
      const std::size_t b = root(at_end[e + 1]);
      components -= a != b ? 1 : 0;
      component[a] = b;
    }
    return {components, made_ - static_cast<std::int64_t>(component.size()) + components};
  }

 private:
  struct End {
    int edge, side;
  };
  struct Vertex {
    std::string name;
    std::vector<End> ends;
  };
  struct Graph {
    std::vector<Vertex> vertices;
  };

  std::size_t any() { return static_cast<std::size_t>(random_.in(0, static_cast<int>(now_.vertices.size()) - 1)); }

  std::vector<End> half_of(std::size_t v) {
    std::vector<End> half;
    for (const End& end : now_.vertices[v].ends) {
      if (random_.one_in(2)) {
        half.push_back(end);
      }
    }
    return half;
  }

  void remember() {
    if (undoes_) {
      before_.push_back(now_);
    }
  }

  ops::Operation glue(std::size_t a, std::size_t b) {
    remember();
    ops::Identify op{{{now_.vertices[a].name, now_.vertices[b].name}}};
    std::vector<End>& ends = now_.vertices[a].ends;
    ends.insert(ends.end(), now_.vertices[b].ends.begin(), now_.vertices[b].ends.end());
    now_.vertices.erase(now_.vertices.begin() + static_cast<std::ptrdiff_t>(b));
    return op;
  }

  ops::Operation split(std::size_t a, std::vector<End> moved) {
    remember();
    ops::Deidentify::Split op{now_.vertices[a].name, "x" + std::to_string(++copies_), {}};
    for (const End& end : moved) {
      op.moves.emplace_back("e" + std::to_string(end.edge), 1 - end.side);  // face 0 leaves out vertex 0
      std::erase_if(now_.vertices[a].ends,
                    [&](const End& other) { return other.edge == end.edge && other.side == end.side; });
    }
    now_.vertices.push_back({op.copy, std::move(moved)});
    return ops::Deidentify{{std::move(op)}};
  }

  ops::Operation undo() {
    const int steps = random_.one_in(3) ? random_.in(10, 30) : random_.in(1, 3);
    for (int k = 0; k < steps; ++k) {
      now_ = std::move(before_.back());
      before_.pop_back();
    }
    return ops::Undo{static_cast<std::uint64_t>(steps)};
  }

  Random random_;
  int edges_;
  bool undoes_;
  int made_ = 0;
  int copies_ = 0;
  Graph now_;
  std::vector<Graph> before_;
};

}  // namespace sesame::tests
