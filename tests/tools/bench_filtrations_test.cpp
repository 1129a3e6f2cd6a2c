#include "tools/bench/filtrations.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "replay/tower/tower_reader.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_file.hpp"

using namespace sesame;
using namespace sesame::tools;

namespace {

using tests::TemporaryFile;

using Vertices = std::vector<std::uint32_t>;

Vertices list_of(std::span<const std::uint32_t> numbers) { return {numbers.begin(), numbers.end()}; }

std::vector<std::size_t> cells_by_dimension(const Filtration& filtration) {
  std::vector<std::size_t> counts(4);
  for (const std::uint8_t dimension : filtration.dimensions) {
    ++counts[dimension];
  }
  return counts;
}

/// The first thing wrong with a filtration, or an empty string: order, dimensions, values, boundaries of boundaries.
std::string first_defect(const Filtration& filtration) {
  for (std::size_t i = 0; i < filtration.size(); ++i) {
    std::map<std::uint32_t, int> twice_removed;
    const auto faces = filtration.faces[i];
    const std::string cell = "cell " + std::to_string(i);
    if (!std::is_sorted(faces.begin(), faces.end())) {
      return cell + " has faces out of order";
    }
    for (const std::uint32_t face : faces) {
      if (face >= i) {
        return cell + " comes before a face";
      }
      if (filtration.dimensions[face] + 1 != filtration.dimensions[i]) {
        return cell + " has a face of a wrong dimension";
      }
      for (const std::uint32_t of_face : filtration.faces[face]) {
        ++twice_removed[of_face];
      }
    }
    for (const auto& [face, times] : twice_removed) {
      if (times != 2) {
        return cell + " has a boundary with a boundary";
      }
    }
    if (i > 0 && filtration.values[i] < filtration.values[i - 1]) {
      return cell + " has a smaller value";
    }
  }
  return {};
}

/// The cells of each value, dimension and vertex list, in order, are ascending.
bool is_ordered_by_value_dimension_vertices(const Filtration& filtration) {
  for (std::size_t i = 1; i < filtration.size(); ++i) {
    const auto key = [&](std::size_t cell) {
      return std::tuple(filtration.values[cell], filtration.dimensions[cell], list_of(filtration.vertices[cell]));
    };
    if (key(i - 1) >= key(i)) {
      return false;
    }
  }
  return true;
}

struct ReadBack {
  replay::TowerFormat format;
  std::vector<int> dimensions;
  std::vector<double> times;
  std::vector<Vertices> labels;
};

ReadBack read_back(void (*write)(std::ostream&, const Filtration&), const Filtration& filtration) {
  std::ostringstream out;
  write(out, filtration);
  const TemporaryFile file(out.str());
  const auto reader = replay::TowerReader::open(file.path());
  REQUIRE(reader);
  ReadBack read{(*reader)->format(), {}, {}, {}};
  for (replay::TowerOperation operation; (*reader)->next(operation).value();) {
    read.dimensions.push_back(operation.dimension);
    read.times.push_back(operation.time.nearest());
    read.labels.emplace_back(operation.labels.begin(), operation.labels.end());
  }
  return read;
}

}  // namespace

TEST_CASE("The torus is one, by its cells and their order", "[bench]") {
  for (const std::uint32_t n : {3U, 4U, 7U}) {
    const Filtration torus = torus_filtration(n);
    const std::size_t vertices = std::size_t{n} * n;
    CHECK(cells_by_dimension(torus) == std::vector<std::size_t>{vertices, 3 * vertices, 2 * vertices, 0});
    CHECK(first_defect(torus).empty());
    CHECK(is_ordered_by_value_dimension_vertices(torus));
    for (std::size_t i = 0; i < torus.size(); ++i) {
      CHECK(torus.values[i] == static_cast<double>(torus.vertices[i].back()));
    }
  }
}

TEST_CASE("Every edge of the torus is in two triangles", "[bench]") {
  const Filtration torus = torus_filtration(5);
  std::map<std::uint32_t, int> triangles;
  for (std::size_t i = 0; i < torus.size(); ++i) {
    if (torus.dimensions[i] != 2) {
      continue;
    }
    for (const std::uint32_t edge : torus.faces[i]) {
      ++triangles[edge];
    }
  }
  CHECK(triangles.size() == 75);
  CHECK(std::all_of(triangles.begin(), triangles.end(), [](const auto& edge) { return edge.second == 2; }));
}

