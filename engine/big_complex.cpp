#include "engine/big_complex.hpp"

#include <map>

#include "engine/lazy_maps.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {

template <Ring R>
BigComplex<R>::BigComplex(R ring, const Structure& structure)
    : ring_{ring}, structure_{structure}, boundary_(ring, 0, 0) {}

template <Ring R>
ops::BodyId BigComplex<R>::body_of(Index generator) const {
  const std::uint32_t origin = origin_[generator];
  if ((origin & removal) != 0) {
    return structure_.body_of(structure_.removed(origin & ~removal));
  }
  if ((origin & pair) != 0) {
    return structure_.find_body(structure_.family(origin & ~pair).body);
  }
  return structure_.body_of(origin);
}

// ------------------------------------------------------------------------------------------------------------- growth

template <Ring R>
std::optional<Index> BigComplex<R>::append_cell(CellId cell) {
  sparse::expects(cell == of_cell_.size(), "cells are appended in the order of their creation");
  if (structure_.is_lazy(cell) || (structure_.parent(cell) == ops::none && structure_.link_of(cell) == ops::none)) {
    of_cell_.push_back(ops::none);
    return std::nullopt;
  }
  column_.clear();
  lazy_column_.clear();
  const ops::TypeInfo& type = structure_.type(cell);
  const auto faces = structure_.faces_as_created(cell);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (structure_.parent(faces[k]) != ops::none) {
      add_g(faces[k], ring_.from(type.faces[k].sign), column_);
      add_lazy_part(faces[k], ring_.from(type.faces[k].sign), lazy_column_);
    }
  }
  of_cell_.push_back(size());
  return append(cell, type.dimension);
}

template <Ring R>
Index BigComplex<R>::append_removal(LinkId link) {
  sparse::expects(link == of_link_.size(), "removals are appended in the order in which they happened");
  column_.clear();
  lazy_column_.clear();
  const CellId removed = structure_.removed(link);
  const auto minus_one = ring_.negate(ring_.one());
  if (const CellId survivor = structure_.parent(removed); survivor != ops::none) {
    add_g(survivor, ring_.one(), column_);
    add_lazy_part(survivor, ring_.one(), lazy_column_);
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
  sparse::expects(copy == of_cell_.size(), "cells are appended in the order of their creation");
  const CellId first = structure_.copy(copy)->moment.created;  // of the copies of this step
  column_.clear();
  lazy_column_.clear();
  const auto add = [&](std::span<const CellId> faces, bool negative) {
    const std::vector<ops::FaceOperator>& operators = structure_.type(copy).faces;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (faces[k] >= first && faces[k] < structure_.created() && structure_.copy(faces[k]) != nullptr) {
        const int sign = negative ? -operators[k].sign : operators[k].sign;
        column_.push_back({of_cell_[faces[k]], ring_.from(sign)});
      }
    }
  };
  add(structure_.faces_as_created(copy), false);
  add(structure_.faces(structure_.copy(copy)->source), true);
  of_cell_.push_back(size());
  return append(copy, structure_.dimension(copy));
}

template <Ring R>
std::vector<Index> BigComplex<R>::split(Index first, std::span<const Structure::MadeMove> moves) {
  std::map<CellId, Terms<R>> gains;  // per cell: what its boundary gains
  for (const Structure::MadeMove& move : moves) {
    const int sign = structure_.type(move.cell).faces[move.slot].sign;
    gains[move.cell].push_back({of_cell_[move.after], ring_.from(sign)});
  }
  std::map<Index, Terms<R>> changes;  // per generator
  std::unordered_map<CellId, Terms<R>> of_lazy;
  for (auto& [cell, gain] : gains) {
    sparse::normalize(ring_, gain);
    const auto add = [&](Index generator, int sign) {
      if (generator < first) {
        sparse::add_multiple<R>(ring_, changes[generator], ring_.from(sign), gain);
      }
    };
    structure_.for_each_member(cell, [&](CellId node) {
      if (structure_.is_lazy(node)) {
        of_lazy.emplace(node, gain);
      } else {
        add(of_cell_[node], 1);
      }
      for (const CellId copy : structure_.copies_of(node)) {
        add(of_cell_[copy], -1);
      }
    });
  }
  if (!of_lazy.empty()) {
    lazy_maps_->add_gains(of_lazy, lazy_part_, changes);
  }
  std::vector<Index> changed;
  for (const auto& [generator, change] : changes) {
    if (!change.empty()) {
      boundary_.add_to_column(generator, ring_.one(), change);
      entries_appended_ += change.size();
      changed.push_back(generator);
    }
  }
  changed_.insert(changed_.end(), changed.begin(), changed.end());
  return changed;
}

