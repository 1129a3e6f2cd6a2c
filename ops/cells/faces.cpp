#include "ops/cells/faces.hpp"

#include <algorithm>

namespace sesame::ops {

OrientedCell Faces::at(CellId c, std::uint32_t k, const Moment& moment) const {
  CellId node = cells_.faces(c)[k];
  int sign = sign_as_created(c, k);
  splits_.for_each_move_of(c, k, 0, moment.moves, [&](const MadeMove& made) {
    node = made.after;
    sign = sign_after(made);
  });
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
  const std::span<const std::uint32_t> onto = splits_.moves_onto(node);
  for (auto at = std::lower_bound(onto.begin(), onto.end(), since.moves); at != onto.end(); ++at) {
    places.emplace_back(splits_.moves()[*at].cell, splits_.moves()[*at].slot);
  }
  return places;
}

}  // namespace sesame::ops
