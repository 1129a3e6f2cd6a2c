/// \file
/// What rewriting costs, counted, and a limit to it.
#pragma once

#include <cstdint>

#include "engine/right/symbol.hpp"

namespace sesame::engine {

/// Thrown by work that has come to cost more than it was given: not an error, but a way out of nested work whose
/// results are worth less than a fresh start.
struct OverBudget {};

/// Counts terms that are read, and what else is worth counting, in words of coefficients. Only grows.
class Effort {
 public:
  void read(std::uint64_t terms) { terms_read_ += terms; }
  /// Of traces and of the core; what large coefficients cost.
  void spend(std::uint64_t words) { other_ += words; }
  [[nodiscard]] std::uint64_t terms_read() const { return terms_read_; }

  /// From now on work may cost this much; `check` throws OverBudget when it has come to cost more.
  void set_budget(std::uint64_t more) { limit_ = more < UINT64_MAX - total() ? total() + more : UINT64_MAX; }
  void check() const {
    if (total() > limit_) [[unlikely]] {
      throw OverBudget{};
    }
  }

 private:
  [[nodiscard]] std::uint64_t total() const { return terms_read_ + other_; }

  std::uint64_t terms_read_ = 0, other_ = 0;
  std::uint64_t limit_ = UINT64_MAX;
};

/// The words that a coefficient is held in: what arithmetic on it costs.
template <class Element>
[[nodiscard]] std::uint64_t words(const Element& coefficient) {
  if constexpr (requires { coefficient.words(); }) {
    return coefficient.words();
  }
  return 1;
}
/// Of Terms or RawTerms.
template <class Vector>
[[nodiscard]] std::uint64_t words_of(const Vector& terms) {
  std::uint64_t sum = 0;
  for (const auto& term : terms) {
    sum += words(term.coefficient);
  }
  return sum;
}

}  // namespace sesame::engine
