#include "ops/cells/value.hpp"

#include <numeric>

#include "tests/support/catch.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame::ops;
using namespace sesame::tests;

namespace {

/// A random map from the vertices of a random type of up to three components.
struct RandomMap {
  CellType type;
  VertexMap map;
  CellType underneath;
};

RandomMap random_map(Random& random) {
  RandomMap made;
  for (int i = random.in(1, 3); i > 0; --i) {
    const int a = random.in(1, 4);
    const int b = random.in(0, a);
    made.type.push_back(a);
    if (b > 0) {
      made.underneath.push_back(b);
    }
    std::vector<std::uint8_t> images;
    for (int k = 0; k <= a; ++k) {
      images.push_back(static_cast<std::uint8_t>(k <= b ? k : random.in(0, b)));
    }
    for (int k = a; k > 0; --k) {
      std::swap(images[static_cast<std::size_t>(k)], images[static_cast<std::size_t>(random.in(0, k))]);
    }
    made.map.insert(made.map.end(), images.begin(), images.end());
  }
  return made;
}

/// Calls `check` with random maps and the values of a cell 7 that have them.
template <class Check>
void for_random_values(TypeTable& types, VertexMaps& maps, unsigned seed, Check&& check) {
  Random random(seed);
  for (int round = 0; round < 500; ++round) {
    const RandomMap made = random_map(random);
    check(made, maps.value_of(7, types.intern(made.type), made.map));
  }
}

}  // namespace

TEST_CASE("a value says where every vertex goes, and nothing else", "[ops]") {
  TypeTable types;
  VertexMaps maps(types);
  for_random_values(types, maps, 1, [&](const RandomMap& made, const Value& v) {
    CHECK(maps.map_of(v) == made.map);
    CHECK(v.is_degenerate() == (made.type != made.underneath));
    CHECK(maps.value_of(7, v.type, maps.map_of(v)) == v);
  });
}

TEST_CASE("faces of values are restrictions of their maps", "[ops]") {
  TypeTable types;
  VertexMaps maps(types);
  for_random_values(types, maps, 2, [&](const RandomMap& made, const Value& v) {
    const TypeId underneath = types.intern(made.underneath);
    // Every face of the cell is a cell of its own, with its vertices in order.
    const auto face_of = [&](CellId, std::uint32_t number) {
      return Value{CellId{100 + number}, types.info(underneath).faces[number].type, 0};
    };
    for (std::uint32_t k = 0; k < types.info(v.type).faces.size(); ++k) {
      const Value face = maps.face(v, k, face_of);
      CHECK(face.type == types.info(v.type).faces[k].type);
      // Removing one vertex after another, in any order, is the same: the face laws, as far as one cell goes.
      for (const FaceLaw& law : types.info(v.type).laws) {
        if (law.first == k && face.cell == 7) {
          const Value other = maps.face(v, law.other_first, face_of);
          if (other.cell == 7) {
            CHECK(maps.face(face, law.second, face_of) == maps.face(other, law.other_second, face_of));
          }
        }
      }
    }
  });
}

TEST_CASE("orders compose and have inverses, and signs multiply", "[ops]") {
  TypeTable types;
  VertexMaps maps(types);
  Random random(3);
  std::vector<OrderId> orders;
  for (int round = 0; round < 30; ++round) {
    std::vector<std::uint8_t> permutation(5);
    std::iota(permutation.begin(), permutation.end(), std::uint8_t{0});
    for (int k = 4; k > 0; --k) {
      std::swap(permutation[static_cast<std::size_t>(k)], permutation[static_cast<std::size_t>(random.in(0, k))]);
    }
    orders.push_back(maps.order(permutation));
  }
  const Value cell{7, types.simplex(4), 0};
  for (const OrderId a : orders) {
    CHECK(maps.compose(a, maps.inverse(a)) == same_order);
    for (const OrderId b : orders) {
      CHECK(maps.sign(maps.compose(a, b)) == maps.sign(a) * maps.sign(b));
      CHECK(maps.reordered(a, maps.reordered(b, cell)).order == maps.compose(a, b));
    }
  }
  CHECK(maps.sign(maps.order(std::vector<std::uint8_t>{1, 0})) == -1);
  CHECK(maps.sign(maps.order(std::vector<std::uint8_t>{1, 2, 0})) == 1);
}
