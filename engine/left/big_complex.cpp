#include "engine/left/big_complex.hpp"

#include <algorithm>

#include "engine/left/lazy_maps.hpp"
#include "engine/left/saturating.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {

template <Ring R>
BigComplex<R>::BigComplex(R ring, const Window& window)
    : ring_{ring}, window_{window}, structure_{window.structure()}, boundary_(ring, 0, 0) {
  append_first_cells();
}

template <Ring R>
ops::BodyId BigComplex<R>::body_of(Index generator) const {
  const std::uint32_t origin = origin_[generator];
  if ((origin & removal) != 0) {
    return structure_.body_of(structure_.removed(origin & ~removal));
  }
  if ((origin & pair) != 0) {
    return structure_.bodies().find(structure_.family(origin & ~pair).body);
  }
  return structure_.body_of(origin);
}

// ------------------------------------------------------------------------------------------------------------- growth

template <Ring R>
void BigComplex<R>::append_first_cells() {
  for (const CellId cell : window_.cells()) {
    column_.clear();
    lazy_column_.clear();
    window_.for_each_first_face(cell, [this](CellId face, int sign) {
      column_.push_back({window_.place(face), ring_.from(sign)});
    });
    append(cell, structure_.dimension(cell));
  }
}

template <Ring R>
std::optional<Index> BigComplex<R>::append_cell(CellId cell) {
  sparse::expects(cell == cells(), "cells are appended in the order of their creation");
  if (window_.is_lazy(cell) || (structure_.parent(cell) == ops::none && structure_.link_of(cell) == ops::none)) {
    of_cell_.push_back(ops::none);
    return std::nullopt;
  }
  column_.clear();
  lazy_column_.clear();
  window_.for_each_first_face(cell, [this](CellId face, int sign) {
    if (structure_.parent(face) != ops::none) {
      add_g(face, ring_.from(sign), column_);
      add_lazy_part(face, ring_.from(sign), lazy_column_);
    }
  });
  of_cell_.push_back(size());
  return append(cell, structure_.dimension(cell));
}

template <Ring R>
Index BigComplex<R>::append_removal(LinkId link) {
  sparse::expects(link == links(), "removals are appended in the order in which they happened");
  column_.clear();
  lazy_column_.clear();
  const CellId removed = structure_.removed(link);
  const auto minus_one = ring_.negate(ring_.one());
  if (const CellId survivor = structure_.parent(removed); survivor != ops::none) {
    const auto sign = ring_.from(structure_.sign_of(link));
    add_g(survivor, sign, column_);
    add_lazy_part(survivor, sign, lazy_column_);
  }
  add_g(removed, minus_one, column_);
  add_lazy_part(removed, minus_one, lazy_column_);
  of_link_.push_back(size());
  return append(removal | link, structure_.dimension(removed) + 1);
}

template <Ring R>
Index BigComplex<R>::append_pair(ops::FamilyId family, int degree, std::span<const sparse::Term<R>> boundary) {
  column_.assign(boundary.begin(), boundary.end());
  lazy_column_.clear();
  return append(pair | family, degree);
}

template <Ring R>
Index BigComplex<R>::append_copy(CellId copy) {
  sparse::expects(copy == cells(), "cells are appended in the order of their creation");
  const CellId first = structure_.splits().copy(copy)->moment.created;  // of the copies of this step
  column_.clear();
  lazy_column_.clear();
  const CellId source = structure_.splits().copy(copy)->source;
  const auto add = [&](CellId face, int sign) {
    if (face >= first && face < structure_.created() && structure_.splits().copy(face) != nullptr) {
      column_.push_back({generator_of(face), ring_.from(sign)});
    }
  };
  for (std::uint32_t k = 0; k < structure_.type(copy).faces.size(); ++k) {
    add(structure_.faces_as_created(copy)[k], structure_.face_sign(copy, k));
    add(structure_.faces(source)[k], -structure_.sign_of_face(source, k));
  }
  for (const Structure::Copy* of = window_.copy(copy); of != nullptr; of = window_.copy(of->source)) {
    if (!window_.is_lazy(of->source)) {
      follow(of->source);
    }
  }
  of_cell_.push_back(size());
  follow(copy);
  return append(copy, structure_.dimension(copy));
}

