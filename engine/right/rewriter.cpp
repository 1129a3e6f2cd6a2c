#include "engine/right/rewriter.hpp"

#include <utility>

namespace sesame::engine {

template <Ring R>
Rewriter<R>::Rewriter(R ring, const sparse::ColumnStore<R, GeneratorId>& boundary)
    : boundary_{boundary},
      rules_{ring},
      perturbations_{ring, rules_},
      dependents_{boundary, rules_, perturbations_},
      lifts_{ring, boundary, rules_, perturbations_, dependents_, effort_},
      memos_{ring, rules_, perturbations_, lifts_, effort_},
      settling_{ring, rules_, effort_} {}

template <Ring R>
void Rewriter<R>::append(int degree) {
  const Symbol x = rules_.append_generator(degree);
  memos_.rewrite(
      [this, generator = rules_.generator_in(x)](auto visit) {
        boundary_.for_each_in_column(
            generator, [&](const TermOfB& term) { visit(rules_.symbol_of(term.index), term.coefficient); });
      },
      column_);
  if (!column_.empty()) {
    settling_.place(x, column_);
    settling_.settle();
  }
}

/// The symbols whose lifts may have one of the changed generators, found by the index of dependents; nothing when
/// looking at all small symbols is cheaper than finding them, or than making the index.
template <Ring R>
typename Perturbations<R>::Reached Rewriter<R>::lifts_with(std::span<const GeneratorId> changed, Symbol first) {
  constexpr std::uint64_t terms_of_a_lift = 16;  // that are read for a small symbol, at least
  constexpr std::uint64_t few = 4;               // small symbols: not worth a search
  static_assert(ops::largest_dimension + 1 < 64);
  std::uint64_t degrees = 0;  // a bit each
  std::uint64_t candidates = 0;
  for (const GeneratorId generator : changed) {
    const int degree = rules_.degree(rules_.symbol_of(generator));
    candidates += (degrees >> degree & 1U) != 0 ? 0 : small_counts()[static_cast<std::size_t>(degree)];
    degrees |= std::uint64_t{1} << degree;
  }
  if (dependents_.is_kept()) {
    for (const GeneratorId generator : changed) {
      boundary_.for_each_in_column(generator, [&](const sparse::Term<R, GeneratorId>& term) {
        if (const Symbol z = rules_.symbol_of(term.index); z >= first) {
          dependents_.gain_boundary(z, rules_.symbol_of(generator));
        }
      });
    }
  }
  if (candidates <= few) {
    return std::nullopt;
  }
  looked_at_ += candidates;
  if (!dependents_.is_kept() && terms_of_a_lift * looked_at_ < dependents_.size_of_backlog()) {
    return std::nullopt;
  }
  dependents_.catch_up();
  return dependents_.lifts_with(changed, terms_of_a_lift * (candidates + 1));
}

template <Ring R>
void Rewriter<R>::perturb(RuleId time, GeneratorId first, std::span<const GeneratorId> changed) {
  ++breaks_;
  const Symbol first_symbol = rules_.symbol_of(first);
  const auto concerned = perturbations_.record(time, first_symbol, changed, lifts_with(changed, first_symbol));
  for (const std::size_t k : concerned.combinations) {
    const auto& combination = rules_.combinations()[k];
    const Terms<R, Symbol> gain = lifts_.gain(combination.made, combination.rule + 1, first_symbol);
    perturbations_.extend_column(k, gain);
    for (const TermType& term : gain) {
      dependents_.gain_boundary(term.index, combination.made);
    }
  }
  for (const Symbol x : concerned.small) {
    if (rules_.removed_by(x) != no_rule) {
      continue;  // since: another one was eliminated with it
    }
    const Terms<R, Symbol> gain = lifts_.gain(x, rules_.size(), first_symbol);
    memos_.rewrite(
        [&gain](auto visit) {
          for (const TermType& term : gain) {
            visit(term.index, term.coefficient);
          }
        },
        column_);
    if (!column_.empty()) {
      settling_.extend(x, std::move(column_));
    }
  }
  settling_.settle();
}

template <Ring R>
void Rewriter<R>::consume(std::span<const Symbol> symbols) {
  ++breaks_;
  for (const Symbol x : symbols) {
    settling_.consume(x);
  }
}

template <Ring R>
Terms<R, Symbol> Rewriter<R>::rewrite(std::span<const TermOfB> chain_of_b) {
  Terms<R, Symbol> image;
  memos_.rewrite(
      [&](auto visit) {
        for (const TermOfB& term : chain_of_b) {
          visit(rules_.symbol_of(term.index), term.coefficient);
        }
      },
      image);
  return image;
}

template <Ring R>
void Rewriter<R>::drop_work() {
  memos_.drop_work();
  lifts_.drop_work();
  settling_.drop_work();
}

template <Ring R>
typename Rewriter<R>::Mark Rewriter<R>::mark() {
  memos_.begin_epoch();
  return {rules_.mark(), perturbations_.size(), settling_.mark(), memos_.size()};
}

template <Ring R>
void Rewriter<R>::undo(const Mark& mark) {
  ++breaks_;
  perturbations_.undo(mark.perturbations, mark.rules.rules);
  settling_.undo(mark.core);
  rules_.undo(mark.rules);
  dependents_.undo(mark.rules);
  memos_.undo(mark.memos);
}

#define SESAME_INSTANTIATE(R) template class Rewriter<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
