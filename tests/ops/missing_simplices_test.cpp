// Simplices by their positions, beside a map.
#include "ops/plan/missing_simplices.hpp"

#include <map>
#include <random>

#include "tests/support/catch.hpp"

namespace sesame {
namespace {

using ops::MissingSimplices;
using Simplex = std::vector<std::uint32_t>;

Simplex random_simplex(std::mt19937& random, std::size_t vertices, std::uint32_t labels) {
  Simplex all(labels);
  for (std::uint32_t k = 0; k < labels; ++k) {
    all[k] = k;
  }
  std::ranges::shuffle(all, random);
  all.resize(vertices);
  std::ranges::sort(all);
  return all;
}

Simplex without(Simplex simplex, std::size_t k) {
  simplex.erase(simplex.begin() + static_cast<std::ptrdiff_t>(k));
  return simplex;
}

TEST_CASE("missing simplices are found, by themselves and as faces, and sorted as a map has them", "[ops]") {
  const std::uint32_t seed = GENERATE(range(0u, 12u));
  const std::size_t vertices = GENERATE(1u, 2u, 3u, 5u);
  CAPTURE(seed, vertices);
  std::mt19937 random(seed);
  MissingSimplices missing(vertices);
  std::map<Simplex, std::uint32_t> plain;
  const auto expected = [&](const Simplex& simplex) {
    const auto at = plain.find(simplex);
    return at == plain.end() ? MissingSimplices::nothing : at->second;
  };
  for (std::size_t step = 0; step < 6 + seed * 10; ++step) {
    const Simplex larger = random_simplex(random, vertices + 1, 9);
    for (std::size_t k = 0; k <= vertices; ++k) {
      const Simplex face = without(larger, k);
      CHECK(missing.find_face(larger, k, MissingSimplices::hash_of(face)) == expected(face));
    }
    const std::size_t k = random() % (vertices + 1);
    const Simplex added = without(larger, k);
    const std::uint64_t hash = MissingSimplices::hash_of(added);
    CHECK(missing.find(added, hash) == expected(added));
    if (plain.contains(added)) {
      continue;
    }
    const std::uint32_t number = step % 2 == 0 ? missing.add(added, hash) : missing.add_face(larger, k, hash);
    CHECK(number == plain.size());
    plain.emplace(added, number);
    CHECK(std::ranges::equal(missing[number], added));
  }
  REQUIRE(missing.size() == plain.size());
  std::vector<std::uint32_t> sorted;
  for (const auto& [simplex, number] : plain) {
    sorted.push_back(number);
  }
  CHECK(missing.sorted() == sorted);
}

}  // namespace
}  // namespace sesame
