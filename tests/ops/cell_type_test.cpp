#include "ops/cells/cell_type.hpp"

#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "sparse/contract.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/monotone_maps.hpp"

using namespace sesame;
using namespace sesame::ops;
using sesame::tests::types_up_to_dimension;

namespace {

/// A face of a product of simplices as what it is: a set of vertices in each factor.
using VertexSets = std::vector<std::set<int>>;

/// The faces in flattened order, straight from the definition: leave out the j-th vertex of a factor with several.
std::vector<VertexSets> faces_of(const VertexSets& cell) {
  std::vector<VertexSets> faces;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    if (cell[i].size() > 1) {
      for (const int vertex : cell[i]) {
        faces.push_back(cell);
        faces.back()[i].erase(vertex);
      }
    }
  }
  return faces;
}

VertexSets whole(const CellType& type) {
  VertexSets sets;
  for (const int a : type) {
    sets.emplace_back();
    for (int v = 0; v <= a; ++v) {
      sets.back().insert(v);
    }
  }
  return sets;
}

std::string suffix_of(const VertexSets& cell) {
  std::string text;
  for (const auto& set : cell) {
    text += text.empty() ? "" : "x";
    std::string factor;
    for (const int vertex : set) {
      factor += (factor.empty() ? "" : "-") + std::to_string(vertex);
    }
    text += factor;
  }
  return text;
}

}  // namespace

TEST_CASE("a type's faces, signs and dimension are those of the definition", "[ops]") {
  TypeTable types;
  for (const CellType& type : types_up_to_dimension(5)) {
    CAPTURE(type);
    const TypeInfo& info = types.info(types.intern(type));
    CHECK(info.type == type);
    CHECK(info.dimension == std::accumulate(type.begin(), type.end(), 0));
    std::size_t k = 0;
    int before = 0;
    for (std::size_t i = 0; i < type.size(); ++i) {
      for (int j = 0; j <= type[i]; ++j, ++k) {
        CellType face = type;
        if (--face[i] == 0) {
          face.erase(face.begin() + static_cast<std::ptrdiff_t>(i));
        }
        REQUIRE(k < info.faces.size());
        CHECK(info.faces[k].component == static_cast<int>(i));
        CHECK(info.faces[k].vertex == j);
        CHECK(info.faces[k].sign == ((j + before) % 2 == 0 ? 1 : -1));
        CHECK(types.info(info.faces[k].type).type == face);
      }
      before += type[i];
    }
    CHECK(info.faces.size() == k);
  }
}

TEST_CASE("the face laws are exactly the coincidences of double faces, each once", "[ops]") {
  TypeTable types;
  for (const CellType& type : types_up_to_dimension(5)) {
    CAPTURE(type);
    using Path = std::pair<std::uint32_t, std::uint32_t>;
    std::map<VertexSets, std::vector<Path>> paths;
    const std::vector<VertexSets> faces = faces_of(whole(type));
    for (std::uint32_t first = 0; first < faces.size(); ++first) {
      const std::vector<VertexSets> second = faces_of(faces[first]);
      for (std::uint32_t k = 0; k < second.size(); ++k) {
        paths[second[k]].emplace_back(first, k);
      }
    }
    std::set<std::pair<Path, Path>> expected;
    for (const auto& [cell, ways] : paths) {
      REQUIRE(ways.size() == 2);
      expected.insert(std::minmax(ways[0], ways[1]));
    }
    std::set<std::pair<Path, Path>> found;
    const std::vector<FaceLaw>& laws = types.info(types.intern(type)).laws;
    for (const FaceLaw& law : laws) {
      found.insert(std::minmax(Path{law.first, law.second}, Path{law.other_first, law.other_second}));
    }
    CHECK(found == expected);
    CHECK(found.size() == laws.size());
  }
}

