#include "replay/export/facets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "replay/text/text_buffer.hpp"

namespace sesame::replay {
namespace {

using ops::CellId;
using Vertices = std::vector<std::uint32_t>;  ///< of a simplex, ascending

Error no_complex(const std::string& why) {
  return {Errc::refused, "the object is no simplicial complex, of which facets could be listed: " + why};
}

/// The vertices of the simplices of a dimension.
Result<std::vector<Vertices>> simplices(const ObjectCells& cells, std::size_t dimension) {
  const ops::Structure& structure = cells.structure();
  std::vector<Vertices> all;
  all.reserve(cells.of(dimension).size());
  for (const CellId cell : cells.of(dimension)) {
    const ops::CellType& type = structure.cells().type(cell).type;
    if (!ops::is_simplex(type)) {
      return no_complex(
          fmt::format("\"{}\" is a {}, and should be a simplex", structure.name(cell), ops::describe(type)));
    }
    Vertices& vertices = all.emplace_back();
    cells.corners(cell, vertices);
    std::sort(vertices.begin(), vertices.end());
    if (const auto twice = std::adjacent_find(vertices.begin(), vertices.end()); twice != vertices.end()) {
      return no_complex(fmt::format("\"{}\" has the vertex \"{}\" more than once", structure.name(cell),
                                    structure.name(cells.of(0)[*twice])));
    }
  }
  return all;
}

/// Two that are simplices on the same vertices.
std::optional<std::pair<std::size_t, std::size_t>> find_twins(const std::vector<Vertices>& all) {
  std::vector<std::size_t> order(all.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    order[k] = k;
  }
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return all[a] != all[b] ? all[a] < all[b] : a < b; });
  const auto twins =
      std::adjacent_find(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return all[a] == all[b]; });
  return twins == order.end() ? std::nullopt : std::optional{std::pair{*twins, *(twins + 1)}};
}

/// What the vertices were inserted as, when all of them were, as integers of 64 bits.
std::optional<std::vector<std::uint64_t>> integer_labels(const ObjectCells& cells) {
  const ops::Structure& structure = cells.structure();
  const ops::AbstractComplex& complex = structure.abstract();
  std::vector<std::uint64_t> labels;
  for (const CellId cell : cells.of(0)) {
    if (!structure.bodies().kind(structure.body_of(cell)).is_abstract || !complex.contains(cell)) {
      return std::nullopt;
    }
    const std::string_view text = complex.text(complex.label_of(complex.vertices(cell).front()));
    std::uint64_t& label = labels.emplace_back();
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), label);
    const bool has_zeros_before = text.size() > 1 && text.front() == '0';  // a text of its own
    if (failed != std::errc{} || end != text.data() + text.size() || has_zeros_before) {
      return std::nullopt;
    }
  }
  return labels;
}

/// For each cell of a dimension whether it is a face of no other.
std::vector<bool> which_are_facets(const ObjectCells& cells, std::size_t dimension) {
  std::vector<bool> is_facet(cells.of(dimension).size(), true);
  std::vector<BoundaryTerm> boundary;
  for (const CellId cell : cells.of(dimension + 1)) {
    cells.boundary(cell, boundary);
    for (const BoundaryTerm& term : boundary) {
      is_facet[term.face] = false;
    }
  }
  return is_facet;
}

}  // namespace

Status write_facets(const ObjectCells& cells, std::ostream& out) {
  const ops::Structure& structure = cells.structure();
  if (cells.dimensions() == 0) {
    return Error{Errc::refused, "the object has no cells; a list of facets should have one at least"};
  }
  std::vector<Vertices> facets;
  for (std::size_t dimension = 0; dimension < cells.dimensions(); ++dimension) {
    Result<std::vector<Vertices>> all = simplices(cells, dimension);
    if (!all) {
      return all.error();
    }
    if (const auto twins = find_twins(*all)) {
      return no_complex(fmt::format("\"{}\" and \"{}\" have the same vertices",
                                    structure.name(cells.of(dimension)[twins->first]),
                                    structure.name(cells.of(dimension)[twins->second])));
    }
    const std::vector<bool> is_facet = which_are_facets(cells, dimension);
    for (std::size_t k = 0; k < all->size(); ++k) {
      if (is_facet[k]) {
        facets.push_back(std::move((*all)[k]));
      }
    }
  }
  TextBuffer text(out);
  text.add("# a simplicial complex of dimension ").add_integer(cells.dimensions() - 1).add(": ");
  text.add_integer(cells.of(0).size()).add(" vertices, ").add_integer(facets.size()).add(" facets\n");
  const auto labels = integer_labels(cells);
  std::string_view before = "[[";
  for (const Vertices& facet : facets) {
    std::vector<std::uint64_t> called(facet.begin(), facet.end());
    if (labels) {
      std::transform(facet.begin(), facet.end(), called.begin(), [&](std::uint32_t k) { return (*labels)[k]; });
      std::sort(called.begin(), called.end());
    }
    for (const std::uint64_t vertex : called) {
      text.add(before).add_integer(vertex);
      before = ",";
    }
    before = "],\n [";
  }
  text.add("]]\n");
  // Behind the list: who looks for its beginning does not look far.
  for (std::size_t k = 0; !labels && k < cells.of(0).size(); ++k) {
    text.add("# ").add_integer(k).add(": ").add(structure.name(cells.of(0)[k])).add('\n');
  }
  return Done{};
}

}  // namespace sesame::replay
