#include "ops/plan/new_cells.hpp"

#include <iterator>

namespace sesame::ops {

void add_face(Incidence face, Plan& plan) {
  if (face.order != same_order) {
    plan.face_orders.emplace_back(static_cast<std::uint32_t>(plan.faces.size()), face.order);
  }
  plan.faces.push_back(face.node);
}

void add_cell(TypeId type, std::size_t first_face, Plan& plan) {
  plan.cells.push_back({type, static_cast<std::uint32_t>(first_face), plan.names.size()});
}

void join_bodies(const std::set<BodyId>& bodies, Plan& plan) {
  plan.into_body = *bodies.begin();
  plan.joined_bodies.assign(std::next(bodies.begin()), bodies.end());
}

}  // namespace sesame::ops
