/// \file
/// Nodes as they were created: their types, faces, bodies and names, and who has which as a face.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ops/cells/cell_type.hpp"
#include "ops/cells/per_node.hpp"
#include "ops/cells/value.hpp"
#include "ops/ids.hpp"
#include "sparse/archive.hpp"

namespace sesame::ops {

/// Where the faces of nodes come from that have none in the store: those of lazy cells.
class FaceSource {
 public:
  FaceSource() = default;
  FaceSource(const FaceSource&) = delete;
  FaceSource& operator=(const FaceSource&) = delete;
  virtual ~FaceSource() = default;

  [[nodiscard]] virtual std::span<const CellId> faces(CellId lazy) const = 0;
  /// The orders of the faces: none when all are the same.
  [[nodiscard]] virtual std::span<const OrderId> orders(CellId lazy) const = 0;
};

/// One row per node, append-only but for undo. How many faces a node has is said by the store, not by its type.
/// Cost of every query: O(1) or as said, apart from what a FaceSource does the first time.
class CellStore {
 public:
  explicit CellStore(TypeTable& types) : types_{types} {}
  /// To be called once, before the first lazy node.
  void set_face_source(const FaceSource& source) { lazy_faces_ = &source; }

  /// How many nodes steps have made, those undone apart: the id of the next one.
  [[nodiscard]] CellId size() const { return type_.made(); }
  /// How many were only asked for: the id of the next one.
  [[nodiscard]] CellId asked() const { return type_.asked(); }
  /// Calls visit(node) for all nodes, those that steps made first, each kind in the order of its creation.
  template <class Visit>
  void for_each_node(Visit&& visit) const {
    for (CellId c = 0; c < size(); ++c) {
      visit(c);
    }
    for (CellId c = asked_node(0); c < asked(); ++c) {
      visit(c);
    }
  }
  /// Whether there is such a node.
  [[nodiscard]] bool contains(CellId c) const { return type_.contains(c); }
  [[nodiscard]] TypeId type_id(CellId c) const { return type_[c]; }
  [[nodiscard]] const TypeInfo& type(CellId c) const { return types_.info(type_[c]); }
  [[nodiscard]] int dimension(CellId c) const { return type(c).dimension; }
  /// The body that a node was created in. It may have joined others since.
  [[nodiscard]] BodyId body(CellId c) const { return body_[c]; }
  /// The number of the name that a node was created with; none for lazy and degenerate ones.
  [[nodiscard]] std::uint32_t name(CellId c) const { return is_asked_for(c) ? std::uint32_t{none} : name_[c]; }
  /// The number of a lazy cell among these, or none.
  [[nodiscard]] std::uint32_t lazy(CellId c) const {
    return is_asked_for(c) ? lazy_[number_of(c)] : std::uint32_t{none};
  }

  /// The faces as they were given at creation, in flattened order: not yet looked up in the forest.
  [[nodiscard]] std::span<const CellId> faces(CellId c) const {
    if (is_asked_for(c)) [[unlikely]] {
      return lazy(c) != none ? lazy_faces_->faces(c) : std::span<const CellId>{};
    }
    return {faces_.data() + first_face_[c], faces_.data() + first_face_[c + 1]};
  }
  /// The order in which face k has the vertices of the node faces(c)[k].
  [[nodiscard]] OrderId order(CellId c, std::uint32_t k) const;

  /// Calls visit(owner, k) for each face k of a node in the store that was given as a certain node, the latest first,
  /// until it returns false. Cost: the logarithm of the number of nodes for each.
  template <class Visit>
  void for_each_incidence(CellId node, Visit&& visit) const {
    for (std::uint32_t entry = first_incidence_[node]; entry != none; entry = next_incidence_[entry]) {
      const CellId owner = owner_of(entry);
      if (!visit(owner, static_cast<std::uint32_t>(entry - first_face_[owner]))) {
        return;
      }
    }
  }

  // ---- change
  /// A node of a step, without faces.
  CellId add(TypeId type, std::uint32_t name, BodyId body);
  /// Gives the last one another face.
  void add_face(CellId face, OrderId order);
  /// Takes the last one back, with its faces.
  void pop_back();
  /// A node that is asked for. `lazy`: its number among lazy cells, or none.
  CellId add_asked(TypeId type, std::uint32_t lazy, BodyId body);
  void pop_asked();

  // ---- to an archive, and instead of what is there from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  /// Without a look at numbers of bodies, names and lazy cells.
  void load(sparse::ArchiveReader& from, const VertexMaps& maps);

 private:
  [[nodiscard]] CellId owner_of(std::uint32_t entry) const;
  void index_faces(sparse::ArchiveReader& from);
  void check_seen_faces(sparse::ArchiveReader& from, const VertexMaps& maps) const;

  TypeTable& types_;
  const FaceSource* lazy_faces_ = nullptr;
  PerNode<TypeId> type_;
  sparse::GrowingArray<std::uint64_t> first_face_{0};  ///< per node of a step and one more: where its faces begin
  sparse::GrowingArray<CellId> faces_;
  sparse::GrowingArray<std::uint32_t> next_incidence_;  ///< per entry of `faces_`: the one before with the same face
  PerNode<std::uint32_t> first_incidence_;              ///< the entry of `faces_` that named the node last
  sparse::GrowingArray<std::uint32_t> name_;            ///< of those that steps made
  std::vector<std::uint32_t> lazy_;                     ///< of those that were asked for
  PerNode<BodyId> body_;
  sparse::GrowingArray<OrderId> face_orders_;  ///< per entry of `faces_`, up to the last one that is not the same
};

}  // namespace sesame::ops
