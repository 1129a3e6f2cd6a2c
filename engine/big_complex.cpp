#include "engine/big_complex.hpp"

#include "sparse/contract.hpp"

namespace sesame::engine {

template <Ring R>
BigComplex<R>::BigComplex(R ring, const Structure& structure)
    : ring_{ring}, structure_{structure}, boundary_(ring, 0, 0) {}

template <Ring R>
Index BigComplex<R>::append_cell(CellId cell) {
  sparse::expects(cell == of_cell_.size(), "cells are appended in the order of their creation");
  column_.clear();
  const ops::TypeInfo& type = structure_.type(cell);
  const auto faces = structure_.faces_as_created(cell);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    add_g(faces[k], ring_.from(type.faces[k].sign), column_);
  }
  of_cell_.push_back(size());
  return append(cell, type.dimension);
}

template <Ring R>
Index BigComplex<R>::append_removal(LinkId link) {
  sparse::expects(link == of_link_.size(), "removals are appended in the order in which they happened");
  column_.clear();
  const CellId removed = structure_.removed(link);
  add_g(structure_.parent(removed), ring_.one(), column_);
  add_g(removed, ring_.negate(ring_.one()), column_);
  of_link_.push_back(size());
  return append(removal | link, structure_.dimension(removed) + 1);
}

template <Ring R>
Index BigComplex<R>::append(std::uint32_t origin, int degree) {
  sparse::normalize(ring_, column_);
  boundary_.append_rows(1);
  boundary_.append_column(column_);
  entries_appended_ += column_.size();
  origin_.push_back(origin);
  degree_.push_back(static_cast<std::uint8_t>(degree));
  if (static_cast<std::size_t>(degree) >= counts_.size()) {
    counts_.resize(static_cast<std::size_t>(degree) + 1, 0);
  }
  ++counts_[static_cast<std::size_t>(degree)];
  return size() - 1;
}

template <Ring R>
void BigComplex<R>::truncate(Index size, CellId cells, LinkId links) {
  for (Index generator = size; generator < origin_.size(); ++generator) {
    --counts_[degree_[generator]];
  }
  while (!counts_.empty() && counts_.back() == 0) {
    counts_.pop_back();
  }
  boundary_.truncate(size, size);
  origin_.resize(size);
  degree_.resize(size);
  of_cell_.resize(cells);
  of_link_.resize(links);
}

template <Ring R>
void BigComplex<R>::add_g(CellId cell, const typename R::Element& factor, Terms<R>& out) const {
  out.push_back({of_cell_[cell], factor});
  const ops::TypeInfo& type = structure_.type(cell);
  const auto faces = structure_.faces_as_created(cell);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (!structure_.is_current(faces[k])) {
      add_path(faces[k], type.faces[k].sign > 0 ? factor : ring_.negate(factor), out);
    }
  }
}

template <Ring R>
void BigComplex<R>::add_path(CellId x, const typename R::Element& factor, Terms<R>& out) const {
  for (; !structure_.is_current(x); x = structure_.parent(x)) {
    out.push_back({of_link_[structure_.link_of(x)], factor});
  }
}

template <Ring R>
CellId BigComplex<R>::f(Index generator) const {
  const std::uint32_t origin = origin_[generator];
  return (origin & removal) != 0 ? ops::none : structure_.find(origin);
}

template <Ring R>
Terms<R> BigComplex<R>::f(std::span<const sparse::Term<R>> chain) const {
  Terms<R> cells;
  for (const auto& [generator, coefficient] : chain) {
    if (const CellId cell = f(generator); cell != ops::none) {
      cells.push_back({cell, coefficient});
    }
  }
  sparse::normalize(ring_, cells);
  return cells;
}

template <Ring R>
Terms<R> BigComplex<R>::h(Index generator) const {
  Terms<R> path;
  if (const std::uint32_t origin = origin_[generator]; (origin & removal) == 0) {
    add_path(origin, ring_.negate(ring_.one()), path);
    sparse::normalize(ring_, path);
  }
  return path;
}

#define SESAME_INSTANTIATE(R) template class BigComplex<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
