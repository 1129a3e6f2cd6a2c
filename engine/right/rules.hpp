/// \file
/// The symbols of the right reduction, and the rules that write one in later ones.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/right/symbol.hpp"
#include "sparse/growing_array.hpp"

namespace sesame::engine {

/// A rule without its value, which is elsewhere.
template <class Element>
struct RewritingRule {
  Symbol a;
  Symbol b;         ///< no_symbol for a change of basis and for a symbol that was consumed
  Element inverse;  ///< e^-1; unused without b
  std::size_t value_begin;
  std::uint32_t value_size;
};

}  // namespace sesame::engine

namespace sesame::sparse {

template <class Element>
inline constexpr bool is_relocatable<engine::RewritingRule<Element>> = is_relocatable<Element>;

}  // namespace sesame::sparse

namespace sesame::engine {

/// The sequence of elementary reductions that leads from B to the small complex S, as it was made.
///
/// *Symbols* are the generators of B, in order, mixed with those that changes of basis made. A rule says how one symbol
/// is written in symbols that were small then, its *value*; these are eliminated by later rules only, or not at all:
///
///   elimination of (a, b), d b = e a + rest, e a unit:   a -> -e^-1 rest,   b -> 0
///   change of basis x' = x - q y (over Z only):          x -> x' + q y
///   consumption of x:                                    x leaves S, and stays what chains are rewritten to
///
/// A symbol is *small* as long as no rule removes it: the small symbols of a degree are the generators of S.
///
/// Degrees begin at -1: that of what a vertex leaves when it is taken away, which is always eliminated.
///
/// Invariants: a symbol is removed by at most one rule; the symbols of a value are small when the rule is made. Undo
/// takes back rules and symbols in reverse order, so it restores every order and every list.
template <Ring R>
class Rules {
 public:
  using Element = typename R::Element;
  using TermType = sparse::Term<R, Symbol>;

  using Rule = RewritingRule<Element>;
  /// The change of basis `made` = x - q y by a rule; `column` is the boundary of `made` in symbols that were small
  /// then.
  struct Combination {
    Symbol x, y;
    Element q;
    RuleId rule;
    Symbol made;
    Terms<R, Symbol> column;
  };

  explicit Rules(R ring) : ring_{ring} {}

  /// Makes room for generators of B.
  void reserve(std::size_t generators);
  /// The symbol of the next generator of B.
  Symbol append_generator(int degree);
  /// Eliminates a and b, where d b = `column` has a unit at a. Requires: all of them are small.
  RuleId eliminate(Symbol a, Symbol b, const Terms<R, Symbol>& column);
  /// Puts the symbol x' = x - q y, which will be `next_symbol()`, in the place of x; its boundary is `column`.
  RuleId change_basis(Symbol x, const Element& q, Symbol y, Terms<R, Symbol> column);
  /// Takes a small symbol out of S.
  void consume(Symbol x);

  [[nodiscard]] RuleId size() const { return RuleId{rules_.size()}; }
  [[nodiscard]] const Rule& operator[](RuleId rule) const { return rules_[rule]; }
  /// As it was made, in normal form.
  [[nodiscard]] std::span<const TermType> value(RuleId rule) const {
    return {values_.data() + rules_[rule].value_begin, rules_[rule].value_size};
  }
  /// Grows with every rule made and every undo: two equal values mean that nothing changed in between.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// The terms of all rules ever made, undone ones included.
  [[nodiscard]] std::uint64_t terms_made() const { return terms_made_; }