template <Ring R>
std::vector<Index> BigComplex<R>::split(Index first, std::span<const Structure::MadeMove> moves) {
  std::map<CellId, Terms<R>> gains;  // per cell: what its boundary gains
  for (const Structure::MadeMove& move : moves) {
    gains[move.cell].push_back({generator_of(move.after), ring_.from(structure_.sign_of_face(move.cell, move.slot))});
  }
  std::map<Index, Terms<R>> changes;  // per generator
  std::unordered_map<CellId, Terms<R>> of_lazy;
  for (auto& [cell, gained] : gains) {
    Terms<R>& gain = gained;  // clang 14 captures no structured bindings
    sparse::normalize(ring_, gain);
    if (gain.empty()) {
      continue;
    }
    const auto add = [&](Index generator, int sign) {
      if (generator < first) {
        sparse::add_multiple<R>(ring_, changes[generator], ring_.from(sign), gain);
        if (const auto shifted = shifted_by_.find(generator); shifted != shifted_by_.end()) {
          for (const Index other : shifted->second) {
            sparse::add_multiple<R>(ring_, changes[other], ring_.from(sign), gain);
          }
        }
      }
    };
    window_.for_each_member(cell, [&](CellId node) {
      const int sign = structure_.find_oriented(node).sign;
      if (window_.is_lazy(node)) {
        Terms<R>& of_node = of_lazy.emplace(node, Terms<R>{}).first->second;
        sparse::add_multiple<R>(ring_, of_node, ring_.from(sign), gain);
      } else {
        add(generator_of(node), sign);
      }
      window_.for_each_copy_of(node, [&](CellId copy) { add(generator_of(copy), -sign); });
    });
  }
  if (!of_lazy.empty()) {
    lazy_maps_->add_gains(of_lazy, lazy_part_, changes);
  }
  MoveSet made;
  std::set<std::pair<CellId, CellId>> candidates;
  for (const Structure::MadeMove& move : moves) {
    made.emplace(move.cell, move.slot, move.after);
    if (const CellId before = window_.known(move.before); !window_.is_lazy(before)) {
      candidates.emplace(before, move.after);
    }
  }
  for (const auto& [node, copy] : candidates) {
    if (moves_wholly(node, copy, made)) {
      shift(node, copy, first, changes);
    }
  }
  std::vector<Index> changed;
  for (const auto& [generator, change] : changes) {
    if (!change.empty()) {
      for (const sparse::Term<R>& term : change) {
        columns_followed_[term.index].push_back(generator);
      }
      boundary_.add_to_column(generator, ring_.one(), change);
      entries_appended_ += change.size();
      changed.push_back(generator);
    }
  }
  changed_.insert(changed_.end(), changed.begin(), changed.end());
  return changed;
}

/// Whether all incidences of a node go to one copy, and it pays to change the basis; a node with very many others is
/// not looked through.
template <Ring R>
bool BigComplex<R>::moves_wholly(CellId node, CellId copy, const MoveSet& moves) const {
  constexpr std::size_t most_others = 64;
  // A place that is glued and split again and again collects generators, or else terms in old boundaries: measured over
  // 100 to 6,000 times at one place, this is where the two cost least together.
  constexpr std::size_t most_generators = 24;
  if (structure_.find_oriented(node).sign < 0) {
    return false;  // the generators would become G - e
  }
  const std::size_t most_places = most_others + 4 * moves.size();
  const auto places = window_.places_of(node, most_places);
  if (places.size() > most_places || generators_of(node).size() > most_generators) {
    return false;
  }
  return std::all_of(places.begin(), places.end(), [&](const auto& place) {
    const auto& [owner, slot] = place;
    const CellId cell = structure_.find(owner);
    if (cell == ops::none || moves.contains({cell, slot, copy})) {
      return true;
    }
    // An incidence that moved away before does not count.
    return structure_.is_current(owner) && window_.known(structure_.faces(owner)[slot]) != node;
  });
}

template <Ring R>
std::vector<Index> BigComplex<R>::generators_of(CellId node) const {
  const auto at = generators_of_.find(node);
  return at != generators_of_.end() ? at->second : std::vector<Index>{generator_of(node)};
}

