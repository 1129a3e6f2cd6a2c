#include "ops/vocabulary/cell_list.hpp"

#include <algorithm>

namespace sesame::ops {
namespace {

/// What a list by cells, ascending, has for one; or null.
template <class What>
const What* find_of(const std::vector<std::pair<std::size_t, What>>& list, std::size_t k) {
  const auto place =
      std::lower_bound(list.begin(), list.end(), k, [](const auto& a, std::size_t b) { return a.first < b; });
  return place != list.end() && place->first == k ? &place->second : nullptr;
}

}  // namespace

void CellList::push_back(const ListedCell& cell) {
  const std::size_t k = size();
  names_.begin_list();
  names_.add(cell.id);
  for (const std::string& face : cell.faces) {
    names_.add(face);
  }
  if (cell.type) {
    const auto [number, is_new] = numbers_.emplace(*cell.type, static_cast<std::uint32_t>(types_.size()));
    if (is_new) {
      types_.push_back(*cell.type);
    }
    type_of_.resize(k + 1, 0);
    type_of_[k] = number->second + 1;
  }
  if (cell.at) {
    at_.emplace_back(k, *cell.at);
  }
  if (cell.boundary) {
    boundaries_.emplace_back(k, *cell.boundary);
  }
}

const Point* CellList::at(std::size_t k) const { return find_of(at_, k); }

const ListedBoundary* CellList::boundary(std::size_t k) const { return find_of(boundaries_, k); }

ListedCell CellList::operator[](std::size_t k) const {
  const NameLists::List faces_of_cell = faces(k);
  ListedCell cell{std::string{id(k)}, {}, {faces_of_cell.begin(), faces_of_cell.end()}, {}, {}};
  if (const CellType* own = type(k)) {
    cell.type = *own;
  }
  if (const Point* place = at(k)) {
    cell.at = *place;
  }
  if (const ListedBoundary* sum = boundary(k)) {
    cell.boundary = *sum;
  }
  return cell;
}

}  // namespace sesame::ops
