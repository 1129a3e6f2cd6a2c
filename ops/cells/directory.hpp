/// \file
/// The names of cells and bodies, and what cells are called.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ops/cells/bodies.hpp"
#include "ops/cells/cell_store.hpp"
#include "ops/cells/cones.hpp"
#include "ops/cells/forest.hpp"
#include "ops/cells/lazy_cells.hpp"
#include "ops/cells/values.hpp"
#include "ops/name_table.hpp"
#include "sparse/archive.hpp"

namespace sesame::ops {

/// Names that were given, in an index by text, with the order in which they have the vertices of what they were given
/// to; and names that are put together when they are asked for: those of faces of standard simploids, which are found
/// and told by arithmetic and count as given, and those of lazy cells. What any other name denotes is read by
/// NameReader. Cost of what is not said: the length of the name.
///
/// Threads: one at a time, as queries keep what they find.
class Directory {
 public:
  Directory(VertexMaps& maps, const CellStore& cells, const Forest& forest, const Values& values, const LazyCells& lazy,
            const Cones& cones, const Bodies& bodies)
      : maps_{maps}, cells_{cells}, forest_{forest}, values_{values}, lazy_{lazy}, cones_{cones}, bodies_{bodies} {}

  /// All names that were given, but for those of the faces of standard simploids.
  [[nodiscard]] const NameTable& names() const { return names_; }
  struct Named {
    CellId cell;  ///< or none
    BodyId body;  ///< or none
  };
  /// What a name denotes that was given, to a face of a standard simploid or else.
  [[nodiscard]] std::optional<Named> find(std::string_view text) const;
  /// The same for a part of a text whose hashes are known, from `begin` on. Cost O(1) when there is none.
  [[nodiscard]] std::optional<Named> find(std::string_view text, const PartHashes& hashes, std::size_t begin) const;
  /// How often something has been looked up, each time with one name. Only grows.
  [[nodiscard]] std::uint64_t looked_up() const { return names_.looked_up() - further_looks_; }
  /// False when no name is that of a face of a standard simploid that would have this name, which is free.
  [[nodiscard]] bool may_have_faces_named(std::string_view name) const;
  /// Of the names in the table, the ones with brackets that do not match, or with a bar outside of brackets; and how
  /// many there are with those of the faces. See NameReader.
  [[nodiscard]] std::span<const std::uint32_t> odd_names() const { return odd_; }
  [[nodiscard]] std::uint64_t count_of_odd_names() const { return count_of_odd_; }
  /// The product that a name is that of, or none.
  [[nodiscard]] FamilyId product_named(const NameTable::Name& name) const;
  /// True when some name begins with this and goes on with "*" or ".(": the prefix of a lazy family would be ambiguous.
  [[nodiscard]] bool is_prefix_taken(std::string_view prefix) const;
  /// True when one of the two names begins with the other, of an apex or a product, and goes on with "*" or ".(": what
  /// names of their cells stand for would be ambiguous. `name` is new. Cost: also the number of cones and products, if
  /// some name begins so.
  [[nodiscard]] bool is_ambiguous_prefix(std::string_view name) const;

  /// The canonical name of the cell that c is now: that of its oldest member.
  [[nodiscard]] std::string name(CellId c) const { return own_name(forest_.oldest(c)); }
  [[nodiscard]] std::string_view name_of_body(BodyId b) const { return names_[bodies_.name(b)].text; }
  /// The sign with which the canonical name of a current cell denotes it: a name stands for the orientation that the
  /// cell had which it was made for.
  [[nodiscard]] int sign_of_name(CellId current) const {
    return maps_.has_orders() ? maps_.sign(named_value(current).order) : 1;
  }
  /// A current cell with its vertices in the order in which its canonical name stands for them.
  [[nodiscard]] Value named_value(CellId current) const;
  /// The name that c was created with.
  [[nodiscard]] std::string own_name(CellId c) const;
  /// The order in which it has the vertices of c. Cost: O(1), unless c is lazy.
  [[nodiscard]] OrderId order_of_own_name(CellId node) const;

  // ---- change; each has its opposite, to be called in reverse order
  /// Requires: the text is no name yet.
  void add(std::string_view text, CellId cell, BodyId body) { add(text, cell, body, none); }
  /// The name of a standard simploid, whose faces were made just before it and get the names "t.0-1" and so on; a
  /// vertex gets "t.0", too. Requires: these are no names, either. The nodes have been made with its number.
  void add_standard(std::string_view text, TypeId type, CellId whole, BodyId body) { add(text, whole, body, type); }
  void pop_back();
  /// Takes back the name that a node was created with, when the node goes. Those of a standard simploid go with the
  /// whole.
  void pop_back_of(CellId last) {
    if (cells_.name(last) + 1 == names_.size()) {
      pop_back();
    }
  }
  /// The name of a node, a copy or a cell of a map, has its vertices in an order.
  void set_order(CellId node, OrderId order) { orders_.emplace(node, order); }
  void forget_order(CellId node) { orders_.erase(node); }

  // ---- to an archive, and into a new directory from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  void load(sparse::ArchiveReader& from);

 private:
  void add(std::string_view text, CellId cell, BodyId body, TypeId standard);
  /// Of a name in the table.
  void add_to_indexes(std::uint32_t number);
  [[nodiscard]] bool is_sound(std::uint32_t number) const;
  template <class HashOf>
  [[nodiscard]] std::optional<Named> find_by(std::string_view text, HashOf&& hash_of) const;
  /// How many names a name in the table stands for.
  [[nodiscard]] std::uint64_t weight(std::uint32_t number) const;
  [[nodiscard]] std::string name_of_lazy(const LazyKey& key) const;

  VertexMaps& maps_;
  const CellStore& cells_;
  const Forest& forest_;
  const Values& values_;
  const LazyCells& lazy_;
  const Cones& cones_;
  const Bodies& bodies_;
  NameTable names_;
  /// Per hash, how many names have a prefix with it that could be that of a lazy family.
  std::unordered_map<std::uint64_t, std::uint32_t> prefixes_;
  /// Per hash of "t", how many names in the table look like that of a face of a standard simploid "t".
  std::unordered_map<std::uint64_t, std::uint32_t> like_faces_;
  std::vector<std::uint32_t> odd_;
  std::uint64_t count_of_odd_ = 0;
  mutable std::uint64_t further_looks_ = 0;
  std::unordered_map<CellId, OrderId> orders_;  ///< as in Plan
};

}  // namespace sesame::ops
