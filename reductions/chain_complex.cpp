#include "reductions/chain_complex.hpp"

#include <numeric>

namespace sesame::reductions {

Sizes trimmed(Sizes sizes) {
  while (!sizes.empty() && sizes.back() == 0) {
    sizes.pop_back();
  }
  return sizes;
}

template <Ring R>
ChainComplex<R>::ChainComplex(R ring, Sizes sizes, std::vector<Matrix<R>> boundaries)
    : ring_{ring}, boundaries_{std::move(boundaries)} {
  sparse::expects(boundaries_.size() == sizes.size(), "a chain complex has one boundary matrix per degree");
  for (std::size_t p = 0; p < boundaries_.size(); ++p) {
    sparse::expects(
        boundaries_[p].rows() == size_at(sizes, static_cast<int>(p) - 1) && boundaries_[p].columns() == sizes[p],
        "boundary p of a chain complex has size(p-1) rows and size(p) columns");
  }
  sizes_ = trimmed(std::move(sizes));
  boundaries_.erase(boundaries_.begin() + static_cast<std::ptrdiff_t>(sizes_.size()), boundaries_.end());
  boundaries_.emplace_back(ring_, size(top()), Index{0});
  boundaries_.emplace_back(ring_, Index{0}, Index{0});
}

template <Ring R>
ChainComplex<R> ChainComplex<R>::with_zero_boundary(R ring, Sizes sizes) {
  std::vector<Matrix<R>> boundaries;
  for (int p = 0; p < static_cast<int>(sizes.size()); ++p) {
    boundaries.emplace_back(ring, size_at(sizes, p - 1), size_at(sizes, p));
  }
  return ChainComplex(ring, std::move(sizes), std::move(boundaries));
}

template <Ring R>
const Matrix<R>& ChainComplex<R>::boundary(int p) const {
  return p >= 0 && p <= top() + 1 ? boundaries_[static_cast<std::size_t>(p)] : boundaries_.back();
}

template <Ring R>
std::vector<Matrix<R>> ChainComplex<R>::boundaries() const {
  return {boundaries_.begin(), boundaries_.begin() + static_cast<std::ptrdiff_t>(sizes_.size())};
}

template <Ring R>
Chain<R> ChainComplex<R>::boundary_of(const Chain<R>& chain) const {
  return boundary(chain.degree().value).apply(chain, -1);
}

template <Ring R>
std::size_t ChainComplex<R>::total_size() const {
  return std::accumulate(sizes_.begin(), sizes_.end(), std::size_t{0});
}

template <Ring R>
bool ChainComplex<R>::equals(const ChainComplex& other) const {
  return ring_ == other.ring_ && sizes_ == other.sizes_ && boundaries_ == other.boundaries_;
}

#define SESAME_INSTANTIATE(R) template class ChainComplex<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions
