#include "ops/cells/cell_store.hpp"

#include <algorithm>
#include <utility>

namespace sesame::ops {

OrderId CellStore::order(CellId c, std::uint32_t k) const {
  if (is_asked_for(c)) {
    const auto orders = lazy_faces_->orders(c);
    return orders.empty() ? same_order : orders[k];
  }
  const std::uint64_t entry = first_face_[c] + k;
  return entry < face_orders_.size() ? face_orders_[entry] : same_order;
}

/// The node whose faces contain an entry of the list of all faces.
CellId CellStore::owner_of(std::uint32_t entry) const {
  return static_cast<CellId>(std::upper_bound(first_face_.begin(), first_face_.end(), entry) - first_face_.begin() - 1);
}

CellId CellStore::add(TypeId type, std::uint32_t name, BodyId body) {
  const CellId id = size();
  type_.push_back(id, type);
  first_face_.push_back(faces_.size());
  first_incidence_.push_back(id, none);
  name_.push_back(name);
  body_.push_back(id, body);
  return id;
}

CellId CellStore::add_asked(TypeId type, std::uint32_t lazy, BodyId body) {
  const CellId id = asked();
  type_.push_back(id, type);
  first_incidence_.push_back(id, none);
  lazy_.push_back(lazy);
  body_.push_back(id, body);
  return id;
}

void CellStore::pop_asked() {
  const CellId last = asked() - 1;
  type_.pop_back(last);
  first_incidence_.pop_back(last);
  lazy_.pop_back();
  body_.pop_back(last);
}

void CellStore::add_face(CellId face, OrderId order) {
  const auto entry = static_cast<std::uint32_t>(faces_.size());
  if (order != same_order) {
    face_orders_.resize(entry);
    face_orders_.push_back(order);
  }
  faces_.push_back(face);
  next_incidence_.push_back(std::exchange(first_incidence_[face], entry));
  ++first_face_.back();
}

void CellStore::pop_back() {
  first_face_.pop_back();
  while (faces_.size() > first_face_.back()) {
    first_incidence_[faces_.back()] = next_incidence_.back();
    faces_.pop_back();
    next_incidence_.pop_back();
  }
  face_orders_.truncate(std::min(face_orders_.size(), faces_.size()));
  const CellId last = size() - 1;
  type_.pop_back(last);
  first_incidence_.pop_back(last);
  name_.pop_back();
  body_.pop_back(last);
}

// --------------------------------------------------------------------------------------------------------- archives

void CellStore::save(sparse::ArchiveWriter& to) const {
  for (const auto& types : type_.lists()) {
    to.put_list(types);
  }
  to.put_list(faces_);
  to.put_list(face_orders_);
  to.put_list(name_);
  to.put_list(lazy_);
  for (const auto& bodies : body_.lists()) {
    to.put_list(bodies);
  }
}

void CellStore::load(sparse::ArchiveReader& from, const VertexMaps& maps) {
  for (auto& types : type_.lists()) {
    types = from.get_list<sparse::GrowingArray<TypeId>>();
    from.check(types.size() < mark_of_asked &&
                   std::all_of(types.begin(), types.end(), [&](TypeId type) { return type < types_.size(); }),
               "cells have types");
  }
  faces_ = from.get_list<sparse::GrowingArray<CellId>>();
  index_faces(from);
  face_orders_ = from.get_list<sparse::GrowingArray<OrderId>>();
  from.check(face_orders_.size() <= faces_.size(), "faces have orders");
  for (std::size_t entry = 0; from.is_good() && entry < face_orders_.size(); ++entry) {
    const OrderId order = face_orders_[entry];
    from.check(order == same_order || maps.is_order_of(order, type_[faces_[entry]]),
               "the order of a face is one of its vertices");
  }
  check_seen_faces(from, maps);
  name_ = from.get_list<sparse::GrowingArray<std::uint32_t>>();
  lazy_ = from.get_list<std::vector<std::uint32_t>>();
  for (auto& bodies : body_.lists()) {
    bodies = from.get_list<sparse::GrowingArray<BodyId>>();
  }
  from.check(name_.size() == type_.lists()[0].size() && body_.lists()[0].size() == name_.size() &&
                 lazy_.size() == type_.lists()[1].size() && body_.lists()[1].size() == lazy_.size(),
             "each cell has a name and a body");
}

/// A cell of a map has faces that are seen from the right darts.
void CellStore::check_seen_faces(sparse::ArchiveReader& from, const VertexMaps& maps) const {
  for (CellId c = 0; c < first_face_.size() - 1 && from.is_good(); ++c) {
    const std::vector<FaceOperator>& operators = types_.info(type_[c]).faces;
    if (types_.info(type_[c]).shape == nullptr) {
      continue;
    }
    for (std::uint32_t k = 0; k < operators.size(); ++k) {
      const CellId face = faces(c)[k];
      from.check(maps.is_value_of({face, operators[k].type, 0, order(c, k)}, type_[face]),
                 "a face of a cell of a map is seen as its type says");
    }
  }
}

/// Where the faces of each node begin, and who has which as a face; checks that they are there and of the right types.
void CellStore::index_faces(sparse::ArchiveReader& from) {
  first_face_.truncate(0);
  next_incidence_.truncate(0);
  for (std::size_t kind = 0; kind < 2; ++kind) {
    auto& first = first_incidence_.lists()[kind];
    first.truncate(0);
    first.resize(type_.lists()[kind].size());
    std::fill(first.begin(), first.end(), std::uint32_t{none});
  }
  const auto& types = type_.lists()[0];
  first_face_.reserve(types.size() + 1);
  first_face_.push_back(0);
  next_incidence_.reserve(faces_.size());
  bool is_sound = from.is_good() && faces_.size() < none;
  for (CellId c = 0; c < types.size() && is_sound; ++c) {
    const std::vector<FaceOperator>& operators = types_.info(types[c]).faces;
    const std::uint64_t begin = first_face_.back();
    is_sound = operators.size() <= faces_.size() - begin;
    for (std::size_t k = 0; k < operators.size() && is_sound; ++k) {
      const auto entry = static_cast<std::uint32_t>(begin + k);
      const CellId face = faces_[entry];
      is_sound = type_.contains(face) && (is_asked_for(face) || face < c) &&
                 types_.canonical(operators[k].type).type == type_[face];
      if (is_sound) {
        next_incidence_.push_back(std::exchange(first_incidence_[face], entry));
      }
    }
    first_face_.push_back(begin + operators.size());
  }
  from.check(is_sound && first_face_.back() == faces_.size(),
             "the faces of a cell are there, and of the types of faces");
}

}  // namespace sesame::ops
