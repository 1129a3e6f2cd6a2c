#include "ops/plan/operation_plans.hpp"

namespace sesame::ops {

Status plan_map(const MakeChainOfMaps&, const Structure&, const Limits&, Plan&) {
  return Error{Errc::refused, "to be written"};
}

}  // namespace sesame::ops
