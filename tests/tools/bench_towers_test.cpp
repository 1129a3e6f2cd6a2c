#include "tools/bench/towers.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/catch.hpp"

using namespace sesame::tools;

namespace {

using Simplex = std::set<std::uint64_t>;

struct Line {
  char kind;
  std::vector<std::uint64_t> labels;
};

std::string text_of(const TowerOptions& options) {
  std::ostringstream out;
  write_random_tower(out, options);
  return out.str();
}

std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream in(text);
  for (std::string words; std::getline(in, words);) {
    std::istringstream line(words);
    lines.push_back({});
    line >> lines.back().kind;
    for (std::uint64_t label = 0; line >> label;) {
      lines.back().labels.push_back(label);
    }
  }
  return lines;
}

/// A plain complex that a tower is carried out on.
struct Complex {
  std::set<Simplex> simplices;
  std::set<std::uint64_t> dead;

  [[nodiscard]] std::size_t vertices() const {
    return static_cast<std::size_t>(
        std::count_if(simplices.begin(), simplices.end(), [](const Simplex& s) { return s.size() == 1; }));
  }
  /// False when the operation is not legal.
  bool apply(const Line& line) { return line.kind == 'i' ? insert(line.labels) : contract(line.labels); }
  bool insert(const std::vector<std::uint64_t>& labels) {
    const Simplex simplex(labels.begin(), labels.end());
    if (simplex.size() != labels.size() || dead.contains(labels[0])) {
      return false;
    }
    for (const std::uint64_t label : simplex) {
      Simplex face = simplex;
      face.erase(label);
      if (!face.empty() && !simplices.contains(face)) {
        return false;
      }
    }
    return simplices.insert(simplex).second;
  }
  bool contract(const std::vector<std::uint64_t>& labels) {
    if (labels.size() != 2 || !simplices.contains({labels[0]}) || !simplices.contains({labels[1]})) {
      return false;
    }
    dead.insert(labels[0]);
    std::set<Simplex> after;
    for (Simplex simplex : simplices) {
      if (simplex.erase(labels[0]) == 1) {
        simplex.insert(labels[1]);
      }
      after.insert(simplex);
    }
    simplices = after;
    return labels[0] != labels[1];
  }
};

}  // namespace

TEST_CASE("Every operation of a random tower is legal, and the vertices keep to their number", "[bench]") {
  for (const bool along_edges : {true, false}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      Complex complex;
      std::size_t contractions = 0, off_edges = 0;
      const std::vector<Line> lines = lines_of(text_of({600, 12, 3, 0.1, along_edges, seed}));
      CHECK(lines.size() == 600);
      for (const Line& line : lines) {
        if (line.kind == 'c') {
          ++contractions;
          off_edges += complex.simplices.contains({line.labels[0], line.labels[1]}) ? 0U : 1U;
        }
        REQUIRE(complex.apply(line));
        REQUIRE(line.labels.size() <= 4);
        REQUIRE(complex.vertices() <= 12);
      }
      CHECK(contractions > 30);
      CHECK(contractions < 120);
      CHECK((off_edges == 0) == along_edges);
    }
  }
}

TEST_CASE("A random tower uses all dimensions it may, and no more", "[bench]") {
  for (const int largest : {0, 1, 2, 3}) {
    std::set<std::size_t> sizes;
    for (const Line& line : lines_of(text_of({500, 20, largest, 0.1, false, 1}))) {
      if (line.kind == 'i') {
        sizes.insert(line.labels.size());
      }
    }
    CHECK(sizes.size() == static_cast<std::size_t>(largest) + 1);
    CHECK(*sizes.rbegin() == static_cast<std::size_t>(largest) + 1);
  }
}

TEST_CASE("A tower that can go on no more ends", "[bench]") {
  CHECK(text_of({10, 1, 3, 0.5, true, 1}) == "i 0\n");
  CHECK(lines_of(text_of({10, 2, 0, 0, true, 1})).size() == 2);
  CHECK(text_of({10, 0, 3, 0.5, false, 1}).empty());
}

TEST_CASE("The live complex of a long tower stays small", "[bench]") {
  const std::vector<Line> lines = lines_of(text_of({20'000, 8, 2, 0.1, true, 1}));
  Complex complex;
  std::size_t largest = 0;
  for (const Line& line : lines) {
    REQUIRE(complex.apply(line));
    largest = std::max(largest, complex.simplices.size());
  }
  CHECK(lines.size() == 20'000);
  CHECK(largest <= 8 + 28 + 56);
}

TEST_CASE("A seed means one tower", "[bench]") {
  const auto tower = [](std::uint64_t seed) { return text_of({200, 10, 2, 0.1, true, seed}); };
  CHECK(tower(1) == tower(1));
  CHECK(tower(1) != tower(2));
}