/// The columns that may have an entry at the generator of a cell or copy, and perhaps others: those of the cells that
/// it was a face of at their creation, of the removals next to it, and those remembered.
template <Ring R>
std::vector<Index> BigComplex<R>::columns_with(Index generator) const {
  const CellId node = origin_[generator];
  std::vector<Index> columns;
  for (const auto& [owner, slot] : window_.places_of(node)) {
    columns.push_back(generator_of(owner));
  }
  const auto add_link = [&](LinkId link) {
    if (link < links()) {
      columns.push_back(generator_of_link(link));
    }
  };
  add_link(structure_.link_of(node));
  window_.for_each_child_link(node, add_link);
  if (const auto followed = columns_followed_.find(generator); followed != columns_followed_.end()) {
    columns.insert(columns.end(), followed->second.begin(), followed->second.end());
  }
  return columns;
}

/// The generators of a node become those of a copy: G + e for G. Changes of the boundary in the new basis.
template <Ring R>
void BigComplex<R>::shift(CellId node, CellId copy, Index first, std::map<Index, Terms<R>>& changes) {
  const Index e = generator_of(copy);
  const Terms<R> unit{{e, ring_.one()}};
  const Terms<R> boundary_of_e = boundary_.column(e);
  std::vector<Index> generators = generators_of(node);
  for (const Index generator : generators) {
    std::vector<Index> columns = columns_with(generator);
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (const Index column : columns) {
      if (column < first) {
        const auto coefficient = boundary_.entry(generator, column);
        sparse::add_multiple<R>(ring_, changes[column], ring_.negate(coefficient), unit);
      }
    }
    sparse::add_multiple<R>(ring_, changes[generator], ring_.one(), boundary_of_e);
    shifts_[generator].push_back(e);
    shifted_by_[e].push_back(generator);
    // What was written with G is written with (G + e) - e.
    const auto rewrite = [&](Index key) {
      auto [chain, is_new] = as_created_.try_emplace(key);
      if (is_new) {
        chain->second = {{key, ring_.one()}};
      }
      const auto at = std::find_if(chain->second.begin(), chain->second.end(),
                                   [&](const sparse::Term<R>& term) { return term.index == generator; });
      if (at != chain->second.end()) {
        const auto coefficient = ring_.negate(at->coefficient);
        sparse::add_multiple<R>(ring_, chain->second, coefficient, unit);
        in_as_created_[e].insert(key);
      }
    };
    rewrite(generator);
    if (const auto keys = in_as_created_.find(generator); keys != in_as_created_.end()) {
      for (const Index key : std::set<Index>{keys->second}) {
        rewrite(key);
      }
    }
  }
  std::vector<Index>& of_copy = generators_of_.try_emplace(copy, std::vector<Index>{e}).first->second;
  of_copy.insert(of_copy.end(), generators.begin(), generators.end());
  generators_of_[node].clear();
  shifted_.push_back({node, copy, std::move(generators)});
}

template <Ring R>
Index BigComplex<R>::append(std::uint32_t origin, int degree) {
  sparse::normalize(ring_, column_);
  if (!columns_followed_.empty()) {
    for (const sparse::Term<R>& term : column_) {
      if (const auto followed = columns_followed_.find(term.index); followed != columns_followed_.end()) {
        followed->second.push_back(size());
      }
    }
  }
  boundary_.append_rows(1);
  boundary_.append_column(column_);
  entries_appended_ += column_.size();
  if (!lazy_column_.empty()) {
    sparse::normalize(ring_, lazy_column_);
    lazy_part_.emplace(size(), lazy_column_);
  }
  origin_.push_back(origin);
  degree_.push_back(static_cast<std::uint8_t>(degree));
  if (static_cast<std::size_t>(degree) >= counts_.size()) {
    counts_.resize(static_cast<std::size_t>(degree) + 1, 0);
  }
  ++counts_[static_cast<std::size_t>(degree)];
  return size() - 1;
}

