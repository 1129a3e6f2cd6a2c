/// \file
/// The cells of an explicit complex, as an operation lists them.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ops/cells/cell_type.hpp"
#include "ops/vocabulary/name_lists.hpp"

namespace sesame::ops {

/// A position; z = 0 in the plane.
using Point = std::array<double, 3>;

/// What is said of a cell that is known by its boundary, which is a sum of faces, with coefficients that are not 0.
struct ListedBoundary {
  int dimension = 0;
  std::vector<int> coefficients = {};  ///< of the faces
};

struct ListedCell {
  std::string id;
  std::optional<CellType> type;  ///< empty: a simplex with as many faces as are listed
  std::vector<std::string> faces;
  std::optional<Point> at;
  std::optional<ListedBoundary> boundary = {};  ///< then it has no type
};

/// Cells with their faces, in any order, in little room: see NameLists. What most cells have not takes none.
class CellList {
 public:
  CellList() = default;
  CellList(std::initializer_list<ListedCell> cells) : CellList(std::vector<ListedCell>(cells)) {}
  explicit CellList(const std::vector<ListedCell>& cells) {
    for (const ListedCell& cell : cells) {
      push_back(cell);
    }
  }

  void push_back(const ListedCell& cell);

  [[nodiscard]] std::size_t size() const { return names_.size(); }
  [[nodiscard]] bool empty() const { return names_.empty(); }
  [[nodiscard]] std::string_view id(std::size_t k) const { return names_[k].front(); }
  [[nodiscard]] NameLists::List faces(std::size_t k) const { return names_[k].without_first(); }
  /// Null where none is given.
  [[nodiscard]] const CellType* type(std::size_t k) const {
    return k < type_of_.size() && type_of_[k] != 0 ? types_.data() + (type_of_[k] - 1) : nullptr;
  }
  [[nodiscard]] const Point* at(std::size_t k) const;
  /// Null where none is given.
  [[nodiscard]] const ListedBoundary* boundary(std::size_t k) const;
  /// A copy of all that is said of cell k.
  [[nodiscard]] ListedCell operator[](std::size_t k) const;

  using Iterator = IteratorByNumber<CellList>;
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size()}; }

 private:
  NameLists names_;                                ///< of each cell its id, then its faces
  std::vector<std::uint32_t> type_of_;             ///< up to the last cell with one: 1 + its number in types_, or 0
  std::vector<CellType> types_;                    ///< none twice
  std::map<CellType, std::uint32_t> numbers_;      ///< where in types_
  std::vector<std::pair<std::size_t, Point>> at_;  ///< by cell, ascending
  std::vector<std::pair<std::size_t, ListedBoundary>> boundaries_;  ///< likewise
};

}  // namespace sesame::ops
