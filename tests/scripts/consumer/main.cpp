// What a user of the library writes: a projective plane from a square, its homology, and the class of a loop; and the
// Laplacian of its graph, by Eigen.
#include <sesame/engine/engine.hpp>
#include <sesame/sparse/eigen.hpp>
#include <sesame/version.hpp>

#include <iostream>

int main() {
  namespace ops = sesame::ops;
  sesame::engine::Engine engine;
  const ops::Operation steps[] = {ops::MakeSimplex{"a", 2, {}}, ops::MakeSimplex{"b", 2, {}},
                                  ops::Identify{{{"a.0-1", "b.0-1"}}},
                                  ops::Identify{{{"a.1-2", "b.0-2"}, {"a.0-2", "b.1-2"}}}};
  for (const ops::Operation& step : steps) {
    if (const auto report = engine.apply(step); !report) {
      std::cerr << report.error().what << '\n';
      return 1;
    }
  }
  const sesame::engine::Homology homology = engine.homology();
  std::cout << "betti";
  for (const auto betti : homology.betti) {
    std::cout << ' ' << betti;
  }
  std::cout << "\ntorsion of H1";
  for (const auto& factor : homology.torsion[1]) {
    std::cout << ' ' << factor.to_string();
  }
  const auto once = engine.chain({{1, "a.0-1"}});
  const auto twice = engine.chain({{2, "a.0-1"}});
  std::cout << "\nthe loop bounds: " << engine.classify(*once).is_zero
            << ", twice the loop bounds: " << engine.classify(*twice).is_zero << '\n';
  const ops::Structure& object = engine.structure();
  const auto complex = ops::chain_complex(object, ops::cells_at(object, ops::now(object)), ops::now(object),
                                          sesame::sparse::Integers{});
  const auto d = sesame::sparse::to_eigen<double>(complex.boundary(1));
  const Eigen::SparseMatrix<double> laplacian = *d * Eigen::SparseMatrix<double>{d->transpose()};
  std::cout << "Laplacian " << laplacian.coeff(0, 0) << ' ' << laplacian.coeff(0, 1) << '\n';
  const auto refused = engine.apply(ops::Identify{{{"a", "a.0"}}});
  std::cout << refused.error().what << "\nsesame " << SESAME_VERSION << '\n';
  return 0;
}
