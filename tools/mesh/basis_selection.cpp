#include "tools/mesh/basis_selection.hpp"

#include <algorithm>

namespace sesame::tools {

namespace {

using sparse::Index;
using sparse::Terms;

/// Whether the entries have no common divisor but units. Over a field: whether there are any.
template <sparse::Ring R>
bool is_primitive(const R& ring, const Terms<R>& vector) {
  if constexpr (R::is_field) {
    return !vector.empty();
  } else {
    sparse::Integer divisor;
    for (const auto& term : vector) {
      divisor = sparse::gcd(divisor, term.coefficient);
      if (ring.is_unit(divisor)) {
        return true;
      }
    }
    return false;
  }
}

}  // namespace

template <sparse::Ring R>
BasisSelection<R>::BasisSelection(R ring, Index rank) : ring_{ring}, missing_{rank}, is_coordinate_(rank, true) {
  for (Index i = 0; i < rank; ++i) {
    images_.push_back({{i, ring_.one()}});
  }
  lifts_ = images_;
}

template <sparse::Ring R>
typename BasisSelection<R>::Vector BasisSelection<R>::image(const Vector& vector) const {
  sparse::RawTerms<R> sum;
  for (const auto& [index, factor] : vector) {
    for (const auto& [coordinate, entry] : images_[index]) {
      sum.push_back({coordinate, ring_.multiply(factor, entry)});
    }
  }
  return std::move(sum).normal(ring_);
}

template <sparse::Ring R>
bool BasisSelection<R>::take(const Vector& vector) {
  Vector taken = image(vector);
  if (!is_primitive(ring_, taken)) {
    return false;
  }
  make_unit(taken);
  const auto pivot = std::find_if(taken.begin(), taken.end(),
                                  [this](const sparse::Term<R>& term) { return ring_.is_unit(term.coefficient); });
  const Index gone = pivot->index;
  const auto inverse = ring_.inverse(pivot->coefficient);
  for (Vector& column : images_) {
    const auto* entry = sparse::find_term<R>(column, gone);
    if (entry == nullptr) {
      continue;
    }
    const auto factor = ring_.negate(ring_.multiply(entry->coefficient, inverse));
    sparse::add_multiple<R>(ring_, column, factor, taken);
  }
  is_coordinate_[gone] = false;
  --missing_;
  return true;
}

/// Euclid's algorithm on the entries of a primitive vector, as changes of basis of the quotient, until one is a unit.
template <sparse::Ring R>
void BasisSelection<R>::make_unit(Vector& image) {
  const auto unit = [this](const sparse::Term<R>& term) { return ring_.is_unit(term.coefficient); };
  if constexpr (!R::is_field) {
    while (std::none_of(image.begin(), image.end(), unit)) {
      const auto least = std::min_element(image.begin(), image.end(), [](const auto& a, const auto& b) {
        return sparse::abs(a.coefficient) < sparse::abs(b.coefficient);
      });
      const Index by = least->index;
      std::vector<Index> others;
      for (const auto& term : image) {
        if (term.index != by) {
          others.push_back(term.index);
        }
      }
      for (const Index reduced : others) {
        change_basis(image, reduced, by);
      }
    }
  }
}

/// The coordinate `reduced` of every image loses q times the coordinate `by`, with q the quotient of the two in
/// `image`.
template <sparse::Ring R>
void BasisSelection<R>::change_basis(Vector& image, Index reduced, Index by) {
  const auto q =
      ring_.quotient(sparse::find_term<R>(image, reduced)->coefficient, sparse::find_term<R>(image, by)->coefficient);
  const auto reduce = [&](Vector& column) {
    const auto* entry = sparse::find_term<R>(column, by);
    if (entry == nullptr) {
      return;
    }
    const Vector change{{reduced, ring_.negate(ring_.multiply(q, entry->coefficient))}};
    sparse::add_multiple<R>(ring_, column, ring_.one(), change);
  };
  for (Vector& column : images_) {
    reduce(column);
  }
  reduce(image);
  sparse::add_multiple<R>(ring_, lifts_[by], q, lifts_[reduced]);
}

template <sparse::Ring R>
std::vector<typename BasisSelection<R>::Vector> BasisSelection<R>::completion() const {
  std::vector<Vector> rest;
  for (Index i = 0; i < is_coordinate_.size(); ++i) {
    if (is_coordinate_[i]) {
      rest.push_back(lifts_[i]);
    }
  }
  return rest;
}

#define SESAME_INSTANTIATE(R) template class BasisSelection<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::tools
