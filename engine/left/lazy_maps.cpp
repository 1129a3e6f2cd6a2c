#include "engine/left/lazy_maps.hpp"

#include <algorithm>
#include <numeric>

#include "engine/left/saturating.hpp"

namespace sesame::engine {

using ops::FamilyId;
using ops::FamilyKind;
using ops::LazyPart;
using ops::Value;

namespace {

/// The steps of a monotone map that do not move, as collapsed directions.
ops::Degeneracy collapsed_steps(const reductions::Vertices& map) {
  ops::Degeneracy collapsed = 0;
  for (std::size_t j = 0; j + 1 < map.size(); ++j) {
    if (map[j] == map[j + 1]) {
      collapsed |= ops::Degeneracy{1} << j;
    }
  }
  return collapsed;
}

template <Ring R>
typename R::Element coefficient_at(const R& ring, const Terms<R>& chain, Index index) {
  const auto at = std::lower_bound(chain.begin(), chain.end(), index,
                                   [](const sparse::Term<R>& term, Index i) { return term.index < i; });
  return at != chain.end() && at->index == index ? at->coefficient : ring.zero();
}

}  // namespace

template <Ring R>
LazyMaps<R>::LazyMaps(R ring, const Window& window, BigComplex<R>& big, Rewriter<R>& rewriter)
    : ring_{ring},
      structure_{window.structure()},
      big_{big},
      rewriter_{rewriter},
      first_family_{window.begin().families} {}

// ------------------------------------------------------------------------------------------------------------ families

template <Ring R>
std::vector<Symbol> LazyMaps<R>::symbols_of(ops::BodyId body) const {
  std::vector<Symbol> symbols;
  for (int p = 0; p < static_cast<int>(rewriter_.small_counts().size()); ++p) {
    for (const Symbol x : rewriter_.small(p)) {
      if (big_.body_of(rewriter_.generator_in(x)) == body) {
        symbols.push_back(x);
      }
    }
  }
  std::sort(symbols.begin(), symbols.end());
  return symbols;
}

template <Ring R>
void LazyMaps<R>::add_family(FamilyId id) {
  const ops::LazyFamily& made = structure_.family(id);
  Family family;
  if (made.kind == FamilyKind::cone) {
    for (const ops::BodyId body : made.bodies) {
      rewriter_.consume(symbols_of(body));
    }
    big_.follow(made.apex);  // it is F of every vertex
    families_.push_back(std::move(family));
    return;
  }
  family.left = symbols_of(made.bodies[0]);
  family.right = symbols_of(made.bodies[1]);
  const auto column_of = [this](Symbol x) {
    const Terms<R>* column = rewriter_.core().find(x);
    return column == nullptr ? Terms<R>{} : *column;
  };
  std::unordered_map<Symbol, Terms<R>> columns;
  for (const auto* symbols : {&family.left, &family.right}) {
    for (const Symbol x : *symbols) {
      columns.try_emplace(x, column_of(x));
    }
  }
  rewriter_.consume(family.left);
  if (made.bodies[0] != made.bodies[1]) {
    rewriter_.consume(family.right);
  }
  const std::size_t width = family.right.size();
  const auto degree_at = [&](std::uint32_t place) {
    return rewriter_.degree(family.left[place / width]) + rewriter_.degree(family.right[place % width]);
  };
  family.places.resize(family.left.size() * width);
  std::iota(family.places.begin(), family.places.end(), 0U);
  std::stable_sort(family.places.begin(), family.places.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return degree_at(a) < degree_at(b); });
  family.pairs.resize(family.places.size());
  family.first = big_.size();
  for (std::size_t k = 0; k < family.places.size(); ++k) {
    family.pairs[family.places[k]] = family.first + static_cast<Index>(k);
  }
  for (const std::uint32_t place : family.places) {  // d(a (x) b) = da (x) b + (-1)^|a| a (x) db
    const Symbol a = family.left[place / width];
    const Symbol b = family.right[place % width];
    Terms<R> boundary;
    add_tensor(family, columns.at(a), {{b, ring_.one()}}, ring_.one(), boundary);
    add_tensor(family, {{a, ring_.one()}}, columns.at(b), ring_.from(rewriter_.degree(a) % 2 == 0 ? 1 : -1), boundary);
    sparse::normalize(ring_, boundary);
    const int degree = degree_at(place);
    big_.append_pair(id, degree, boundary);
    rewriter_.append(degree);
  }
  families_.push_back(std::move(family));
}

