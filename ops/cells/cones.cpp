#include "ops/cells/cones.hpp"

namespace sesame::ops {

void Cones::save(sparse::ArchiveWriter& to) const {
  to.put(static_cast<std::uint64_t>(cones_.size()));
  for (const Cone& cone : cones_) {
    to.put(cone.apex);
    to.put(cone.end);
    to.put(cone.made);
    to.put(cone.links);
    to.put(cone.family);
    to.put(cone.by_edges);
  }
}

void Cones::load(sparse::ArchiveReader& from, const Moment& now) {
  constexpr std::size_t bytes = 25;
  for (std::size_t left = from.get_count(bytes); left > 0 && from.is_good(); --left) {
    Cone cone{};
    cone.apex = from.get<CellId>();
    cone.end = from.get<CellId>();
    cone.made = from.get<Instant>();
    cone.links = from.get<LinkId>();
    cone.family = from.get<FamilyId>();
    cone.by_edges = from.get_bool();
    const CellId earliest = cones_.empty() ? CellId{0} : cones_.back().end;
    from.check(cone.apex >= earliest && cone.apex < cone.end && cone.end <= now.created && cone.links <= now.links &&
                   (cone.family == none || cone.family < now.families),
               "cones are taken one after the other");
    add(cone);
  }
}

}  // namespace sesame::ops
