/// \file
/// Where a change of a boundary can be felt: which lifts may have a generator.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/right/perturbations.hpp"
#include "engine/right/rules.hpp"
#include "sparse/column_store.hpp"

namespace sesame::engine {

/// A generator c of B is in the lift V(c); and when c is the b of a rule, in the lift of every symbol whose boundary is
/// rewritten by that rule, or by another one whose b has c in its lift. This is an index for going that way, from a
/// generator to the lifts that may have it, so that nobody has to look at all of S:
///
///   z is in the value of a rule, or in its gain     rewriting what the rule removed comes to z
///   z is in the boundary of x                       lifting x rewrites z
///   z is x or y of a change of basis x' = x - q y   what is in the lift of z is in that of x'
///
/// It is made when it is first needed and then goes along with the rules: histories without de-identifications never
/// have one. What it says may be out of date, where a step was undone or a term has cancelled: it answers with at least
/// all lifts that have the generator, and nothing depends on whether there are others.
template <Ring R>
class Dependents {
 public:
  /// All of them must outlive it.
  Dependents(const sparse::ColumnStore<R, GeneratorId>& boundary, const Rules<R>& rules,
             const Perturbations<R>& perturbations)
      : boundary_{boundary}, rules_{rules}, perturbations_{perturbations} {}

  /// Whether `catch_up` has been called.
  [[nodiscard]] bool is_kept() const { return is_kept_; }
  /// What `catch_up` would read, about.
  [[nodiscard]] std::uint64_t size_of_backlog() const;
  /// Takes in the symbols and rules made since the last time, and what rules have gained.
  /// Cost: what they have in boundaries and values.
  void catch_up();
  /// The boundary of a generator, of a combination, the value of a rule have gained a term in z. Without an index,
  /// nothing.
  void gain_boundary(Symbol z, Symbol x) {
    if (is_kept_) {
      add(z, x, Kind::boundary);
    }
  }
  void gain_value(Symbol z, RuleId rule) {
    if (is_kept_) {
      add(z, rule, Kind::value);
    }
  }

  /// The small symbols, and the combinations that are none any more, whose lifts may have one of some generators, by
  /// increasing number; or nothing, when more than `most` symbols would have to be looked at. Requires: caught up.
  /// Cost: the symbols that depend on the generators, not more than `most`.
  [[nodiscard]] std::optional<std::vector<Symbol>> lifts_with(std::span<const GeneratorId> generators,
                                                              std::uint64_t most);
  /// How many symbols and edges searches have looked at, all of them.
  [[nodiscard]] std::uint64_t looked_at() const { return looked_at_; }

  /// The rules and symbols have been undone to a mark. Cost: amortised, none.
  void undo(const typename Rules<R>::Mark& mark);

 private:
  enum class Kind : std::uint8_t { value, boundary, combination };
  struct Edge {
    Symbol from;
    std::uint32_t to;  ///< a rule for a value, else a symbol
    std::uint32_t previous;
    Kind kind;
  };
  static constexpr std::uint32_t no_edge = UINT32_MAX;

  void add(Symbol from, std::uint32_t to, Kind kind);
  void add_symbol(Symbol x);
  void add_rule(RuleId rule);
  [[nodiscard]] bool is_gone(const Edge& edge, const typename Rules<R>::Mark& mark) const;
  void reach_rewriting(Symbol z);
  void reach_lift(Symbol x);

  const sparse::ColumnStore<R, GeneratorId>& boundary_;
  const Rules<R>& rules_;
  const Perturbations<R>& perturbations_;
  bool is_kept_ = false;
  typename Rules<R>::Mark seen_;     ///< what has been taken in
  std::vector<Edge> edges_;          ///< in the order in which they came about, nearly
  std::vector<std::uint32_t> last_;  ///< per symbol: its last edge
  // One search.
  struct Reached {
    std::uint64_t rewriting = 0, lift = 0;  ///< the last search in which it was
  };
  std::vector<Reached> reached_;
  std::uint64_t search_ = 0;
  std::uint64_t looked_at_ = 0;
  std::vector<Symbol> pending_rewritings_, pending_lifts_, found_;
};

}  // namespace sesame::engine
