#include "reductions/graded_map.hpp"

#include <algorithm>

namespace sesame::reductions {

template <Ring R>
GradedMap<R>::GradedMap(R ring, int degree, Sizes source, Sizes target)
    : ring_{ring}, degree_{degree}, source_{trimmed(std::move(source))}, target_{trimmed(std::move(target))} {
  for (int p = lowest(); p <= highest(); ++p) {
    parts_.emplace_back(ring_, size_at(target_, p + degree_), size_at(source_, p));
  }
  parts_.emplace_back(ring_, Index{0}, Index{0});
}

template <Ring R>
GradedMap<R>::GradedMap(R ring, int degree, Sizes source, Sizes target, std::vector<Matrix<R>> parts)
    : GradedMap(ring, degree, std::move(source), std::move(target)) {
  sparse::expects(parts.size() >= source_.size(), "a graded map has one matrix per degree of its source");
  for (std::size_t p = 0; p < source_.size(); ++p) {
    set(static_cast<int>(p), std::move(parts[p]));
  }
}

template <Ring R>
GradedMap<R> GradedMap<R>::zero(R ring, int degree, Sizes source, Sizes target) {
  return GradedMap(ring, degree, std::move(source), std::move(target));
}

template <Ring R>
GradedMap<R> GradedMap<R>::identity(R ring, const Sizes& sizes) {
  GradedMap result(ring, 0, sizes, sizes);
  for (int p = 0; p <= result.highest(); ++p) {
    result.set(p, Matrix<R>::identity(ring, size_at(sizes, p)));
  }
  return result;
}

template <Ring R>
int GradedMap<R>::highest() const {
  return std::max(static_cast<int>(source_.size()), static_cast<int>(target_.size()) - degree_) - 1;
}

template <Ring R>
const Matrix<R>& GradedMap<R>::at(int p) const {
  return p >= lowest() && p <= highest() ? parts_[static_cast<std::size_t>(p - lowest())] : parts_.back();
}

template <Ring R>
void GradedMap<R>::set(int p, Matrix<R> part) {
  sparse::expects(p >= lowest() && p <= highest(), "set: not a degree of this graded map");
  sparse::expects(part.rows() == size_at(target_, p + degree_) && part.columns() == size_at(source_, p),
                  "part p of a graded map of degree k has |D_{p+k}| rows and |C_p| columns");
  parts_[static_cast<std::size_t>(p - lowest())] = std::move(part);
}

template <Ring R>
Chain<R> GradedMap<R>::apply(const Chain<R>& chain) const {
  return at(chain.degree().value).apply(chain, degree_);
}

template <Ring R>
bool GradedMap<R>::is_zero() const {
  return std::all_of(parts_.begin(), parts_.end(), [](const Matrix<R>& part) { return part.is_zero(); });
}

template <Ring R>
void GradedMap<R>::add(const Element& a, const GradedMap& other) {
  sparse::expects(degree_ == other.degree_ && source_ == other.source_ && target_ == other.target_,
                  "only graded maps of the same degree between the same modules can be added");
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    parts_[k].add(a, other.parts_[k]);
  }
}

template <Ring R>
void GradedMap<R>::negate() {
  for (Matrix<R>& part : parts_) {
    part = -std::move(part);
  }
}

template <Ring R>
GradedMap<R> GradedMap<R>::raised(int source_up, int target_up) const {
  sparse::expects(source_up >= 0 && target_up >= 0, "raised: degrees are raised, not lowered");
  const auto raise = [](const Sizes& sizes, int up) {
    Sizes result(static_cast<std::size_t>(up), 0);
    result.insert(result.end(), sizes.begin(), sizes.end());
    return result;
  };
  GradedMap result(ring_, degree_ + target_up - source_up, raise(source_, source_up), raise(target_, target_up));
  for (int p = 0; p < static_cast<int>(source_.size()); ++p) {
    result.set(p + source_up, at(p));
  }
  return result;
}

template <Ring R>
GradedMap<R> GradedMap<R>::after(const GradedMap& first) const {
  sparse::expects(first.target_ == source_, "composition: the target of the first map is the source of the second");
  GradedMap result(ring_, degree_ + first.degree_, first.source_, target_);
  for (int p = 0; p < static_cast<int>(first.source_.size()); ++p) {
    result.set(p, at(p + first.degree_) * first.at(p));
  }
  return result;
}

template <Ring R>
bool GradedMap<R>::equals(const GradedMap& other) const {
  return ring_ == other.ring_ && degree_ == other.degree_ && source_ == other.source_ && target_ == other.target_ &&
         parts_ == other.parts_;
}

