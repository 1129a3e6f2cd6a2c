// The types of cells that are known by their boundaries.
#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "ops/cells/cell_type.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {

TypeId TypeTable::by_boundary(int dimension, std::span<const BoundaryFace> faces, KnownBy known_by) {
  CellType type{static_cast<int>(known_by), dimension};
  for (const auto& [coefficient, face] : faces) {
    const CellType& of_face = infos_[face].type;
    sparse::expects(coefficient != 0 && infos_[face].dimension == dimension - 1, "faces have one dimension less");
    type.push_back(coefficient);
    type.push_back(static_cast<int>(of_face.size()));
    type.insert(type.end(), of_face.begin(), of_face.end());
  }
  if (const auto known = ids_.find(type); known != ids_.end()) {
    return known->second;
  }
  TypeInfo info;
  info.type = type;
  info.dimension = dimension;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    info.faces.push_back({0, static_cast<int>(k), faces[k].coefficient, faces[k].type});
  }
  return add(std::move(type), std::move(info));
}

std::size_t TypeTable::length_by_boundary(std::span<const BoundaryFace> faces) const {
  std::size_t length = 2;
  for (const BoundaryFace& face : faces) {
    length += 2 + infos_[face.type].type.size();
  }
  return length;
}

bool TypeTable::load_by_boundary(const CellType& type, sparse::ArchiveReader& from) {
  std::vector<BoundaryFace> faces;
  bool is_sound = type.size() >= 2 && type[0] >= static_cast<int>(KnownBy::cone_part) && type[1] >= 1 &&
                  type[1] <= largest_dimension;
  for (std::span<const int> rest = std::span{type}.subspan(is_sound ? 2 : type.size()); is_sound && !rest.empty();) {
    is_sound = rest.size() >= 2 && rest[0] != 0 && rest[1] >= 0 && static_cast<std::size_t>(rest[1]) <= rest.size() - 2;
    if (is_sound) {
      const auto of_face = rest.subspan(2, static_cast<std::size_t>(rest[1]));
      const auto known = ids_.find(CellType(of_face.begin(), of_face.end()));
      is_sound = known != ids_.end() && infos_[known->second].dimension == type[1] - 1;
      if (is_sound) {
        faces.push_back({rest[0], known->second});
      }
      rest = rest.subspan(2 + of_face.size());
    }
  }
  if (!from.check(is_sound && !ids_.contains(type),
                  "the type of a cell known by its boundary lists those of its faces")) {
    return false;
  }
  by_boundary(type[1], faces, KnownBy{type[0]});
  return true;
}

}  // namespace sesame::ops
