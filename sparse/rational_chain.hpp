/// \file
/// Chains as they are told to the outside, whatever ring they are over.
#pragma once

#include <vector>

#include "sparse/rational.hpp"

namespace sesame::sparse {

/// A sum of generators of one degree; coefficients are integers but over Q, and in [0, p) over Z/p. Whoever makes one
/// says what its generators are, by their type, and how they are sorted.
template <class Generator>
struct RationalChain {
  struct Term {
    Rational coefficient;
    Generator generator;
    friend bool operator==(const Term&, const Term&) = default;
  };
  int degree = 0;
  std::vector<Term> terms;
  friend bool operator==(const RationalChain&, const RationalChain&) = default;
};

}  // namespace sesame::sparse
