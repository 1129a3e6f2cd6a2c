/// \file
/// What nodes have become: the signed union-find of identifications, and what degenerate nodes are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "ops/cells/cell_store.hpp"
#include "ops/cells/per_node.hpp"
#include "ops/cells/value.hpp"
#include "ops/ids.hpp"
#include "sparse/archive.hpp"

namespace sesame::ops {

/// A current cell, or none, and with which orientation: sign 1, or -1 when it is the opposite one.
struct OrientedCell {
  CellId cell;
  int sign;
};

/// Links that are deletions. Cost of every query: the logarithm of their number.
class DeletionLinks {
 public:
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(links_.size()); }
  [[nodiscard]] bool contains(LinkId link) const { return std::binary_search(links_.begin(), links_.end(), link); }

 private:
  friend class Forest;
  sparse::GrowingArray<LinkId> links_;  ///< in order
};

/// One *link* per removed cell, to the cell that it became; each tree is at most log2(nodes) deep, as the planner has
/// the larger class survive. A node is *current*, or has a parent, or has become degenerate: then it has a value; or it
/// is *deleted*, taken out of the object with all that it stood for. That is a link as well, to nothing.
/// Cost of what is not said: O(log nodes).
class Forest {
 public:
  /// `none` when the node is degenerate or deleted.
  [[nodiscard]] CellId parent(CellId c) const { return parent_[c]; }
  [[nodiscard]] bool is_current(CellId c) const { return parent_[c] == c; }
  /// The current cell that c is now, or none when it is degenerate or deleted.
  [[nodiscard]] CellId find(CellId c) const {
    while (c != none && parent_[c] != c) {
      c = parent_[c];
    }
    return c;
  }
  /// The cell that c was (or none) when there had been only `links` removals.
  [[nodiscard]] CellId find_at(CellId c, LinkId links) const;
  [[nodiscard]] OrientedCell find_oriented(CellId c) const { return find_oriented_at(c, links()); }
  [[nodiscard]] OrientedCell find_oriented_at(CellId c, LinkId links) const;
  /// The cell that c is now, or was last before it became degenerate or was deleted.
  [[nodiscard]] CellId last_root(CellId c) const;

  /// The number of nodes that a current cell stands for.
  [[nodiscard]] std::uint32_t members(CellId current) const { return size_[current]; }
  /// Calls visit(node) for each of them. Cost: their number.
  template <class Visit>
  void for_each_member(CellId current, Visit&& visit) const;
  /// Calls visit(link) for each removal in favour of a node itself, the latest first, as far as it is none of the first
  /// `since` removals.
  template <class Visit>
  void for_each_child_link(CellId node, LinkId since, Visit&& visit) const {
    for (LinkId link = last_child_[node]; link != none && link >= since; link = links_[link].previous_child) {
      visit(link);
    }
  }
  /// The oldest member of the class of c: of the cell that it is now, or was last before it became degenerate.
  [[nodiscard]] CellId oldest(CellId c) const { return oldest_[last_root(c)]; }
  /// The oldest member that a node had when there had been only `links` removals and it was a current cell.
  [[nodiscard]] CellId oldest_at(CellId node, LinkId links) const;

  // ---- removals, in their order
  [[nodiscard]] LinkId links() const { return static_cast<LinkId>(links_.size()); }
  [[nodiscard]] CellId removed(LinkId link) const { return links_[link].removed; }
  /// The link by which c was removed, or none.
  [[nodiscard]] LinkId link_of(CellId c) const { return link_of_[c]; }
  /// -1 when the removed cell became the other one with the opposite orientation.
  [[nodiscard]] int sign_of(LinkId link) const { return reverses_[link] ? -1 : 1; }
  /// Vertex k of the removed cell became vertex order(k) of the other one.
  [[nodiscard]] OrderId order_of(LinkId link) const;
  /// Whether some removal changed an order.
  [[nodiscard]] bool has_orders() const { return !orders_.empty(); }
  /// The number of removals before the step in which one was made.
  [[nodiscard]] LinkId links_before_step(LinkId link) const;

  /// Those removals that are deletions.
  [[nodiscard]] const DeletionLinks& deletions() const { return deletions_; }

  // ---- degenerate nodes
  /// What a node became that is degenerate. Requires: parent(node) == none, and it is not deleted.
  [[nodiscard]] const Value& squashed(CellId node) const { return squashed_.at(node); }
  /// The nodes that became degenerate over a node itself.
  [[nodiscard]] std::span<const CellId> squashed_onto(CellId node) const;

  // ---- change; each has its opposite, to be called in reverse order
  /// The next node of a kind, a current one.
  void add(CellId node);
  void pop_back(CellId node);
  /// A node is degenerate from the start. Undone by `unsquash`.
  void squash(CellId node, const Value& becomes);
  /// Requires: the node was squashed last of those that are still degenerate over the same node.
  void unsquash(CellId node);
  /// A step begins that removes cells.
  void begin_step() { first_links_.push_back(links()); }
  /// `removed`, of two current cells, becomes the other one; its vertices change their order by one of a sign. `oldest`
  /// is the older one of the oldest members of the two.
  void link(CellId removed, CellId survivor, OrderId order, int sign, CellId oldest);
  /// A current cell becomes degenerate, or, with a value of no cell, is taken out of the object.
  void link_squashed(CellId removed, const Value& becomes);
  /// Takes the last removal back. Returns the cell that is current again.
  CellId undo_last_link();

 private:
  friend class Structure;  // to an archive, and into a new forest from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  void load(sparse::ArchiveReader& from, const CellStore& cells, const VertexMaps& maps);

  struct Link {
    CellId removed, oldest_before;
    LinkId previous_child;  ///< the link that ended at the same node before
  };
  void add_link(const Link& link, OrderId order, int sign);
  void load_links(sparse::ArchiveReader& from, const CellStore& cells, const VertexMaps& maps);
  void load_deletions(sparse::ArchiveReader& from);
  void load_squashed(sparse::ArchiveReader& from, const CellStore& cells, const VertexMaps& maps);

  PerNode<CellId> parent_, oldest_;
  PerNode<std::uint32_t> size_;
  PerNode<LinkId> link_of_;
  PerNode<LinkId> last_child_;  ///< the last link that ends at the node
  sparse::GrowingArray<Link> links_;
  std::vector<bool> reverses_;                  ///< per link
  std::uint32_t reversals_ = 0;                 ///< links that do
  std::unordered_map<LinkId, OrderId> orders_;  ///< of links in another order
  sparse::GrowingArray<LinkId> first_links_;    ///< of the steps that made some
  DeletionLinks deletions_;
  std::unordered_map<CellId, Value> squashed_;  ///< what a node that became degenerate is
  std::unordered_map<CellId, std::vector<CellId>> squashed_onto_;
};

/// Whether a node itself was taken out of the object.
[[nodiscard]] inline bool is_deleted(const Forest& forest, CellId node) {
  return forest.deletions().size() > 0 && forest.parent(node) == none &&
         forest.deletions().contains(forest.link_of(node));
}

template <class Visit>
void Forest::for_each_member(CellId current, Visit&& visit) const {
  std::vector<CellId> pending{current};
  while (!pending.empty()) {
    const CellId node = pending.back();
    pending.pop_back();
    visit(node);
    for_each_child_link(node, 0, [&](LinkId link) { pending.push_back(links_[link].removed); });
  }
}

}  // namespace sesame::ops
