#include "tools/bench/zigzags.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <initializer_list>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "replay/text/text_buffer.hpp"
#include "sparse/contract.hpp"
#include "tools/bench/draws.hpp"

namespace sesame::tools {
namespace {

using Vertex = std::uint32_t;

/// A clique complex, written as its edges come and go.
class CliqueComplex {
 public:
  CliqueComplex(std::ostream& out, std::size_t vertices, std::size_t largest_dimension)
      : text_{out}, largest_dimension_{largest_dimension}, neighbours_(vertices) {}

  [[nodiscard]] std::uint64_t operations() const { return operations_; }
  [[nodiscard]] bool has_edge(Vertex u, Vertex v) const { return neighbours_[u].contains(v); }
  [[nodiscard]] std::size_t degree(Vertex u) const { return neighbours_[u].size(); }

  void add_vertex(Vertex v) { write('i', {v}); }
  void remove_vertex(Vertex v) { write('d', {v}); }
  void add_edge(Vertex u, Vertex v) {
    write('i', {u, v});
    const std::vector<Vertex> common = common_neighbours(u, v);
    for (const Vertex w : common) {
      write('i', {u, v, w});
    }
    for_each_edge(common, [&](Vertex w, Vertex x) { write('i', {u, v, w, x}); });
    neighbours_[u].insert(v);
    neighbours_[v].insert(u);
  }
  void remove_edge(Vertex u, Vertex v) {
    const std::vector<Vertex> common = common_neighbours(u, v);
    for_each_edge(common, [&](Vertex w, Vertex x) { write('d', {u, v, w, x}); });
    for (const Vertex w : common) {
      write('d', {u, v, w});
    }
    write('d', {u, v});
    neighbours_[u].erase(v);
    neighbours_[v].erase(u);
  }

 private:
  /// Those that make triangles with an edge, if triangles are wanted.
  [[nodiscard]] std::vector<Vertex> common_neighbours(Vertex u, Vertex v) const {
    std::vector<Vertex> common;
    if (largest_dimension_ >= 2) {
      std::ranges::set_intersection(neighbours_[u], neighbours_[v], std::back_inserter(common));
    }
    return common;
  }
  /// Those that make tetrahedra.
  template <class Visit>
  void for_each_edge(std::span<const Vertex> vertices, Visit&& visit) const {
    for (std::size_t j = 0; largest_dimension_ >= 3 && j < vertices.size(); ++j) {
      for (std::size_t k = j + 1; k < vertices.size(); ++k) {
        if (has_edge(vertices[j], vertices[k])) {
          visit(vertices[j], vertices[k]);
        }
      }
    }
  }
  void write(char operation, std::initializer_list<Vertex> simplex) {
    std::vector<Vertex> sorted(simplex);
    std::ranges::sort(sorted);
    text_.add(operation);
    for (const Vertex v : sorted) {
      text_.add(' ').add_integer(v);
    }
    text_.add('\n');
    ++operations_;
  }

  replay::TextBuffer text_;
  std::size_t largest_dimension_;
  std::vector<std::set<Vertex>> neighbours_;
  std::uint64_t operations_ = 0;
};

using Edge = std::pair<Vertex, Vertex>;

Edge edge(Vertex u, Vertex v) { return {std::min(u, v), std::max(u, v)}; }

struct Point {
  double x, y;
};

double distance(const Point& a, const Point& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

/// Puts the points into the order in which each is the farthest from those before; returns how far that is.
std::vector<double> sort_farthest_first(std::vector<Point>& points) {
  std::vector<double> nearest(points.size(), std::numeric_limits<double>::infinity()), found;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto farthest = static_cast<std::size_t>(
        std::max_element(nearest.begin() + static_cast<std::ptrdiff_t>(k), nearest.end()) - nearest.begin());
    found.push_back(nearest[farthest]);
    std::swap(points[k], points[farthest]);
    std::swap(nearest[k], nearest[farthest]);
    for (std::size_t j = k + 1; j < points.size(); ++j) {
      nearest[j] = std::min(nearest[j], distance(points[k], points[j]));
    }
  }
  return found;
}

}  // namespace

void write_temporal_network(std::ostream& out, std::uint64_t operations, std::uint32_t people, std::uint32_t window,
                            std::uint64_t seed) {
  sparse::expects(people >= 16 && window > 0, "a network has 16 people at least, and a memory");
  Draws draws(seed);
  CliqueComplex complex(out, people, 3);
  std::deque<Edge> met;
  std::map<Edge, std::uint64_t> times;  ///< how often each is in `met`
  while (complex.operations() < operations && out) {
    const Vertex u = draws.below(people);
    const Vertex step = draws.below(16) > 0 ? 1 + draws.below(6) : 1 + draws.below(people - 1);
    const Edge contact = edge(u, (u + step) % people);
    met.push_back(contact);
    if (times[contact]++ == 0) {
      for (const Vertex v : {contact.first, contact.second}) {
        if (complex.degree(v) == 0) {
          complex.add_vertex(v);
        }
      }
      complex.add_edge(contact.first, contact.second);
    }
    if (met.size() <= window) {
      continue;
    }
    const Edge forgotten = met.front();
    met.pop_front();
    if (--times[forgotten] == 0) {
      times.erase(forgotten);
      complex.remove_edge(forgotten.first, forgotten.second);
      for (const Vertex v : {forgotten.first, forgotten.second}) {
        if (complex.degree(v) == 0) {
          complex.remove_vertex(v);
        }
      }
    }
  }
}

void write_oscillating_rips(std::ostream& out, std::uint32_t points, double nearer, double farther,
                            std::uint64_t seed) {
  sparse::expects(nearer <= farther && points < 65536, "pairs are parted that are farther than those that are joined");
  Draws draws(seed);
  std::vector<Point> places(points);
  for (Point& place : places) {
    place.x = draws.unit();
    place.y = draws.unit();
  }
  std::vector<double> units = sort_farthest_first(places);
  units.push_back(0);
  struct Pair {
    double length;
    Vertex u, v;
    [[nodiscard]] auto operator<=>(const Pair&) const = default;
  };
  CliqueComplex complex(out, points, 2);
  std::set<Pair> joined, parted;  ///< by length
  for (Vertex k = 0; k < points; ++k) {
    complex.add_vertex(k);
    for (Vertex j = 0; j < k; ++j) {
      parted.insert({distance(places[j], places[k]), j, k});
    }
    while (k > 0 && !parted.empty() && parted.begin()->length <= farther * units[k]) {
      const Pair pair = *parted.begin();
      parted.erase(parted.begin());
      complex.add_edge(pair.u, pair.v);
      joined.insert(pair);
    }
    while (!joined.empty() && joined.rbegin()->length > nearer * units[k + 1]) {
      const Pair pair = *joined.rbegin();
      joined.erase(pair);
      complex.remove_edge(pair.u, pair.v);
      parted.insert(pair);
    }
  }
}

}  // namespace sesame::tools
