#include "reductions/eilenberg_zilber.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "sparse/contract.hpp"

namespace sesame::reductions {

namespace {

using sparse::expects;

/// The values from, from + 1, ..., to.
Vertices range(int from, int to) {
  Vertices values(static_cast<std::size_t>(to - from + 1));
  std::iota(values.begin(), values.end(), static_cast<std::uint8_t>(from));
  return values;
}

/// The map of [m + j + 1] that is 0, ..., j on its first j + 1 vertices, then goes through `tail`: [m] -> ... + shift.
Vertices after_range(int j, const Vertices& tail, int shift) {
  Vertices values = range(0, j);
  values.reserve(values.size() + tail.size());
  std::transform(tail.begin(), tail.end(), std::back_inserter(values),
                 [shift](std::uint8_t v) { return static_cast<std::uint8_t>(v + shift); });
  return values;
}

/// The term of g for one order of the steps.
SignedPair shuffle(const std::vector<bool>& step_is_of_y) {
  SignedPair term{1, {0}, {0}};
  int sign_of_step_of_x = 1;  // the steps of y that it passes on its way to the front
  for (const bool is_of_y : step_is_of_y) {
    const std::uint8_t x = term.first.back();
    const std::uint8_t y = term.second.back();
    if (is_of_y) {
      sign_of_step_of_x = -sign_of_step_of_x;
    } else {
      term.sign *= sign_of_step_of_x;
    }
    term.first.push_back(static_cast<std::uint8_t>(is_of_y ? x : x + 1));
    term.second.push_back(static_cast<std::uint8_t>(is_of_y ? y + 1 : y));
  }
  return term;
}

}  // namespace

std::vector<FrontAndBack> alexander_whitney(int n) {
  expects(0 <= n && n <= max_simplex_dimension, "alexander_whitney: a dimension from 0 to max_simplex_dimension");
  std::vector<FrontAndBack> terms;
  terms.reserve(static_cast<std::size_t>(n) + 1);
  for (int k = 0; k <= n; ++k) {
    terms.push_back({range(0, k), range(k, n)});
  }
  return terms;
}

std::vector<SignedPair> shuffles(int p, int q) {
  expects(p >= 0 && q >= 0 && p <= max_simplex_dimension - q,
          "shuffles: dimensions from 0 on, together at most max_simplex_dimension");
  std::vector<SignedPair> terms;
  std::vector<bool> step_is_of_y(static_cast<std::size_t>(p), false);
  step_is_of_y.insert(step_is_of_y.end(), static_cast<std::size_t>(q), true);
  do {
    terms.push_back(shuffle(step_is_of_y));
  } while (std::next_permutation(step_is_of_y.begin(), step_is_of_y.end()));
  return terms;
}

std::vector<SignedPair> shih(int n) {
  expects(0 <= n && n < max_simplex_dimension, "shih: a dimension from 0 to below max_simplex_dimension");
  std::vector<SignedPair> terms;
  // On pairs of maps, the ' of the recursion puts a vertex 0 in front and raises the others by one; ' and then s_0 only
  // puts a 0 in front. So the terms of g f for dimension n - j enter after 0, ..., j, raised by j. Those with k = 0
  // begin with j in both maps, and so collapse the step from the j before it: degenerate, and left out.
  for (int j = 0; j < n; ++j) {
    const int sign = j % 2 == 0 ? -1 : 1;
    for (int k = 1; k <= n - j; ++k) {
      for (const SignedPair& term : shuffles(k, n - j - k)) {
        terms.push_back({sign * term.sign, after_range(j, term.first, j), after_range(j, term.second, j + k)});
      }
    }
  }
  return terms;
}

const std::vector<SignedPair>& EilenbergZilberTerms::shuffles(int p, int q) {
  auto found = shuffles_.find({p, q});
  if (found == shuffles_.end()) {
    found = shuffles_.emplace(std::pair{p, q}, reductions::shuffles(p, q)).first;
  }
  return found->second;
}

const std::vector<SignedPair>& EilenbergZilberTerms::shih(int n) {
  auto found = shih_.find(n);
  if (found == shih_.end()) {
    found = shih_.emplace(n, reductions::shih(n)).first;
  }
  return found->second;
}

}  // namespace sesame::reductions
