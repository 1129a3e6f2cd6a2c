// H_1 of a mesh: which loops generate it, and on which side of their surface they bound.
#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "sparse/contract.hpp"
#include "tools/mesh/chain_measures.hpp"
#include "tools/mesh/first_homology.hpp"
#include "tools/mesh/graph.hpp"
#include "tools/mesh/incidence.hpp"
#include "tools/mesh/mesh_generators.hpp"
#include "tools/mesh/short_loops.hpp"
#include "tools/mesh/sorted_loops.hpp"

namespace sesame::tools {

namespace {

using engine::CellChain;
using engine::SmallChain;
using sparse::Integer;
using sparse::Integers;
using sparse::Terms;

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

/// Whether a part may have loops that are not sorted.
bool may_have_more(const Component& component, const PartSorting& sorting) {
  return !sorting.is_sorted && !(component.is_closed() && component.genus() == 0);
}

class LoopFinder {
 public:
  LoopFinder(const MeshCells& cells, engine::Engine& engine, const sparse::AnyRing& ring, const KnownOfMesh& known)
      : cells_{cells},
        engine_{engine},
        ring_{ring},
        known_{known},
        validity_{known.validity},
        measures_{cells, ring},
        graph_{within_one(cells.mesh().polygons.points), cells.edges()},
        parts_{connected_parts(cells.mesh().triangles.points.size(), incidence_of(cells.mesh().triangles).edges)} {}