template <Ring R>
void BigComplex<R>::truncate(const Mark& mark) {
  while (changed_.size() > mark.changed) {
    const Index generator = changed_.back();
    changed_.pop_back();
    if (generator < mark.generators) {
      Terms<R> column = boundary_.column(generator);
      std::erase_if(column, [&](const sparse::Term<R>& term) { return term.index >= mark.generators; });
      boundary_.set_column(generator, column);
    }
  }
  while (shifted_.size() > mark.shifted) {
    Shift& last = shifted_.back();
    for (const Index generator : last.generators) {
      if (const auto shifts = shifts_.find(generator); shifts->second.size() == 1) {
        shifts_.erase(shifts);
      } else {
        shifts->second.pop_back();
      }
    }
    if (last.generators == std::vector<Index>{generator_of(last.node)}) {  // an entry must not outlive its node
      generators_of_.erase(last.node);
    } else {
      generators_of_[last.node] = std::move(last.generators);
    }
    generators_of_.erase(last.copy);
    shifted_.pop_back();
  }
  for (Index generator = mark.generators; generator < origin_.size(); ++generator) {
    if (const auto keys = in_as_created_.find(generator); keys != in_as_created_.end()) {
      for (const Index key : keys->second) {
        std::erase_if(as_created_[key], [&](const sparse::Term<R>& term) { return term.index >= mark.generators; });
      }
      in_as_created_.erase(keys);
    }
    columns_followed_.erase(generator);
    shifted_by_.erase(generator);
    as_created_.erase(generator);
    --counts_[degree_[generator]];
    if (!lazy_part_.empty()) {
      lazy_part_.erase(generator);
    }
  }
  while (!counts_.empty() && counts_.back() == 0) {
    counts_.pop_back();
  }
  boundary_.truncate(mark.generators, mark.generators);
  origin_.resize(mark.generators);
  degree_.resize(mark.generators);
  of_cell_.resize(mark.cells - window_.begin().created);
  of_link_.resize(mark.links - window_.begin().links);
}

// --------------------------------------------------------------------------------------------------------------- maps

template <Ring R>
Terms<R> BigComplex<R>::g(CellId cell) const {
  Terms<R> out;
  add_g(cell, ring_.one(), out);
  sparse::normalize(ring_, out);
  return out;
}

template <Ring R>
void BigComplex<R>::add_g(CellId cell, const typename R::Element& factor, Terms<R>& out) const {
  if (window_.has_splits() || window_.is_lazy(cell)) {
    add_g_at(cell, structure_.now(), factor, out);
    return;
  }
  out.push_back({generator_of(cell), factor});  // without copies there are no changes of basis
  window_.for_each_first_face(cell, [&](CellId face, int sign) {
    if (!structure_.is_current(face)) {
      add_path(face, structure_.links(), sign > 0 ? factor : ring_.negate(factor), out);
    }
  });
}

/// g as the history was at a moment, for a cell that was current then.
template <Ring R>
void BigComplex<R>::add_g_at(CellId cell, const ops::Moment& moment, const typename R::Element& factor,
                             Terms<R>& out) const {
  if (window_.is_lazy(cell)) {
    lazy_maps_->add_F(cell, factor, out);
  } else {
    add_as_created(generator_of(cell), factor, out);
    if (const Structure::Copy* copy = window_.copy(cell)) {
      add_g_at(copy->source, copy->moment, factor, out);
    }
  }
  window_.for_each_face_of_history(cell, moment, [&](CellId node, int sign, LinkId links) {
    add_path(node, links, sign > 0 ? factor : ring_.negate(factor), out);
  });
}

template <Ring R>
void BigComplex<R>::add_as_created(Index generator, const typename R::Element& factor, Terms<R>& out) const {
  if (const auto at = as_created_.empty() ? as_created_.end() : as_created_.find(generator); at != as_created_.end()) {
    for (const auto& [index, coefficient] : at->second) {
      out.push_back({index, ring_.multiply(factor, coefficient)});
    }
    return;
  }
  out.push_back({generator, factor});
}

template <Ring R>
void BigComplex<R>::add_lazy_part(CellId cell, const typename R::Element& factor, Terms<R>& out) const {
  if (window_.families() == 0) {
    return;
  }
  while (const Structure::Copy* copy = window_.copy(cell)) {
    cell = copy->source;
  }
  if (window_.is_lazy(cell)) {
    out.push_back({cell, factor});
  }
}

template <Ring R>
void BigComplex<R>::add_path(CellId x, LinkId links, const typename R::Element& factor, Terms<R>& out) const {
  int sign = 1;
  while (x != ops::none) {
    const LinkId link = structure_.link_of(x);
    if (link >= links) {  // none is more than any: it is current, or degenerate from the start
      return;
    }
    ++links_followed_;
    out.push_back({generator_of_link(link), sign > 0 ? factor : ring_.negate(factor)});
    sign *= structure_.sign_of(link);
    x = structure_.parent(x);
  }
}

