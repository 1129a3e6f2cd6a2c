/// \file
/// Finite formal sums of generators: terms, term vectors, and chains that know their degree.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sparse/contract.hpp"
#include "sparse/degree.hpp"
#include "sparse/ring.hpp"

namespace sesame::sparse {

/// The index of a generator within its degree, or of a row or column of a matrix.
using Index = std::uint32_t;

/// One term of a chain, one entry of a matrix column: `coefficient * generator(index)`. Where the generators have ids
/// of a kind of their own, chains are in these: then a chain of one kind is no chain of another.
template <Ring R, class Id = Index>
struct Term {
  Id index;
  typename R::Element coefficient;
  friend bool operator==(const Term&, const Term&) = default;
};

template <Ring R, class Id>
inline constexpr bool is_relocatable<Term<R, Id>> = is_relocatable<typename R::Element>;

/// Terms sorted by index, without repeats and without zero coefficients: the *normal form* of a sparse vector.
template <Ring R, class Id = Index>
using Terms = std::vector<Term<R, Id>>;

/// A sum that is being collected: terms in any order, perhaps repeated, perhaps zero. A type of its own, so that nobody
/// takes them for `Terms`, which they become at the end.
template <Ring R, class Id = Index>
class RawTerms {
 public:
  using TermType = Term<R, Id>;

  RawTerms() = default;
  RawTerms(std::initializer_list<TermType> terms) : terms_{terms} {}
  /// A vector in normal form is a sum, too.
  RawTerms(Terms<R, Id> terms) : terms_{std::move(terms)} {}  // NOLINT(google-explicit-constructor)

  void push_back(TermType term) { terms_.push_back(std::move(term)); }
  void clear() { terms_.clear(); }
  [[nodiscard]] std::size_t size() const { return terms_.size(); }
  [[nodiscard]] bool empty() const { return terms_.empty(); }
  [[nodiscard]] auto begin() const { return terms_.begin(); }
  [[nodiscard]] auto end() const { return terms_.end(); }

  /// The sum. Cost O(n log n) for n terms, O(n) when they are in order.
  [[nodiscard]] Terms<R, Id> normal(const R& ring) && {
    normalize(ring);
    return std::move(terms_);
  }
  /// The same into `out`; afterwards there are no terms here. Both keep their room for the next time.
  void finish(const R& ring, Terms<R, Id>& out) {
    normalize(ring);
    out.swap(terms_);
    terms_.clear();
  }

 private:
  void normalize(const R& ring);

  std::vector<TermType> terms_;
};

/// The term of a vector in normal form at an index, or null. Cost: the logarithm of its length.
template <Ring R, class Id>
[[nodiscard]] const Term<R, Id>* find_term(const Terms<R, Id>& terms, std::type_identity_t<Id> index) {
  const auto at = std::lower_bound(terms.begin(), terms.end(), index,
                                   [](const Term<R, Id>& term, Id wanted) { return term.index < wanted; });
  return at != terms.end() && at->index == index ? &*at : nullptr;
}

/// into += factor * terms, both in normal form. Cost O(|into| + |terms|).
template <Ring R, class Id>
void add_multiple(const R& ring, Terms<R, Id>& into, const typename R::Element& factor,
                  std::type_identity_t<std::span<const Term<R, Id>>> terms);

/// For people: `e0 - 2 e3`, `0`; `letter` names the generators.
template <Ring R>
[[nodiscard]] std::string to_string(const R& ring, std::span<const Term<R>> terms, std::string_view letter = "e");

/// A chain: a finite formal sum of generators, all of one degree.
template <Ring R>
class Chain {
 public:
  using Element = typename R::Element;

  Chain(R ring, Degree degree) : ring_{ring}, degree_{degree} {}
  Chain(R ring, Degree degree, RawTerms<R> terms)
      : ring_{ring}, degree_{degree}, terms_{std::move(terms).normal(ring_)} {}

  [[nodiscard]] const R& ring() const { return ring_; }
  [[nodiscard]] Degree degree() const { return degree_; }
  [[nodiscard]] const Terms<R>& terms() const { return terms_; }
  [[nodiscard]] bool is_zero() const { return terms_.empty(); }
  /// The coefficient of a generator, zero when absent. Cost O(log terms).
  [[nodiscard]] Element coefficient(Index generator) const;

  /// this += a * generator. Cost O(terms).
  void add(const Element& a, Index generator);
  /// this += a * other. Requires: same degree, same ring.
  void add(const Element& a, const Chain& other);

  friend Chain operator+(Chain a, const Chain& b) {
    a.add(a.ring_.one(), b);
    return a;
  }
  friend Chain operator-(Chain a, const Chain& b) {
    a.add(a.ring_.negate(a.ring_.one()), b);
    return a;
  }
  friend bool operator==(const Chain&, const Chain&) = default;

  /// As the free `to_string` of its terms.
  [[nodiscard]] std::string to_string(std::string_view letter = "e") const;

 private:
  R ring_;
  Degree degree_;
  Terms<R> terms_;
};

}  // namespace sesame::sparse
