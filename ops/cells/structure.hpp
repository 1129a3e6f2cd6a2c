/// \file
/// The cell structure under construction: simploids with faces, names, bodies, the union-find of identifications and
/// degeneracies, copies made by de-identification, families of cells that are made when they are asked for, and the
/// abstract simplicial complexes among the bodies.
/// Append-only but for undo, which is truncation.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ops/cells/bodies.hpp"
#include "ops/cells/cell_type.hpp"
#include "ops/cells/degeneracy.hpp"
#include "ops/cells/journal.hpp"
#include "ops/cells/lazy_family.hpp"
#include "ops/cells/moment.hpp"
#include "ops/cells/plan.hpp"
#include "ops/cells/split_history.hpp"
#include "ops/name_table.hpp"
#include "ops/simplicial/abstract_complex.hpp"

namespace sesame::ops {

/// A cone as it was made: over which cells follows from the moment and, when it is written out, from its cells.
struct Cone {
  CellId apex;
  CellId end;       ///< of a cone that is written out: its cells come between the apex and this
  Instant made;     ///< what happened before
  LinkId links;     ///< of that, removals
  FamilyId family;  ///< of a lazy cone, else none
  bool by_edges;    ///< as in NewFamily
};

/// The cells of all bodies. Cost of every lookup below: O(1) or O(log cells).
///
/// A *node* is a cell as it was created; the *current cell* that it is now is `find(node)`, or none when it has become
/// degenerate; its *value* is its normal form in either case.
///
/// Cells of products and of cones over whole bodies are *lazy*: they get an id, their faces and their name when
/// something first asks for them. That is knowledge, not state: it happens inside queries too, and nothing that the
/// structure says depends on it but ids.
class Structure {
 public:
  Structure();
  Structure(const Structure&) = delete;
  Structure& operator=(const Structure&) = delete;
  ~Structure();

  // ---- cells
  [[nodiscard]] TypeTable& types() const { return *types_; }
  /// The arithmetic of values, and all orders of vertices that there are.
  [[nodiscard]] VertexMaps& maps() const { return *maps_; }
  /// The number of nodes ever created (and not undone), lazy ones counted when they were asked for.
  [[nodiscard]] CellId created() const { return static_cast<CellId>(nodes_->type.size()); }
  /// Of these, the ones that steps made: not what was only asked for.
  [[nodiscard]] CellId made_by_steps() const {
    return created() - static_cast<CellId>(nodes_->lazy_cells.size() + nodes_->degenerate_index.size());
  }
  [[nodiscard]] TypeId type_id(CellId c) const { return nodes_->type[c]; }
  [[nodiscard]] const TypeInfo& type(CellId c) const { return types_->info(nodes_->type[c]); }
  [[nodiscard]] int dimension(CellId c) const { return type(c).dimension; }
  /// The faces as they were given at creation, in flattened order: not yet looked up by `find`.
  [[nodiscard]] std::span<const CellId> faces_as_created(CellId c) const;
  /// The nodes that the faces are now: those given at creation, but for the incidences that have moved since.
  [[nodiscard]] std::span<const CellId> faces(CellId c) const;
  /// The order in which face k has the vertices of the node faces_as_created(c)[k], or faces(c)[k].
  [[nodiscard]] OrderId order_as_created(CellId c, std::uint32_t k) const {
    return has_orders_ ? known_order_as_created(c, k) : same_order;
  }
  [[nodiscard]] OrderId order_of_face(CellId c, std::uint32_t k) const {
    return has_orders_ ? known_order_of_face(c, k) : same_order;
  }
  /// The current cell that c is now, or none when it is degenerate.
  [[nodiscard]] CellId find(CellId c) const {
    const std::vector<CellId>& parent = nodes_->parent;
    while (c != none && parent[c] != c) {
      c = parent[c];
    }
    return c;
  }
  /// The cell that c was (or none) when there had been only `links` removals.
  [[nodiscard]] CellId find_at(CellId c, LinkId links) const;
  /// The current cell that c is now, or none, and with which orientation: sign 1, or -1 when it is the opposite one.
  struct Oriented {
    CellId cell;
    int sign;
  };
  [[nodiscard]] Oriented find_oriented(CellId c) const { return find_oriented_at(c, links()); }
  [[nodiscard]] Oriented find_oriented_at(CellId c, LinkId links) const;
  /// The sign of the node faces_as_created(c)[k], or faces(c)[k], in the boundary of c.
  [[nodiscard]] int face_sign(CellId c, std::uint32_t k) const {
    const int sign = type(c).faces[k].sign;
    return has_orders_ ? sign * maps_->sign(known_order_as_created(c, k)) : sign;
  }
  [[nodiscard]] int sign_of_face(CellId c, std::uint32_t k) const {
    const int sign = type(c).faces[k].sign;
    return has_orders_ ? sign * maps_->sign(known_order_of_face(c, k)) : sign;
  }
  /// The cell that face k of c was at a moment, or none, with its sign in the boundary of c.
  [[nodiscard]] Oriented oriented_face_at(CellId c, std::uint32_t k, const Moment& moment) const;
  /// The normal form of what c is now.
  [[nodiscard]] Value value(CellId c) const;
  /// The same for a value whose cell is any node.
  [[nodiscard]] Value normal_form(Value v) const;
  /// Face k of a value in normal form, in normal form. Cost O(dimension), amortised.
  [[nodiscard]] Value face(const Value& v, std::uint32_t k) const;
  /// Face k of a cell, in normal form.
  [[nodiscard]] Value face_of_cell(CellId c, std::uint32_t k) const;
  /// A value in normal form as a face: a cell in an order, or a node that is degenerate from the start.
  [[nodiscard]] Incidence incidence_of(const Value& v) const;
  [[nodiscard]] bool is_current(CellId c) const { return nodes_->parent[c] == c; }
  /// The number of current cells of each dimension, up to the largest that has one.
  [[nodiscard]] std::span<const std::uint64_t> counts() const;
  [[nodiscard]] Moment now() const {
    return {created(), links(), static_cast<std::uint32_t>(splits_.moves().size()), families(), splits_.copies()};
  }
  /// Whether c was a current cell of the object at a moment.
  [[nodiscard]] bool was_current(CellId c, const Moment& moment) const;

