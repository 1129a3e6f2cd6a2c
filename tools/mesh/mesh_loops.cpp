// H_1 of a mesh: which loops generate it.
#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "sparse/contract.hpp"
#include "tools/mesh/chain_measures.hpp"
#include "tools/mesh/first_homology.hpp"
#include "tools/mesh/mesh_generators.hpp"
#include "tools/mesh/short_loops.hpp"

namespace sesame::tools {

namespace {

using engine::CellChain;
using engine::SmallChain;
using sparse::Integer;
using sparse::Integers;
using sparse::Terms;

/// The points, scaled to within 1 of the origin, so that no distance between them is too large for a double.
std::vector<Point> within_one(std::vector<Point> points) {
  const int exponent = binary_exponent(points);
  for (Point& point : points) {
    point = scaled(point, -exponent);
  }
  return points;
}

/// Z/p when all orders are one prime p: then bases of the torsion are bases over Z/p.
std::optional<sparse::AnyRing> common_prime(const std::vector<Integer>& orders) {
  if (orders.empty() || orders.front() != orders.back()) {
    return std::nullopt;
  }
  const auto field = sparse::parse_ring("Z/" + orders.front().to_string());
  return field ? std::optional{*field} : std::nullopt;
}

SmallChain sum(const Terms<Integers>& factors, const std::vector<SmallChain>& cycles) {
  sparse::RawTerms<Integers> terms;
  for (const auto& [k, factor] : factors) {
    for (const auto& [coefficient, x] : cycles[k].terms) {
      terms.push_back({x, factor * coefficient.numerator()});
    }
  }
  return small_chain(std::move(terms).normal(Integers{}));
}

class LoopFinder {
 public:
  LoopFinder(const MeshCells& cells, engine::Engine& engine, const sparse::AnyRing& ring)
      : cells_{cells},
        engine_{engine},
        ring_{ring},
        measures_{cells, ring},
        graph_{within_one(cells.mesh().polygons.points), cells.edges()} {}

  FoundGenerators find() {
    const FirstHomology h = first_homology(engine_, cells_.cells_of_edges());
    if (!std::holds_alternative<sparse::Rationals>(ring_)) {
      find_torsion(h);
    }
    const LoopBasis free = short_loops(graph_, {ring_, &h.free});
    for (const Loop& loop : free.loops) {
      found_.generators.push_back(from_loop(loop, 0));
    }
    for (const auto& rest : free.completion) {
      found_.generators.push_back(from_engine(sum(rest, h.free_cycles), 0));
    }
    found_.loops_tried += free.tried;
    return std::move(found_);
  }

 private:
  void find_torsion(const FirstHomology& h) {
    if (const auto prime = common_prime(h.orders)) {
      const LoopBasis torsion = short_loops(graph_, {*prime, &h.torsion, &h.free});
      for (const Loop& loop : torsion.loops) {
        found_.generators.push_back(from_loop(loop, h.orders[0]));
      }
      for (const auto& rest : torsion.completion) {
        found_.generators.push_back(from_engine(sum(rest, h.torsion_cycles), h.orders[0]));
      }
      found_.loops_tried += torsion.tried;
    } else {
      for (std::size_t k = 0; k < h.orders.size(); ++k) {
        found_.generators.push_back(from_engine(h.torsion_cycles[k], h.orders[k]));
      }
    }
    for (MeshGenerator& generator : found_.generators) {
      generator.bounding = bounding(generator);
    }
  }

  [[nodiscard]] MeshGenerator from_loop(const Loop& loop, const Integer& order) const {
    MeshGenerator generator;
    generator.degree = 1;
    generator.order = order;
    generator.is_short = true;
    generator.chain = {1, {}};
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const auto from = loop.points[i];
      const auto to = loop.points[i + 1 < loop.points.size() ? i + 1 : 0];
      generator.chain.terms.push_back(
          {from < to ? Integer{1} : minus_one(ring_), cells_.cells_of_edges()[graph_.way(from, to).edge]});
      generator.vertices.push_back(cells_.in_file(from));
    }
    std::sort(generator.chain.terms.begin(), generator.chain.terms.end(),
              [](const CellChain::Term& a, const CellChain::Term& b) { return a.generator < b.generator; });
    measures_.measure_cycle(generator);
    return generator;
  }

  [[nodiscard]] MeshGenerator from_engine(const SmallChain& cycle, const Integer& order) {
    MeshGenerator generator;
    generator.degree = 1;
    generator.order = order;
    generator.chain = engine_.maps().apply_G(cycle);
    generator.vertices = simple_loop(generator.chain);
    measures_.measure_cycle(generator);
    return generator;
  }

  /// The points of a cycle in order, in the file's numbers; none when it is not one simple loop.
  [[nodiscard]] std::vector<std::uint32_t> simple_loop(const CellChain& chain) const {
    std::map<std::uint32_t, std::vector<std::uint32_t>> neighbours;
    for (const auto& [coefficient, edge] : chain.terms) {
      if (coefficient != 1 && coefficient != minus_one(ring_)) {
        return {};
      }
      const auto [low, high] = cells_.ends(edge);
      neighbours[low].push_back(high);
      neighbours[high].push_back(low);
    }
    for (const auto& [point, others] : neighbours) {
      if (others.size() != 2) {
        return {};
      }
    }
    const std::uint32_t first = neighbours.begin()->first;
    std::vector<std::uint32_t> loop{cells_.in_file(first)};
    std::uint32_t before = first;
    for (std::uint32_t here = neighbours.at(first)[0]; here != first;) {
      loop.push_back(cells_.in_file(here));
      const auto& others = neighbours.at(here);
      before = std::exchange(here, others[0] == before ? others[1] : others[0]);
    }
    return loop.size() == neighbours.size() ? loop : std::vector<std::uint32_t>{};
  }

  [[nodiscard]] std::optional<CellChain> bounding(const MeshGenerator& generator) {
    CellChain multiple = generator.chain;
    for (auto& term : multiple.terms) {
      term.coefficient *= generator.order;
    }
    auto answer = engine_.classify(multiple);
    sparse::expects(answer.is_zero, "a torsion generator times its order is a boundary");
    return std::move(answer.bounds);
  }

  const MeshCells& cells_;
  engine::Engine& engine_;
  const sparse::AnyRing& ring_;
  ChainMeasures measures_;
  EdgeGraph graph_;
  FoundGenerators found_;
};

}  // namespace

FoundGenerators loops_of(const MeshCells& cells, engine::Engine& engine, const sparse::AnyRing& ring) {
  return cells.edges().empty() ? FoundGenerators{} : LoopFinder(cells, engine, ring).find();
}

}  // namespace sesame::tools
