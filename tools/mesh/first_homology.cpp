#include "tools/mesh/first_homology.hpp"

#include <optional>

#include "sparse/smith.hpp"

namespace sesame::tools {

namespace {

using engine::SmallChain;
using sparse::Index;
using sparse::Integer;
using sparse::Integers;
using sparse::Terms;

/// The coordinates of each generator of S_1.
struct Coordinates {
  std::vector<Terms<Integers>> free;
  std::vector<Terms<Integers>> torsion;
};

/// What is left of d_2 in the small complex, as columns on the generators of S_1.
sparse::Matrix<Integers> small_boundary(engine::Engine& engine, Index rows, std::uint32_t columns) {
  sparse::Matrix<Integers> boundary{Integers{}, rows, 0};
  for (engine::SmallId y = 0; y < columns; ++y) {
    sparse::RawTerms<Integers> sum;
    for (const auto& [coefficient, x] : engine.maps().boundary(SmallChain{2, {{1, y}}}).terms) {
      sum.push_back({x, coefficient.numerator()});
    }
    const Terms<Integers> column = std::move(sum).normal(Integers{});
    if (!column.empty()) {
      boundary.append_column(column);
    }
  }
  return boundary;
}

/// The basis in which the boundaries are diagonal; only over Z is there anything to do.
Coordinates by_smith_form(const sparse::Matrix<Integers>& boundary, FirstHomology& h) {
  const auto smith = sparse::smith_form(boundary);
  const Index generators = boundary.rows();
  std::vector<std::optional<Index>> coordinate(generators);  // of a row of the diagonal, within its kind
  for (Index row = 0; row < generators; ++row) {
    const bool is_free = row >= smith.factors.size();
    if (!is_free && smith.factors[row].is_unit()) {
      continue;
    }
    auto& cycles = is_free ? h.free_cycles : h.torsion_cycles;
    coordinate[row] = static_cast<Index>(cycles.size());
    cycles.push_back(small_chain(smith.left_inverse.column(row)));
    if (!is_free) {
      h.orders.push_back(smith.factors[row]);
    }
  }
  Coordinates coordinates{std::vector<Terms<Integers>>(generators), std::vector<Terms<Integers>>(generators)};
  for (Index x = 0; x < generators; ++x) {
    smith.left.for_each_in_column(x, [&](const sparse::Term<Integers>& term) {
      if (!coordinate[term.index]) {
        return;
      }
      auto& kind = term.index >= smith.factors.size() ? coordinates.free : coordinates.torsion;
      kind[x].push_back({*coordinate[term.index], term.coefficient});
    });
  }
  return coordinates;
}

/// Every generator of S_1 is a cycle: the boundary of an edge has unit coefficients, so nothing of it is left in dS.
Coordinates coordinates_of_small(engine::Engine& engine, FirstHomology& h) {
  const engine::Homology homology = engine.homology();
  if (homology.small.size() < 2) {
    return {};
  }
  const Index generators = homology.small[1];
  if (generators != static_cast<Index>(homology.betti[1])) {
    return by_smith_form(small_boundary(engine, generators, homology.small.at(2)), h);
  }
  Coordinates coordinates{{}, std::vector<Terms<Integers>>(generators)};
  for (Index i = 0; i < generators; ++i) {
    coordinates.free.push_back({{i, 1}});
    h.free_cycles.push_back(small_chain(coordinates.free.back()));
  }
  return coordinates;
}

}  // namespace

FirstHomology first_homology(engine::Engine& engine, const std::vector<ops::CellId>& edges) {
  FirstHomology h;
  const Coordinates of_small = coordinates_of_small(engine, h);
  h.free.rank = static_cast<Index>(h.free_cycles.size());
  h.torsion.rank = static_cast<Index>(h.torsion_cycles.size());
  for (const ops::CellId edge : edges) {
    Terms<Integers> free;
    Terms<Integers> torsion;
    for (const auto& [coefficient, x] : engine.maps().apply_F({1, {{1, edge}}}).terms) {
      sparse::add_multiple<Integers>(Integers{}, free, coefficient.numerator(), of_small.free[x]);
      sparse::add_multiple<Integers>(Integers{}, torsion, coefficient.numerator(), of_small.torsion[x]);
    }
    h.free.of_edge.push_back(std::move(free));
    h.torsion.of_edge.push_back(std::move(torsion));
  }
  return h;
}

SmallChain small_chain(const Terms<Integers>& terms) {
  SmallChain chain{1, {}};
  for (const auto& [index, coefficient] : terms) {
    chain.terms.push_back({coefficient, engine::SmallId{index}});
  }
  return chain;
}

}  // namespace sesame::tools
