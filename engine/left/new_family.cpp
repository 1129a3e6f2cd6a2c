#include "engine/left/new_family.hpp"

#include <memory>

#include "engine/left/cone_maps.hpp"
#include "engine/left/product_maps.hpp"
#include "engine/left/simplicial_product_maps.hpp"
#include "engine/left/small_of_body.hpp"

namespace sesame::engine {

namespace {

/// dS of some small generators.
template <Ring R>
using Columns = std::unordered_map<Symbol, Terms<R, Symbol>>;

template <Ring R>
void add_columns(const std::vector<Symbol>& symbols, const Rewriter<R>& rewriter, Columns<R>& columns) {
  for (const Symbol x : symbols) {
    const Terms<R, Symbol>* column = rewriter.core().find(x);
    columns.try_emplace(x, column == nullptr ? Terms<R, Symbol>{} : *column);
  }
}

/// d(a (x) b) = da (x) b + (-1)^|a| a (x) db
template <Ring R>
Terms<R, GeneratorId> boundary_of_pair(const R& ring, const PairTable& pairs, Symbol a, Symbol b, int degree_of_a,
                                       const Columns<R>& columns) {
  RawTerms<R, GeneratorId> boundary;
  pairs.add_tensor(ring, columns.at(a), {{b, ring.one()}}, ring.one(), boundary);
  pairs.add_tensor(ring, {{a, ring.one()}}, columns.at(b), ring.from(degree_of_a % 2 == 0 ? 1 : -1), boundary);
  return std::move(boundary).normal(ring);
}

template <Ring R>
PairTable append_pairs(ops::FamilyId id, const Structure& structure, BigComplex<R>& big, Rewriter<R>& rewriter) {
  const std::vector<ops::BodyId>& factors = structure.lazy().family(id).bodies;
  const std::vector<Symbol> left = small_of_body(factors[0], structure, big, rewriter);
  const std::vector<Symbol> right = small_of_body(factors[1], structure, big, rewriter);
  Columns<R> columns;
  add_columns(left, rewriter, columns);
  add_columns(right, rewriter, columns);
  rewriter.consume(left);
  if (factors[0] != factors[1]) {
    rewriter.consume(right);
  }
  const PairTable pairs(left, right, big.size(), [&](Symbol x) { return rewriter.degree(x); });
  for (GeneratorId generator = pairs.first(); generator < pairs.end(); ++generator) {
    const auto [a, b] = pairs.pair(generator);
    const int degree = rewriter.degree(a) + rewriter.degree(b);
    big.append_of_family(id, degree, boundary_of_pair(big.ring(), pairs, a, b, rewriter.degree(a), columns));
    rewriter.append(degree);
  }
  return pairs;
}

}  // namespace

template <Ring R>
void append_family(ops::FamilyId id, const Structure& structure, FrozenMaps<R>& frozen, BigComplex<R>& big,
                   Rewriter<R>& rewriter) {
  const R& ring = big.ring();
  const ops::LazyFamily& family = structure.lazy().family(id);
  if (family.kind == ops::FamilyKind::cone) {
    for (const ops::BodyId body : family.bodies) {
      rewriter.consume(small_of_body(body, structure, big, rewriter));
    }
    big.follow(family.apex);  // it is F of every vertex
    big.append_family(std::make_unique<ConeMaps<R>>(ring, structure, id, big.maps()));
    return;
  }
  PairTable pairs = append_pairs(id, structure, big, rewriter);
  if (family.kind != ops::FamilyKind::simplicial_product) {
    big.append_family(std::make_unique<ProductMaps<R>>(ring, structure, id, std::move(pairs), frozen));
  } else {
    big.append_family(std::make_unique<SimplicialProductMaps<R>>(ring, structure, id, std::move(pairs), frozen));
  }
}

#define SESAME_INSTANTIATE(R) \
  template void append_family(ops::FamilyId, const Structure&, FrozenMaps<R>&, BigComplex<R>&, Rewriter<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
