#include "engine/right/rewriter.hpp"

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::engine {

using sparse::expects;

template <Ring R>
Rewriter<R>::Rewriter(R ring, const sparse::ColumnStore<R, GeneratorId>& boundary)
    : boundary_{boundary},
      rules_{ring},
      perturbations_{ring, rules_},
      dependents_{boundary, rules_, perturbations_},
      lifts_{ring, boundary, rules_, perturbations_, dependents_, effort_},
      memos_{ring, rules_, perturbations_, lifts_, effort_},
      settling_{ring, rules_, effort_},
      deletion_gains_{ring, boundary, rules_, settling_.core(), lifts_, effort_} {}

template <Ring R>
void Rewriter<R>::append(int degree) {
  const Symbol x = rules_.append_generator(degree);
  deletion_gains_.append(rules_.generator_in(x));
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

namespace {

constexpr const char* sound_record = "a record is one of eliminations of generators";

/// Reads the columns of a record, one after the other.
template <Ring R>
class RecordedColumns {
 public:
  RecordedColumns(const R& ring, const EliminationRecord& record) : ring_{ring}, record_{record} {
    expects(record.index.size() == record.coefficient.size(), sound_record);
  }
  /// Requires, and checks: it is in normal form, and all its symbols may be in it.
  template <class MayBe>
  void next(std::uint32_t terms, MayBe may_be, Terms<R, Symbol>& out) {
    expects(terms <= record_.index.size() - at_, sound_record);
    out.clear();
    for (const std::size_t end = at_ + terms; at_ < end; ++at_) {
      const Symbol x{record_.index[at_]};
      expects((out.empty() || out.back().index < x) && may_be(x), sound_record);
      out.push_back({x, ring_.from(std::int64_t{record_.coefficient[at_]})});
      expects(!ring_.is_zero(out.back().coefficient), sound_record);
    }
  }
  [[nodiscard]] bool is_at_end() const { return at_ == record_.index.size(); }

 private:
  const R& ring_;
  const EliminationRecord& record_;
  std::size_t at_ = 0;
};

/// Appends a term to a record. False when its coefficient is not small.
template <Ring R>
bool add_to(EliminationRecord& record, const R& ring, Symbol x, const typename R::Element& coefficient) {
  if constexpr (std::same_as<typename R::Element, sparse::Rational>) {
    if (!coefficient.is_integer()) {
      return false;
    }
  }
  const auto word = ring.to_integer(coefficient).to_int64();
  if (!word || *word < INT32_MIN || *word > INT32_MAX) {
    return false;
  }
  record.index.push_back(x);
  record.coefficient.push_back(static_cast<std::int32_t>(*word));
  return true;
}

}  // namespace

template <Ring R>
void Rewriter<R>::append_recorded(std::span<const int> degrees, const EliminationRecord& record) {
  const R ring = memos_.ring();
  RecordedColumns<R> columns(ring, record);
  const auto may_be_in_boundary_of = [this](Symbol b) {
    expects(b < rules_.next_symbol() && rules_.removed_by(b) == no_rule, sound_record);
    return [this, b](Symbol x) {
      return x < rules_.next_symbol() && rules_.degree(x) + 1 == rules_.degree(b) && rules_.removed_by(x) == no_rule;
    };
  };
  auto next = record.eliminations.begin();
  for (std::uint32_t generators = 0; generators <= degrees.size(); ++generators) {
    for (; next != record.eliminations.end() && next->generators == generators; ++next) {
      const Symbol a{next->a}, b{next->b};
      columns.next(next->terms, may_be_in_boundary_of(b), column_);
      const TermType* unit = sparse::find_term<R>(column_, a);
      expects(unit != nullptr && ring.is_unit(unit->coefficient), sound_record);
      rules_.eliminate(a, b, column_);
    }
    if (generators < degrees.size()) {
      rules_.append_generator(degrees[generators]);
    }
  }
  expects(next == record.eliminations.end(), sound_record);
  expects(!R::is_field || record.core.empty(), sound_record);
  for (const EliminationRecord::Column& each : record.core) {
    const Symbol x{each.x};
    columns.next(each.terms, may_be_in_boundary_of(x), column_);
    expects(!column_.empty() && core().find(x) == nullptr, sound_record);
    settling_.restore(x, column_, each.owns_pivot != 0);
  }
  expects(columns.is_at_end(), sound_record);
}

template <Ring R>
std::optional<EliminationRecord> Rewriter<R>::record() const {
  if (!rules_.combinations().empty() || breaks_ != 0 || perturbations_.version() != 0) {
    return std::nullopt;
  }
  const R ring = memos_.ring();
  EliminationRecord record;
  std::uint32_t generators = 0;
  for (RuleId rule = 0; rule < rules_.size(); ++rule) {
    const auto& [a, b, inverse, begin, size] = rules_[rule];
    while (generators < rules_.next_symbol() && rules_.born(Symbol{generators}) <= rule) {
      ++generators;
    }
    record.eliminations.push_back({a, b, generators, size + 1});
    const typename R::Element unit = ring.inverse(inverse);
    const typename R::Element minus_unit = ring.negate(unit);
    bool is_told = false, is_small = true;
    for (const TermType& term : rules_.value(rule)) {
      if (!is_told && term.index > a) {
        is_told = true;
        is_small = is_small && add_to<R>(record, ring, a, unit);
      }
      is_small = is_small && add_to<R>(record, ring, term.index, ring.multiply(minus_unit, term.coefficient));
    }
    if (!(is_small && (is_told || add_to<R>(record, ring, a, unit)))) {
      return std::nullopt;
    }
  }
  for (const auto& [x, column] : core().columns()) {
    const bool owns_pivot = core().pivot_owner(column.back().index) == x;
    record.core.push_back({x, owns_pivot ? 1U : 0U, static_cast<std::uint32_t>(column.size())});
    for (const TermType& term : column) {
      if (!add_to<R>(record, ring, term.index, term.coefficient)) {
        return std::nullopt;
      }
    }
  }
  return record;
}

/// Takes note that the boundaries of some generators have gained terms in symbols from `first` on.
template <Ring R>
void Rewriter<R>::extend_dependents(std::span<const GeneratorId> changed, Symbol first) {
  if (!dependents_.is_kept()) {
    return;
  }
  for (const GeneratorId generator : changed) {
    boundary_.for_each_in_column(generator, [&](const sparse::Term<R, GeneratorId>& term) {
      if (const Symbol z = rules_.symbol_of(term.index); z >= first) {
        dependents_.gain_boundary(z, rules_.symbol_of(generator));
      }
    });
  }
}

/// How many small symbols there are of the degrees of the changed generators.
template <Ring R>
std::uint64_t Rewriter<R>::candidates(std::span<const GeneratorId> changed) const {
  static_assert(ops::largest_dimension + 1 < 64);
  std::uint64_t degrees = 0;  // a bit each
  std::uint64_t candidates = 0;
  for (const GeneratorId generator : changed) {
    const int degree = rules_.degree(rules_.symbol_of(generator));
    candidates += (degrees >> degree & 1U) != 0 ? 0 : small_counts()[static_cast<std::size_t>(degree)];
    degrees |= std::uint64_t{1} << degree;
  }
  return candidates;
}

/// The symbols whose lifts may have one of the changed generators, found by the index of dependents; nothing when
/// looking at all small symbols is cheaper than finding them, or than making the index.
template <Ring R>
typename Perturbations<R>::Reached Rewriter<R>::lifts_with(std::span<const GeneratorId> changed) {
  const std::uint64_t candidates = this->candidates(changed);
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

/// Takes note of a perturbation. What it does to the columns of combinations is done.
template <Ring R>
typename Perturbations<R>::Concerned Rewriter<R>::record_perturbation(RuleId time, Symbol first_symbol,
                                                                      std::span<const GeneratorId> changed,
                                                                      const Reached& reached, bool is_deletion) {
  auto concerned = perturbations_.record(time, first_symbol, changed, reached, is_deletion);
  for (const std::size_t k : concerned.combinations) {
    const auto& combination = rules_.combinations()[k];
    const Terms<R, Symbol> gain = lifts_.gain(combination.made, combination.rule + 1, first_symbol);
    perturbations_.extend_column(k, gain);
    for (const TermType& term : gain) {
      dependents_.gain_boundary(term.index, combination.made);
    }
  }
  return concerned;
}

/// The boundary of a small symbol has this more.
template <Ring R>
void Rewriter<R>::extend_column_of(Symbol x, const Terms<R, Symbol>& gain) {
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

template <Ring R>
void Rewriter<R>::perturb(RuleId time, GeneratorId first, std::span<const GeneratorId> changed) {
  ++breaks_;
  deletion_gains_.clear();
  const Symbol first_symbol = rules_.symbol_of(first);
  extend_dependents(changed, first_symbol);
  for (const Symbol x : record_perturbation(time, first_symbol, changed, lifts_with(changed), false).small) {
    if (rules_.removed_by(x) == no_rule) {  // else another one was eliminated with it since
      extend_column_of(x, lifts_.gain(x, rules_.size(), first_symbol));
    }
  }
  settling_.settle();
}

/// The boundaries of small symbols gain multiples of e. Returns whether a column of the core is another one then: not
/// when a cycle is eliminated with e, of which the others gain nothing then. Else all gain what they do before any is
/// settled, for the moves of that need to know their boundaries.
template <Ring R>
bool Rewriter<R>::settle_gains(Symbol e) {
  const std::vector<TermType> gained = deletion_gains_.gained();
  const auto cycle = std::find_if(gained.begin(), gained.end(), [this](const TermType& gain) {
    return memos_.ring().is_unit(gain.coefficient) && core().find(gain.index) == nullptr;
  });
  if (cycle != gained.end()) {
    extend_column_of(cycle->index, {{e, cycle->coefficient}});
  } else {
    for (const TermType& gain : gained) {
      extend_column_of(gain.index, {{e, gain.coefficient}});
    }
  }
  settling_.settle();
  return cycle == gained.end() && !gained.empty();
}

/// Whether searches for the lifts that have the generators of deletions have cost as much as looking at all small
/// symbols of their degree, from which on it is known.
template <Ring R>
bool Rewriter<R>::is_index_worth_it(std::span<const GeneratorId> changed) const {
  return searched_ > terms_of_a_lift * candidates(changed);
}

template <Ring R>
void Rewriter<R>::take_away(RuleId time, GeneratorId deletion, std::span<const GeneratorId> changed) {
  const Symbol e = rules_.symbol_of(deletion);
  perturbations_.expect(e);  // lifts are worked out before it is recorded
  extend_dependents(changed, e);
  deletion_gains_.begin(deletion, changed);
  const bool has_combinations = !rules_.combinations().empty();  // they would have to be found, too
  Reached reached = has_combinations ? std::nullopt : deletion_gains_.small_with();
  if (!reached && (has_combinations || !is_index_worth_it(changed))) {
    const std::uint64_t before = dependents_.looked_at();
    reached = lifts_with(changed);
    searched_ += dependents_.looked_at() - before;
  }
  const auto concerned = record_perturbation(time, e, changed, reached, true);
  const RuleId since = rules_.size();
  if (!reached && !has_combinations && perturbations_.last_concerns_rules() && candidates(changed) > few) {
    deletion_gains_.begin_index();
    searched_ = 0;
  }
  for (const Symbol x : concerned.small) {
    if (x != e && rules_.removed_by(x) == no_rule) {
      deletion_gains_.add(x);
    }
  }
  const bool changes_columns = settle_gains(e) || !concerned.combinations.empty();
  breaks_ += changes_columns ? 1 : 0;  // else they change only where the b of a rule goes
  perturbations_.forget_those_not_felt();
  deletion_gains_.finish(since, perturbations_.last_concerns_rules());
}

template <Ring R>
void Rewriter<R>::consume(std::span<const Symbol> symbols) {
  ++breaks_;
  deletion_gains_.clear();
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
  deletion_gains_.clear();
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
