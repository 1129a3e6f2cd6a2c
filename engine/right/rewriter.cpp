#include "engine/right/rewriter.hpp"

#include <utility>

namespace sesame::engine {

template <Ring R>
Rewriter<R>::Rewriter(R ring, const sparse::ColumnStore<R, GeneratorId>& boundary)
    : boundary_{boundary},
      rules_{ring},
      perturbations_{ring, rules_},
      lifts_{ring, boundary, rules_, perturbations_, effort_},
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

template <Ring R>
void Rewriter<R>::perturb(RuleId time, GeneratorId first, std::span<const GeneratorId> changed) {
  ++breaks_;
  const Symbol first_symbol = rules_.symbol_of(first);
  const auto concerned = perturbations_.record(time, first_symbol, changed);
  for (const std::size_t k : concerned.combinations) {
    const auto& combination = rules_.combinations()[k];
    perturbations_.extend_column(k, lifts_.gain(combination.made, combination.rule + 1, first_symbol));
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
  memos_.undo(mark.memos);
}

#define SESAME_INSTANTIATE(R) template class Rewriter<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