template <Ring R>
std::optional<Place> first_difference(const GradedMap<R>& a, const GradedMap<R>& b) {
  sparse::expects(a.degree() == b.degree() && a.source() == b.source() && a.target() == b.target(),
                  "only graded maps of the same degree between the same modules can be compared place by place");
  for (int p = 0; p < static_cast<int>(a.source().size()); ++p) {
    if (const auto place = sparse::first_difference(a.at(p), b.at(p))) {
      return Place{p, place->row, place->column};
    }
  }
  return std::nullopt;
}

template <Ring R>
GradedMap<R> differential(const ChainComplex<R>& complex) {
  return GradedMap<R>(complex.ring(), -1, complex.sizes(), complex.sizes(), complex.boundaries());
}

template <Ring R>
ChainComplex<R> complex_with(const GradedMap<R>& differential) {
  sparse::expects(differential.degree() == -1 && differential.source() == differential.target(),
                  "a differential has degree -1 and goes from a module to itself");
  std::vector<Matrix<R>> boundaries;
  for (int p = 0; p < static_cast<int>(differential.source().size()); ++p) {
    boundaries.push_back(differential.at(p));
  }
  return ChainComplex<R>(differential.ring(), differential.source(), std::move(boundaries));
}

template <Ring R>
GradedMap<R> identity_of(const ChainComplex<R>& complex) {
  return GradedMap<R>::identity(complex.ring(), complex.sizes());
}

template <Ring R>
GradedMap<R> commutator(const GradedMap<R>& phi, const ChainComplex<R>& source, const ChainComplex<R>& target) {
  return differential(target) * phi - phi * differential(source);
}

Sizes sum(const Sizes& a, const Sizes& b) {
  Sizes result(std::max(a.size(), b.size()), 0);
  for (std::size_t p = 0; p < result.size(); ++p) {
    const std::uint64_t size = std::uint64_t{size_at(a, static_cast<int>(p))} + size_at(b, static_cast<int>(p));
    sparse::expects(size <= ~Index{0}, "direct sum: more than 2^32 - 1 generators in one degree");
    result[p] = static_cast<Index>(size);
  }
  return result;
}

template <Ring R>
GradedMap<R> block_map(const GradedMap<R>& a, const GradedMap<R>& b, const GradedMap<R>& c, const GradedMap<R>& d) {
  sparse::expects(a.degree() == b.degree() && a.degree() == c.degree() && a.degree() == d.degree(),
                  "the blocks of a graded map have one degree");
  sparse::expects(
      a.source() == c.source() && b.source() == d.source() && a.target() == b.target() && c.target() == d.target(),
      "the blocks of a graded map share the source of their column and the target of their row");
  Sizes source = sum(a.source(), b.source());
  Sizes target = sum(a.target(), c.target());
  std::vector<Matrix<R>> parts;
  for (int p = 0; p < static_cast<int>(source.size()); ++p) {
    parts.push_back(sparse::blocks(a.at(p), b.at(p), c.at(p), d.at(p)));
  }
  return GradedMap<R>(a.ring(), a.degree(), std::move(source), std::move(target), std::move(parts));
}

template <Ring R>
GradedMap<R> diagonal(const GradedMap<R>& a, const GradedMap<R>& d) {
  return block_map(a, GradedMap<R>::zero(a.ring(), a.degree(), d.source(), a.target()),
                   GradedMap<R>::zero(a.ring(), a.degree(), a.source(), d.target()), d);
}

template <Ring R>
GradedMap<R> beside(const GradedMap<R>& a, const GradedMap<R>& b) {
  return block_map(a, b, GradedMap<R>::zero(a.ring(), a.degree(), a.source(), {}),
                   GradedMap<R>::zero(b.ring(), b.degree(), b.source(), {}));
}

template <Ring R>
GradedMap<R> stacked(const GradedMap<R>& a, const GradedMap<R>& c) {
  return block_map(a, GradedMap<R>::zero(a.ring(), a.degree(), {}, a.target()), c,
                   GradedMap<R>::zero(c.ring(), c.degree(), {}, c.target()));
}

#define SESAME_INSTANTIATE(R)                                                                                          \
  template class GradedMap<R>;                                                                                         \
  template std::optional<Place> first_difference(const GradedMap<R>&, const GradedMap<R>&);                            \
  template GradedMap<R> differential(const ChainComplex<R>&);                                                          \
  template ChainComplex<R> complex_with(const GradedMap<R>&);                                                          \
  template GradedMap<R> identity_of(const ChainComplex<R>&);                                                           \
  template GradedMap<R> commutator(const GradedMap<R>&, const ChainComplex<R>&, const ChainComplex<R>&);               \
  template GradedMap<R> block_map(const GradedMap<R>&, const GradedMap<R>&, const GradedMap<R>&, const GradedMap<R>&); \
  template GradedMap<R> diagonal(const GradedMap<R>&, const GradedMap<R>&);                                            \
  template GradedMap<R> beside(const GradedMap<R>&, const GradedMap<R>&);                                              \
  template GradedMap<R> stacked(const GradedMap<R>&, const GradedMap<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions
