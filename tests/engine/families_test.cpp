// Products and cones as the big complex sees them: against the tensor product of the factors' maps, against the laws,
// and against the same cones written out.
#include "engine/left/families.hpp"

#include <map>
#include <memory>
#include <set>

#include "engine/left/cone_maps.hpp"
#include "engine/left/product_maps.hpp"
#include "engine/left/simplicial_product_maps.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/left_side.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::FamilyMaps;
using engine::PairTable;
using engine::Symbol;
using ops::CellId;

namespace {

/// Applies steps that must be legal, and lets a left side follow.
template <sparse::Ring R>
void take_steps(Workshop& shop, LeftSide<R>& side, const std::vector<ops::Operation>& steps) {
  for (const ops::Operation& step : steps) {
    REQUIRE(shop.apply(step));
    side.follow();
  }
}

/// A product of the bodies A and B, followed up to the step before it.
template <sparse::Ring R>
class ProductOf {
 public:
  ProductOf(R ring, const Body& a, const Body& b, bool is_simplicial)
      : side_{std::make_unique<LeftSide<R>>(ring, engine::Window{shop_.structure()})} {
    take_steps(shop_, *side_, a.steps);
    take_steps(shop_, *side_, b.steps);
    left_ = symbols_of(a.name);
    right_ = symbols_of(b.name);
    const PairTable pairs(left_, right_, side_->big().size(), [&](Symbol x) { return side_->rewriter().degree(x); });
    take_steps(shop_, *side_, {product("P", a.name, b.name, is_simplicial)});
    if (is_simplicial) {
      maps_ = std::make_unique<engine::SimplicialProductMaps<R>>(ring, shop_.structure(), ops::FamilyId{}, pairs,
                                                                 side_->frozen());
    } else {
      maps_ =
          std::make_unique<engine::ProductMaps<R>>(ring, shop_.structure(), ops::FamilyId{}, pairs, side_->frozen());
    }
    pairs_ = std::make_unique<PairTable>(pairs);
  }

  const ops::Structure& structure() const { return shop_.structure(); }
  LeftSide<R>& side() { return *side_; }
  const FamilyMaps<R>& maps() const { return *maps_; }
  const PairTable& pairs() const { return *pairs_; }
  const std::vector<Symbol>& left() const { return left_; }
  const std::vector<Symbol>& right() const { return right_; }

 private:
  /// The small generators of a body, sorted.
  std::vector<Symbol> symbols_of(const std::string& body) {
    std::vector<Symbol> symbols;
    engine::Rewriter<R>& rewriter = side_->rewriter();
    for (int p = 0; p < static_cast<int>(rewriter.small_counts().size()); ++p) {
      for (const Symbol x : rewriter.small(p)) {
        if (side_->big().body_of(rewriter.generator_in(x)) == *shop_.structure().lookup_body(body)) {
          symbols.push_back(x);
        }
      }
    }
    std::sort(symbols.begin(), symbols.end());
    return symbols;
  }

  Workshop shop_;
  std::unique_ptr<LeftSide<R>> side_;
  std::unique_ptr<FamilyMaps<R>> maps_;
  std::unique_ptr<PairTable> pairs_;
  std::vector<Symbol> left_, right_;
};

template <sparse::Ring R, class Id>
Terms<R, Id> normal(const R& ring, sparse::RawTerms<R, Id> terms) {
  return std::move(terms).normal(ring);
}
template <sparse::Ring R>
Terms<R, GeneratorId> F(const R& ring, const FamilyMaps<R>& maps, CellId cell) {
  sparse::RawTerms<R, GeneratorId> out;
  maps.add_F(cell, ring.one(), out);
  return normal(ring, out);
}
template <sparse::Ring R>
Terms<R, CellId> G(const R& ring, const FamilyMaps<R>& maps, GeneratorId generator) {
  sparse::RawTerms<R, CellId> out;
  maps.add_G(generator, ring.one(), out);
  return normal(ring, out);
}
template <sparse::Ring R>
Terms<R, CellId> K(const R& ring, const FamilyMaps<R>& maps, CellId cell) {
  sparse::RawTerms<R, CellId> out;
  maps.add_K(cell, ring.one(), out);
  return normal(ring, out);
}

/// d of a cell or chain of the family, of the generators of one; with d F = F d, d G = G d and d K + K d = 1 - G F.
template <sparse::Ring R>
void check_laws(const R& ring, const FamilyMaps<R>& maps, const LeftSide<R>& side, const std::vector<CellId>& cells,
                std::span<const GeneratorId> generators) {
  const auto of = [&](const auto& map, const auto& chain) { return applied(ring, map, chain); };
  const auto d = [&](CellId c) { return side.boundary_of_cell(c); };
  const auto d_small = [&](GeneratorId x) { return side.boundary_of_generator(x); };
  const auto map_F = [&](CellId c) { return F(ring, maps, c); };
  const auto map_G = [&](GeneratorId x) { return G(ring, maps, x); };
  const auto map_K = [&](CellId c) { return K(ring, maps, c); };
  for (const CellId c : cells) {
    REQUIRE(of(d_small, map_F(c)) == of(map_F, d(c)));
    REQUIRE(sum_of<CellId>(ring, {of(d, map_K(c)), of(map_K, d(c)), of(map_G, map_F(c))}) == one_term(ring, c));
  }
  for (const GeneratorId x : generators) {
    REQUIRE(of(d, map_G(x)) == of(map_G, d_small(x)));
  }
}

/// What is said without writing a map out is what it is.
template <sparse::Ring R>
void check_questions(const R& ring, const FamilyMaps<R>& maps, const std::vector<CellId>& cells,
                     std::span<const GeneratorId> generators) {
  Random random(1);
  for (const CellId c : cells) {
    sparse::RawTerms<R, CellId> all;
    maps.add_K(c, ring.from(3), all);
    REQUIRE(maps.terms_of_K(c) >= all.size());
    std::vector<CellId> at;
    std::copy_if(cells.begin(), cells.end(), std::back_inserter(at), [&](CellId) { return random.one_in(3); });
    std::sort(at.begin(), at.end());
    Terms<R, CellId> expected = normal(ring, all);
    std::erase_if(expected, [&](const auto& term) { return !std::binary_search(at.begin(), at.end(), term.index); });
    sparse::RawTerms<R, CellId> at_those;
    maps.add_K_at(c, at, ring.from(3), at_those);
    Terms<R, CellId> found = normal(ring, at_those);
    std::erase_if(found, [&](const auto& term) {  // it may be asked for cells of any dimension
      return std::none_of(expected.begin(), expected.end(), [&](const auto& e) { return e.index == term.index; });
    });
    REQUIRE(found == expected);
    sparse::RawTerms<R, GeneratorId> column;
    for (const GeneratorId x : generators) {
      for (const auto& [cell, coefficient] : G(ring, maps, x)) {
        if (cell == c) {
          column.push_back({x, coefficient});
        }
      }
    }
    REQUIRE(maps.transposed_G(c) == normal(ring, column));
  }
  for (const GeneratorId x : generators) {
    sparse::RawTerms<R, CellId> all;
    maps.add_G(x, ring.one(), all);
    REQUIRE(maps.terms_of_G(x) == all.size());
  }
}

template <sparse::Ring R>
std::vector<GeneratorId> generators_of(const ProductOf<R>& made) {
  std::vector<GeneratorId> generators;
  for (GeneratorId x = made.pairs().first(); x < made.pairs().end(); ++x) {
    generators.push_back(x);
  }
  return generators;
}

template <sparse::Ring R>
void check_product(const R& ring, const Body& a, const Body& b, bool is_simplicial) {
  CAPTURE(a.what, b.what, is_simplicial);
  ProductOf<R> made(ring, a, b, is_simplicial);
  const std::vector<CellId> cells = current_cells(made.structure());
  const std::vector<GeneratorId> generators = generators_of(made);
  REQUIRE(generators.size() == made.left().size() * made.right().size());
  check_laws(ring, made.maps(), made.side(), cells, generators);
  check_questions(ring, made.maps(), cells, generators);
  for (const CellId c : cells) {  // the big complex has the same maps
    REQUIRE(made.side().g(c) == F(ring, made.maps(), c));
    REQUIRE(made.side().K(c) == K(ring, made.maps(), c));
  }
  for (const GeneratorId x : generators) {
    REQUIRE(made.side().f(x) == G(ring, made.maps(), x));
  }
}

}  // namespace