template <Ring R>
void LazyMaps<R>::truncate(const Mark& mark, Index generators) {
  families_.resize(mark.families);
  const auto forget = [](auto& known, std::size_t size, auto& map) {
    while (known.size() > size) {
      map.erase(known.back());
      known.pop_back();
    }
  };
  forget(images_known_, mark.images, images_);
  forget(homotopies_known_, mark.homotopies, homotopies_);
  forget(lifts_known_, mark.lifts, lifts_);
  while (gained_.size() > mark.gained) {
    Terms<R>& gain = gains_.at(gained_.back());
    std::erase_if(gain, [generators](const sparse::Term<R>& term) { return term.index >= generators; });
    if (gain.empty()) {
      gains_.erase(gained_.back());
    }
    gained_.pop_back();
  }
}

// ------------------------------------------------------------------------------------------- maps of the frozen bodies

template <Ring R>
const Terms<R>& LazyMaps<R>::F_of(CellId cell) {
  if (const auto known = images_.find(cell); known != images_.end()) {
    return known->second;
  }
  Terms<R> image = rewriter_.rewrite(big_.g(cell));
  images_known_.push_back(cell);
  return images_.emplace(cell, std::move(image)).first->second;
}

template <Ring R>
const Terms<R>& LazyMaps<R>::G_of(Symbol symbol) {
  if (const auto known = lifts_.find(symbol); known != lifts_.end()) {
    return known->second;
  }
  Terms<R> cells = big_.f(rewriter_.lift(Terms<R>{{symbol, ring_.one()}}));
  lifts_known_.push_back(symbol);
  return lifts_.emplace(symbol, std::move(cells)).first->second;
}

template <Ring R>
const typename LazyMaps<R>::Homotopy& LazyMaps<R>::homotopy_of(CellId cell) {
  if (const auto known = homotopies_.find(cell); known != homotopies_.end()) {
    return known->second;
  }
  const Terms<R> g = big_.g(cell);
  Terms<R> bounded = big_.f(rewriter_.lift({}, rewriter_.trace(g)));
  add_K_of_lazy_part(cell, ring_.one(), bounded);
  sparse::normalize(ring_, bounded);
  Terms<R> image = big_.f(rewriter_.lift(rewriter_.rewrite(g)));
  homotopies_known_.push_back(cell);
  return homotopies_.emplace(cell, Homotopy{std::move(bounded), std::move(image)}).first->second;
}

// ---------------------------------------------------------------------------------------------------------------- F, G

/// left (x) right, both in symbols of the factors, in generators of the family.
template <Ring R>
void LazyMaps<R>::add_tensor(const Family& family, const Terms<R>& left, const Terms<R>& right, const Element& factor,
                             Terms<R>& out) const {
  const auto place = [](const std::vector<Symbol>& symbols, Symbol x) {
    return static_cast<std::size_t>(std::lower_bound(symbols.begin(), symbols.end(), x) - symbols.begin());
  };
  for (const auto& [a, coefficient_a] : left) {
    const std::size_t row = place(family.left, a) * family.right.size();
    const Element scaled = ring_.multiply(factor, coefficient_a);
    for (const auto& [b, coefficient_b] : right) {
      out.push_back({family.pairs[row + place(family.right, b)], ring_.multiply(scaled, coefficient_b)});
    }
  }
}

/// The face or degeneracy of a simplex along a monotone map.
template <Ring R>
Value LazyMaps<R>::restrict(Value v, const reductions::Vertices& map) const {
  const int n = structure_.types().info(v.type).dimension;
  for (int vertex = n; vertex >= 0; --vertex) {
    if (!std::binary_search(map.begin(), map.end(), static_cast<std::uint8_t>(vertex))) {
      v = structure_.face(v, static_cast<std::uint32_t>(vertex));
    }
  }
  const ops::Degeneracy steps = collapsed_steps(map);
  return {v.cell, structure_.types().simplex(static_cast<int>(map.size()) - 1), ops::compose(steps, v.collapsed)};
}

