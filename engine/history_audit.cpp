#include "engine/history_audit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "ops/plan/step_sequence.hpp"

namespace sesame::engine {
namespace {

using sparse::Index;
using sparse::Terms;

/// Independent vectors, each with another largest index.
template <sparse::Ring R>
class Reduced {
 public:
  Reduced(R ring, std::size_t rows) : ring_{ring}, with_largest_(rows) {}
  /// Takes multiples of the vectors from another one. Whether anything is left, which is kept.
  bool add(Terms<R> vector) {
    reduce(vector);
    if (vector.empty()) {
      return false;
    }
    const Index largest = vector.back().index;
    with_largest_[largest] = std::move(vector);
    ++rank_;
    return true;
  }
  [[nodiscard]] bool spans(Terms<R> vector) const {
    reduce(vector);
    return vector.empty();
  }
  [[nodiscard]] std::size_t rank() const { return rank_; }

 private:
  void reduce(Terms<R>& vector) const {
    while (!vector.empty()) {
      const Terms<R>& other = with_largest_[vector.back().index];
      if (other.empty()) {
        return;
      }
      const auto factor =
          ring_.negate(ring_.multiply(vector.back().coefficient, ring_.inverse(other.back().coefficient)));
      sparse::add_multiple(ring_, vector, factor, other);
    }
  }
  R ring_;
  std::vector<Terms<R>> with_largest_;
  std::size_t rank_ = 0;
};

/// The object after a map, with bases of its boundaries, by degree.
template <sparse::Ring R>
struct ObjectThen {
  ops::CellBasis basis;
  reductions::ChainComplex<R> complex;
  std::vector<Reduced<R>> boundaries;

  ObjectThen(const R& ring, const ops::Structure& structure, const ops::Moment& moment)
      : basis{ops::cells_at(structure, moment)}, complex{ops::chain_complex(structure, basis, moment, ring)} {
    for (int p = 0; p <= complex.top(); ++p) {
      boundaries.emplace_back(ring, complex.size(p));
      const sparse::Matrix<R>& matrix = complex.boundary(p + 1);
      for (Index k = 0; k < complex.size(p + 1); ++k) {
        Terms<R> column;
        matrix.for_each_in_column(k, [&](const auto& term) { column.push_back(term); });
        boundaries.back().add(std::move(column));
      }
    }
  }
  [[nodiscard]] std::size_t betti(std::size_t p) const {
    return complex.size(static_cast<int>(p)) - (p > 0 ? boundaries[p - 1].rank() : 0) - boundaries[p].rank();
  }
};

template <sparse::Ring R>
class HistoryAudit {
 public:
  HistoryAudit(const R& ring, const ops::Structure& structure, const std::vector<HistoryMap>& maps,
               const std::vector<ChainBar<R>>& bars, const std::atomic<bool>* stop)
      : ring_{ring}, structure_{structure}, maps_{maps}, bars_{bars}, stop_{stop}, at_(bars.size(), 0) {
    for (std::size_t k = 0; k < bars.size(); ++k) {
      by_birth_.push_back(k);
    }
    std::sort(by_birth_.begin(), by_birth_.end(),
              [&](std::size_t a, std::size_t b) { return bars[a].birth < bars[b].birth; });
  }

  std::optional<std::string> first_defect() {
    auto next = by_birth_.begin();
    for (std::uint64_t m = 0; m < maps_.size() && (stop_ == nullptr || !stop_->load()); ++m) {
      const std::unique_ptr<const ObjectThen<R>> before = std::move(now_);
      now_ = std::make_unique<const ObjectThen<R>>(ring_, structure_, maps_[m].after);
      for (; next != by_birth_.end() && bars_[*next].birth == m; ++next) {
        open_.push_back(*next);
      }
      for (const std::size_t bar : open_) {
        if (before && !is_sent_on(bar, m, *before)) {
          return told(bar, m, "is not sent to what comes next");
        }
      }
      std::erase_if(open_, [&](std::size_t bar) { return bars_[bar].death == m; });
      if (std::optional<std::string> defect = first_defect_of_basis(m)) {
        return defect;
      }
    }
    return std::nullopt;
  }

 private:
  using Chain = Terms<R, ops::CellId>;

  /// That of a bar after a map, or 0 when it is not alive.
  [[nodiscard]] const Chain& chain(std::size_t bar, std::uint64_t m) {
    static const Chain zero;
    const ChainBar<R>& each = bars_[bar];
    if (m < each.birth || m >= each.death) {
      return zero;
    }
    std::size_t& at = at_[bar];
    while (at + 1 < each.pieces.size() && each.pieces[at + 1].from <= m) {
      ++at;
    }
    return each.pieces[at].chain;
  }
  /// Nothing when there is no such chain.
  [[nodiscard]] static std::optional<Terms<R>> in_basis(const R& ring, const ops::CellBasis& basis,
                                                        const Chain& chain) {
    const bool is_there =
        std::all_of(chain.begin(), chain.end(), [&](const auto& term) { return basis.contains(term.index); });
    return is_there ? std::optional{reductions::in_basis(ring, basis, sparse::RawTerms<R, ops::CellId>{chain})}
                    : std::nullopt;
  }
  [[nodiscard]] bool is_sent_on(std::size_t bar, std::uint64_t m, const ObjectThen<R>& before) {
    const Chain old = m > 0 ? chain(bar, m - 1) : Chain{};
    const Chain& now = chain(bar, m);
    const bool is_backward = maps_backward(maps_[m].kind);
    sparse::RawTerms<R, ops::CellId> difference;
    for (const auto& [cell, coefficient] : is_backward ? now : old) {
      if (const auto [to, sign] = image_by(maps_[m], structure_, cell); to != ops::none) {
        difference.push_back({to, sign > 0 ? coefficient : ring_.negate(coefficient)});
      }
    }
    for (const auto& [cell, coefficient] : is_backward ? old : now) {
      difference.push_back({cell, ring_.negate(coefficient)});
    }
    const bool is_end = m == bars_[bar].birth ? !is_backward : m == bars_[bar].death && is_backward;
    const ObjectThen<R>& target = is_backward ? before : *now_;
    const std::optional<Terms<R>> terms = in_basis(ring_, target.basis, std::move(difference).normal(ring_));
    // Where no map leads out of the bar there is nothing to ask.
    const auto p = static_cast<std::size_t>(bars_[bar].dimension);
    return is_end || (terms && (terms->empty() || target.boundaries[p].spans(*terms)));
  }
  /// What is wrong with the chains of the open bars of an object.
  [[nodiscard]] std::optional<std::string> first_defect_of_basis(std::uint64_t m) {
    std::vector<Reduced<R>> classes = now_->boundaries;
    std::vector<std::size_t> counts(classes.size(), 0);
    for (const std::size_t bar : open_) {
      const int dimension = bars_[bar].dimension;
      const auto p = static_cast<std::size_t>(dimension);
      const std::optional<Terms<R>> terms = in_basis(ring_, now_->basis, chain(bar, m));
      if (!terms || p >= counts.size()) {
        return told(bar, m, "has a cell that is not there");
      }
      if (!now_->complex.boundary_of(sparse::Chain<R>(ring_, sparse::Degree{dimension}, *terms)).is_zero()) {
        return told(bar, m, "is no cycle");
      }
      if (!classes[p].add(*terms)) {
        return told(bar, m, "depends on others");
      }
      ++counts[p];
    }
    for (std::size_t p = 0; p < counts.size(); ++p) {
      if (counts[p] != now_->betti(p)) {
        return fmt::format("after step {} there are {} bars of H{}, and its Betti number is {}", maps_[m].step,
                           counts[p], p, now_->betti(p));
      }
    }
    return std::nullopt;
  }
  [[nodiscard]] std::string told(std::size_t bar, std::uint64_t m, const char* what) const {
    return fmt::format("at step {} the cycle of the bar of H{} that step {} begins {}", maps_[m].step,
                       bars_[bar].dimension, maps_[bars_[bar].birth].step, what);
  }

  const R& ring_;
  const ops::Structure& structure_;
  const std::vector<HistoryMap>& maps_;
  const std::vector<ChainBar<R>>& bars_;
  const std::atomic<bool>* stop_;
  std::vector<std::size_t> at_, by_birth_, open_;
  std::unique_ptr<const ObjectThen<R>> now_;
};

}  // namespace

template <sparse::Ring R>
std::optional<std::string> first_wrong_bar(const R& ring, const ops::Structure& structure,
                                           const std::vector<HistoryMap>& maps, const std::vector<ChainBar<R>>& bars,
                                           const std::atomic<bool>* stop) {
  return HistoryAudit<R>(ring, structure, maps, bars, stop).first_defect();
}

#define SESAME_INSTANTIATE(R)                                                             \
  template std::optional<std::string> first_wrong_bar<R>(const R&, const ops::Structure&, \
                                                         const std::vector<HistoryMap>&,  \
                                                         const std::vector<ChainBar<R>>&, const std::atomic<bool>*);
SESAME_INSTANTIATE(sparse::Z2)
SESAME_INSTANTIATE(sparse::Zp)
SESAME_INSTANTIATE(sparse::Rationals)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
