/// \file
/// Lifts of symbols that have been worked out, as versions of one another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/right/rules.hpp"

namespace sesame::engine {

/// Long lifts V(x), so that their coefficients can be asked for while cells are taken away one after the other: the
/// cycle of a closed surface has every triangle, and when one goes and another comes, the new cycle is the old one
/// times a unit, but for two entries.
///
/// Of lifts that differ in a few entries one is written out, that which was asked for last; the others are what makes
/// them of it. To ask for another one moves the written lift there, along these differences (as in persistent arrays).
///
/// Invariant: what is kept was true when it was kept. Whoever keeps lifts has to say when they change.
///
/// Source: H. G. Baker, "Shallow binding makes functional arrays fast" (1991).
template <Ring R>
class KnownLifts {
 public:
  using Element = typename R::Element;
  using TermOfB = sparse::Term<R, GeneratorId>;

  explicit KnownLifts(R ring) : ring_{ring} {}

  [[nodiscard]] bool is_known(Symbol x) const { return !nodes_.empty() && node_of_.contains(x); }
  [[nodiscard]] bool empty() const { return nodes_.empty(); }
  /// The coefficient of a generator in the lift of x. Requires: it is known. Cost: O(log n) of its terms, and those of
  /// the differences on the way to it, amortised.
  [[nodiscard]] Element coefficient(Symbol x, GeneratorId generator);

  /// The number of terms of a lift, about. Requires: it is known. Cost: that of asking for it.
  [[nodiscard]] std::size_t size(Symbol x) { return reach(x).size(); }

  /// Keeps a lift, unless it is short: then it is quicker to work it out. Cost: its terms.
  void keep(Symbol x, Terms<R, GeneratorId> lift);
  /// Keeps `factor` times the lift of `base`, plus `difference`. Requires: that of `base` is known, and differs from x.
  void keep(Symbol x, Symbol base, const Element& factor, Terms<R, GeneratorId> difference);
  /// Adds `factor` times the lift of y to that of x. Requires: both are known. Cost: the shorter one, and that of
  /// asking for the longer one.
  void add(Symbol x, const Element& factor, Symbol y);
  /// All of a lift. Requires: it is known. Cost: its terms.
  [[nodiscard]] Terms<R, GeneratorId> written_out(Symbol x);
  /// V(x) = factor V(y) + difference.
  struct Relation {
    Element factor;
    Terms<R, GeneratorId> difference;
  };
  /// How a lift is made of another one, if they are versions that are a few steps apart. Requires: both are known.
  [[nodiscard]] std::optional<Relation> relation(Symbol x, Symbol y) const;
  void forget(Symbol x) { node_of_.erase(x); }
  void clear();

 private:
  static constexpr std::size_t short_lift = 8;
  static constexpr std::size_t most_terms = std::size_t{1} << 25U;

  /// A lift that is written out: scale times the sum of both parts.
  struct Written {
    Element scale;
    Terms<R, GeneratorId> terms;
    std::unordered_map<GeneratorId, Element> more;

    [[nodiscard]] std::size_t size() const { return terms.size() + more.size(); }
  };
  using NodeId = std::uint32_t;
  static constexpr NodeId no_node = UINT32_MAX;
  static constexpr std::size_t terms_of_a_node = 16;  ///< the memory of one is that of so many
  /// A version: written out, or factor times another one plus a difference.
  struct Node {
    std::unique_ptr<Written> written;
    NodeId base = no_node;
    Element factor;
    Terms<R, GeneratorId> difference;
  };

  /// A node and those that it is made of, the next one first, not many.
  [[nodiscard]] std::vector<NodeId> way_from(NodeId node) const;
  /// The node at the beginning of a way as a multiple of that at a place of it, and a difference.
  [[nodiscard]] Relation along(std::span<const NodeId> way, std::size_t place) const;
  Written& reach(Symbol x) { return reach_node(node_of_.at(x)); }
  Written& reach_node(NodeId node);
  void move_from(NodeId base, NodeId to);
  void add_to(Written& written, const Element& factor, const Terms<R, GeneratorId>& terms) const;
  bool make_room(std::size_t terms);
  void keep_version(Symbol x, NodeId base, const Element& factor, Terms<R, GeneratorId> difference);

  R ring_;
  std::vector<Node> nodes_;
  std::unordered_map<Symbol, NodeId> node_of_;
  std::size_t terms_ = 0;  ///< that were kept since the last `clear`
};

}  // namespace sesame::engine