  // ---- the union-find forest: one link per removed cell, each tree at most log2(cells) deep
  [[nodiscard]] LinkId links() const { return static_cast<LinkId>(links_.size()); }
  [[nodiscard]] CellId removed(LinkId link) const { return links_[link].removed; }
  /// -1 when the removed cell became the other one with the opposite orientation.
  [[nodiscard]] int sign_of(LinkId link) const { return reverses_[link] ? -1 : 1; }
  /// Vertex k of the removed cell became vertex order(k) of the other one.
  [[nodiscard]] OrderId order_of(LinkId link) const;
  /// The number of removals before the step in which one was made.
  [[nodiscard]] LinkId links_before_step(LinkId link) const;
  /// What c was removed in favour of: a node, or none when it became degenerate; c itself when it is current.
  [[nodiscard]] CellId parent(CellId c) const { return nodes_->parent[c]; }
  /// The link by which c was removed, or `none`.
  [[nodiscard]] LinkId link_of(CellId c) const { return nodes_->link_of[c]; }
  /// The number of nodes that a current cell stands for.
  [[nodiscard]] std::uint32_t members(CellId current) const { return nodes_->size[current]; }
  /// Calls visit(node) for each node that a current cell stands for. Cost: their number.
  template <class Visit>
  void for_each_member(CellId current, Visit&& visit) const;

  /// Calls visit(link) for each removal in favour of a node itself, the latest first, as far as it is none of the first
  /// `since` removals.
  template <class Visit>
  void for_each_child_link(CellId node, LinkId since, Visit&& visit) const {
    for (LinkId link = nodes_->last_child[node]; link != none && link >= since; link = links_[link].previous_child) {
      visit(link);
    }
  }

  // ---- de-identification
  using Copy = SplitHistory::Copy;
  using MadeMove = SplitHistory::MadeMove;
  [[nodiscard]] const SplitHistory& splits() const { return splits_; }
  /// The sign of the face in the boundary of the cell after a move.
  [[nodiscard]] int sign_after(const MadeMove& made) const {
    return type(made.cell).faces[made.slot].sign * maps_->sign(made.order_after);
  }
  /// The current cells that have a face which is a given current cell or degenerate over it, oldest first.
  /// Cost: the incidences that its members were created with; for a lazy cell also those of the factors' cells, for the
  /// apex of a lazy cone all cells that the cone is taken over.
  [[nodiscard]] std::vector<CellId> cofaces(CellId current) const;