template <Ring R>
void LazyMaps<R>::add_F(CellId cell, const Element& factor, Terms<R>& out) {
  const ops::LazyKey key = structure_.lazy_of(cell)->key;
  const ops::LazyFamily& made = structure_.family(key.family);
  if (made.kind == FamilyKind::cone) {
    if (key.part == LazyPart::base && structure_.dimension(cell) == 0) {
      big_.add_g(made.apex, factor, out);
    }
  } else if (made.kind == FamilyKind::product) {
    const Terms<R> left = F_of(key.left.cell);
    add_tensor(family(key.family), left, F_of(key.right.cell), factor, out);
  } else {
    for (const auto& [front, back] : reductions::alexander_whitney(structure_.dimension(cell))) {
      const Value a = restrict(key.left, front);
      const Value b = restrict(key.right, back);
      if (!a.is_degenerate() && !b.is_degenerate()) {
        const Terms<R> left = F_of(a.cell);
        add_tensor(family(key.family), left, F_of(b.cell), factor, out);
      }
    }
  }
  if (!gains_.empty()) {
    subtract_gains(gains_, cell, factor, out);
  }
}

template <Ring R>
void LazyMaps<R>::add_simplicial_pair(FamilyId family, const reductions::SignedPair& maps, const Value& left,
                                      const Value& right, const Element& factor, Terms<R>& out) const {
  const Value a = restrict(left, maps.first);
  const Value b = restrict(right, maps.second);
  if ((a.collapsed & b.collapsed) == 0) {
    out.push_back({structure_.lazy_cell(family, LazyPart::pair, a, b), maps.sign > 0 ? factor : ring_.negate(factor)});
  }
}

/// left (x) right, both chains of the factors, as a chain of the product: pair by pair, or by shuffles.
template <Ring R>
void LazyMaps<R>::add_pairs(FamilyId family, const Terms<R>& left, const Terms<R>& right, const Element& factor,
                            Terms<R>& out) {
  const bool is_simplicial = structure_.family(family).kind == FamilyKind::simplicial_product;
  const auto as_value = [this](CellId c) { return Value{c, structure_.type_id(c), 0}; };
  for (const auto& [a, coefficient_a] : left) {
    const Element scaled = ring_.multiply(factor, coefficient_a);
    for (const auto& [b, coefficient_b] : right) {
      const Element coefficient = ring_.multiply(scaled, coefficient_b);
      if (!is_simplicial) {
        out.push_back({structure_.lazy_cell(family, LazyPart::pair, as_value(a), as_value(b)), coefficient});
        continue;
      }
      for (const auto& shuffle : terms_.shuffles(structure_.dimension(a), structure_.dimension(b))) {
        add_simplicial_pair(family, shuffle, as_value(a), as_value(b), coefficient, out);
      }
    }
  }
}

template <Ring R>
void LazyMaps<R>::add_G(FamilyId id, Index generator, const Element& factor, Terms<R>& out) {
  const Family& family = this->family(id);
  const std::uint32_t place = family.places[generator - family.first];
  const Terms<R> left = G_of(family.left[place / family.right.size()]);
  const Terms<R> right = G_of(family.right[place % family.right.size()]);
  add_pairs(id, left, right, factor, out);
}

template <Ring R>
std::uint64_t LazyMaps<R>::cells_of_pair(FamilyId family, int p, int q) const {
  if (structure_.family(family).kind != FamilyKind::simplicial_product) {
    return 1;
  }
  std::uint64_t shuffles = 1;
  for (int k = 1; k <= q; ++k) {  // the binomial coefficients of p + k over k
    const std::uint64_t product = saturating_product(shuffles, static_cast<std::uint64_t>(p + k));
    if (product == uncountable) {
      return product;
    }
    shuffles = product / static_cast<std::uint64_t>(k);
  }
  return shuffles;
}

template <Ring R>
std::uint64_t LazyMaps<R>::terms_of_lift(Symbol symbol) {
  const auto known = lifts_.find(symbol);
  return known != lifts_.end() ? known->second.size()
                               : big_.terms_of_f(rewriter_.lift(Terms<R>{{symbol, ring_.one()}}));
}

template <Ring R>
std::uint64_t LazyMaps<R>::terms_of_G(FamilyId id, Index generator) {
  const Family& family = this->family(id);
  const std::uint32_t place = family.places[generator - family.first];
  const Symbol left = family.left[place / family.right.size()];
  const Symbol right = family.right[place % family.right.size()];
  return saturating_product(cells_of_pair(id, rewriter_.degree(left), rewriter_.degree(right)),
                            saturating_product(terms_of_lift(left), terms_of_lift(right)));
}

// ------------------------------------------------------------------------------------------------------------------- K

template <Ring R>
void LazyMaps<R>::add_K_of_product(FamilyId family, CellId left, CellId right, const Element& factor, Terms<R>& out) {
  const Homotopy of_left = homotopy_of(left);
  const Terms<R> of_right = homotopy_of(right).K;
  add_pairs(family, of_left.K, {{right, ring_.one()}}, factor, out);
  add_pairs(family, of_left.GF, of_right, structure_.dimension(left) % 2 == 0 ? factor : ring_.negate(factor), out);
}

template <Ring R>
void LazyMaps<R>::add_K_of_lazy_part(CellId cell, const Element& factor, Terms<R>& out) {
  Terms<R> part;
  big_.add_lazy_part(cell, factor, part);
  Terms<R> nodes;
  for (const auto& [lazy, coefficient] : part) {
    add_K(lazy, coefficient, nodes);
  }
  big_.add_as_now(nodes, out);
}

template <Ring R>
void LazyMaps<R>::add_K(CellId cell, const Element& factor, Terms<R>& out) {
  const ops::LazyKey key = structure_.lazy_of(cell)->key;
  const int n = structure_.dimension(cell);
  switch (structure_.family(key.family).kind) {
    case FamilyKind::cone:
      if (key.part == LazyPart::base) {
        out.push_back(
            {structure_.lazy_cell(key.family, LazyPart::coned, key.left), n % 2 == 0 ? ring_.negate(factor) : factor});
      }
      break;
    case FamilyKind::product:
      add_K_of_product(key.family, key.left.cell, key.right.cell, factor, out);
      break;
    case FamilyKind::simplicial_product:
      for (const auto& term : terms_.shih(n)) {
        add_simplicial_pair(key.family, term, key.left, key.right, factor, out);
      }
      for (const auto& [front, back] : reductions::alexander_whitney(n)) {
        const Value a = restrict(key.left, front);
        const Value b = restrict(key.right, back);
        if (!a.is_degenerate() && !b.is_degenerate()) {
          add_K_of_product(key.family, a.cell, b.cell, factor, out);
        }
      }
      break;
  }
}

template <Ring R>
std::uint64_t LazyMaps<R>::terms_of_K_of_product(FamilyId family, CellId left, CellId right) {
  const int p = structure_.dimension(left);
  const int q = structure_.dimension(right);
  const std::uint64_t of_right = homotopy_of(right).K.size();
  const Homotopy& of_left = homotopy_of(left);
  const std::uint64_t first = saturating_product(of_left.K.size(), cells_of_pair(family, p + 1, q));
  const std::uint64_t second = saturating_product(of_left.GF.size(), of_right);
  return saturating_sum(first, saturating_product(second, cells_of_pair(family, p, q + 1)));
}

template <Ring R>
std::uint64_t LazyMaps<R>::terms_of_K(CellId cell) {
  const ops::LazyKey key = structure_.lazy_of(cell)->key;
  const int n = structure_.dimension(cell);
  switch (structure_.family(key.family).kind) {
    case FamilyKind::cone:
      return key.part == LazyPart::base ? 1 : 0;
    case FamilyKind::product:
      return terms_of_K_of_product(key.family, key.left.cell, key.right.cell);
    case FamilyKind::simplicial_product:
      break;
  }
  std::uint64_t terms = terms_.shih(n).size();
  for (const auto& [front, back] : reductions::alexander_whitney(n)) {
    const Value a = restrict(key.left, front);
    const Value b = restrict(key.right, back);
    if (!a.is_degenerate() && !b.is_degenerate()) {
      terms = saturating_sum(terms, terms_of_K_of_product(key.family, a.cell, b.cell));
    }
  }
  return terms;
}

// --------------------------------------------------------------------------------------------------- de-identification

