#include "reductions/homology.hpp"

#include "reductions/elimination.hpp"
#include "sparse/smith.hpp"

namespace sesame::reductions {

namespace {

/// H_p of the small complex, its cycles and bounding chains carried to the big one by g.
template <Ring R>
HomologyGroup<R> lifted_group(const sparse::AgostonBasis<R>& basis, const GradedMap<R>& g, int p) {
  const R& ring = g.ring();
  const Chain<R> nothing(ring, Degree{p + 1});
  HomologyGroup<R> result;
  for (std::size_t k = 0; k < basis.cycles.size(); ++k) {
    const bool is_free = k >= basis.orders.size();
    if (!is_free && ring.is_unit(basis.orders[k])) {
      continue;
    }
    Chain<R> cycle = g.apply(Chain<R>(ring, Degree{p}, basis.cycles[k]));
    if (is_free) {
      ++result.group.rank;
      result.generators.push_back({std::move(cycle), Integer{0}, nothing});
    } else {
      const Integer order = ring.to_integer(basis.orders[k]);
      result.group.torsion.push_back(order);
      result.generators.push_back(
          {std::move(cycle), order, g.apply(Chain<R>(ring, Degree{p + 1}, basis.bounded_by[k]))});
    }
  }
  return result;
}

}  // namespace

template <Ring R>
std::vector<HomologyGroup<R>> homology(const ChainComplex<R>& complex) {
  const SmallModel<R> model = small_model(complex);
  const std::vector<sparse::AgostonBasis<R>> bases = sparse::agoston_bases(model.small.boundaries());
  std::vector<HomologyGroup<R>> result;
  for (int p = 0; p <= complex.top(); ++p) {
    result.push_back(p <= model.small.top() ? lifted_group(bases[static_cast<std::size_t>(p)], model.g, p)
                                            : HomologyGroup<R>{});
  }
  return result;
}

template <Ring R>
std::vector<AbelianGroup> homology_groups(const ChainComplex<R>& complex) {
  const ChainComplex<R> small = small_complex(complex);
  const R& ring = small.ring();
  std::vector<AbelianGroup> groups;
  Index rank_below = 0;  // of d_p
  for (int p = 0; p <= complex.top(); ++p) {
    const auto factors = sparse::invariant_factors(small.boundary(p + 1));
    AbelianGroup& group = groups.emplace_back();
    const auto rank_above = static_cast<Index>(factors.size());
    group.rank = small.size(p) - rank_below - rank_above;
    rank_below = rank_above;
    for (const auto& factor : factors) {
      if (!ring.is_unit(factor)) {
        group.torsion.push_back(ring.to_integer(factor));
      }
    }
  }
  return groups;
}

#define SESAME_INSTANTIATE(R)                                              \
  template std::vector<HomologyGroup<R>> homology(const ChainComplex<R>&); \
  template std::vector<AbelianGroup> homology_groups(const ChainComplex<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions
