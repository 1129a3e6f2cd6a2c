#include "engine/left/window.hpp"

#include <algorithm>
#include <numeric>

namespace sesame::engine {

Window::Window(const Structure& structure, std::vector<CellId> cells)
    : structure_{&structure},
      begin_{structure.now()},
      deletions_before_{structure.forest().deletions().size()},
      start_{structure.journal().end()},
      cells_{std::move(cells)} {
  index_cells();
  std::size_t faces_in_all = 0;
  for (const CellId cell : cells_) {
    faces_in_all += structure.faces().of(cell).size();
  }
  faces_.reserve(faces_in_all);
  signs_.reserve(faces_in_all);
  first_face_.reserve(cells_.size() + 1);
  first_face_.push_back(0);
  for (const CellId cell : cells_) {
    const auto arity = static_cast<std::uint32_t>(structure.faces().of(cell).size());
    for (std::uint32_t k = 0; k < arity; ++k) {
      const auto [face, sign] = structure.faces().now(cell, k);
      faces_.push_back(face);
      const bool is_sign = sign == 1 || sign == -1;
      if (!is_sign) {
        coefficients_.emplace(static_cast<std::uint32_t>(signs_.size()), sign);
      }
      signs_.push_back(static_cast<std::int8_t>(is_sign ? sign : 0));
    }
    first_face_.push_back(static_cast<std::uint32_t>(faces_.size()));
  }
}

void Window::index_cells() {
  constexpr std::size_t most_nodes = 8;  // for each cell
  const bool is_dense = begin_.created / most_nodes <= cells_.size() && structure_->lazy().families() == 0;
  if (is_dense) {
    place_of_.resize(begin_.created);
    std::fill(place_of_.begin(), place_of_.end(), std::uint32_t{ops::none});
  } else {
    places_.reserve(cells_.size());
  }
  for (std::uint32_t at = 0; at < cells_.size(); ++at) {
    if (is_dense) {
      place_of_[cells_[at]] = at;
    } else {
      places_.insert(hash_of(cells_[at]), at);
    }
  }
}

void Window::make_cofaces() const {
  first_coface_.assign(cells_.size() + 1, 0);
  const auto for_each = [this](auto&& visit) {
    for (std::uint32_t at = 0; at < cells_.size(); ++at) {
      for (std::uint32_t k = first_face_[at]; k < first_face_[at + 1]; ++k) {
        if (faces_[k] != ops::none) {
          visit(place(faces_[k]), at, k - first_face_[at]);
        }
      }
    }
  };
  for_each([this](std::uint32_t face, std::uint32_t, std::uint32_t) { ++first_coface_[face + 1]; });
  std::partial_sum(first_coface_.begin(), first_coface_.end(), first_coface_.begin());
  cofaces_.resize(first_coface_.back());
  std::vector<std::uint32_t> next(first_coface_.begin(), first_coface_.end() - 1);
  for_each([&](std::uint32_t face, std::uint32_t at, std::uint32_t k) { cofaces_[next[face]++] = {cells_[at], k}; });
}

std::vector<std::pair<CellId, std::uint32_t>> Window::places_of(CellId node, std::size_t most) const {
  std::vector<std::pair<CellId, std::uint32_t>> places = structure_->faces().places_of(node, begin_, most);
  if (is_first(node)) {
    if (first_coface_.empty()) {
      make_cofaces();
    }
    const std::uint32_t at = place(node);
    const auto first = cofaces_.begin() + first_coface_[at];
    const auto last = cofaces_.begin() + first_coface_[at + 1];
    places.insert(places.end(), first, last);
  }
  return places;
}

}  // namespace sesame::engine
