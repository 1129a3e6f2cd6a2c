#include "replay/export/positions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <variant>

namespace sesame::replay {
namespace {

using ops::CellId;
using Given = std::pair<CellId, ops::Point>;

/// The vertices of a standard cell are the first of its nodes, an apex is the first of those of its cone.
void add_in_order(const std::vector<ops::Point>& points, CellId first, std::vector<Given>& given) {
  for (const ops::Point& point : points) {
    given.emplace_back(first++, point);
  }
}

/// Of a list of cells, each of which is called by its id between two texts.
void add_listed(const ops::CellList& cells, const std::string& before, const std::string& after,
                const ops::Structure& structure, std::vector<Given>& given) {
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (const ops::Point* point = cells.at(k)) {
      if (const auto node = structure.lookup(before + std::string{cells.id(k)} + after)) {
        given.emplace_back(*node, *point);
      }
    }
  }
  std::sort(given.begin(), given.end());
}

void add_apexes(const ops::MakeSuspension& made, const ops::Structure& structure, std::vector<Given>& given) {
  for (std::size_t k = 0; k < made.at.size(); ++k) {
    if (const auto node = structure.lookup(made.apexes.at(k))) {
      given.emplace_back(*node, made.at[k]);
    }
  }
}

/// The vertex that a replacement makes, if it makes one, is its first cell.
std::optional<ops::Point> position_of_new(const ops::Replace& replace) {
  if (const auto* flip = std::get_if<ops::Replace::Flip>(&replace.move)) {
    return flip->at;
  }
  const auto* subdivision = std::get_if<ops::Replace::Subdivision>(&replace.move);
  return subdivision != nullptr ? subdivision->at : std::nullopt;
}

/// The vertex of the object that a node has become, or none when it belongs to a factor of a product.
CellId vertex_of_object(const ops::Structure& structure, CellId node) {
  CellId vertex = structure.find(node);
  while (structure.lazy().is_consumed(vertex)) {
    const ops::FamilyId family = structure.lazy().consumed_by(vertex);
    if (structure.lazy().family(family).kind != ops::FamilyKind::cone) {
      return ops::none;
    }
    const ops::Value factor = structure.values().of(vertex);
    vertex = structure.find(structure.lazy().cell(family, ops::LazyPart::base, factor));
  }
  return vertex;
}

/// A vertex that was split off is where the one is that it was split from, unless a position is known already.
void place_copies(const ObjectCells& cells, std::vector<std::optional<ops::Point>>& found) {
  const ops::Structure& structure = cells.structure();
  for (CellId c = 0; structure.splits().copies() > 0 && c < structure.cells().size(); ++c) {
    const auto* copy = structure.dimension(c) == 0 ? structure.splits().copy(c) : nullptr;
    if (copy == nullptr) {
      continue;
    }
    const CellId vertex = vertex_of_object(structure, c);
    const CellId source = vertex_of_object(structure, copy->source);
    if (vertex != ops::none && source != ops::none && !found[cells.number(vertex)]) {
      found[cells.number(vertex)] = found[cells.number(source)];
    }
  }
}

}  // namespace

std::vector<std::pair<ops::CellId, ops::Point>> given_positions(const ops::Operation& operation,
                                                                const engine::StepReport& report,
                                                                const ops::Structure& structure) {
  const CellId first = report.before.created;
  std::vector<Given> given;
  if (const auto* simplex = std::get_if<ops::MakeSimplex>(&operation)) {
    add_in_order(simplex->at, first, given);
  } else if (const auto* simploid = std::get_if<ops::MakeSimploid>(&operation)) {
    add_in_order(simploid->at, first, given);
  } else if (const auto* gmap = std::get_if<ops::MakeGMap>(&operation)) {
    add_in_order(gmap->at, first, given);  // their vertices come first
  } else if (const auto* map = std::get_if<ops::MakeMap>(&operation)) {
    add_in_order(map->at, first, given);
  } else if (const auto* polygon = std::get_if<ops::MakePolygon>(&operation)) {
    add_in_order(polygon->at, first, given);
  } else if (const auto* complex = std::get_if<ops::MakeComplex>(&operation)) {
    add_listed(complex->cells, complex->name + ".", "", structure, given);
  } else if (const auto* incidence = std::get_if<ops::MakeIncidence>(&operation)) {
    add_listed(incidence->cells, incidence->name + (incidence->as_simplices ? ".<" : "."),
               incidence->as_simplices ? ">" : "", structure, given);
  } else if (const auto* chain = std::get_if<ops::MakeChainOfMaps>(&operation)) {
    add_in_order(chain->at, first, given);
  } else if (const auto* suspension = std::get_if<ops::MakeSuspension>(&operation)) {
    add_apexes(*suspension, structure, given);
  } else if (const auto* cone = std::get_if<ops::MakeCone>(&operation); cone != nullptr && cone->at) {
    given.emplace_back(first, *cone->at);
  } else if (const auto* inserted = std::get_if<ops::InsertCell>(&operation); inserted != nullptr && inserted->at) {
    given.emplace_back(first, *inserted->at);  // the new vertex comes first
  } else if (const auto* split = std::get_if<ops::SplitCell>(&operation); split != nullptr && split->at) {
    given.emplace_back(first, *split->at);
  } else if (const auto* replace = std::get_if<ops::Replace>(&operation)) {
    if (const auto at = position_of_new(*replace); at && report.after.created > first) {
      given.emplace_back(first, *at);
    }
  }
  return given;
}

void Positions::take(const ops::Operation& operation, const engine::StepReport& report,
                     const ops::Structure& structure) {
  if (std::holds_alternative<ops::Undo>(operation)) {
    while (!given_.empty() && given_.back().first >= structure.cells().size()) {
      given_.pop_back();
    }
    return;
  }
  const std::vector<Given> given = given_positions(operation, report, structure);
  given_.insert(given_.end(), given.begin(), given.end());
}

std::pair<std::vector<std::optional<ops::Point>>, std::uint64_t> Positions::known(const ObjectCells& cells) const {
  const ops::Structure& structure = cells.structure();
  std::vector<std::optional<ops::Point>> found(cells.of(0).size());
  std::vector<bool> is_torn(found.size(), false);
  for (const auto& [node, point] : given_) {
    if (const CellId vertex = vertex_of_object(structure, node); vertex != ops::none) {
      std::optional<ops::Point>& place = found[cells.number(vertex)];
      is_torn[cells.number(vertex)] = is_torn[cells.number(vertex)] || (place && *place != point);
      place = place ? place : point;
    }
  }
  place_copies(cells, found);
  return {std::move(found), static_cast<std::uint64_t>(std::count(is_torn.begin(), is_torn.end(), true))};
}

Result<Positions::Points> Positions::of_vertices(const ObjectCells& cells) const {
  const auto [found, torn] = known(cells);
  Points all{{}, torn};
  all.points.reserve(found.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!found[k]) {
      return Error{Errc::refused,
                   fmt::format("the vertex \"{}\" has no position, and a drawing needs one of each: \"at\" of simplex, "
                               "simploid, complex, incidence, gmap, map, polygon, chain_of_maps, cone, suspend or "
                               "replace gives it; other formats, such as phat, need none",
                               cells.structure().name(cells.of(0)[k]))};
    }
    all.points.push_back(*found[k]);
  }
  return all;
}

}  // namespace sesame::replay
