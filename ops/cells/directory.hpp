/// \file
/// The names of cells and bodies, and what cells are called.
#pragma once

#include <cstdint>
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

namespace sesame::ops {

/// Names that were given, in an index by text, with the order in which they have the vertices of what they were given
/// to; and the names of lazy cells, put together when they are asked for. What a name denotes that was not given is
/// read by NameReader. Cost of what is not said: the length of the name.
class Directory {
 public:
  Directory(VertexMaps& maps, const CellStore& cells, const Forest& forest, const Values& values, const LazyCells& lazy,
            const Cones& cones, const Bodies& bodies)
      : maps_{maps}, cells_{cells}, forest_{forest}, values_{values}, lazy_{lazy}, cones_{cones}, bodies_{bodies} {}

  /// All names that were given.
  [[nodiscard]] const NameTable& names() const { return names_; }
  /// Of these, the ones with brackets that do not match, or with a bar outside of brackets. See NameReader.
  [[nodiscard]] std::span<const std::uint32_t> odd_names() const { return odd_; }
  /// The product that a name is that of, or none.
  [[nodiscard]] FamilyId product_named(const NameTable::Name& name) const;
  /// True when some name begins with this and goes on with "*" or ".(": the prefix of a lazy family would be ambiguous.
  [[nodiscard]] bool is_prefix_taken(std::string_view prefix) const;
  /// True when one of the two names begins with the other, of an apex or a product, and goes on with "*" or ".(": what
  /// names of their cells stand for would be ambiguous. `name` is new. Cost: also the number of cones and products, if
  /// some name begins so.
  [[nodiscard]] bool is_ambiguous_prefix(std::string_view name) const;

  /// The canonical name of the cell that c is now: that of its oldest member.
  [[nodiscard]] std::string_view name(CellId c) const { return own_name(forest_.oldest(c)); }
  [[nodiscard]] std::string_view name_of_body(BodyId b) const { return names_[bodies_.name(b)].text; }
  /// The sign with which the canonical name of a current cell denotes it: a name stands for the orientation that the
  /// cell had which it was made for.
  [[nodiscard]] int sign_of_name(CellId current) const {
    return maps_.has_orders() ? maps_.sign(named_value(current).order) : 1;
  }
  /// A current cell with its vertices in the order in which its canonical name stands for them.
  [[nodiscard]] Value named_value(CellId current) const;
  /// The name that c was created with.
  [[nodiscard]] std::string_view own_name(CellId c) const;
  /// The order in which it has the vertices of c. Cost: O(1), unless c is lazy.
  [[nodiscard]] OrderId order_of_own_name(CellId node) const;

  // ---- change; each has its opposite, to be called in reverse order
  /// Requires: the text is no name yet.
  void add(std::string_view text, CellId cell, BodyId body);
  void pop_back();
  /// The name of a node, a copy, has its vertices in an order.
  void set_order(CellId node, OrderId order) { orders_.emplace(node, order); }
  void forget_order(CellId node) { orders_.erase(node); }

 private:
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
  std::vector<std::uint32_t> odd_;
  std::unordered_map<CellId, OrderId> orders_;  ///< of copies, as in Plan
};

}  // namespace sesame::ops
