#include "ops/plan/operation_plans.hpp"

namespace sesame::ops {

Status plan_surgery(const RemoveCell&, const Structure&, const Limits&, Plan&) {
  return Error{Errc::refused, "to be written"};
}
Status plan_surgery(const ContractCell&, const Structure&, const Limits&, Plan&) {
  return Error{Errc::refused, "to be written"};
}
Status plan_surgery(const InsertCell&, const Structure&, const Limits&, Plan&) {
  return Error{Errc::refused, "to be written"};
}
Status plan_surgery(const SplitCell&, const Structure&, const Limits&, Plan&) {
  return Error{Errc::refused, "to be written"};
}

}  // namespace sesame::ops
