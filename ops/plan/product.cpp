// Products of two bodies: always a lazy family, whose cells are only counted here.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"

namespace sesame::ops {
namespace {

/// The cells of a body, by dimension.
using Counts = std::span<const std::uint64_t>;

std::uint64_t total(Counts counts) { return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}); }
std::uint64_t vertices(Counts counts) { return counts.empty() ? 0 : counts[0]; }

/// Exact for n up to 62.
std::uint64_t binomial(std::size_t n, std::size_t k) {
  std::uint64_t result = 1;
  k = std::min(k, n - k);
  for (std::size_t j = 1; j <= k; ++j) {
    const std::uint64_t common = std::gcd(result, j);  // divided first: the product need not fit
    result = result / common * ((n - k + j) / (j / common));
  }
  return result;
}

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

/// Adds left * right * places * choices, or more than `largest_count` where that is beyond 64 bits.
void add_product(std::uint64_t& count, std::uint64_t left, std::uint64_t right, std::uint64_t places,
                 std::uint64_t choices) {
  std::uint64_t cells = 0;
  if (__builtin_mul_overflow(left, right, &cells) || __builtin_mul_overflow(cells, places, &cells) ||
      __builtin_mul_overflow(cells, choices, &cells) || __builtin_add_overflow(count, cells, &count)) {
    count = largest_count + 1;
  }
}

/// The cells of a product, by dimension, put into `counts`, which are 0 and as many as there can be dimensions.
void count_cells(Counts lefts, Counts rights, bool simplicial, std::vector<std::uint64_t>& counts) {
  for (std::size_t p = 0; p < lefts.size(); ++p) {
    for (std::size_t q = 0; q < rights.size(); ++q) {
      if (!simplicial) {
        add_product(counts[p + q], lefts[p], rights[q], 1, 1);
        continue;
      }
      for (std::size_t n = std::max(p, q); n <= p + q; ++n) {  // n! / ((n - p)! (n - q)! (p + q - n)!) pairs
        add_product(counts[n], lefts[p], rights[q], binomial(n, p), binomial(p, p + q - n));
      }
    }
  }
  while (!counts.empty() && counts.back() == 0) {
    counts.pop_back();
  }
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

Status plan_product(const MakeProduct& operation, const Structure& structure, Plan& plan) {
  if (Status s = check_new_prefix(operation.name, structure); !s) {
    return s;
  }
  const auto left = resolve_body(operation.left, structure);
  const auto right = resolve_body(operation.right, structure);
  if (!left || !right) {
    return left ? right.error() : left.error();
  }
  if (operation.simplicial) {
    for (const auto& [body, name] : {std::pair{*left, operation.left}, std::pair{*right, operation.right}}) {
      if (Status s = check_triangulable(body, name, structure); !s) {
        return s;
      }
    }
  }
  const FamilyKind kind = operation.simplicial ? FamilyKind::simplicial_product : FamilyKind::product;
  NewFamily product{kind, operation.name, {*left, *right}, false, {}, 0};
  const Counts lefts = structure.bodies().counts(*left);
  const Counts rights = structure.bodies().counts(*right);
  product.counts.assign(std::max<std::size_t>(lefts.size() + rights.size(), 1) - 1, 0);
  if (Status s = check_family(product, structure); !s) {  // the dimension, before anything is multiplied
    return s;
  }
  count_cells(lefts, rights, operation.simplicial, product.counts);
  if (Status s = check_family(product, structure); !s) {
    return s;
  }
  if (!operation.simplicial) {
    product.simploids = total(product.counts) - simplices_of_product(*left, *right, structure);
  }
  plan.new_body = operation.name;
  plan.family = std::move(product);
  return Done{};
}

}  // namespace sesame::ops