TEST_CASE("A Rips complex has every clique of its edges, at the length of the longest", "[bench]") {
  const Filtration rips = rips_filtration(25, 1000, 3);
  CHECK(first_defect(rips).empty());
  CHECK(is_ordered_by_value_dimension_vertices(rips));
  std::map<Vertices, double> value;
  for (std::size_t i = 0; i < rips.size(); ++i) {
    value[list_of(rips.vertices[i])] = rips.values[i];
  }
  std::size_t cliques = 0;
  const auto longest_edge = [&](const Vertices& vertices) {
    double longest = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      for (std::size_t j = i + 1; j < vertices.size(); ++j) {
        const auto edge = value.find({vertices[i], vertices[j]});
        longest = std::max(longest, edge == value.end() ? 1e9 : edge->second);
      }
    }
    return longest;
  };
  const auto count = [&](const Vertices& vertices) {
    const double longest = longest_edge(vertices);
    if (longest < 1e9) {
      ++cliques;
      CHECK(value.at(vertices) == longest);
    }
  };
  for (std::uint32_t a = 0; a < 25; ++a) {
    count({a});
    for (std::uint32_t b = a + 1; b < 25; ++b) {
      count({a, b});
      for (std::uint32_t c = b + 1; c < 25; ++c) {
        count({a, b, c});
        for (std::uint32_t d = c + 1; d < 25; ++d) {
          count({a, b, c, d});
        }
      }
    }
  }
  CHECK(cliques == rips.size());
}

TEST_CASE("A Rips complex is the smallest with so many cells", "[bench]") {
  const Filtration rips = rips_filtration(40, 2000, 1);
  CHECK(rips.size() >= 2000);
  const auto longest = std::lower_bound(rips.values.begin(), rips.values.end(), rips.values.back());
  CHECK(longest - rips.values.begin() < 2000);
  CHECK(rips_filtration(5, 1000, 1).size() == 5 + 10 + 10 + 5);
  CHECK(rips_filtration(1, 1000, 1).size() == 1);
}

TEST_CASE("A cubical grid has the largest value of its vertices on every cell", "[bench]") {
  for (const unsigned rounds : {0U, 3U}) {
    const Filtration grid = cubical_filtration(5, rounds, 2);
    CHECK(cells_by_dimension(grid) == std::vector<std::size_t>{125, 300, 240, 64});
    CHECK(first_defect(grid).empty());
    CHECK(!grid.is_simplicial());
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const auto faces = grid.faces[i];
      CHECK(faces.size() == std::size_t{2} * grid.dimensions[i]);
      if (faces.empty()) {
        continue;
      }
      double largest = 0;
      for (const std::uint32_t face : faces) {
        largest = std::max(largest, grid.values[face]);
      }
      CHECK(grid.values[i] == largest);
    }
  }
}

TEST_CASE("Smoothing draws the values of a grid together", "[bench]") {
  double spread = 2;
  for (const unsigned rounds : {0U, 1U, 4U}) {
    const Filtration grid = cubical_filtration(8, rounds, 2);
    const double here = grid.values.back() - grid.values.front();
    CHECK(here < spread);
    spread = here;
  }
}

TEST_CASE("A random 2-complex has all edges and different triangles", "[bench]") {
  const Filtration complex = random_two_complex(9, 50, 4);
  CHECK(cells_by_dimension(complex) == std::vector<std::size_t>{9, 36, 50, 0});
  CHECK(first_defect(complex).empty());
  std::set<Vertices> different;
  for (std::size_t i = 0; i < complex.size(); ++i) {
    different.insert(list_of(complex.vertices[i]));
  }
  CHECK(different.size() == complex.size());
  CHECK(std::is_sorted(complex.dimensions.begin(), complex.dimensions.end()));
  CHECK(random_two_complex(5, 1000, 4).size() == 5 + 10 + 10);
}

TEST_CASE("Seeds make a difference, and the only one", "[bench]") {
  CHECK(rips_filtration(20, 500, 1).values == rips_filtration(20, 500, 1).values);
  CHECK(rips_filtration(20, 500, 1).values != rips_filtration(20, 500, 2).values);
  // The first number of the engine that the standard defines, 2469588189546311528 for seed 1, cut to 53 bits.
  CHECK(cubical_filtration(1, 0, 1).values == std::vector<double>{0x1.122deafddb434p-3});
}

TEST_CASE("What is written in each format reads back as the same filtration", "[bench]") {
  const Filtration rips = rips_filtration(12, 400, 6);
  const std::vector<int> dimensions(rips.dimensions.begin(), rips.dimensions.end());
  std::vector<Vertices> vertices, faces;
  for (std::size_t i = 0; i < rips.size(); ++i) {
    vertices.push_back(list_of(rips.vertices[i]));
    faces.push_back(list_of(rips.faces[i]));
  }
  const ReadBack phat = read_back(write_phat, rips), binary = read_back(write_phat_binary, rips);
  const ReadBack gudhi = read_back(write_gudhi, rips), tower = read_back(write_tower, rips);
  CHECK(phat.format == replay::TowerFormat::phat);
  CHECK(binary.format == replay::TowerFormat::phat_binary);
  CHECK(gudhi.format == replay::TowerFormat::gudhi);
  CHECK(tower.format == replay::TowerFormat::tower);
  for (const ReadBack& read : {phat, binary, gudhi, tower}) {
    CHECK(read.dimensions == dimensions);
  }
  CHECK(phat.labels == faces);
  CHECK(binary.labels == faces);
  CHECK(gudhi.labels == vertices);
  CHECK(tower.labels == vertices);
  CHECK(gudhi.times == rips.values);
}
