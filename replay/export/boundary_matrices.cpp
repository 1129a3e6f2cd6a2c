#include "replay/export/boundary_matrices.hpp"

#include <cstring>
#include <string_view>

#include "replay/text/text_buffer.hpp"

namespace sesame::replay {
namespace {

/// Calls column(dimension, rows) for each cell, rows being the numbers of its faces of odd incidence among all cells.
template <class Column>
void for_each_column(const ObjectCells& cells, Column column) {
  std::vector<BoundaryTerm> boundary;
  std::vector<std::uint64_t> rows;
  std::uint64_t below = 0;  // the number of the first cell of one dimension less
  for (std::size_t dimension = 0; dimension < cells.dimensions(); ++dimension) {
    for (const ops::CellId cell : cells.of(dimension)) {
      cells.boundary(cell, boundary);
      rows.clear();
      for (const auto& [face, coefficient] : boundary) {
        if (coefficient % 2 != 0) {
          rows.push_back(below + face);
        }
      }
      column(dimension, rows);
    }
    below += dimension > 0 ? cells.of(dimension - 1).size() : 0;
  }
}

void add_word(TextBuffer& out, std::uint64_t word) {
  char bytes[sizeof word];
  std::memcpy(bytes, &word, sizeof word);
  out.add(std::string_view{bytes, sizeof word});
}

void add_names(TextBuffer& text, const ObjectCells& cells, std::size_t dimension, std::string_view what) {
  std::size_t number = 0;
  for (const ops::CellId cell : cells.of(dimension)) {
    text.add("% ").add(what).add(' ').add_integer(++number).add(": ").add(cells.structure().name(cell)).add('\n');
  }
}

}  // namespace

void write_phat(const ObjectCells& cells, std::ostream& out) {
  TextBuffer text(out);
  for_each_column(cells, [&](std::size_t dimension, const std::vector<std::uint64_t>& rows) {
    text.add_integer(dimension);
    for (const std::uint64_t row : rows) {
      text.add(' ').add_integer(row);
    }
    text.add('\n');
  });
}

void write_phat_binary(const ObjectCells& cells, std::ostream& out) {
  TextBuffer bytes(out);
  add_word(bytes, cells.size());
  for_each_column(cells, [&](std::size_t dimension, const std::vector<std::uint64_t>& rows) {
    add_word(bytes, dimension);
    add_word(bytes, rows.size());
    for (const std::uint64_t row : rows) {
      add_word(bytes, row);
    }
  });
}

void write_matrix_market(const ObjectCells& cells, std::size_t dimension, std::ostream& out) {
  const auto rows = cells.of(dimension - 1);
  const auto columns = cells.of(dimension);
  std::vector<BoundaryTerm> boundary;
  std::uint64_t entries = 0;
  for (const ops::CellId cell : columns) {
    cells.boundary(cell, boundary);
    entries += boundary.size();
  }
  TextBuffer text(out);
  text.add("%%MatrixMarket matrix coordinate integer general\n");
  text.add("% the boundary from dimension ").add_integer(dimension).add(" to ").add_integer(dimension - 1);
  text.add(": ").add_integer(rows.size()).add(" rows, ").add_integer(columns.size()).add(" columns\n");
  text.add("% rows and columns are cells by age, oriented as their names say\n");
  add_names(text, cells, dimension - 1, "row");
  add_names(text, cells, dimension, "column");
  text.add_integer(rows.size()).add(' ').add_integer(columns.size()).add(' ').add_integer(entries).add('\n');
  std::size_t column = 0;
  for (const ops::CellId cell : columns) {
    ++column;
    cells.boundary(cell, boundary);
    for (const auto& [face, coefficient] : boundary) {
      text.add_integer(std::uint64_t{face} + 1).add(' ').add_integer(column).add(' ').add_integer(coefficient);
      text.add('\n');
    }
  }
}

}  // namespace sesame::replay
