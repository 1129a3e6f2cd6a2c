/// \file
/// The cells of lazy families: made when they are asked for.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <span>
#include <unordered_map>
#include <vector>

#include "ops/cells/bodies.hpp"
#include "ops/cells/cell_store.hpp"
#include "ops/cells/forest.hpp"
#include "ops/cells/journal.hpp"
#include "ops/cells/lazy_family.hpp"
#include "ops/cells/plan.hpp"
#include "ops/cells/product_types.hpp"
#include "ops/cells/values.hpp"
#include "sparse/archive.hpp"

namespace sesame::ops {

/// Cells of products and of cones over whole bodies get an id, their faces and their name when something first asks for
/// them. That is knowledge, not state: it happens inside queries too, and nothing that the structure says depends on it
/// but ids.
///
/// Threads: one at a time, as queries keep what they find.
class LazyCells final : public FaceSource {
 public:
  LazyCells(TypeTable& types, VertexMaps& maps, CellStore& cells, Forest& forest, const Values& values,
            const Bodies& bodies, Journal& journal)
      : types_{types},
        maps_{maps},
        cells_{cells},
        forest_{forest},
        values_{values},
        bodies_{bodies},
        journal_{journal},
        products_{types} {}

  // ---- families
  [[nodiscard]] FamilyId families() const { return static_cast<FamilyId>(families_.size()); }
  [[nodiscard]] const LazyFamily& family(FamilyId f) const { return families_[f]; }
  template <class Holds>
  [[nodiscard]] bool any_family(Holds&& holds) const {
    return std::any_of(families_.begin(), families_.end(), holds);
  }
  /// Whether a cell is one of a body that has become a factor: it is no cell of the object any more.
  [[nodiscard]] bool is_consumed(CellId c) const { return consumed_by(c) != none; }
  /// The family whose factor the body of a cell has become, or none.
  [[nodiscard]] FamilyId consumed_by(CellId c) const {
    return families_.empty() ? FamilyId{none} : bodies_.consumed_by(cells_.body(c));
  }

  // ---- cells
  [[nodiscard]] bool is_lazy(CellId c) const { return cells_.lazy(c) != none; }
  /// What a lazy cell is made of, or null for others.
  [[nodiscard]] const LazyCell* of(CellId c) const {
    const std::uint32_t number = cells_.lazy(c);
    return number == none ? nullptr : &lazy_cells_[number];
  }
  /// How many have been asked for.
  [[nodiscard]] std::size_t made() const { return lazy_cells_.size(); }
  /// A lazy cell, made if need be, as a face: of a degenerate one the node. The parts are values in normal form.
  /// Cost O(1), but for the arithmetic of types and orders.
  [[nodiscard]] Incidence face(FamilyId family, LazyPart part, const Value& left, const Value& right = {}) const;
  /// Its node.
  [[nodiscard]] CellId cell(FamilyId family, LazyPart part, const Value& left, const Value& right = {}) const {
    return face(family, part, left, right).node;
  }
  /// A cell of a product of maps as it is seen from the dart that the two values and a word of that many steps make:
  /// see ProductDarts. `face` takes the word 0, from where the cell has the orientation of a tensor product.
  /// Cost: the same.
  [[nodiscard]] Incidence pair_seen(FamilyId family, const Value& left, const Value& right, std::uint32_t word) const;
  [[nodiscard]] std::span<const CellId> faces(CellId lazy) const override { return expanded(lazy).faces; }
  [[nodiscard]] std::span<const OrderId> orders(CellId lazy) const override { return expanded(lazy).orders; }
  /// Makes all lazy cells of the object: for looking at the whole of it. Cost: the cells of all families.
  void make_all() const;
  /// The current cells of a body, oldest first. Cost: the cells ever created in it; makes all its lazy cells.
  [[nodiscard]] std::vector<CellId> cells_of(BodyId body) const;
  /// Whether a was created before b. Cells of one lazy family are as old as what they are made of.
  /// Cost O(1), of lazy cells the depth to which families are nested.
  [[nodiscard]] bool is_older(CellId a, CellId b) const { return families_.empty() ? a < b : compare_age(a, b) < 0; }

  // ---- change; each has its opposite, to be called in reverse order
  void add_family(const LazyFamily& family);
  void pop_family();
  /// Forgets the lazy cell that was asked for last.
  void undo_last_cell();
  /// Forgets the faces that were asked for last.
  void undo_last_expansion();

  // ---- to an archive, and into a new store from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  /// `most_nested`: how deep families may be made of one another.
  void load(sparse::ArchiveReader& from, std::uint32_t most_nested);

 private:
  const LazyCell& expanded(CellId lazy) const;
  [[nodiscard]] CellId node_of(const LazyKey& key, TypeId type) const;
  [[nodiscard]] std::vector<Incidence> faces_of(const LazyKey& key) const;
  [[nodiscard]] std::vector<Incidence> faces_of_pair_of_maps(const LazyKey& key) const;
  void make_all_of(FamilyId id) const;
  [[nodiscard]] int compare_age(CellId a, CellId b) const;
  void load_family(sparse::ArchiveReader& from, std::uint32_t most_nested);
  void load_cell(sparse::ArchiveReader& from, CellId node);
  [[nodiscard]] bool is_part(const Value& v, FamilyId of) const;
  [[nodiscard]] bool is_sound(const LazyKey& key, TypeId type) const;

  TypeTable& types_;
  VertexMaps& maps_;
  CellStore& cells_;
  Forest& forest_;
  const Values& values_;
  const Bodies& bodies_;
  Journal& journal_;
  ProductTypes products_;
  std::deque<LazyFamily> families_;
  mutable std::deque<LazyCell> lazy_cells_;
  mutable std::unordered_map<LazyKey, CellId, LazyKeyHash> index_;
  mutable std::vector<std::vector<CellId>> made_;  ///< per family: those asked for, in that order
  mutable std::vector<CellId> expanded_;           ///< lazy nodes whose faces have been asked for, in that order
};

}  // namespace sesame::ops
