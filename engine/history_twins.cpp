#include "engine/history_twins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::engine {
namespace {

/// Finds chains in a list of them.
template <sparse::Ring R>
class ChainIndex {
 public:
  using Chain = sparse::Terms<R, ops::CellId>;
  explicit ChainIndex(const std::vector<Chain>& chains) : chains_{chains}, by_cells_(chains.size()) {
    std::iota(by_cells_.begin(), by_cells_.end(), std::size_t{0});
    std::sort(by_cells_.begin(), by_cells_.end(),
              [&](std::size_t a, std::size_t b) { return is_before(chains[a], chains[b]); });
  }
  [[nodiscard]] std::optional<std::size_t> find(const Chain& chain) const {
    auto at = std::lower_bound(by_cells_.begin(), by_cells_.end(), chain,
                               [&](std::size_t k, const Chain& wanted) { return is_before(chains_[k], wanted); });
    for (; at != by_cells_.end() && !is_before(chain, chains_[*at]); ++at) {
      if (chains_[*at] == chain) {
        return *at;
      }
    }
    return std::nullopt;
  }

 private:
  static bool is_before(const Chain& a, const Chain& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                        [](const auto& x, const auto& y) { return x.index < y.index; });
  }
  const std::vector<Chain>& chains_;
  std::vector<std::size_t> by_cells_;
};

}  // namespace

template <sparse::Ring R>
Status HistoryTwins<R>::apply(ops::Operation operation, std::uint64_t step) {
  // The one that is behind does the step that the other has done, and this one.
  std::swap(before_, after_);
  if (last_) {
    if (const auto caught_up = after_->apply(*last_); !caught_up) {
      return caught_up.error();
    }
  }
  last_ = std::move(operation);
  const Result<StepReport> report = after_->apply(*last_);
  if (!report) {
    return report.error();
  }
  if (const char* reason = why_no_map(report->kind); reason != nullptr) {
    return Error{Errc::refused, fmt::format("there is no barcode: step {} {}", step, reason)};
  }
  map_ = {step, report->kind, report->before, report->after};
  generators_before_ = std::move(generators_after_);
  generators_after_ = generators_of(*after_);
  return Done{};
}

template <sparse::Ring R>
typename HistoryTwins<R>::Images HistoryTwins<R>::images(std::size_t p) {
  const bool is_backward = maps_backward(map_.kind);
  const std::vector<Chain>& from = generators(is_backward ? generators_after_ : generators_before_, p);
  const std::vector<Chain>& to = generators(is_backward ? generators_before_ : generators_after_, p);
  const ChainIndex<R> index(to);
  Images images{from.size() == to.size(), {}};
  for (std::size_t k = 0; k < from.size(); ++k) {
    const Chain chain = image(from[k]);
    const std::optional<std::size_t> same = index.find(chain);
    images.are_basis &= same == k;
    if (same) {
      images.vectors.emplace_back(to.size(), ring_.zero())[*same] = ring_.one();
      continue;
    }
    std::optional<Vector> found = class_in(is_backward ? *before_ : *after_, p, chain);
    sparse::expects(found && found->size() == to.size(), "a chain map takes cycles to cycles");
    images.vectors.push_back(std::move(*found));
  }
  if (images.are_basis) {
    images.vectors.clear();
  }
  return images;
}

template <sparse::Ring R>
typename HistoryTwins<R>::Chain HistoryTwins<R>::image(const Chain& chain) const {
  sparse::RawTerms<R, ops::CellId> sum;
  for (const auto& [cell, coefficient] : chain) {
    const auto [to, sign] = image_by(map_, after_->structure(), cell);
    if (to != ops::none) {
      sum.push_back({to, sign > 0 ? coefficient : ring_.negate(coefficient)});
    }
  }
  return std::move(sum).normal(ring_);
}

template <sparse::Ring R>
typename HistoryTwins<R>::Chain HistoryTwins<R>::chain_of(std::size_t p, const Vector& vector) const {
  sparse::RawTerms<R, ops::CellId> sum;
  for (std::size_t k = 0; k < vector.size(); ++k) {
    if (!ring_.is_zero(vector[k])) {
      for (const auto& [cell, coefficient] : generators_after_[p][k]) {
        sum.push_back({cell, ring_.multiply(vector[k], coefficient)});
      }
    }
  }
  return std::move(sum).normal(ring_);
}

template <sparse::Ring R>
std::optional<typename HistoryTwins<R>::Vector> HistoryTwins<R>::class_after(std::size_t p, const Chain& chain) {
  const bool is_there = std::all_of(chain.begin(), chain.end(),
                                    [&](const auto& term) { return after_->structure().is_current(term.index); });
  return is_there ? class_in(*after_, p, chain) : std::nullopt;
}

/// Chains are told with the orientations that names stand for.
template <sparse::Ring R>
typename HistoryTwins<R>::Generators HistoryTwins<R>::generators_of(Engine& engine) const {
  const ops::Directory& directory = engine.structure().directory();
  Generators generators(engine.cells().size());
  for (std::size_t p = 0; p < generators.size(); ++p) {
    for (const Generator& generator : engine.generators(static_cast<int>(p))) {
      sparse::RawTerms<R, ops::CellId> chain;
      for (const auto& [coefficient, cell] : generator.cycle.terms) {
        const auto told = sparse::from_rational(ring_, coefficient);
        chain.push_back({cell, directory.sign_of_name(cell) > 0 ? told : ring_.negate(told)});
      }
      generators[p].push_back(std::move(chain).normal(ring_));
    }
  }
  return generators;
}

template <sparse::Ring R>
std::optional<typename HistoryTwins<R>::Vector> HistoryTwins<R>::class_in(Engine& engine, std::size_t p,
                                                                          const Chain& chain) const {
  const ops::Directory& directory = engine.structure().directory();
  const Generators& generators = &engine == after_.get() ? generators_after_ : generators_before_;
  Vector vector(HistoryTwins::generators(generators, p).size(), ring_.zero());
  if (chain.empty()) {
    return vector;
  }
  CellChain told{static_cast<int>(p), {}};
  for (const auto& [cell, coefficient] : chain) {
    const auto value = directory.sign_of_name(cell) > 0 ? coefficient : ring_.negate(coefficient);
    told.terms.push_back({sparse::to_rational(ring_, value), cell});
  }
  const ClassAnswer answer = engine.classify(told);
  if (!answer.is_cycle) {
    return std::nullopt;
  }
  sparse::expects(answer.coefficients.size() == vector.size(), "a class is one in the generators");
  for (std::size_t k = 0; k < vector.size(); ++k) {
    vector[k] = sparse::from_rational(ring_, answer.coefficients[k]);
  }
  return vector;
}

#define SESAME_INSTANTIATE(R) template class HistoryTwins<R>;
SESAME_INSTANTIATE(sparse::Z2)
SESAME_INSTANTIATE(sparse::Zp)
SESAME_INSTANTIATE(sparse::Rationals)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
