#include "engine/history_maps.hpp"

#include <string>
#include <variant>

namespace sesame::engine {

std::vector<ops::Operation> maps_of(const ops::Operation& operation) {
  const auto* replace = std::get_if<ops::Replace>(&operation);
  if (replace == nullptr || replace->fills || std::holds_alternative<ops::Replace::Contraction>(replace->move)) {
    return {operation};
  }
  const auto* flip = std::get_if<ops::Replace::Flip>(&replace->move);
  const std::string& cell = flip != nullptr ? flip->cell : std::get<ops::Replace::Subdivision>(replace->move).cell;
  return {ops::Replace{replace->move, true}, ops::Remove{{cell}, true}};
}

ops::OrientedCell image_by(const HistoryMap& map, const ops::Structure& structure, ops::CellId cell) {
  if (!maps_backward(map.kind)) {
    return structure.forest().find_oriented_at(cell, map.after.links);
  }
  return {cell >= map.before.created ? structure.splits().copy(cell)->source : cell, 1};
}

const char* why_no_map(ops::StepKind kind) {
  switch (kind) {
    case ops::StepKind::lazy_cone:
      return "is a cone over more cells than are written out, whose base's classes are no longer told apart";
    case ops::StepKind::product:
      return "is a product, which consumes the bodies before it";
    default:
      return nullptr;
  }
}

const char* why_no_map_forward(ops::StepKind kind) {
  switch (kind) {
    case ops::StepKind::split:
      return "splits cells, and so maps the object before it nowhere";
    case ops::StepKind::deletion:
      return "removes cells, and so maps the object after it into the one before";
    case ops::StepKind::replacement:
      return "replaces cells, and so maps the objects before and after it into a third one";
    default:
      return why_no_map(kind);
  }
}

}  // namespace sesame::engine
