#include "tools/bench/present_complex.hpp"

#include <algorithm>
#include <utility>

namespace sesame::tools {

using ops::CellId;
using sparse::Index;

void PresentComplex::begin_again() {
  cells_.clear();
  position_ = {};
}

void PresentComplex::catch_up() {
  structure_.lazy().make_all();
  const auto is_in_object = [this](CellId c) { return structure_.is_current(c) && !structure_.lazy().is_consumed(c); };
  for (auto& cells : cells_) {
    cells_read_ += cells.size();
    std::erase_if(cells, [&](CellId c) { return !is_in_object(c); });
  }
  const auto take = [&](CellId c) {
    ++cells_read_;
    position_.push_back(c, 0);
    if (is_in_object(c)) {
      const auto degree = static_cast<std::size_t>(structure_.dimension(c));
      cells_.resize(std::max(cells_.size(), degree + 1));
      cells_[degree].push_back(c);
    }
  };
  while (position_.made() < structure_.cells().size()) {
    take(position_.made());
  }
  while (position_.asked() < structure_.cells().asked()) {
    take(position_.asked());
  }
  while (!cells_.empty() && cells_.back().empty()) {
    cells_.pop_back();
  }
  for (const auto& cells : cells_) {
    for (std::size_t k = 0; k < cells.size(); ++k) {
      position_[cells[k]] = static_cast<Index>(k);
    }
  }
}

template <sparse::Ring R>
reductions::ChainComplex<R> PresentComplex::matrices(const R& ring) {
  catch_up();
  std::vector<Index> sizes;
  std::vector<sparse::Matrix<R>> boundaries;
  sparse::RawTerms<R> faces_of_cell;  // kept from cell to cell, as is the next: no allocation for each
  sparse::Terms<R> terms;
  for (const auto& cells : cells_) {
    sparse::Matrix<R> boundary(ring, sizes.empty() ? 0 : sizes.back(), 0);
    for (const CellId cell : cells) {
      structure_.faces().for_each_now(cell, [&](CellId face, int sign) {
        faces_of_cell.push_back({position_[face], ring.from(sign)});
      });
      faces_of_cell.finish(ring, terms);
      boundary.append_column(terms);
    }
    sizes.push_back(static_cast<Index>(cells.size()));
    boundaries.push_back(std::move(boundary));
  }
  return reductions::ChainComplex<R>(ring, sizes, std::move(boundaries));
}

#define SESAME_INSTANTIATE(R) template reductions::ChainComplex<R> PresentComplex::matrices(const R&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::tools
