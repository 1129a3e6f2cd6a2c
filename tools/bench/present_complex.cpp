#include "tools/bench/present_complex.hpp"

#include <algorithm>
#include <utility>

namespace sesame::tools {

using ops::CellId;
using sparse::Index;

void PresentComplex::begin_again() {
  cells_.clear();
  seen_ = 0;
}

void PresentComplex::catch_up() {
  structure_.lazy().make_all();
  const auto is_in_object = [this](CellId c) { return structure_.is_current(c) && !structure_.lazy().is_consumed(c); };
  cells_read_ += structure_.cells().size() - seen_;
  for (auto& cells : cells_) {
    cells_read_ += cells.size();
    std::erase_if(cells, [&](CellId c) { return !is_in_object(c); });
  }
  for (; seen_ < structure_.cells().size(); ++seen_) {
    if (is_in_object(seen_)) {
      const auto degree = static_cast<std::size_t>(structure_.dimension(seen_));
      cells_.resize(std::max(cells_.size(), degree + 1));
      cells_[degree].push_back(seen_);
    }
  }
  while (!cells_.empty() && cells_.back().empty()) {
    cells_.pop_back();
  }
  position_.resize(structure_.cells().size());
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