  /// The places where a node was given as a face since a moment: at the creation of cells, and by moves. As (cell as
  /// created, number). Stops when there are more than `most`.
  [[nodiscard]] std::vector<std::pair<CellId, std::uint32_t>> places_of(CellId node, const Moment& since,
                                                                        std::size_t most = SIZE_MAX) const;

  // ---- names
  [[nodiscard]] const NameTable& names() const { return names_; }
  /// The node of a name, or empty. Cells of bodies that a cone was taken over are those of the cone. May make a node,
  /// for a degenerate cell that only the name describes.
  [[nodiscard]] std::optional<CellId> lookup(std::string_view name) const {
    const auto named = lookup_in_order(name);
    return named ? std::optional{named->node} : std::nullopt;
  }
  /// The canonical name of the cell that c is now: that of its oldest member.
  [[nodiscard]] std::string_view name(CellId c) const { return own_name(oldest(c)); }
  /// The sign with which the canonical name of a current cell denotes it: a name stands for the orientation that the
  /// cell had which it was made for.
  [[nodiscard]] int sign_of_name(CellId current) const {
    return has_orders_ ? maps_->sign(named_value(current).order) : 1;
  }
  /// A current cell with its vertices in the order in which its canonical name stands for them.
  [[nodiscard]] Value named_value(CellId current) const;
  /// The order in which the name that a node was created with has its vertices. Cost: O(1), unless it is lazy.
  [[nodiscard]] OrderId order_of_own_name(CellId node) const;
  /// The order in which any name has the vertices of the node that `lookup` finds: another one when it lists vertices
  /// or labels that are not in the order of the node's vertices, or has such a name in it.
  [[nodiscard]] OrderId order_of_name(std::string_view name) const;
  /// The sign with which it denotes that node.
  [[nodiscard]] int sign_of_name(std::string_view name) const { return maps_->sign(order_of_name(name)); }
  /// The name that c was created with.
  [[nodiscard]] std::string_view own_name(CellId c) const;
  /// The oldest member of the class of c: of the cell that it is now, or was last before it became degenerate.
  [[nodiscard]] CellId oldest(CellId c) const { return nodes_->oldest[last_root(c)]; }
  /// Whether a was created before b. Cells of one lazy family are as old as what they are made of.
  [[nodiscard]] bool is_older(CellId a, CellId b) const { return families_.empty() ? a < b : compare_age(a, b) < 0; }
  [[nodiscard]] bool is_name_taken(std::string_view name) const;
  /// True when some name begins with this and goes on with "*" or ".(": the prefix of a lazy family would be ambiguous.
  [[nodiscard]] bool is_prefix_taken(std::string_view prefix) const;
  /// True when one of the two names begins with the other, of an apex or a product, and goes on with "*" or ".(": what
  /// names of their cells stand for would be ambiguous. `name` is new.
  [[nodiscard]] bool is_ambiguous_prefix(std::string_view name) const;
  /// How often names, parts of names and labels have been looked up: what reading names has cost. Only grows.
  [[nodiscard]] std::uint64_t names_looked_up() const { return names_.looked_up() + abstract_.labels_looked_up(); }

  // ---- bodies
  [[nodiscard]] const Bodies& bodies() const { return bodies_; }
  /// The current body of a name, or empty. A body that became part of a cone is that cone's body.
  [[nodiscard]] std::optional<BodyId> lookup_body(std::string_view name) const;
  [[nodiscard]] BodyId body_of(CellId c) const { return bodies_.find(nodes_->body[c]); }
  /// Whether a cell is one of a body that has become a factor: it is no cell of the object any more.
  [[nodiscard]] bool is_consumed(CellId c) const {
    return !families_.empty() && bodies_.consumed_by(nodes_->body[c]) != none;
  }
  [[nodiscard]] std::string_view body_name(BodyId b) const { return names_[bodies_.name(b)].text; }
  /// The current cells of a body, oldest first. Cost: the cells ever created in it; makes all its lazy cells.
  [[nodiscard]] std::vector<CellId> cells_of(BodyId body) const;

  // ---- abstract simplicial complexes
  [[nodiscard]] const AbstractComplex& abstract() const { return abstract_; }

  // ---- cones, lazy or written out, and what their cells are called after
  [[nodiscard]] std::uint32_t cones() const { return static_cast<std::uint32_t>(cones_.size()); }
  /// The cone that has a cell as its apex, or null.
  [[nodiscard]] const Cone* cone_from(CellId apex) const;
  /// The oldest member that a node had when there had been only `links` removals and it was a current cell.
  [[nodiscard]] CellId oldest_at(CellId node, LinkId links) const;
  /// The product that a name is that of, or none.
  [[nodiscard]] FamilyId product_named(const NameTable::Name& name) const;
  /// What a node became that is degenerate. Requires: parent(node) == none.
  [[nodiscard]] const Value& squashed(CellId node) const { return nodes_->squashed.at(node); }
  /// The nodes that became degenerate over a node itself.
  [[nodiscard]] std::span<const CellId> squashed_onto(CellId node) const;
  /// Names with brackets that do not match, or with a bar outside of brackets: their numbers. See NameReader.
  [[nodiscard]] std::span<const std::uint32_t> odd_names() const { return odd_names_; }

  // ---- lazy families: products, and cones over whole bodies
  [[nodiscard]] FamilyId families() const { return static_cast<FamilyId>(families_.size()); }
  [[nodiscard]] const LazyFamily& family(FamilyId f) const { return families_[f]; }
  [[nodiscard]] bool is_lazy(CellId c) const { return lazy_of(c) != nullptr; }
  /// What a lazy cell is made of, or null for others.
  [[nodiscard]] const LazyCell* lazy_of(CellId c) const {
    return families_.empty() || nodes_->lazy[c] == none ? nullptr : &nodes_->lazy_cells[nodes_->lazy[c]];
  }
  /// A lazy cell, made if need be, as a face: of a degenerate one the node. The parts are values in normal form.
  [[nodiscard]] Incidence lazy_face(FamilyId family, LazyPart part, const Value& left, const Value& right = {}) const;
  /// Its node.
  [[nodiscard]] CellId lazy_cell(FamilyId family, LazyPart part, const Value& left, const Value& right = {}) const {
    return lazy_face(family, part, left, right).node;
  }
  /// Makes all lazy cells of the object: for looking at the whole of it. Cost: the cells of all families.
  void make_all_lazy_cells() const;

  // ---- change
  /// All that has happened and is not undone, what queries made included.
  [[nodiscard]] const Journal& journal() const { return *journal_; }
  /// The moment when the journal had come to a position. Cost: what has happened since.
  [[nodiscard]] Moment moment_at(Journal::Position position) const;
  /// Carries a plan out. Requires: planned for the present state. Cost: the size of the plan.
  void apply(const Plan& plan);
  /// Takes back the events from a position on. Cost: the size of what goes.
  void truncate(Journal::Position position);

