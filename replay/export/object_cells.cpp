#include "replay/export/object_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "ops/cells/cell_order.hpp"

namespace sesame::replay {
namespace {

using ops::CellId;

std::uint64_t saturating_sum(std::uint64_t a, std::uint64_t b) {
  return a > std::numeric_limits<std::uint64_t>::max() - b ? std::numeric_limits<std::uint64_t>::max() : a + b;
}

std::uint64_t total(std::span<const std::uint64_t> counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}, saturating_sum);
}

/// The cells of all products and large cones, those that have become factors included: they are made on the way.
std::uint64_t cells_of_families(const ops::LazyCells& lazy) {
  std::uint64_t sum = 0;
  for (ops::FamilyId family = 0; family < lazy.families(); ++family) {
    sum = saturating_sum(sum, total(lazy.family(family).counts));
  }
  return sum;
}

Status check_room(const ops::Structure& structure, std::uint64_t most) {
  const std::uint64_t of_families = cells_of_families(structure.lazy());
  const std::uint64_t of_object = total(structure.counts());
  if (of_families == 0 || std::max(of_families, of_object) <= most) {
    return Done{};
  }
  return Error{Errc::refused,
               fmt::format("the object has {} cells, and its products and large cones have {}, which would have to be "
                           "written out; there should be at most {}, or what --max-cells says",
                           of_object, of_families, most)};
}

/// The vertex of a value with a number in each component of its type.
CellId corner(const ops::Structure& structure, ops::Value value, std::vector<int> vertex) {
  while (!vertex.empty()) {
    const int last = structure.types().info(value.type).type.front();
    // All other vertices of the first component go, one after the other.
    const bool is_first = vertex.front() == 0;
    value = structure.values().face(value, is_first ? static_cast<std::uint32_t>(last) : 0U);
    if (last == 1) {
      vertex.erase(vertex.begin());
    } else if (!is_first) {
      --vertex.front();
    }
  }
  return value.cell;
}

/// The next vertex of a type in lexicographic order; false after the last one.
bool advance(std::vector<int>& vertex, const ops::CellType& type) {
  for (std::size_t k = type.size(); k-- > 0;) {
    if (vertex[k] < type[k]) {
      ++vertex[k];
      return true;
    }
    vertex[k] = 0;
  }
  return false;
}

}  // namespace

Result<ObjectCells> ObjectCells::list(const ops::Structure& structure, std::uint64_t most) {
  if (const Status checked = check_room(structure, most); !checked) {
    return checked.error();
  }
  structure.lazy().make_all();
  ObjectCells listed(structure);
  std::vector<CellId> all;
  structure.cells().for_each_node([&](CellId c) {
    listed.number_.push_back(c, 0);
    if (structure.is_current(c) && !structure.lazy().is_consumed(c)) {
      all.push_back(c);
    }
  });
  ops::sort_by_dimension_and_age(structure, all);
  for (const CellId c : all) {
    const auto dimension = static_cast<std::size_t>(structure.dimension(c));
    listed.cells_.resize(std::max(listed.cells_.size(), dimension + 1));
    listed.number_[c] = static_cast<std::uint32_t>(listed.cells_[dimension].size());
    listed.cells_[dimension].push_back(c);
  }
  return listed;
}

std::uint64_t ObjectCells::size() const {
  std::uint64_t sum = 0;
  for (const auto& cells : cells_) {
    sum += cells.size();
  }
  return sum;
}

void ObjectCells::boundary(CellId cell, std::vector<BoundaryTerm>& terms) const {
  terms.clear();
  const ops::Directory& directory = structure_->directory();
  const int own = directory.sign_of_name(cell);
  structure_->faces().for_each_now(cell, [&](CellId face, int sign) {
    terms.push_back({number(face), own * sign * directory.sign_of_name(face)});
  });
  std::sort(terms.begin(), terms.end(), [](const auto& a, const auto& b) { return a.face < b.face; });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < terms.size();) {
    BoundaryTerm sum{terms[k].face, 0};
    for (; k < terms.size() && terms[k].face == sum.face; ++k) {
      sum.coefficient += terms[k].coefficient;
    }
    if (sum.coefficient != 0) {
      terms[kept++] = sum;
    }
  }
  terms.resize(kept);
}

void ObjectCells::corners(CellId cell, std::vector<std::uint32_t>& corners) const {
  corners.clear();
  const ops::Value value =
      structure_->maps().has_orders() ? structure_->directory().named_value(cell) : structure_->values().plain(cell);
  const ops::CellType& type = structure_->cells().type(cell).type;
  if (ops::is_by_boundary(type)) {
    return;
  }
  if (ops::is_of_map(type)) {
    for (std::uint32_t side = 0; side < structure_->faces().of(cell).size() && structure_->dimension(cell) == 2;
         ++side) {
      const ops::Value edge = structure_->values().face(structure_->values().plain(cell), side);
      corners.push_back(number(structure_->values().face(edge, 0).cell));  // where the dart is that sees the side
    }
    return;
  }
  std::vector<int> vertex(type.size(), 0);
  do {
    corners.push_back(number(corner(*structure_, value, vertex)));
  } while (advance(vertex, type));
}

}  // namespace sesame::replay