TEST_CASE("a standard cell lists every face once, faces before cofaces, with its vertex subsets as suffix", "[ops]") {
  TypeTable types;
  for (const CellType& type : types_up_to_dimension(5)) {
    CAPTURE(type);
    const StandardCell& standard = types.standard(types.intern(type));
    CHECK(static_cast<std::int64_t>(standard.cells.size()) == standard_cell_count(type));
    // Every cell below the whole, with its faces, found from the definition alone.
    std::map<std::string, std::vector<std::string>> expected;
    std::vector<VertexSets> pending{whole(type)};
    while (!pending.empty()) {
      const VertexSets cell = pending.back();
      pending.pop_back();
      auto [at, is_new] = expected.emplace(suffix_of(cell), std::vector<std::string>{});
      if (is_new) {
        for (const VertexSets& face : faces_of(cell)) {
          at->second.push_back(suffix_of(face));
          pending.push_back(face);
        }
      }
    }
    CHECK(expected.size() == standard.cells.size());
    for (std::uint32_t k = 0; k < standard.cells.size(); ++k) {
      const StandardFace& cell = standard.cells[k];
      std::vector<std::string> faces;
      for (const std::uint32_t face : cell.faces) {
        REQUIRE(face < k);
        faces.push_back(standard.cells[face].suffix);
      }
      REQUIRE(expected.contains(cell.suffix));
      CHECK(expected.at(cell.suffix) == faces);
      CHECK(types.info(cell.type).faces.size() == faces.size());
    }
    CHECK(standard.cells.back().suffix == suffix_of(whole(type)));
    CHECK(types.info(standard.cells.back().type).type == type);
  }
}

TEST_CASE("the signs make every boundary of a boundary vanish", "[ops]") {
  TypeTable types;
  for (const CellType& type : types_up_to_dimension(5)) {
    CAPTURE(type);
    const StandardCell& standard = types.standard(types.intern(type));
    for (const StandardFace& cell : standard.cells) {
      std::map<std::uint32_t, int> twice;
      for (std::size_t k = 0; k < cell.faces.size(); ++k) {
        const StandardFace& face = standard.cells[cell.faces[k]];
        for (std::size_t m = 0; m < face.faces.size(); ++m) {
          twice[face.faces[m]] += types.info(cell.type).faces[k].sign * types.info(face.type).faces[m].sign;
        }
      }
      for (const auto& [below, coefficient] : twice) {
        CHECK(coefficient == 0);
      }
    }
  }
}

TEST_CASE("vertices of a simploid come in lexicographic order", "[ops]") {
  TypeTable types;
  std::vector<std::string> vertices;
  for (const StandardFace& cell : types.standard(types.intern({2, 1})).cells) {
    if (cell.faces.empty()) {
      vertices.push_back(cell.suffix);
    }
  }
  CHECK(vertices == std::vector<std::string>{"0x0", "0x1", "1x0", "1x1", "2x0", "2x1"});
}

TEST_CASE("the number of faces of a standard cell saturates instead of overflowing", "[ops]") {
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  CHECK(standard_cell_count({}) == 1);
  CHECK(standard_cell_count({3}) == 15);
  CHECK(standard_cell_count({2, 1}) == 21);
  CHECK(standard_cell_count({61}) == (std::int64_t{1} << 62) - 1);
  CHECK(standard_cell_count({62}) == most);
  CHECK(standard_cell_count({1'000'000}) == most);
  CHECK(standard_cell_count({61, 1}) == most);
  CHECK(standard_cell_count(CellType(39, 1)) == 4052555153018976267);  // 3^39
  CHECK(standard_cell_count(CellType(40, 1)) == most);
  CHECK(standard_cell_count(CellType(100'000, 1)) == most);
}

TEST_CASE("a type is described once, and for people", "[ops]") {
  TypeTable types;
  CHECK(types.intern({}) == types.vertex());
  CHECK(types.simplex(0) == types.vertex());
  CHECK(types.intern({2, 1}) == types.intern({2, 1}));
  CHECK(types.intern({2, 1}) != types.intern({1, 2}));
  CHECK(types.simplex(2) == types.intern({2}));
  CHECK(describe({}) == "vertex");
  CHECK(describe({2}) == "simplex of dimension 2");
  CHECK(describe({1, 1}) == "cube of dimension 2");
  CHECK(describe({2, 1}) == "simploid [2,1]");
  CHECK(is_simplex({}));
  CHECK(is_simplex({4}));
  CHECK_FALSE(is_simplex({1, 1}));
  CHECK_THROWS_AS(types.intern({1, 0}), sparse::ContractViolation);
}
