#include "engine/left/window.hpp"

#include <numeric>

namespace sesame::engine {

Window::Window(const Structure& structure, std::vector<CellId> cells)
    : structure_{&structure}, begin_{structure.now()}, start_{structure.journal().end()}, cells_{std::move(cells)} {
  places_.reserve(cells_.size());
  std::size_t faces_in_all = 0;
  for (const CellId cell : cells_) {
    faces_in_all += structure.faces().of(cell).size();
  }
  faces_.reserve(faces_in_all);
  signs_.reserve(faces_in_all);
  first_face_.reserve(cells_.size() + 1);
  first_face_.push_back(0);
  first_coface_.assign(cells_.size() + 1, 0);
  for (std::uint32_t at = 0; at < cells_.size(); ++at) {
    const CellId cell = cells_[at];
    const auto arity = static_cast<std::uint32_t>(structure.faces().of(cell).size());
    for (std::uint32_t k = 0; k < arity; ++k) {
      const auto [face, sign] = structure.faces().now(cell, k);
      faces_.push_back(face);
      signs_.push_back(static_cast<std::int8_t>(sign));
      if (face != ops::none) {
        ++first_coface_[place(face) + 1];  // each cell comes after its faces
      }
    }
    first_face_.push_back(static_cast<std::uint32_t>(faces_.size()));
    places_.insert(hash_of(cell), at);
  }
  std::partial_sum(first_coface_.begin(), first_coface_.end(), first_coface_.begin());
  cofaces_.resize(first_coface_.back());
  std::vector<std::uint32_t> next(first_coface_.begin(), first_coface_.end() - 1);
  for (std::uint32_t at = 0; at < cells_.size(); ++at) {
    for (std::uint32_t k = first_face_[at]; k < first_face_[at + 1]; ++k) {
      if (faces_[k] != ops::none) {
        cofaces_[next[place(faces_[k])]++] = {cells_[at], k - first_face_[at]};
      }
    }
  }
}

std::vector<std::pair<CellId, std::uint32_t>> Window::places_of(CellId node, std::size_t most) const {
  std::vector<std::pair<CellId, std::uint32_t>> places = structure_->faces().places_of(node, begin_, most);
  if (is_first(node)) {
    const std::uint32_t at = place(node);
    const auto first = cofaces_.begin() + first_coface_[at];
    const auto last = cofaces_.begin() + first_coface_[at + 1];
    places.insert(places.end(), first, last);
  }
  return places;
}

}  // namespace sesame::engine
