#include "engine/left/left_maps.hpp"

#include "engine/left/saturating.hpp"

namespace sesame::engine {

// ------------------------------------------------------------------------------------------------------------------- g

template <Ring R>
Terms<R, GeneratorId> LeftMaps<R>::g(CellId cell) const {
  RawTerms<R, GeneratorId> out;
  add_g(cell, ring_.one(), out);
  return std::move(out).normal(ring_);
}

/// Coefficients in boundaries are signs but for cells that are known by their boundaries.
template <Ring R>
auto LeftMaps<R>::times(int coefficient, const Element& factor) const -> Element {
  return coefficient == 1    ? factor
         : coefficient == -1 ? ring_.negate(factor)
                             : ring_.multiply(factor, ring_.from(coefficient));
}

template <Ring R>
void LeftMaps<R>::add_g(CellId cell, const Element& factor, RawTerms<R, GeneratorId>& out) const {
  if (window_.has_splits() || window_.is_lazy(cell)) {
    add_g_at(cell, structure_.now(), factor, out);
    return;
  }
  out.push_back({generators_.of(cell), factor});  // without copies there are no changes of basis
  window_.for_each_first_face(cell, [&](CellId face, int sign) {
    if (!structure_.is_current(face)) {
      add_path(face, structure_.forest().links(), times(sign, factor), out);
    }
  });
}

/// g as the history was at a moment, for a cell that was current then.
template <Ring R>
void LeftMaps<R>::add_g_at(CellId cell, const ops::Moment& moment, const Element& factor,
                           RawTerms<R, GeneratorId>& out) const {
  if (window_.is_lazy(cell)) {
    families_.add_F(cell, factor, out);
  } else {
    shifts_.add_as_created(generators_.of(cell), factor, out);
    if (const ops::SplitHistory::Copy* copy = window_.copy(cell)) {
      add_g_at(copy->source, copy->moment, factor, out);
    }
  }
  window_.for_each_face_of_history(
      cell, moment, [&](CellId node, int sign, LinkId links) { add_path(node, links, times(sign, factor), out); });
}

template <Ring R>
void LeftMaps<R>::add_path(CellId x, LinkId links, const Element& factor, RawTerms<R, GeneratorId>& out) const {
  int sign = 1;
  while (x != ops::none) {
    const LinkId link = structure_.forest().link_of(x);
    if (link >= links) {  // none is more than any: it is current, or degenerate from the start
      return;
    }
    const CellId parent = structure_.forest().parent(x);
    if (parent == ops::none && structure_.forest().deletions().contains(link)) {
      return;
    }
    ++links_followed_;
    out.push_back({generators_.of_link(link), sign > 0 ? factor : ring_.negate(factor)});
    sign *= structure_.forest().sign_of(link);
    x = parent;
  }
}

template <Ring R>
void LeftMaps<R>::add_lazy_part(CellId cell, const Element& factor, RawTerms<R, CellId>& out) const {
  if (window_.families() == 0) {
    return;
  }
  while (const ops::SplitHistory::Copy* copy = window_.copy(cell)) {
    cell = copy->source;
  }
  if (window_.is_lazy(cell)) {
    out.push_back({cell, factor});
  }
}

template <Ring R>
void LeftMaps<R>::add_K_of_lazy_part(CellId cell, const Element& factor, RawTerms<R, CellId>& out) const {
  RawTerms<R, CellId> part;
  add_lazy_part(cell, factor, part);
  RawTerms<R, CellId> nodes;
  for (const auto& [lazy, coefficient] : part) {
    families_.add_K(lazy, coefficient, nodes);
  }
  add_as_now(nodes, out);
}

// ------------------------------------------------------------------------------------------------------------------- f

template <Ring R>
Terms<R, CellId> LeftMaps<R>::f(std::span<const sparse::Term<R, GeneratorId>> chain) const {
  RawTerms<R, CellId> cells;
  for (const auto& [generator, coefficient] : chain) {
    add_f(generator, coefficient, cells);
  }
  return std::move(cells).normal(ring_);
}

/// f of a generator times a factor, added to `out`: current cells.
template <Ring R>
void LeftMaps<R>::add_f(GeneratorId generator, const Element& factor, RawTerms<R, CellId>& out) const {
  if (families_.has_attached()) {
    RawTerms<R, CellId> bounded;
    families_.add_K_of_attached(generator, ring_.negate(factor), bounded);
    add_as_now(bounded, out);
  }
  if (generators_.is_removal(generator)) {
    return;
  }
  if (generators_.is_deletion(generator)) {
    for (const auto& [node, coefficient] : deletions_.boundary(generator)) {
      add_cell(node, ring_.multiply(factor, ring_.from(-coefficient)), out);
    }
    return;
  }
  if (generators_.is_of_family(generator)) {
    RawTerms<R, CellId> cells;
    families_.maps(generators_.family(generator)).add_G(generator, factor, cells);
    add_as_now(cells, out);
    return;
  }
  for_each_node_of(generator,
                   [&](CellId node, int sign) { add_cell(node, sign > 0 ? factor : ring_.negate(factor), out); });
}

template <Ring R>
template <class Visit>
void LeftMaps<R>::for_each_node_of(GeneratorId generator, Visit visit) const {
  const auto visit_difference = [&](CellId node) {
    visit(node, 1);
    if (const ops::SplitHistory::Copy* copy = window_.copy(node)) {
      visit(copy->source, -1);
    }
  };
  visit_difference(generators_.cell(generator));
  for (const GeneratorId e : shifts_.added_to(generator)) {
    visit_difference(generators_.cell(e));
  }
}

/// A chain of cells as created, as the current cells that they are now, added to `out`.
template <Ring R>
void LeftMaps<R>::add_as_now(const RawTerms<R, CellId>& nodes, RawTerms<R, CellId>& out) const {
  for (const auto& [node, coefficient] : nodes) {
    add_cell(node, coefficient, out);
  }
}

template <Ring R>
void LeftMaps<R>::add_cell(CellId node, const Element& factor, RawTerms<R, CellId>& out) const {
  if (const auto [cell, sign] = structure_.forest().find_oriented(node); cell != ops::none) {
    out.push_back({cell, sign > 0 ? factor : ring_.negate(factor)});
  }
}

template <Ring R>
std::uint64_t LeftMaps<R>::terms_of_f(std::span<const sparse::Term<R, GeneratorId>> chain) const {
  std::uint64_t terms = 0;
  for (const auto& term : chain) {
    terms = saturating_sum(terms, terms_of_f(term.index));
  }
  return terms;
}

template <Ring R>
std::uint64_t LeftMaps<R>::terms_of_f(GeneratorId generator) const {
  const std::uint64_t terms = families_.terms_of_K_of_attached(generator);
  if (generators_.is_removal(generator)) {
    return terms;
  }
  if (generators_.is_deletion(generator)) {
    return saturating_sum(terms, deletions_.boundary(generator).size());
  }
  if (generators_.is_of_family(generator)) {
    return saturating_sum(terms, families_.maps(generators_.family(generator)).terms_of_G(generator));
  }
  const std::size_t differences = 1 + shifts_.added_to(generator).size();
  return saturating_sum(terms, 2 * differences - (window_.copy(generators_.cell(generator)) == nullptr ? 1 : 0));
}

// ------------------------------------------------------------------------------------------------------------------- h

template <Ring R>
Terms<R, GeneratorId> LeftMaps<R>::h(GeneratorId generator) const {
  RawTerms<R, GeneratorId> path;
  if (generators_.is_removal(generator)) {
    return {};
  }
  if (generators_.is_deletion(generator)) {
    // What its faces have become since comes in as it does for a cell that is there.
    add_g_at(structure_.forest().removed(generators_.link(generator)), structure_.now(), ring_.one(), path);
    return std::move(path).normal(ring_);
  }
  for_each_node_of(
      generator, [&](CellId node, int sign) { add_path(node, structure_.forest().links(), ring_.from(-sign), path); });
  return std::move(path).normal(ring_);
}

#define SESAME_INSTANTIATE(R) template class LeftMaps<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
