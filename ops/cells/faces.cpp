#include "ops/cells/faces.hpp"

namespace sesame::ops {

OrientedCell Faces::at(CellId c, std::uint32_t k, const Moment& moment) const {
  CellId node = cells_.faces(c)[k];
  int sign = sign_as_created(c, k);
  if (const auto made = splits_.last_move_of(c, k, moment.moves)) {
    node = made->after;
    sign = sign_after(*made);
  }
  const OrientedCell face = forest_.find_oriented_at(node, moment.links);
  return {face.cell, sign * face.sign};
}

std::vector<std::pair<CellId, std::uint32_t>> Faces::places_of(CellId node, const Moment& since,
                                                               std::size_t most) const {
  std::vector<std::pair<CellId, std::uint32_t>> places;
  cells_.for_each_incidence(node, [&](CellId owner, std::uint32_t k) {
    if (places.size() > most || owner < since.created) {
      return false;
    }
    places.emplace_back(owner, k);
    return true;
  });
  splits_.for_each_move_onto(node, since.moves,
                             [&](const MadeMove& made) { places.emplace_back(made.cell, made.slot); });
  return places;
}

}  // namespace sesame::ops