TEST_CASE("a table of pairs has each pair once, by degree, and tensor products in it", "[engine][left]") {
  const auto degree_of = [](Symbol x) { return static_cast<int>(x % 3); };
  const std::vector<Symbol> left{2, 3, 7};
  const std::vector<Symbol> right{0, 4};
  const PairTable pairs(left, right, 100, degree_of);
  CHECK(pairs.end() == 106);
  std::set<std::pair<Symbol, Symbol>> seen;
  int degree = 0;
  const sparse::Integers z;
  for (GeneratorId x = pairs.first(); x < pairs.end(); ++x) {
    const auto [a, b] = pairs.pair(x);
    CHECK(seen.emplace(a, b).second);
    CHECK(degree_of(a) + degree_of(b) >= degree);
    degree = degree_of(a) + degree_of(b);
    sparse::RawTerms<sparse::Integers, GeneratorId> out;
    pairs.add_tensor(z, {{a, 2}}, {{b, 3}}, sparse::Integer{5}, out);
    CHECK(normal(z, out) == Terms<sparse::Integers, GeneratorId>{{x, 30}});
  }
  sparse::RawTerms<sparse::Integers, GeneratorId> out;
  pairs.add_tensor(z, {{2, 1}, {7, -1}}, {{0, 1}, {4, 2}}, sparse::Integer{1}, out);
  CHECK(out.size() == 4);
}

TEST_CASE("the maps of a product are an equivalence with the tensor product of the factors' small complexes",
          "[engine][left]") {
  check_product(sparse::Integers{}, circle("A"), plane_of_three_cells("B"), false);
  check_product(sparse::Integers{}, moore_body("A", 3), moore_body("B", 2), false);
  check_product(sparse::Z2{}, plane_of_triangles("A"), torus_of_square("B"), false);
  check_product(*sparse::Zp::make(3), scattered("A", 3), edge("B"), false);
}

TEST_CASE("the maps of a simplicial product are an equivalence with the tensor product of the small complexes",
          "[engine][left]") {
  check_product(sparse::Integers{}, circle("A"), plane_of_three_cells("B"), true);
  check_product(sparse::Integers{}, moore_body("A", 2), circle("B"), true);
  check_product(sparse::Z2{}, plane_of_three_cells("A"), plane_of_three_cells("B"), true);
  check_product(*sparse::Zp::make(3), edge("A"), squashed_sphere("B", 2), true);
}

TEST_CASE("F, G and K of a product of cells are those of the factors, multiplied term by term", "[engine][left]") {
  const sparse::Integers z;
  ProductOf<sparse::Integers> made(z, moore_body("A", 3), plane_of_triangles("B"), false);
  engine::FrozenMaps<sparse::Integers>& factors = made.side().frozen();
  const ops::Structure& structure = made.structure();
  const auto cell_of = [&](CellId a, CellId b) {
    const ops::Values& values = structure.values();
    return structure.lazy().cell(0, ops::LazyPart::pair, values.plain(a), values.plain(b));
  };
  const auto tensor = [&](const auto& left, const auto& right, auto&& place, int sign) {
    using Id = decltype(place(left.front().index, right.front().index));
    sparse::RawTerms<sparse::Integers, Id> out;
    for (const auto& [a, m] : left) {
      for (const auto& [b, n] : right) {
        out.push_back({place(a, b), m * n * sparse::Integer{sign}});
      }
    }
    return std::move(out).normal(z);
  };
  const auto generator_of = [&](Symbol a, Symbol b) {
    GeneratorId x = made.pairs().first();
    while (made.pairs().pair(x) != std::pair{a, b}) {
      ++x;
    }
    return x;
  };
  for (const CellId a : structure.lazy().cells_of(*structure.lookup_body("A"))) {
    for (const CellId b : structure.lazy().cells_of(*structure.lookup_body("B"))) {
      const CellId cell = cell_of(a, b);
      REQUIRE(F(z, made.maps(), cell) == tensor(factors.F(a), factors.F(b), generator_of, 1));
      const auto& of_a = factors.homotopy(a);
      REQUIRE(K(z, made.maps(), cell) == sum_of<CellId>(z, {tensor(of_a.K, one_term(z, b), cell_of, 1),
                                                            tensor(of_a.GF, factors.homotopy(b).K, cell_of,
                                                                   structure.dimension(a) % 2 == 0 ? 1 : -1)}));
    }
  }
  for (const Symbol a : made.left()) {
    for (const Symbol b : made.right()) {
      REQUIRE(G(z, made.maps(), generator_of(a, b)) == tensor(factors.G(a), factors.G(b), cell_of, 1));
    }
  }
}