template <Ring R>
void BigComplex<R>::add_cell(CellId node, const typename R::Element& factor, Terms<R>& out) const {
  if (const auto [cell, sign] = structure_.find_oriented(node); cell != ops::none) {
    out.push_back({cell, sign > 0 ? factor : ring_.negate(factor)});
  }
}

template <Ring R>
void BigComplex<R>::add_as_now(std::span<const sparse::Term<R>> nodes, Terms<R>& out) const {
  for (const auto& [node, coefficient] : nodes) {
    add_cell(node, coefficient, out);
  }
}

template <Ring R>
void BigComplex<R>::add_f(Index generator, const typename R::Element& factor, Terms<R>& out) const {
  const std::uint32_t origin = origin_[generator];
  if (const auto part = lazy_part_.empty() ? lazy_part_.end() : lazy_part_.find(generator); part != lazy_part_.end()) {
    Terms<R> bounded;
    for (const auto& [cell, coefficient] : part->second) {
      lazy_maps_->add_K(cell, ring_.negate(ring_.multiply(factor, coefficient)), bounded);
    }
    add_as_now(bounded, out);
  }
  if ((origin & removal) != 0) {
    return;
  }
  if ((origin & pair) != 0) {
    Terms<R> cells;
    lazy_maps_->add_G(origin & ~pair, generator, factor, cells);
    add_as_now(cells, out);
    return;
  }
  const auto add_difference = [&](CellId node) {
    add_cell(node, factor, out);
    if (const Structure::Copy* copy = window_.copy(node)) {
      add_cell(copy->source, ring_.negate(factor), out);
    }
  };
  add_difference(origin);
  if (const auto shifts = shifts_.empty() ? shifts_.end() : shifts_.find(generator); shifts != shifts_.end()) {
    for (const Index e : shifts->second) {
      add_difference(origin_[e]);
    }
  }
}

template <Ring R>
std::uint64_t BigComplex<R>::terms_of_f(Index generator) const {
  const std::uint32_t origin = origin_[generator];
  std::uint64_t terms = 0;
  if (const auto part = lazy_part_.empty() ? lazy_part_.end() : lazy_part_.find(generator); part != lazy_part_.end()) {
    for (const auto& [cell, coefficient] : part->second) {
      terms = saturating_sum(terms, lazy_maps_->terms_of_K(cell));
    }
  }
  if ((origin & removal) != 0) {
    return terms;
  }
  if ((origin & pair) != 0) {
    return saturating_sum(terms, lazy_maps_->terms_of_G(origin & ~pair, generator));
  }
  const auto shifts = shifts_.empty() ? shifts_.end() : shifts_.find(generator);
  const std::size_t differences = 1 + (shifts == shifts_.end() ? 0 : shifts->second.size());
  return saturating_sum(terms, 2 * differences - (window_.copy(origin) == nullptr ? 1 : 0));
}

template <Ring R>
std::uint64_t BigComplex<R>::terms_of_f(std::span<const sparse::Term<R>> chain) const {
  std::uint64_t terms = 0;
  for (const auto& term : chain) {
    terms = saturating_sum(terms, terms_of_f(term.index));
  }
  return terms;
}

template <Ring R>
Terms<R> BigComplex<R>::f(std::span<const sparse::Term<R>> chain) const {
  Terms<R> cells;
  for (const auto& [generator, coefficient] : chain) {
    add_f(generator, coefficient, cells);
  }
  sparse::normalize(ring_, cells);
  return cells;
}

template <Ring R>
Terms<R> BigComplex<R>::h(Index generator) const {
  Terms<R> path;
  const auto add = [&](CellId node) {
    add_path(node, structure_.links(), ring_.negate(ring_.one()), path);
    if (const Structure::Copy* copy = window_.copy(node)) {
      add_path(copy->source, structure_.links(), ring_.one(), path);
    }
  };
  if (const std::uint32_t origin = origin_[generator]; (origin & removal) == 0) {
    add(origin);
    if (const auto shifts = shifts_.find(generator); shifts != shifts_.end()) {
      for (const Index e : shifts->second) {
        add(origin_[e]);
      }
    }
    sparse::normalize(ring_, path);
  }
  return path;
}

#define SESAME_INSTANTIATE(R) template class BigComplex<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
