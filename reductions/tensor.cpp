#include "reductions/tensor.hpp"

#include <utility>

namespace sesame::reductions {

TensorBasis::TensorBasis(Sizes first, Sizes second)
    : first_{trimmed(std::move(first))}, second_{trimmed(std::move(second))} {
  if (first_.empty() || second_.empty()) {
    return;
  }
  for (int n = 0; n < static_cast<int>(first_.size() + second_.size()) - 1; ++n) {
    std::uint64_t size = 0;
    std::vector<Index>& offsets = offsets_.emplace_back();
    for (int p = 0; p <= n; ++p) {
      offsets.push_back(static_cast<Index>(size));
      size += std::uint64_t{size_at(first_, p)} * size_at(second_, n - p);
      sparse::expects(size <= ~Index{0}, "tensor product: more than 2^32 - 1 generators in one degree");
    }
    sizes_.push_back(static_cast<Index>(size));
  }
}

namespace {

/// The columns of phi (x) psi for generators a (x) b with a of degree p, b of degree q, set in `into`.
template <Ring R>
void set_product_columns(Matrix<R>& into, const TensorBasis& source, const TensorBasis& target, const GradedMap<R>& phi,
                         int p, const GradedMap<R>& psi, int q) {
  const R& ring = phi.ring();
  const bool negative = psi.degree() % 2 != 0 && p % 2 != 0;
  const int image_p = p + phi.degree();
  const int image_q = q + psi.degree();
  Terms<R> terms;
  for (Index i = 0; i < size_at(phi.source(), p); ++i) {
    const Terms<R> image_a = phi.at(p).column(i);
    for (Index j = 0; j < size_at(psi.source(), q); ++j) {
      terms.clear();
      for (const Term<R>& s : image_a) {
        psi.at(q).for_each_in_column(j, [&](const Term<R>& t) {
          typename R::Element product = ring.multiply(s.coefficient, t.coefficient);
          terms.push_back(
              {target.index(image_p, s.index, image_q, t.index), negative ? ring.negate(product) : std::move(product)});
        });
      }
      if (!terms.empty()) {
        into.set_column(source.index(p, i, q, j), terms);
      }
    }
  }
}

template <Ring R>
bool is_identity(const GradedMap<R>& map) {
  return map.degree() == 0 && map.source() == map.target() && map == GradedMap<R>::identity(map.ring(), map.source());
}

}  // namespace

template <Ring R>
GradedMap<R> tensor(const GradedMap<R>& phi, const GradedMap<R>& psi) {
  const TensorBasis source(phi.source(), psi.source());
  if (is_identity(phi) && is_identity(psi)) {
    return GradedMap<R>::identity(phi.ring(), source.sizes());
  }
  const TensorBasis target(phi.target(), psi.target());
  const int degree = phi.degree() + psi.degree();
  std::vector<Matrix<R>> parts;
  for (int n = 0; n < static_cast<int>(source.sizes().size()); ++n) {
    Matrix<R>& part = parts.emplace_back(phi.ring(), size_at(target.sizes(), n + degree), size_at(source.sizes(), n));
    for (int p = 0; p <= n; ++p) {
      set_product_columns(part, source, target, phi, p, psi, n - p);
    }
  }
  return GradedMap<R>(phi.ring(), degree, source.sizes(), target.sizes(), std::move(parts));
}

template <Ring R>
ChainComplex<R> tensor(const ChainComplex<R>& a, const ChainComplex<R>& b) {
  return complex_with(tensor(differential(a), identity_of(b)) + tensor(identity_of(a), differential(b)));
}

template <Ring R>
Reduction<R> tensor(const Reduction<R>& a, const Reduction<R>& b) {
  return {tensor(a.big, b.big), tensor(a.small, b.small), tensor(a.f, b.f), tensor(a.g, b.g),
          tensor(a.h, identity_of(b.big)) + tensor(a.g * a.f, b.h)};
}

template <Ring R>
Equivalence<R> tensor(const Equivalence<R>& a, const Equivalence<R>& b) {
  return {tensor(a.left, b.left), tensor(a.right, b.right)};
}

#define SESAME_INSTANTIATE(R)                                                      \
  template GradedMap<R> tensor(const GradedMap<R>&, const GradedMap<R>&);          \
  template ChainComplex<R> tensor(const ChainComplex<R>&, const ChainComplex<R>&); \
  template Reduction<R> tensor(const Reduction<R>&, const Reduction<R>&);          \
  template Equivalence<R> tensor(const Equivalence<R>&, const Equivalence<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions
