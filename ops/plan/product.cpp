// Products of two bodies: always a lazy family, whose cells are only counted here.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "ops/cells/family_counts.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"

namespace sesame::ops {
namespace {

using Counts = CellCounts;

std::uint64_t total(Counts counts) { return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}); }
std::uint64_t vertices(Counts counts) { return counts.empty() ? 0 : counts[0]; }

/// For a product that is triangulated: simplices, with their vertices in the order of their faces.
Status check_triangulable(BodyId body, const std::string& name, const Structure& structure) {
  if (!structure.bodies().has_only_simplices(body)) {
    return Error{Errc::refused, fmt::format("the body \"{}\" has cells that are no simplices: a simplicial product "
                                            "needs simplices, a simploidal one takes all",
                                            name)};
  }
  if (!structure.bodies().kind(body).keeps_orders) {
    return Error{Errc::refused,
                 fmt::format("cells of the body \"{}\" have their vertices in another order than their faces, which "
                             "comes of collapses and of gluing by vertex maps: a simplicial product goes by the order "
                             "of the vertices; a simploidal one takes all",
                             structure.directory().name_of_body(body))};
  }
  return Done{};
}

/// The cells of a simploidal product that are simplices: pairs of a simplex and a vertex. A pair of vertices is one.
std::uint64_t simplices_of_product(BodyId left, BodyId right, const Structure& structure) {
  const Counts lefts = structure.bodies().counts(left);
  const Counts rights = structure.bodies().counts(right);
  const std::uint64_t left_simplices = total(lefts) - structure.bodies().simploids(left);
  const std::uint64_t right_simplices = total(rights) - structure.bodies().simploids(right);
  return left_simplices * vertices(rights) + vertices(lefts) * right_simplices - vertices(lefts) * vertices(rights);
}

}  // namespace

Status plan_product(const MakeProduct& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  if (Status s = check_new_prefix(operation.name, structure); !s) {
    return s;
  }
  const auto left = resolve_body(operation.left, structure);
  const auto right = resolve_body(operation.right, structure);
  if (!left || !right) {
    return left ? right.error() : left.error();
  }
  const auto has_others = [&](BodyId body) { return structure.bodies().kind(body).has_others; };
  const bool is_of_maps = has_others(*left) || has_others(*right);
  if (operation.simplicial) {
    for (const BodyId body : {*left, *right}) {
      if (Status s = check_simploids(body, "a simplicial product", structure); !s) {
        return s;
      }
    }
    for (const auto& [body, name] : {std::pair{*left, operation.left}, std::pair{*right, operation.right}}) {
      if (Status s = check_triangulable(body, name, structure); !s) {
        return s;
      }
    }
  }
  const FamilyKind kind = operation.simplicial ? FamilyKind::simplicial_product
                          : is_of_maps         ? FamilyKind::map_product
                                               : FamilyKind::product;
  NewFamily product{kind, operation.name, {*left, *right}, false, {}, 0};
  const Counts lefts = structure.bodies().counts(*left);
  const Counts rights = structure.bodies().counts(*right);
  product.counts.assign(std::max<std::size_t>(lefts.size() + rights.size(), 1) - 1, 0);
  if (Status s = check_family(product, structure); !s) {  // the dimension, before anything is multiplied
    return s;
  }
  product.counts = cells_of_product(lefts, rights, operation.simplicial);
  if (Status s = check_family(product, structure); !s) {
    return s;
  }
  if (!operation.simplicial) {
    product.simploids = total(product.counts) - simplices_of_product(*left, *right, structure);
  }
  if (is_of_maps) {
    if (Status s = plan_map_product(product, structure, limits, plan); !s) {
      return s;
    }
  }
  plan.new_body = operation.name;
  plan.family = std::move(product);
  return Done{};
}

}  // namespace sesame::ops