template <Ring R>
Index BigComplex<R>::append(std::uint32_t origin, int degree) {
  sparse::normalize(ring_, column_);
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
  for (Index generator = mark.generators; generator < origin_.size(); ++generator) {
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
  of_cell_.resize(mark.cells);
  of_link_.resize(mark.links);
}

// --------------------------------------------------------------------------------------------------------------- maps

template <Ring R>
void BigComplex<R>::add_g(CellId cell, const typename R::Element& factor, Terms<R>& out) const {
  if (!structure_.moves().empty() || structure_.copies() > 0 || structure_.is_lazy(cell)) {
    add_g_at(cell, structure_.now(), factor, out);
    return;
  }
  out.push_back({of_cell_[cell], factor});
  const ops::TypeInfo& type = structure_.type(cell);
  const auto faces = structure_.faces_as_created(cell);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (!structure_.is_current(faces[k])) {
      add_path(faces[k], structure_.links(), type.faces[k].sign > 0 ? factor : ring_.negate(factor), out);
    }
  }
}

/// g as the history was at a moment, for a cell that was current then.
template <Ring R>
void BigComplex<R>::add_g_at(CellId cell, const ops::Moment& moment, const typename R::Element& factor,
                             Terms<R>& out) const {
  if (const Structure::Copy* copy = structure_.copy(cell)) {
    out.push_back({of_cell_[cell], factor});
    add_g_at(copy->source, copy->moment, factor, out);
  } else if (structure_.is_lazy(cell)) {
    lazy_maps_->add_F(cell, factor, out);
  } else {
    out.push_back({of_cell_[cell], factor});
  }
  const std::vector<ops::FaceOperator>& operators = structure_.type(cell).faces;
  for (std::uint32_t k = 0; k < operators.size(); ++k) {
    const auto signed_factor = operators[k].sign > 0 ? factor : ring_.negate(factor);
    structure_.for_each_face_of_history(
        cell, k, moment, [&](CellId node, LinkId links) { add_path(node, links, signed_factor, out); });
  }
}

template <Ring R>
void BigComplex<R>::add_lazy_part(CellId cell, const typename R::Element& factor, Terms<R>& out) const {
  if (structure_.families() == 0) {
    return;
  }
  while (const Structure::Copy* copy = structure_.copy(cell)) {
    cell = copy->source;
  }
  if (structure_.is_lazy(cell)) {
    out.push_back({cell, factor});
  }
}

template <Ring R>
void BigComplex<R>::add_path(CellId x, LinkId links, const typename R::Element& factor, Terms<R>& out) const {
  while (x != ops::none) {
    const LinkId link = structure_.link_of(x);
    if (link >= links) {  // none is more than any: it is current, or degenerate from the start
      return;
    }
    out.push_back({of_link_[link], factor});
    x = structure_.parent(x);
  }
}

template <Ring R>
void BigComplex<R>::add_cell(CellId node, const typename R::Element& factor, Terms<R>& out) const {
  if (const CellId cell = structure_.find(node); cell != ops::none) {
    out.push_back({cell, factor});
  }
}

template <Ring R>
void BigComplex<R>::add_f(Index generator, const typename R::Element& factor, Terms<R>& out) const {
  const std::uint32_t origin = origin_[generator];
  if (const auto part = lazy_part_.empty() ? lazy_part_.end() : lazy_part_.find(generator);
      part != lazy_part_.end()) {
    Terms<R> bounded;
    for (const auto& [cell, coefficient] : part->second) {
      lazy_maps_->add_K(cell, ring_.negate(ring_.multiply(factor, coefficient)), bounded);
    }
    for (const auto& [cell, coefficient] : bounded) {
      add_cell(cell, coefficient, out);
    }
  }
  if ((origin & removal) != 0) {
    return;
  }
  if ((origin & pair) != 0) {
    Terms<R> cells;
    lazy_maps_->add_G(origin & ~pair, generator, factor, cells);
    for (const auto& [cell, coefficient] : cells) {
      add_cell(cell, coefficient, out);
    }
    return;
  }
  add_cell(origin, factor, out);
  if (const Structure::Copy* copy = structure_.copy(origin)) {
    add_cell(copy->source, ring_.negate(factor), out);
  }
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
  if (const std::uint32_t origin = origin_[generator]; (origin & removal) == 0) {
    add_path(origin, structure_.links(), ring_.negate(ring_.one()), path);
    if (const Structure::Copy* copy = structure_.copy(origin)) {
      add_path(copy->source, structure_.links(), ring_.one(), path);
    }
    sparse::normalize(ring_, path);
  }
  return path;
}

#define SESAME_INSTANTIATE(R) template class BigComplex<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
