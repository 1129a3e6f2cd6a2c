#include "ops/cells/plan.hpp"

namespace sesame::ops {

void Plan::clear() {
  cells.clear();
  faces.clear();
  face_orders.clear();
  first = none;
  names.clear();
  standard = none;
  merges.clear();
  deletions.clear();
  degenerate.clear();
  sources.clear();
  name_orders.clear();
  moves.clear();
  cones.clear();
  family.reset();
  abstract.reset();
  new_body.reset();
  into_body.reset();
  joined_bodies.clear();
  map.reset();
  extended.clear();
  sewings.clear();
  newly_seen.clear();
  darts_taken_out.clear();
  already = 0;
}

StepKind Plan::kind() const {
  if (family) {
    return family->kind == FamilyKind::cone ? StepKind::lazy_cone : StepKind::product;
  }
  if (!merges.empty()) {
    return StepKind::removal;
  }
  if (!deletions.empty()) {
    return cells.empty() ? StepKind::deletion : StepKind::replacement;
  }
  if (!sources.empty()) {
    return StepKind::split;
  }
  return cells.size() == degenerate.size() ? StepKind::nothing : StepKind::addition;
}

}  // namespace sesame::ops