 private:
  /// One entry per node. Behind a pointer, as lazy nodes are added by queries.
  struct Nodes {
    std::vector<TypeId> type;
    std::vector<std::uint64_t> first_face;
    std::vector<CellId> faces;
    std::vector<std::uint32_t> next_incidence;   ///< per entry of `faces`: the next one with the same face
    std::vector<std::uint32_t> first_incidence;  ///< per node: the entry of `faces` that named it last
    std::vector<CellId> parent, oldest;
    std::vector<std::uint32_t> size;
    std::vector<LinkId> link_of;
    std::vector<LinkId> last_child;  ///< the last link that ends at this node
    std::vector<std::uint32_t> name;
    std::vector<std::uint32_t> lazy;
    std::vector<BodyId> body;
    std::unordered_map<CellId, Value> squashed;                     ///< what a node that became degenerate is
    std::unordered_map<CellId, std::vector<CellId>> squashed_onto;  ///< per node: those that became degenerate over it
    std::deque<LazyCell> lazy_cells;
    std::unordered_map<LazyKey, CellId, LazyKeyHash> lazy_index;
    std::unordered_map<Value, CellId, ValueHash> degenerate_index;
    std::vector<std::vector<CellId>> lazy_made;  ///< per family: those asked for, in that order
    std::vector<CellId> expanded;                ///< lazy nodes whose faces have been asked for, in that order
  };
  struct Link {
    CellId removed, oldest_before;
    LinkId previous_child;  ///< the link that ended at the same node before
  };
  CellId add_node(TypeId type, std::uint32_t name, std::uint32_t lazy, BodyId body) const;
  void squash(CellId node, const Value& becomes) const;
  void unsquash(CellId node) const;
  void note(EventKind kind, std::size_t number) const { journal_->append(kind, static_cast<std::uint32_t>(number)); }
  void undo_last_event();
  void undo_last_cell();
  void undo_last_copy();
  void undo_last_degenerate();
  void undo_last_lazy();
  void undo_last_expansion();
  void drop_last_node();
  void add_cells(const Plan& plan, BodyId new_body);
  void add_family(const NewFamily& family, BodyId body);
  void link(const Merge& merge);
  void undo_last_link();
  void undo_last_family();
  void make_move(const Move& move);
  void join_bodies(BodyId a, BodyId b);
  void change_abstract(const Plan& plan, CellId first);
  void leave_abstract(const Plan& plan);
  void note_orders(const Plan& plan, CellId first);
  void lower_kind(BodyId body, BodyKind kind);
  [[nodiscard]] OrderId known_order_as_created(CellId c, std::uint32_t k) const;
  [[nodiscard]] OrderId known_order_of_face(CellId c, std::uint32_t k) const;
  void count(CellId c, int change);
  void add_name(std::string_view text, CellId cell, BodyId body);
  void drop_last_name();
  [[nodiscard]] CellId last_root(CellId c) const;
  void advance_to_root(Value& v) const;
  [[nodiscard]] int compare_age(CellId a, CellId b) const;
  [[nodiscard]] std::vector<Incidence> faces_of_lazy(const LazyKey& key) const;
  void make_all_cells_of(FamilyId id) const;
  [[nodiscard]] std::optional<Incidence> lookup_in_order(std::string_view name) const;
  [[nodiscard]] std::string lazy_name(const LazyKey& key) const;
  [[nodiscard]] CellId owner_of(std::uint32_t entry) const;
  void add_cofaces(CellId current, std::vector<CellId>& out) const;
  void add_cofaces_of_apex(FamilyId id, std::vector<CellId>& out) const;
  void add_lazy_cofaces(const LazyKey& key, CellId cell, std::vector<CellId>& out) const;

  std::unique_ptr<TypeTable> types_;  // behind a pointer: planning interns types, and that changes no state
  std::unique_ptr<VertexMaps> maps_;  // likewise
  std::unique_ptr<Nodes> nodes_;
  std::unique_ptr<Journal> journal_;  // likewise: it has the lazy nodes that queries made
  std::vector<Link> links_;
  std::vector<bool> reverses_;                       ///< per link
  LinkId reversals_ = 0;                             ///< links that do
  std::unordered_map<LinkId, OrderId> link_orders_;  ///< of links in another order
  std::vector<LinkId> first_links_;                  ///< of the steps that made some
  std::vector<std::uint64_t> counts_;

  SplitHistory splits_;

  NameTable names_;
  /// Per hash, how many names have a prefix with it that could be that of a lazy family.
  std::unordered_map<std::uint64_t, std::uint32_t> prefixes_;
  std::vector<std::uint32_t> odd_names_;
  std::deque<Cone> cones_;

  Bodies bodies_;
  AbstractComplex abstract_;
  /// Orders of faces as created, where not the same: by place in the list of all faces.
  std::unordered_map<std::uint64_t, OrderId> face_orders_;
  std::unordered_map<CellId, OrderId> name_orders_;  ///< of copies, as in Plan
  mutable bool has_orders_ = false;                  ///< some face, link or name has, or had, another order
  std::deque<LazyFamily> families_;
};

template <class Visit>
void Structure::for_each_member(CellId current, Visit&& visit) const {
  std::vector<CellId> pending{current};
  while (!pending.empty()) {
    const CellId node = pending.back();
    pending.pop_back();
    visit(node);
    for_each_child_link(node, 0, [&](LinkId link) { pending.push_back(links_[link].removed); });
  }
}

}  // namespace sesame::ops
