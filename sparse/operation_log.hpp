/// \file
/// A change of basis as the list of the operations that made it, applied to vectors when it is needed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sparse/transform.hpp"

namespace sesame::sparse {

/// The lines of a Transform, rows or columns, which are never written out: an elimination of unit pivots logs no more
/// than what it reads, where its transforms would fill up. Applying it to a vector costs the operations logged, or, for
/// coordinates on the one side and combinations on the other, those that meet the vector.
template <Ring R>
class OperationLog {
 public:
  using Element = typename R::Element;

  OperationLog(R ring, Index lines) : ring_{ring}, lines_{lines} {}

  // ---- as a Transform, of which these are the operations
  void add(const R& ring, Index pivot, const Terms<R>& multiples, bool is_last) {
    (void)ring;
    if (!multiples.empty()) {
      log({Kind::add, is_last, pivot, 0}, multiples);
    }
  }
  void scale(const R& ring, Index k, const Element& unit) {
    log({Kind::scale, false, k, 0}, {{0, unit}, {1, ring.inverse(unit)}});
  }
  void combine(const R& ring, Index i, Index j, const TwoByTwo<R>& lines, const TwoByTwo<R>& of_inverse) {
    (void)ring;
    Terms<R> entries;
    for (const TwoByTwo<R>* matrix : {&lines, &of_inverse}) {
      for (const Element& entry : *matrix) {
        entries.push_back({static_cast<Index>(entries.size()), entry});
      }
    }
    log({Kind::combine, false, i, j}, entries);
  }

  /// The sum of c_k times line k. Cost: all operations.
  [[nodiscard]] Terms<R> combination(const Terms<R>& c) const { return taken_back<Of::lines>(c); }
  /// The sum of c_k times line k of the inverse. Cost: the operations, and the multiples of those that meet it.
  [[nodiscard]] Terms<R> combination_of_inverse(const Terms<R>& c) const { return taken_back<Of::inverse>(c); }
  /// The products of v with all lines. Cost: the operations, and the multiples of those that meet it.
  [[nodiscard]] Terms<R> products(const Terms<R>& v) const {
    std::vector<Element> values = dense(v);
    for (std::size_t at = 0; at < operations_.size(); ++at) {
      apply<Of::lines, Order::as_made>(at, values);
    }
    return sparse_of(values);
  }
  /// The products of v with the lines of the inverse, but for those that the last operation of a pivot made: these are
  /// read by no other. Cost: the operations, without these.
  [[nodiscard]] Terms<R> products_with_inverse_but_last(const Terms<R>& v) const {
    std::vector<Element> values = dense(v);
    for (const std::size_t at : not_last_) {
      apply<Of::inverse, Order::as_made>(at, values);
    }
    return sparse_of(values);
  }

 private:
  enum class Kind : std::uint8_t { add, scale, combine };
  struct Operation {
    Kind kind;
    bool is_last;  ///< of its line, but for its scaling
    Index line, other;
    std::size_t end = 0;  ///< of its terms: the multiples; two factors; two matrices
  };

  void log(Operation operation, const Terms<R>& terms) {
    if (!operation.is_last) {
      not_last_.push_back(operations_.size());
    }
    terms_.insert(terms_.end(), terms.begin(), terms.end());
    operation.end = terms_.size();
    operations_.push_back(operation);
  }
  [[nodiscard]] std::size_t begin(std::size_t at) const { return at == 0 ? 0 : operations_[at - 1].end; }

  enum class Of { lines, inverse };
  enum class Order { as_made, reversed };  ///< for products, for combinations: the one is the other transposed

  template <Of of>
  [[nodiscard]] Terms<R> taken_back(const Terms<R>& c) const {
    std::vector<Element> sum = dense(c);
    for (std::size_t at = operations_.size(); at-- > 0;) {
      apply<of, Order::reversed>(at, sum);
    }
    return sparse_of(sum);
  }

  /// A multiple as it was added, no copy, or what takes it back.
  template <Of of>
  [[nodiscard]] decltype(auto) in_sense_of(const Element& multiple) const {
    if constexpr (of == Of::inverse) {
      return ring_.negate(multiple);
    } else {
      return (multiple);
    }
  }
  /// One operation, on the values of all lines.
  template <Of of, Order order>
  void apply(std::size_t at, std::vector<Element>& values) const {
    constexpr bool is_inverse = of == Of::inverse;
    const Operation& operation = operations_[at];
    const Term<R>* terms = terms_.data() + begin(at);
    Element& line = values[operation.line];
    switch (operation.kind) {
      case Kind::add:
        if constexpr (is_inverse == (order == Order::reversed)) {
          spread(in_sense_of<of>(line), at, values);
        } else {
          for (const Term<R>* term = terms; term != terms_.data() + operation.end; ++term) {
            ring_.add_product(line, in_sense_of<of>(term->coefficient), values[term->index]);
          }
        }
        break;
      case Kind::scale:
        line = ring_.multiply(line, terms[is_inverse ? 1 : 0].coefficient);
        break;
      case Kind::combine:
        if constexpr (order == Order::as_made) {
          transform(line, values[operation.other], terms + (is_inverse ? 4 : 0));
        } else {
          transform_back(line, values[operation.other], terms + (is_inverse ? 4 : 0));
        }
        break;
    }
  }
  /// values[k] += a * factor for the multiples k a of an operation, whose own line is none of the k.
  void spread(const Element& factor, std::size_t at, std::vector<Element>& values) const {
    if (!ring_.is_zero(factor)) {
      for (std::size_t k = begin(at); k < operations_[at].end; ++k) {
        ring_.add_product(values[terms_[k].index], terms_[k].coefficient, factor);
      }
    }
  }
  void transform(Element& x, Element& y, const Term<R>* abcd) const {
    const Element first = ring_.add(ring_.multiply(abcd[0].coefficient, x), ring_.multiply(abcd[1].coefficient, y));
    y = ring_.add(ring_.multiply(abcd[2].coefficient, x), ring_.multiply(abcd[3].coefficient, y));
    x = first;
  }
  void transform_back(Element& x, Element& y, const Term<R>* abcd) const {
    const Element first = ring_.add(ring_.multiply(abcd[0].coefficient, x), ring_.multiply(abcd[2].coefficient, y));
    y = ring_.add(ring_.multiply(abcd[1].coefficient, x), ring_.multiply(abcd[3].coefficient, y));
    x = first;
  }

  [[nodiscard]] std::vector<Element> dense(const Terms<R>& terms) const {
    std::vector<Element> values(lines_, ring_.zero());
    for (const Term<R>& term : terms) {
      values[term.index] = term.coefficient;
    }
    return values;
  }
  [[nodiscard]] Terms<R> sparse_of(std::vector<Element>& values) const {
    Terms<R> terms;
    for (Index k = 0; k < lines_; ++k) {
      if (!ring_.is_zero(values[k])) {
        terms.push_back({k, std::move(values[k])});
      }
    }
    return terms;
  }

  R ring_;
  Index lines_;
  std::vector<Operation> operations_;
  std::vector<Term<R>> terms_;         ///< of all operations, one after the other
  std::vector<std::size_t> not_last_;  ///< operations
};

}  // namespace sesame::sparse