TEST_CASE("the maps of a cone contract it to its apex", "[engine][left]") {
  const sparse::Integers z;
  Workshop shop(limits(true));
  LeftSide<sparse::Integers> side(z, engine::Window{shop.structure()});
  take_steps(shop, side, plane_of_triangles("B").steps);
  take_steps(shop, side, {cone_over_body("v", "B")});
  const ops::Structure& structure = shop.structure();
  REQUIRE(structure.lazy().families() == 1);
  const engine::ConeMaps<sparse::Integers> maps(z, structure, 0, side.maps());
  const CellId apex = shop.cell("v");
  std::vector<CellId> cells = current_cells(structure);
  std::erase(cells, apex);
  const auto of = [&](const auto& map, const auto& chain) { return applied(z, map, chain); };
  const auto d = [&](CellId c) { return side.boundary_of_cell(c); };
  const auto on_apex = [&](CellId c) { return c == apex ? Terms<sparse::Integers, CellId>{} : K(z, maps, c); };
  const auto image = [&](CellId c) { return c == apex ? side.g(apex) : F(z, maps, c); };
  for (const CellId c : cells) {
    REQUIRE(of(image, d(c)) == of([&](GeneratorId x) { return side.boundary_of_generator(x); }, image(c)));
    // G of the apex' generator is the apex.
    const Terms<sparse::Integers, CellId> back =
        image(c).empty() ? Terms<sparse::Integers, CellId>{} : one_term(z, apex);
    REQUIRE(sum_of<CellId>(z, {of(d, K(z, maps, c)), of(on_apex, d(c)), back}) == one_term(z, c));
    REQUIRE(maps.terms_of_K(c) == K(z, maps, c).size());
    REQUIRE(maps.transposed_G(c).empty());
    const bool is_vertex_of_base = structure.dimension(c) == 0;
    REQUIRE(F(z, maps, c) == (is_vertex_of_base ? side.g(apex) : Terms<sparse::Integers, GeneratorId>{}));
  }
}

TEST_CASE("a lazy cone has the cells and boundaries of the cone written out, and K is one of its cones",
          "[engine][left]") {
  const sparse::Integers z;
  Workshop lazy(limits(true));
  Workshop written;
  LeftSide<sparse::Integers> side(z, engine::Window{lazy.structure()});
  LeftSide<sparse::Integers> side_of_written(z, engine::Window{written.structure()});
  for (const ops::Operation& step : {moore_body("B", 3).steps[0], cone_over_body("v", "B")}) {
    take_steps(lazy, side, {step});
    take_steps(written, side_of_written, {step});
  }
  REQUIRE(lazy.structure().lazy().families() == 1);
  REQUIRE(written.structure().lazy().families() == 0);
  CHECK(broken_left_law(side) == "");
  CHECK(broken_left_law(side_of_written) == "");
  const auto names = [](const ops::Structure& structure) {
    std::map<std::string, std::vector<std::string>> faces;
    for (const CellId c : current_cells(structure)) {
      faces.emplace(structure.name(c), face_texts(structure, c));
    }
    return faces;
  };
  CHECK(names(lazy.structure()) == names(written.structure()));
  const engine::ConeMaps<sparse::Integers> maps(z, lazy.structure(), 0, side.maps());
  for (const CellId c : current_cells(lazy.structure())) {
    if (!lazy.structure().lazy().is_lazy(c) || lazy.structure().lazy().of(c)->key.part != ops::LazyPart::base) {
      continue;
    }
    const Terms<sparse::Integers, CellId> bounded = K(z, maps, c);
    REQUIRE(bounded.size() == 1);
    CHECK(lazy.structure().name(bounded[0].index) == "v*" + std::string{lazy.structure().name(c)});
    CHECK(bounded[0].coefficient == sparse::Integer{lazy.structure().dimension(c) % 2 == 0 ? -1 : 1});
  }
}

TEST_CASE("what de-identifications give lazy cells is taken back by undo, and the maps keep their laws",
          "[engine][left]") {
  const bool is_simplicial = GENERATE(false, true);
  Workshop shop;
  LeftSide<sparse::Integers> side(sparse::Integers{}, engine::Window{shop.structure()});
  take_steps(shop, side, circle("A").steps);
  take_steps(shop, side, circle("B").steps);
  take_steps(shop, side, {product("P", "A", "B", is_simplicial)});
  const std::string before = dump(side);
  const auto structure_before = mark_of(shop.structure());
  const auto mark = side.mark();
  RandomSteps steps(7, {.most_cells = 1, .splits = true});
  int split = 0;
  for (int step = 0; step < 60; ++step) {
    const ops::Operation op = steps.next(shop.structure());
    if (std::holds_alternative<ops::Deidentify>(op)) {
      take_steps(shop, side, {op});
      REQUIRE(broken_left_law(side) == "");
      ++split;
    }
  }
  CHECK(split > 0);
  shop.go_back_to(structure_before);
  side.go_back_to(mark);
  CHECK(first_difference(dump(side), before) == "");
}
