// Persistence by GUDHI, for comparison: `bench_gudhi FILE` reads lines `dim v0 ... vd value`, computes over Z/2 and
// prints `betti b0 b1 ...`.
#include <iostream>  // the headers below use it without including it

#include <gudhi/Persistent_cohomology.h>
#include <gudhi/Simplex_tree.h>

#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Complex = Gudhi::Simplex_tree<Gudhi::Simplex_tree_options_fast_persistence>;
using Cohomology = Gudhi::persistent_cohomology::Persistent_cohomology<Complex, Gudhi::persistent_cohomology::Field_Zp>;

Complex read(const std::string& path) {
  std::ifstream in(path);
  if (!in) {
    throw std::runtime_error("cannot read " + path);
  }
  Complex complex;
  std::vector<Complex::Vertex_handle> simplex;
  for (std::size_t dimension = 0; in >> dimension;) {
    simplex.resize(dimension + 1);
    for (auto& vertex : simplex) {
      in >> vertex;
    }
    Complex::Filtration_value value = 0;
    in >> value;
    complex.insert_simplex(simplex, value);
  }
  return complex;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) {
      throw std::runtime_error("usage: bench_gudhi FILE");
    }
    Complex complex = read(argv[1]);
    Cohomology cohomology(complex, true);  // true: classes of the largest dimension too
    cohomology.init_coefficients(2);
    cohomology.compute_persistent_cohomology();
    std::cout << "betti";
    for (const int b : cohomology.betti_numbers()) {
      std::cout << ' ' << b;
    }
    std::cout << '\n';
  } catch (const std::exception& e) {
    std::cerr << "bench_gudhi: " << e.what() << '\n';
    return 1;
  }
  return 0;
}
