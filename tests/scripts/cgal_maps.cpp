// CGAL's side of cgal_maps_test.py: it writes maps of its own, and counts what it reads in those of others.
//
//   cgal_maps write NAME FILE          one of the maps below
//   cgal_maps count map|general FILE   valid or wrong, darts, cells of dimensions 0 to 3, components; of a
//   combinatorial
//                                      map also how many points there are, and their sum
#include <CGAL/Generalized_map.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>

#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

using Complex = CGAL::Linear_cell_complex_for_combinatorial_map<3, 3>;
using General = CGAL::Generalized_map<3>;
using Point = Complex::Point;

Complex some_complex(const std::string& name) {
  Complex complex;
  if (name == "tetrahedron") {
    complex.make_tetrahedron(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 0.1));
  }
  for (int x = 0; name == "cubes" && x < 3; ++x) {
    complex.make_hexahedron(Point(x, 0, 0), Point(x + 1, 0, 0), Point(x + 1, 1, 0), Point(x, 1, 0), Point(x, 1, 1),
                            Point(x, 0, 1), Point(x + 1, 0, 1), Point(x + 1, 1, 1));
  }
  complex.sew3_same_facets();
  if (name == "torus") {
    const auto side = complex.make_combinatorial_polygon(4);
    complex.sew<2>(side, complex.beta(side, 1, 1));
    complex.sew<2>(complex.beta(side, 1), complex.beta(side, 0));
  }
  return complex;
}

/// A square with two opposite sides sewn so that it is a Moebius strip.
General moebius() {
  General map;
  const auto first = map.make_combinatorial_polygon(4);
  map.sew<2>(first, map.alpha(first, 1, 0, 1, 0));
  return map;
}

template <class Map>
int write(const Map& map, const std::string& file) {
  std::ofstream out(file);
  out << map;
  return out.flush() ? 0 : 1;
}

template <class Map>
void say(const Map& map) {
  std::cout << (map.is_valid() ? "valid" : "wrong") << ' ' << map.number_of_darts();
  for (const unsigned int count : map.count_cells({0, 1, 2, 3, 4})) {
    std::cout << ' ' << count;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv, argv + argc);
  if (words.size() != 4) {
    return 1;
  }
  if (words[1] == "write") {
    return words[2] == "moebius" ? write(moebius(), words[3]) : write(some_complex(words[2]), words[3]);
  }
  std::ifstream in(words[3]);
  if (words[2] == "general") {
    General map;
    in >> map;
    say(map);
    std::cout << '\n';
    return 0;
  }
  Complex map;
  in >> map;
  say(map);
  double x = 0, y = 0, z = 0;
  for (auto at = map.vertex_attributes().begin(); at != map.vertex_attributes().end(); ++at) {
    x += at->point().x(), y += at->point().y(), z += at->point().z();
  }
  std::cout << ' ' << map.vertex_attributes().size() << ' ' << x << ' ' << y << ' ' << z << '\n';
  return 0;
}
