/// \file
/// Lifts that are worked out without some deletions, and corrected for them afterwards.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <queue>
#include <unordered_map>
#include <vector>

#include "engine/right/correctable_deletions.hpp"
#include "engine/right/effort.hpp"
#include "engine/right/known_lifts.hpp"
#include "engine/right/lifts.hpp"
#include "engine/right/rules.hpp"
#include "sparse/column_store.hpp"

namespace sesame::engine {

/// To work a lift out, rules need not take in the deletions that can be corrected for, with all rules that they depend
/// on: V'(x) is what a rewriting that knows nothing of those comes to, and
///
///   V(x) = V'(x) - sum c_k V(z_k),    delta_k(V(x)) = 0 for each of these deletions k,
///
/// where z_k is the cycle that was eliminated with e_k, at a time when its lift had none of the earlier e in its
/// boundary. So c_k = delta_k(what there is so far) / delta_k(V(z_k)), the oldest k first.
///
/// Source: engine/LIVE_FORM.md.
template <Ring R>
class CorrectedLifts {
 public:
  using Element = typename R::Element;
  using TermOfB = sparse::Term<R, GeneratorId>;

  /// A multiple of a lift that is known, to which deletions before `from` have nothing to add.
  struct Base {
    Symbol x;
    Element factor;
    std::size_t from;
  };
  /// terms + more + base.
  struct Sum {
    Terms<R, GeneratorId> terms;
    std::unordered_map<GeneratorId, Element> more;
    std::optional<Base> base;
  };

  /// All of them must outlive it.
  CorrectedLifts(R ring, const sparse::ColumnStore<R, GeneratorId>& boundary, const Rules<R>& rules, Lifts<R>& lifts,
                 Effort& effort, KnownLifts<R>& known, const CorrectableDeletions& deletions)
      : ring_{ring},
        boundary_{boundary},
        rules_{rules},
        lifts_{lifts},
        effort_{effort},
        known_{known},
        deletions_{deletions} {}

  /// V(x) now, while a deletion is at hand whose generator is `last`. Nothing: that would go too deep.
  /// Cost: that of the lift without corrections, and for each of these those of the lifts that have to be added up.
  [[nodiscard]] std::optional<Sum> lift(Symbol x, Symbol last) {
    last_ = last;
    return work_out(x, rules_.size(), deletions_.of_degree(degree()).size(), 0);
  }
  /// All of a sum but the base.
  [[nodiscard]] Terms<R, GeneratorId> explicit_part(Sum sum) const;

 private:
  static constexpr int deepest = 100;  ///< lifts that are worked out within one another
  /// Deletions by their places, the oldest first.
  using Queue = std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>>;

  [[nodiscard]] int degree() const { return rules_.degree(last_); }
  [[nodiscard]] std::optional<Sum> work_out(Symbol x, RuleId time, std::size_t deletions, int depth);
  bool correct(Sum& sum, std::size_t deletions, int depth);
  void enqueue(GeneratorId generator, std::size_t from, Queue& queue) const;
  void add(Sum& sum, const Element& factor, const Terms<R, GeneratorId>& terms) const;
  bool add_known(Sum& sum, const Base& more);
  [[nodiscard]] Element coefficient(const Sum& sum, GeneratorId generator) const;
  void move_base(Sum& sum, Symbol z, std::size_t k, Queue& queue);
  [[nodiscard]] Element excess_of(const Sum& sum, const CorrectableDeletions::Deletion& deletion, RuleId rule);

  R ring_;
  const sparse::ColumnStore<R, GeneratorId>& boundary_;
  const Rules<R>& rules_;
  Lifts<R>& lifts_;
  Effort& effort_;
  KnownLifts<R>& known_;
  const CorrectableDeletions& deletions_;
  Symbol last_{};
};

}  // namespace sesame::engine