  [[nodiscard]] Symbol next_symbol() const { return Symbol{removed_by_.size()}; }
  [[nodiscard]] int degree(Symbol x) const { return degree_[x]; }
  /// The rule that removed a symbol, as its a or as its b; no_rule when rewriting ends at it: it is small, or consumed.
  [[nodiscard]] RuleId removed_by(Symbol x) const { return removed_by_[x]; }
  /// Whether there is a rule that writes x in other symbols.
  [[nodiscard]] bool is_rewritten(Symbol x) const { return removed_by_[x] != no_rule && rules_[removed_by_[x]].a == x; }
  /// Whether it is a generator of S.
  [[nodiscard]] bool is_small(Symbol x) const {
    const Symbol before = neighbours_[x].before;
    return removed_by_[x] == no_rule && (before == no_symbol ? first_[list_of(x)] : neighbours_[before].after) == x;
  }
  /// The time at which a symbol was made.
  [[nodiscard]] RuleId born(Symbol x) const { return born_[x]; }
  [[nodiscard]] Symbol symbol_of(GeneratorId generator) const { return symbol_of_[generator]; }
  /// The generator of B that a symbol is, or one of those that it is a combination of.
  [[nodiscard]] GeneratorId generator_in(Symbol x) const;
  /// The small symbol that a generator has become by changes of basis; no_symbol: it was eliminated or consumed.
  [[nodiscard]] Symbol small_of(GeneratorId generator) const;
  /// What a symbol is a combination of; nullptr when it is a generator of B.
  [[nodiscard]] const Combination* combination(Symbol x) const {
    return is_combination(x) ? &combinations_[generator_[x] & ~combination_bit] : nullptr;
  }
  /// All of them, in the order in which they were made.
  [[nodiscard]] std::span<const Combination> combinations() const { return combinations_; }
  /// The boundary of a combination gains terms in symbols that are younger than all it has, or loses those in symbols
  /// from `first` on.
  void extend_column(std::size_t combination, const Terms<R, Symbol>& terms);
  void cut_column(std::size_t combination, Symbol first);

  /// The small symbols of a degree, oldest first.
  [[nodiscard]] std::vector<Symbol> small(int degree) const;
  /// Calls visit(x) for those from one on, youngest first.
  template <class Visit>
  void for_each_small_since(int degree, Symbol first, Visit visit) const {
    Symbol x = degree >= 0 && list_of_degree(degree) < last_.size() ? last_[list_of_degree(degree)] : no_symbol;
    for (; x != no_symbol && x >= first; x = neighbours_[x].before) {
      visit(x);
    }
  }
  /// The number of small symbols of each degree from 0 on.
  [[nodiscard]] const std::vector<std::uint32_t>& small_counts() const { return small_counts_; }
  /// Calls visit(a, b) for each elimination, with the two generators of B. Requires: there is no change of basis.
  template <class Visit>
  void for_each_pair(Visit visit) const {
    for (const Rule& rule : rules_) {
      if (rule.b != no_symbol) {
        visit(generator_in(rule.a), generator_in(rule.b));
      }
    }
  }

  /// How many there were at some moment.
  struct Mark {
    Symbol symbols = 0;
    RuleId rules = 0;
  };
  [[nodiscard]] Mark mark() const { return {next_symbol(), size()}; }
  /// Goes back to a mark. Cost: what was done since.
  void undo(const Mark& mark);

 private:
  static constexpr std::uint32_t combination_bit = 0x8000'0000U;  ///< in generator_
  struct Neighbours {
    Symbol before, after;
  };

  [[nodiscard]] bool is_combination(Symbol x) const { return (generator_[x] & combination_bit) != 0; }
  [[nodiscard]] static std::size_t list_of_degree(int degree) { return static_cast<std::size_t>(degree + 1); }
  [[nodiscard]] std::size_t list_of(Symbol x) const { return list_of_degree(degree_[x]); }
  void count_small(Symbol x, int change);
  Symbol add_symbol(int degree, std::uint32_t generator);
  void drop_last_symbol();
  void unlink(Symbol x);
  void relink(Symbol x);
  RuleId push(Symbol a, Symbol b, Element inverse, std::size_t value_begin);
  void pop();

  R ring_;
  // Per symbol.
  sparse::GrowingArray<RuleId> removed_by_;
  sparse::GrowingArray<std::int8_t> degree_;
  sparse::GrowingArray<std::uint32_t> generator_;  ///< of B, or combination_bit | index in combinations_
  sparse::GrowingArray<RuleId> born_;
  sparse::GrowingArray<Neighbours>
      neighbours_;                    ///< small symbols of a degree: a doubly linked list, undone in reverse order
  std::vector<Symbol> first_, last_;  ///< per degree, from -1 on
  std::vector<std::uint32_t> small_counts_;  ///< per degree, from 0 on

  sparse::GrowingArray<Symbol> symbol_of_;  ///< per generator of B
  std::vector<Combination> combinations_;
  sparse::GrowingArray<Rule> rules_;
  sparse::GrowingArray<TermType> values_;  ///< of all rules, one after the other
  std::uint64_t version_ = 1, terms_made_ = 0;
};

}  // namespace sesame::engine
