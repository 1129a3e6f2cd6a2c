// The format: "The VTK User's Guide", "Simple legacy formats"; of version 5.1 also its OFFSETS and CONNECTIVITY.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <utility>

#include "tools/mesh/number_reader.hpp"
#include "tools/mesh/solids.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {
namespace {

constexpr std::int64_t largest_number = std::numeric_limits<std::uint32_t>::max() - 1;

/// How many corners a type of cells has, or why it has not.
enum class Shape : std::uint8_t { flat, solid, voxel, polyhedron, unknown };
struct CellType {
  Shape shape;
  std::size_t corners = 0;
};
CellType cell_type(std::int64_t number) {
  switch (number) {
    case 10:
      return {Shape::solid, 4};
    case 11:
      return {Shape::voxel, 8};
    case 12:
      return {Shape::solid, 8};
    case 13:
      return {Shape::solid, 6};
    case 14:
      return {Shape::solid, 5};
    case 15:
      return {Shape::solid, 10};
    case 16:
      return {Shape::solid, 12};
    case 42:
      return {Shape::polyhedron};
    default:
      return {number >= 0 && number <= 9 ? Shape::flat : Shape::unknown};
  }
}

class VtkReader {
 public:
  VtkReader(std::string_view bytes, std::string_view name)
      : name_{name}, lines_{bytes, name}, in_{lines_, WordReader::Comments::none} {}

  Result<Solids> read() {
    if (Status s = read_head(); !s) {
      return s.error();
    }
    in_ = NumberReader{lines_, WordReader::Comments::none};
    for (std::string_view word = in_.word(); !word.empty(); word = in_.word()) {
      const std::string section = lower_case(word);
      if (section == "cell_data" || section == "point_data") {
        break;  // data only, from here on
      }
      if (Status s = read_section(section); !s) {
        return s.error();
      }
    }
    if (types_.size() != cells_.size()) {
      return in_.error(fmt::format("there are {} cells, and CELL_TYPES has {}", cells_.size(), types_.size()));
    }
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      if (Status s = add_cell(cells_[k], types_[k]); !s) {
        return s.error();
      }
    }
    if (Status s = check_corners(solids_, name_, 0); !s) {
      return s.error();
    }
    if (flat_ > 0) {
      solids_.remarks.push_back(fmt::format("left out {} of lower dimensions", counted(flat_, "cell", "cells")));
    }
    return std::move(solids_);
  }

 private:
  struct Cell {
    std::vector<std::uint32_t> numbers;
    std::size_t line;
  };

  Status read_head() {
    lines_.next();
    if (!lines_.line().starts_with("# vtk DataFile")) {
      return lines_.error("`# vtk DataFile Version 2.0` or another version is expected");
    }
    lines_.next();  // a title
    lines_.next();
    std::string_view rest = lines_.line();
    if (lower_case(next_word(rest)) != "ascii") {
      return lines_.error("the file is not ASCII, which this reader wants: save it so");
    }
    return Done{};
  }

  Status read_section(const std::string& section) {
    if (section == "dataset") {
      const std::string what = lower_case(in_.word());
      return what == "unstructured_grid"
                 ? Status{Done{}}
                 : in_.error(
                       fmt::format("a dataset {}: an UNSTRUCTURED_GRID is expected, which has solids", shown(what)));
    }
    if (section == "points") {
      return read_points();
    }
    if (section == "cells") {
      return read_cells();
    }
    if (section == "cell_types") {
      return read_types();
    }
    if (section == "field") {
      return skip_field();
    }
    if (section == "metadata") {  // of the points or cells before
      in_.skip_lines_to_blank();
      return Done{};
    }
    return in_.error(
        fmt::format("{} is no section of an unstructured grid, such as POINTS, CELLS or CELL_TYPES", shown(section)));
  }

  Status read_points() {
    const Result<std::int64_t> count = in_.count("the number of points");
    in_.word();  // the type of their numbers
    for (std::int64_t k = 0; count && k < *count; ++k) {
      const Result<Point> point = in_.point();
      if (!point) {
        return point.error();
      }
      solids_.points.push_back(*point);
    }
    return count ? Status{Done{}} : count.error();
  }

  Status read_cells() {
    const Result<std::int64_t> count = in_.count("the number of cells");
    const Result<std::int64_t> total = count ? in_.count("the number of numbers of cells") : count;
    if (!total) {
      return total.error();
    }
    const std::size_t line = in_.line();
    NumberReader ahead = in_;
    if (lower_case(ahead.word()) == "offsets") {
      in_ = ahead;
      return read_offsets(*count, *total, line);
    }
    for (std::int64_t k = 0; k < *count; ++k) {
      const Result<std::int64_t> size = in_.count("how many numbers a cell has");
      Cell cell{{}, in_.line()};
      for (std::int64_t j = 0; size && j < *size; ++j) {
        if (Status s = read_number(cell.numbers); !s) {
          return s;
        }
      }
      if (!size) {
        return size.error();
      }
      cells_.push_back(std::move(cell));
    }
    return Done{};
  }

  Status read_number(std::vector<std::uint32_t>& numbers) {
    const Result<std::int64_t> number = in_.whole("a number of a cell", 0, largest_number);
    if (number) {
      numbers.push_back(static_cast<std::uint32_t>(*number));
    }
    return number ? Status{Done{}} : number.error();
  }

  /// Of version 5.1: where the numbers of each cell begin and end in one list of all.
  Status read_offsets(std::int64_t count, std::int64_t total, std::size_t line) {
    in_.word();  // a type
    std::vector<std::uint32_t> offsets, all;
    for (std::int64_t k = 0; k < count; ++k) {
      if (Status s = read_number(offsets); !s) {
        return s;
      }
      if (offsets.back() > total || (k > 0 && offsets.back() < offsets[offsets.size() - 2])) {
        return in_.error(
            fmt::format("an offset {}: they should not decrease, nor be more than {}, the length of "
                        "CONNECTIVITY",
                        offsets.back(), total));
      }
    }
    if (lower_case(in_.word()) != "connectivity") {
      return in_.error("CONNECTIVITY is expected behind OFFSETS");
    }
    in_.word();
    for (std::int64_t k = 0; k < total; ++k) {
      if (Status s = read_number(all); !s) {
        return s;
      }
    }
    for (std::size_t k = 0; k + 1 < offsets.size(); ++k) {
      cells_.push_back({{all.begin() + offsets[k], all.begin() + offsets[k + 1]}, line});
    }
    return Done{};
  }

  Status read_types() {
    const Result<std::int64_t> count = in_.count("the number of types");
    for (std::int64_t k = 0; count && k < *count; ++k) {
      const Result<std::int64_t> type = in_.whole("a type of cells", 0, 255);
      if (!type) {
        return type.error();
      }
      types_.push_back(*type);
    }
    return count ? Status{Done{}} : count.error();
  }

  /// A name and a number of arrays, each with a name, two numbers whose product is its length, and a type.
  Status skip_field() {
    in_.word();
    const Result<std::int64_t> arrays = in_.count("the number of arrays of a field");
    for (std::int64_t k = 0; arrays && k < *arrays; ++k) {
      in_.word();
      const Result<std::int64_t> width = in_.count("the width of an array");
      const Result<std::int64_t> length = width ? in_.count("the length of an array") : width;
      if (!length) {
        return length.error();
      }
      in_.word();
      for (std::int64_t n = 0; n < *width * *length; ++n) {
        if (in_.word().empty()) {
          return in_.error("the file ends in the array of a field");
        }
      }
    }
    return arrays ? Status{Done{}} : arrays.error();
  }

  [[nodiscard]] Error error_of(const Cell& cell, std::string_view what) const {
    return lines_.error_at(cell.line, what);
  }

  Status add_cell(const Cell& cell, std::int64_t type) {
    const auto [shape, corners] = cell_type(type);
    switch (shape) {
      case Shape::flat:
        ++flat_;
        return Done{};
      case Shape::unknown:
        return error_of(cell,
                        fmt::format("a cell of type {}: linear ones, 1 to 16, and polyhedra, 42, are expected", type));
      case Shape::polyhedron:
        return add_polyhedron(cell);
      default:
        break;
    }
    if (cell.numbers.size() != corners) {
      return error_of(
          cell, fmt::format("a cell of type {} has {} points, and should have {}", type, cell.numbers.size(), corners));
    }
    std::vector<std::uint32_t> turned = cell.numbers;
    if (shape == Shape::voxel) {  // along the axes, and not around
      std::swap(turned[2], turned[3]);
      std::swap(turned[6], turned[7]);
    }
    add_solid(faces_of_solid(corners), turned, cell.line, solids_);
    return Done{};
  }

  /// The number of faces; for each face how many corners it has, and these.
  Status add_polyhedron(const Cell& cell) {
    const std::vector<std::uint32_t>& numbers = cell.numbers;
    std::size_t at = 1;
    for (std::uint32_t face = 0; !numbers.empty() && face < numbers[0]; ++face) {
      if (at >= numbers.size() || numbers[at] < 3 || numbers[at] > numbers.size() - at - 1) {
        return error_of(cell,
                        "the faces of a polyhedron should each have the number of their points, 3 at least, and "
                        "then these");
      }
      for (const std::size_t end = at + numbers[at]; at < end;) {
        solids_.faces.push_corner(numbers[++at]);
      }
      ++at;
      solids_.faces.close_face();
    }
    if (at != numbers.size() || numbers[0] == 0) {
      return error_of(cell, "a polyhedron should have the number of its faces, and then these faces and no more");
    }
    solids_.first_face.push_back(static_cast<std::uint32_t>(solids_.faces.size()));
    solids_.lines.push_back(cell.line);
    solids_.has_polyhedra = true;
    return Done{};
  }

  std::string_view name_;
  LineReader lines_;
  NumberReader in_;
  std::vector<Cell> cells_;
  std::vector<std::int64_t> types_;
  std::size_t flat_ = 0;
  Solids solids_;
};

}  // namespace

Result<Solids> read_vtk(std::string_view bytes, std::string_view name) { return VtkReader{bytes, name}.read(); }

}  // namespace sesame::tools
