/// \file
/// Maps and complexes by what they do to each generator, where generators have ids of their own.
#pragma once

#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "reductions/graded_map.hpp"

namespace sesame::reductions {

/// The generators of a graded module, by ids that someone else gave them: generators()[p][k] is generator k of degree
/// p.
template <class Id>
class Basis {
 public:
  /// Requires: the id is not there yet.
  void add(int degree, Id id) {
    const auto p = static_cast<std::size_t>(degree);
    if (p >= generators_.size()) {
      generators_.resize(p + 1);
    }
    index_.emplace(id, static_cast<Index>(generators_[p].size()));
    generators_[p].push_back(id);
  }
  [[nodiscard]] const std::vector<std::vector<Id>>& generators() const { return generators_; }
  /// Those of one degree; none where there are none.
  [[nodiscard]] const std::vector<Id>& generators(std::size_t degree) const {
    static const std::vector<Id> none;
    return degree < generators_.size() ? generators_[degree] : none;
  }
  /// Where a generator stands in its degree. Requires: it is there.
  [[nodiscard]] Index index(Id id) const { return index_.at(id); }
  [[nodiscard]] bool contains(Id id) const { return index_.contains(id); }
  [[nodiscard]] Sizes sizes() const {
    Sizes sizes;
    for (const auto& generators : generators_) {
      sizes.push_back(static_cast<Index>(generators.size()));
    }
    return sizes;
  }

 private:
  std::vector<std::vector<Id>> generators_;
  std::unordered_map<Id, Index> index_;
};

/// A chain in the ids of a basis as one in its generators.
template <Ring R, class Id>
[[nodiscard]] Terms<R> in_basis(const R& ring, const Basis<Id>& basis,
                                const std::type_identity_t<RawTerms<R, Id>>& chain) {
  RawTerms<R> sum;
  for (const Term<R, Id>& term : chain) {
    sum.push_back({basis.index(term.index), term.coefficient});
  }
  return std::move(sum).normal(ring);
}

/// The map of this degree that sends each generator of the source to column(id), Terms or RawTerms in ids of the
/// target. Cost: the columns, sorted.
template <Ring R, class From, class To, class Column>
[[nodiscard]] GradedMap<R> map_by_columns(const R& ring, int degree, const Basis<From>& source, const Basis<To>& target,
                                          const Column& column) {
  const Sizes to = target.sizes();
  std::vector<Matrix<R>> parts;
  for (std::size_t p = 0; p < source.generators().size(); ++p) {
    Matrix<R>& part = parts.emplace_back(ring, size_at(to, static_cast<int>(p) + degree), Index{0});
    for (const From id : source.generators(p)) {
      part.append_column(in_basis<R>(ring, target, column(id)));
    }
  }
  return GradedMap<R>(ring, degree, source.sizes(), to, std::move(parts));
}

/// The map of degree 0 that does so with some generators of the source and is zero or the identity on the others.
/// Cost: those columns.
template <Ring R, class From, class To, class Column>
[[nodiscard]] GradedMap<R> map_by_columns(const R& ring, const Basis<From>& source, const Basis<To>& target, Rest rest,
                                          const Basis<From>& some, const Column& column) {
  const Sizes from = source.sizes();
  const Sizes to = target.sizes();
  std::vector<Matrix<R>> parts;
  for (std::size_t p = 0; p < from.size(); ++p) {
    Matrix<R>& part = parts.emplace_back(ring, size_at(to, static_cast<int>(p)), from[p], rest);
    for (const From id : some.generators(p)) {
      part.set_column(source.index(id), in_basis<R>(ring, target, column(id)));
    }
  }
  return GradedMap<R>(ring, 0, from, to, std::move(parts));
}

/// The complex in which the boundary of a generator is column(id).
template <Ring R, class Id, class Column>
[[nodiscard]] ChainComplex<R> complex_by_columns(const R& ring, const Basis<Id>& basis, const Column& column) {
  const Sizes sizes = basis.sizes();
  std::vector<Matrix<R>> boundaries;
  for (std::size_t p = 0; p < sizes.size(); ++p) {
    Matrix<R>& boundary = boundaries.emplace_back(ring, size_at(sizes, static_cast<int>(p) - 1), Index{0});
    for (const Id id : basis.generators(p)) {
      boundary.append_column(in_basis<R>(ring, basis, column(id)));
    }
  }
  return ChainComplex<R>(ring, sizes, std::move(boundaries));
}

}  // namespace sesame::reductions
