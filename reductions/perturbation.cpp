#include "reductions/perturbation.hpp"

#include <algorithm>
#include <string>

#include "reductions/defect.hpp"
#include "reductions/strong_components.hpp"

namespace sesame::reductions {

namespace {

/// The complex with differential d + delta, or what is wrong with it.
template <Ring R>
Result<ChainComplex<R>> perturbed(const ChainComplex<R>& complex, const GradedMap<R>& delta) {
  ChainComplex<R> result = complex_with(differential(complex) + delta);
  if (const auto defect = first_defect(result)) {
    return Error{Errc::law_broken, "perturbation: (d + delta) (d + delta) = 0 fails on generator " +
                                       std::to_string(defect->column) + " of degree " + std::to_string(defect->degree)};
  }
  return result;
}

template <Ring R>
std::vector<std::vector<Index>> support_graph(const Matrix<R>& m) {
  std::vector<std::vector<Index>> successors(m.columns());
  for (Index j = 0; j < m.columns(); ++j) {
    m.for_each_in_column(j, [&](const Term<R>& t) { successors[j].push_back(t.index); });
  }
  return successors;
}

/// Computes the alternating series 1 - N + N^2 - ... of a square matrix N, one strongly connected part of its support
/// after the other: a column of the series is the part of the series inside, then what the finished columns make of
/// whatever leaves.
template <Ring R>
class AlternatingSeries {
 public:
  explicit AlternatingSeries(const Matrix<R>& n) : n_{n}, sum_(n.ring(), n.rows(), n.columns()) {}

  /// Empty on success, otherwise a column on which no power of N vanishes.
  std::optional<Index> run() {
    for (const std::vector<Index>& component : strong_components(support_graph(n_))) {
      for (const Index j : component) {
        if (!sum_column(component, j)) {
          return j;
        }
      }
      for (std::size_t k = 0; k < component.size(); ++k) {
        sum_.set_column(component[k], columns_[k]);
      }
      columns_.clear();
    }
    return std::nullopt;
  }

  [[nodiscard]] Matrix<R> take() && { return std::move(sum_); }

 private:
  /// Appends column j of the sum to columns_; false when the powers of N within the component do not vanish on e_j.
  bool sum_column(const std::vector<Index>& component, Index j) {
    const R& ring = n_.ring();
    const auto leaves = [&](const Term<R>& t) {
      return !std::binary_search(component.begin(), component.end(), t.index);
    };
    Terms<R> inside{{j, ring.one()}};
    Terms<R> total;
    typename R::Element sign = ring.one();
    for (std::size_t round = 0; !inside.empty(); ++round) {
      if (round == component.size()) {
        return false;
      }
      sparse::add_multiple<R>(ring, total, sign, inside);
      Terms<R> image = n_.apply(inside);
      sign = ring.negate(sign);
      const auto middle = std::stable_partition(image.begin(), image.end(), leaves);
      inside.assign(middle, image.end());
      image.erase(middle, image.end());
      sparse::add_multiple<R>(ring, total, sign, sum_.apply(image));
    }
    columns_.push_back(std::move(total));
    return true;
  }

  const Matrix<R>& n_;
  Matrix<R> sum_;
  std::vector<Terms<R>> columns_;  // of the component in progress
};

/// phi = sum of (-h delta)^n.
template <Ring R>
Result<GradedMap<R>> alternating_series(const GradedMap<R>& h_delta) {
  GradedMap<R> phi = GradedMap<R>::zero(h_delta.ring(), 0, h_delta.source(), h_delta.target());
  for (int p = 0; p < static_cast<int>(h_delta.source().size()); ++p) {
    AlternatingSeries<R> series(h_delta.at(p));
    if (const auto generator = series.run()) {
      return Error{Errc::not_nilpotent, "perturbation: the series of h delta does not stop on generator " +
                                            std::to_string(*generator) + " of degree " + std::to_string(p) +
                                            " of the big complex; h delta has to be nilpotent"};
    }
    phi.set(p, std::move(series).take());
  }
  return phi;
}

}  // namespace

template <Ring R>
Result<Reduction<R>> easy_perturbation(const Reduction<R>& reduction, const GradedMap<R>& delta) {
  auto small = perturbed(reduction.small, delta);
  if (!small) {
    return small.error();
  }
  ChainComplex<R> big = complex_with(differential(reduction.big) + reduction.g * delta * reduction.f);
  return Reduction<R>{std::move(big), std::move(*small), reduction.f, reduction.g, reduction.h};
}

template <Ring R>
Result<Reduction<R>> basic_perturbation(const Reduction<R>& reduction, const GradedMap<R>& delta) {
  auto big = perturbed(reduction.big, delta);
  if (!big) {
    return big.error();
  }
  const auto phi = alternating_series(reduction.h * delta);
  if (!phi) {
    return phi.error();
  }
  GradedMap<R> g = *phi * reduction.g;
  GradedMap<R> h = *phi * reduction.h;
  const GradedMap<R> f_delta = reduction.f * delta;
  ChainComplex<R> small = complex_with(differential(reduction.small) + f_delta * g);
  GradedMap<R> f = reduction.f - f_delta * h;  // f psi, because psi = 1 - delta phi h
  return Reduction<R>{std::move(*big), std::move(small), std::move(f), std::move(g), std::move(h)};
}

#define SESAME_INSTANTIATE(R)                                                                \
  template Result<Reduction<R>> easy_perturbation(const Reduction<R>&, const GradedMap<R>&); \
  template Result<Reduction<R>> basic_perturbation(const Reduction<R>&, const GradedMap<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions
