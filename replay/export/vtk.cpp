// An object as an unstructured grid of VTK, in both of its text formats.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>

#include "replay/export/drawing.hpp"
#include "replay/text/text_buffer.hpp"

namespace sesame::replay {
namespace {

constexpr std::size_t dimensions_drawn = 4;

/// A type of cells of VTK: its number, and its corners as numbers of ours, which are in lexicographic order.
struct GridShape {
  int number;
  std::vector<std::uint32_t> corners;
};

/// A polygon has as many corners as it has, in turn; a larger cell of a map is not drawn.
GridShape shape_of_map(const ops::CellType& type, std::size_t corners) {
  GridShape shape{type[1] == 2 ? 7 : 0, std::vector<std::uint32_t>(corners)};
  std::iota(shape.corners.begin(), shape.corners.end(), 0U);
  return shape;
}

/// Cells that are known by their boundaries have no shape: they stand as cells without a corner.
const GridShape& shape_of(const ops::CellType& type) {
  static const GridShape no_shape{0, {}};
  if (ops::is_by_boundary(type)) {
    return no_shape;
  }
  static const std::array<std::pair<ops::CellType, GridShape>, 8> shapes{{
      {{}, {1, {0}}},
      {{1}, {3, {0, 1}}},
      {{2}, {5, {0, 1, 2}}},
      {{1, 1}, {9, {0, 2, 3, 1}}},
      {{3}, {10, {0, 1, 2, 3}}},
      {{2, 1}, {13, {0, 2, 4, 1, 3, 5}}},
      {{1, 2}, {13, {0, 1, 2, 3, 4, 5}}},
      {{1, 1, 1}, {12, {0, 4, 6, 2, 1, 5, 7, 3}}},
  }};
  return std::find_if(shapes.begin(), shapes.end(), [&](const auto& shape) { return shape.first == type; })->second;
}

/// The cells of an object in the order in which they are written, by dimension and age.
struct Grid {
  explicit Grid(const ObjectCells& cells) {
    std::vector<std::uint32_t> corners;
    for (std::size_t dimension = 0; dimension < dimensions_drawn; ++dimension) {
      for (const ops::CellId cell : cells.of(dimension)) {
        const ops::CellType& type = cells.structure().cells().type(cell).type;
        cells.corners(cell, corners);
        const GridShape shape = ops::is_of_map(type) ? shape_of_map(type, corners.size()) : shape_of(type);
        for (const std::uint32_t corner : shape.corners) {
          connectivity.push_back(corners[corner]);
        }
        ends.push_back(connectivity.size());
        shapes.push_back(shape.number);
        dimensions.push_back(static_cast<int>(dimension));
      }
    }
  }
  [[nodiscard]] std::size_t size() const { return ends.size(); }

  std::vector<std::uint32_t> connectivity;
  std::vector<std::size_t> ends;  ///< of the corners of each cell
  std::vector<int> shapes, dimensions;
};

void add_point(TextBuffer& text, const ops::Point& point) {
  text.add_number(point[0]).add(' ').add_number(point[1]).add(' ').add_number(point[2]).add('\n');
}

/// A line for each cell of the grid.
void add_coefficients(TextBuffer& text, const ObjectCells& cells, const CoefficientColumn& column) {
  for (std::size_t dimension = 0; dimension < dimensions_drawn; ++dimension) {
    for (std::size_t k = 0; k < cells.of(dimension).size(); ++k) {
      text.add_number(static_cast<int>(dimension) == column.degree() ? column[k] : 0).add('\n');
    }
  }
}

template <class Numbers>
void add_lines(TextBuffer& text, const Numbers& numbers) {
  for (const auto number : numbers) {
    text.add_integer(number).add('\n');
  }
}

Remarks remarks_on(const ObjectCells& cells) {
  std::uint64_t higher = 0;
  for (std::size_t dimension = dimensions_drawn; dimension < cells.dimensions(); ++dimension) {
    higher += cells.of(dimension).size();
  }
  Remarks remarks;
  if (higher > 0) {
    remarks.push_back(fmt::format("{} cells of dimensions above 3 are not shown", higher));
  }
  const auto count_of = [&](int dimension, bool (*is_meant)(const ops::CellType&)) {
    return std::ranges::count_if(cells.of(static_cast<std::size_t>(dimension)),
                                 [&](ops::CellId cell) { return is_meant(cells.structure().cells().type(cell).type); });
  };
  if (const auto of_maps = count_of(3, ops::is_of_map); of_maps > 0) {
    remarks.push_back(fmt::format("of {} solids of maps only the faces are shown", of_maps));
  }
  if (const auto shapeless = count_of(2, ops::is_by_boundary) + count_of(3, ops::is_by_boundary); shapeless > 0) {
    remarks.push_back(
        fmt::format("{} cells that are known by their boundaries have no shape that could be shown", shapeless));
  }
  return remarks;
}

/// The array of a vtu file that is being written; ends with it.
class XmlArray {
 public:
  XmlArray(TextBuffer& text, std::string_view type, std::string_view attributes) : text_{text} {
    text_.add("<DataArray type=\"").add(type).add("\" ").add(attributes).add(" format=\"ascii\">\n");
  }
  XmlArray(const XmlArray&) = delete;
  XmlArray& operator=(const XmlArray&) = delete;
  ~XmlArray() { text_.add("</DataArray>\n"); }

 private:
  TextBuffer& text_;
};

std::string order_of(const engine::Generator& generator) {
  return generator.order.is_zero() ? "free" : "of order " + generator.order.to_string();
}

}  // namespace

Remarks write_vtk(const Drawing& drawing, std::ostream& out) {
  const Grid grid(drawing.cells);
  TextBuffer text(out);
  text.add("# vtk DataFile Version 3.0\nan object and generators of its homology\nASCII\nDATASET UNSTRUCTURED_GRID\n");
  text.add("POINTS ").add_integer(drawing.points.size()).add(" double\n");
  for (const ops::Point& point : drawing.points) {
    add_point(text, point);
  }
  text.add("CELLS ").add_integer(grid.size()).add(' ').add_integer(grid.size() + grid.connectivity.size()).add('\n');
  std::size_t begin = 0;
  for (const std::size_t end : grid.ends) {
    text.add_integer(end - begin);
    for (; begin < end; ++begin) {
      text.add(' ').add_integer(grid.connectivity[begin]);
    }
    text.add('\n');
  }
  text.add("CELL_TYPES ").add_integer(grid.size()).add('\n');
  add_lines(text, grid.shapes);
  text.add("CELL_DATA ").add_integer(grid.size()).add('\n');
  text.add("SCALARS dimension int 1\nLOOKUP_TABLE default\n");
  add_lines(text, grid.dimensions);
  for (const auto& [name, generator] : drawing.generators) {
    const CoefficientColumn column(drawing.cells, generator);
    text.add("SCALARS ").add(name).add(column.is_integral() ? " int 1\n" : " double 1\n").add("LOOKUP_TABLE default\n");
    add_coefficients(text, drawing.cells, column);
  }
  return remarks_on(drawing.cells);
}

Remarks write_vtu(const Drawing& drawing, std::ostream& out) {
  const Grid grid(drawing.cells);
  TextBuffer text(out);
  text.add(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n");
  text.add("<UnstructuredGrid>\n<Piece NumberOfPoints=\"").add_integer(drawing.points.size());
  text.add("\" NumberOfCells=\"").add_integer(grid.size()).add("\">\n<Points>\n");
  {
    const XmlArray array(text, "Float64", "Name=\"positions\" NumberOfComponents=\"3\"");
    for (const ops::Point& point : drawing.points) {
      add_point(text, point);
    }
  }
  text.add("</Points>\n<Cells>\n");
  {
    const XmlArray array(text, "Int64", "Name=\"connectivity\"");
    add_lines(text, grid.connectivity);
  }
  {
    const XmlArray array(text, "Int64", "Name=\"offsets\"");
    add_lines(text, grid.ends);
  }
  {
    const XmlArray array(text, "UInt8", "Name=\"types\"");
    add_lines(text, grid.shapes);
  }
  text.add("</Cells>\n<CellData>\n");
  {
    const XmlArray array(text, "Int32", "Name=\"dimension\"");
    add_lines(text, grid.dimensions);
  }
  for (const auto& [name, generator] : drawing.generators) {
    const CoefficientColumn column(drawing.cells, generator);
    text.add("<!-- ").add(name).add(": ").add(order_of(generator)).add(" -->\n");
    const XmlArray array(text, column.is_integral() ? "Int32" : "Float64", "Name=\"" + name + "\"");
    add_coefficients(text, drawing.cells, column);
  }
  text.add("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  return remarks_on(drawing.cells);
}

}  // namespace sesame::replay