  FoundGenerators find() {
    const LoopSorting sorting = sort_loops(cells_.mesh().polygons, known_);
    found_.sorting = sorting.parts;
    found_.remarks = sorting.remarks;
    std::vector<MeshGenerator> free;
    if (has_more_parts()) {
      free = find_unsorted();
    }
    add_half(sorting.handles, sorting.tunnels, LoopSide::handle, free);
    add_half(sorting.tunnels, sorting.handles, LoopSide::tunnel, free);
    std::stable_sort(free.begin(), free.end(),
                     [](const MeshGenerator& a, const MeshGenerator& b) { return is_less(a.length, b.length); });
    std::move(free.begin(), free.end(), std::back_inserter(found_.generators));
    for (MeshGenerator& generator : found_.generators) {
      list_edges(generator);
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool has_more_parts() const {
    for (std::size_t part = 0; part < found_.sorting.size(); ++part) {
      if (may_have_more(validity_.components[part], found_.sorting[part])) {
        return true;
      }
    }
    return false;
  }

  /// Torsion, and the free generators of the parts that are not sorted.
  std::vector<MeshGenerator> find_unsorted() {
    const FirstHomology h = first_homology(engine_, cells_.cells_of_edges());
    if (!std::holds_alternative<sparse::Rationals>(ring_)) {
      find_torsion(h);
    }
    const LoopBasis basis = short_loops(graph_, {ring_, &h.free});
    found_.loops_tried += basis.tried;
    keep_apart(basis);
    std::vector<MeshGenerator> free;
    for (const Loop& loop : basis.loops) {
      if (!found_.sorting[parts_.of[loop.points.front()]].is_sorted) {
        free.push_back(from_loop(loop, 0));
      }
    }
    for (const auto& rest : basis.completion) {
      free.push_back(from_engine(sum(rest, h.free_cycles), 0));
    }
    return free;
  }

  /// What completes a basis need not be within one part: then parts that have too few loops in it stay as they are.
  void keep_apart(const LoopBasis& basis) {
    std::vector<long long> loops(parts_.count, 0);
    for (const Loop& loop : basis.loops) {
      ++loops[parts_.of[loop.points.front()]];
    }
    for (std::size_t part = 0; part < parts_.count; ++part) {
      PartSorting& sorting = found_.sorting[part];
      if (sorting.is_sorted && loops[part] != 2 * validity_.components[part].genus().value()) {
        sorting = {false, "its loops were not told apart from those of other components"};
      }
    }
  }

  /// The loops of one side of all surfaces that are sorted.
  void add_half(const HalfOfLoops& half, const HalfOfLoops& rest, LoopSide side, std::vector<MeshGenerator>& free) {
    if (half.coordinates.rank == 0) {
      return;
    }
    const HalfBasis basis = short_half(graph_, half, rest);
    found_.loops_tried += basis.tried;
    std::vector<MeshGenerator> loops;
    for (const Loop& loop : basis.loops) {
      loops.push_back(from_loop(loop, 0));
    }
    for (const WeightedEdges& cycle : basis.completion) {
      loops.push_back(from_edges(cycle));
      loops.back().vertices = simple_loop(loops.back().chain);
    }
    for (MeshGenerator& loop : loops) {
      loop.side = side;
      if (found_.sorting[part_of(loop)].is_sorted) {
        free.push_back(std::move(loop));
      }
    }
  }

  [[nodiscard]] std::uint32_t part_of(const MeshGenerator& generator) const {
    return parts_.of[cells_.ends(generator.chain.terms.front().generator)[0]];
  }

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

  /// A closed walk; only one that does not meet itself has its vertices listed.
  [[nodiscard]] MeshGenerator from_loop(const Loop& loop, const Integer& order) const {
    sparse::RawTerms<Integers> edges;
    std::vector<CycleEdge> walk;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const auto from = loop.points[i];
      const auto to = loop.points[i + 1 < loop.points.size() ? i + 1 : 0];
      edges.push_back({graph_.way(from, to).edge, from < to ? 1 : -1});
      walk.push_back(cycle_edge(from, to, 1));
    }
    MeshGenerator generator = from_edges(std::move(edges).normal(Integers{}));
    generator.order = order;
    generator.is_short = true;
    // A way there and back is no part of the cycle, and what is left of the walk then is in pieces.
    if (generator.chain.terms.size() == walk.size()) {
      generator.edges = std::move(walk);
    }
    if (std::set<std::uint32_t>(loop.points.begin(), loop.points.end()).size() == loop.points.size()) {
      for (const std::uint32_t point : loop.points) {
        generator.vertices.push_back(cells_.in_file(point));
      }
    } else {
      generator.vertices = simple_loop(generator.chain);
    }
    return generator;
  }

  /// A cycle, by how often it runs up each edge.
  [[nodiscard]] MeshGenerator from_edges(const Terms<Integers>& edges) const {
    MeshGenerator generator;
    generator.degree = 1;
    generator.chain = {1, {}};
    for (const auto& term : edges) {
      const Integer times = std::visit([&](const auto& r) { return r.to_integer(r.from(term.coefficient)); }, ring_);
      if (!times.is_zero()) {
        generator.chain.terms.push_back({times, cells_.cells_of_edges()[term.index]});
      }
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

  [[nodiscard]] CycleEdge cycle_edge(std::uint32_t from, std::uint32_t to, const Integer& times) const {
    const auto& points = cells_.mesh().triangles.points;
    return {{cells_.in_file(from), cells_.in_file(to)}, {points[from], points[to]}, times};
  }

  /// The part of the mesh that has a cycle, and its edges when no walk has told them: along the loop that it is, else
  /// as the chain has them.
  void list_edges(MeshGenerator& generator) const {
    if (generator.chain.terms.empty()) {
      return;
    }
    generator.part = part_of(generator);
    if (!generator.edges.empty()) {
      return;
    }
    std::map<std::array<std::uint32_t, 2>, CycleEdge> edges;
    for (const auto& [coefficient, cell] : generator.chain.terms) {
      const auto [low, high] = cells_.ends(cell);
      generator.edges.push_back(cycle_edge(low, high, coefficient.numerator()));
      for (const CycleEdge& edge : {cycle_edge(low, high, 1), cycle_edge(high, low, 1)}) {
        edges.emplace(edge.vertices, edge);
      }
    }
    const auto& loop = generator.vertices;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      generator.edges[i] = edges.at({loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]});
    }
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
  const KnownOfMesh& known_;
  const Validity& validity_;
  ChainMeasures measures_;
  EdgeGraph graph_;
  Parts parts_;
  FoundGenerators found_;
};

}  // namespace

FoundGenerators loops_of(const MeshCells& cells, engine::Engine& engine, const sparse::AnyRing& ring,
                         const KnownOfMesh& known) {
  if (cells.edges().empty()) {
    FoundGenerators none;
    none.sorting.resize(known.validity.components.size());
    return none;
  }
  return LoopFinder(cells, engine, ring, known).find();
}

}  // namespace sesame::tools