/// -chi(K c) times a factor, for a lazy cell c.
template <Ring R>
void LazyMaps<R>::subtract_gains(const Gains& gains, CellId cell, const Element& factor, Terms<R>& out) {
  const ops::LazyKey key = structure_.lazy_of(cell)->key;
  const auto concerns = [&](CellId gained) {
    return structure_.lazy_of(gained)->key.family == key.family &&
           structure_.dimension(gained) == structure_.dimension(cell) + 1;
  };
  if (std::none_of(gains.begin(), gains.end(), [&](const auto& gain) { return concerns(gain.first); })) {
    return;
  }
  const Element minus = ring_.negate(factor);
  const auto add = [&](const Terms<R>& gain, const Element& coefficient) {
    for (const auto& [generator, part] : gain) {
      big_.add_as_created(generator, ring_.multiply(coefficient, part), out);
    }
  };
  if (structure_.family(key.family).kind != FamilyKind::product) {
    Terms<R> bounded;
    add_K(cell, minus, bounded);
    for (const auto& [node, coefficient] : bounded) {
      if (const auto gain = gains.find(node); gain != gains.end()) {
        add(gain->second, coefficient);
      }
    }
    return;
  }
  // Only the coefficients that count: K of a cell of a product is as long as those of its factors multiplied.
  const Homotopy left = homotopy_of(key.left.cell);
  const Terms<R> right = homotopy_of(key.right.cell).K;
  const bool is_odd = structure_.dimension(key.left.cell) % 2 != 0;
  std::map<CellId, Element> coefficients;  // by cell: `gains` has no order of its own
  for (const auto& [gained, gain] : gains) {
    if (!concerns(gained)) {
      continue;
    }
    const ops::LazyKey& at = structure_.lazy_of(gained)->key;
    Element sum =
        ring_.multiply(coefficient_at(ring_, left.GF, at.left.cell), coefficient_at(ring_, right, at.right.cell));
    if (is_odd) {
      sum = ring_.negate(sum);
    }
    if (at.right.cell == key.right.cell) {
      sum = ring_.add(sum, coefficient_at(ring_, left.K, at.left.cell));
    }
    coefficients.emplace(gained, std::move(sum));
  }
  for (const auto& [gained, coefficient] : coefficients) {
    add(gains.at(gained), ring_.multiply(minus, coefficient));
  }
}

/// The coefficient of a lazy cell in G of a pair.
template <Ring R>
typename R::Element LazyMaps<R>::coefficient_of_G(const ops::LazyKey& key, Symbol left, Symbol right) {
  const auto product = [&](const Element& sign) {
    const Element a = coefficient_at(ring_, G_of(left), key.left.cell);
    return ring_.multiply(sign, ring_.multiply(a, coefficient_at(ring_, G_of(right), key.right.cell)));
  };
  if (structure_.family(key.family).kind == FamilyKind::product) {
    return product(ring_.one());
  }
  for (const auto& shuffle :
       terms_.shuffles(structure_.dimension(key.left.cell), structure_.dimension(key.right.cell))) {
    if (collapsed_steps(shuffle.first) == key.left.collapsed &&
        collapsed_steps(shuffle.second) == key.right.collapsed) {
      return product(ring_.from(shuffle.sign));
    }
  }
  return ring_.zero();
}

template <Ring R>
void LazyMaps<R>::add_gains(const Gains& gains, const std::unordered_map<Index, Terms<R>>& lazy_parts,
                            std::map<Index, Terms<R>>& changes) {
  const std::map<CellId, Terms<R>> ordered(gains.begin(), gains.end());
  for (const auto& [cell, gain] : ordered) {
    const ops::LazyKey key = structure_.lazy_of(cell)->key;
    if (key.part == LazyPart::pair) {
      const Family& family = this->family(key.family);
      for (std::size_t place = 0; place < family.pairs.size(); ++place) {
        const Symbol left = family.left[place / family.right.size()];
        const Symbol right = family.right[place % family.right.size()];
        if (rewriter_.degree(left) == structure_.dimension(key.left.cell) &&
            rewriter_.degree(right) == structure_.dimension(key.right.cell)) {
          sparse::add_multiple<R>(ring_, changes[family.pairs[place]], coefficient_of_G(key, left, right), gain);
        }
      }
    }
  }
  std::map<Index, const Terms<R>*> parts;
  for (const auto& [generator, part] : lazy_parts) {
    parts.emplace(generator, &part);
  }
  for (const auto& [generator, part] : parts) {
    Terms<R> change;
    for (const auto& [cell, coefficient] : *part) {
      subtract_gains(gains, cell, coefficient, change);
    }
    sparse::normalize(ring_, change);
    sparse::add_multiple<R>(ring_, changes[generator], ring_.one(), change);
  }
  for (const auto& [cell, gain] : ordered) {
    Terms<R>& sum = gains_[cell];
    sparse::add_multiple<R>(ring_, sum, ring_.one(), gain);
    gained_.push_back(cell);
  }
}

#define SESAME_INSTANTIATE(R) template class LazyMaps<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
