#include "ops/cells/cell_store.hpp"

#include <algorithm>
#include <utility>

namespace sesame::ops {

OrderId CellStore::order(CellId c, std::uint32_t k) const {
  if (is_asked_for(c)) {
    const auto orders = lazy_faces_->orders(c);
    return orders.empty() ? same_order : orders[k];
  }
  const auto at = face_orders_.empty() ? face_orders_.end() : face_orders_.find(first_face_[c] + k);
  return at == face_orders_.end() ? same_order : at->second;
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
    face_orders_.emplace(entry, order);
  }
  faces_.push_back(face);
  next_incidence_.push_back(std::exchange(first_incidence_[face], entry));
  ++first_face_.back();
}

void CellStore::pop_back() {
  first_face_.pop_back();
  while (faces_.size() > first_face_.back()) {
    if (!face_orders_.empty()) {
      face_orders_.erase(faces_.size() - 1);
    }
    first_incidence_[faces_.back()] = next_incidence_.back();
    faces_.pop_back();
    next_incidence_.pop_back();
  }
  const CellId last = size() - 1;
  type_.pop_back(last);
  first_incidence_.pop_back(last);
  name_.pop_back();
  body_.pop_back(last);
}

}  // namespace sesame::ops
