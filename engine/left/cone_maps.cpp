#include "engine/left/cone_maps.hpp"

#include "sparse/contract.hpp"

namespace sesame::engine {

template <Ring R>
void ConeMaps<R>::add_F(CellId cell, const Element& factor, RawTerms<R, GeneratorId>& out) const {
  if (is_of_base(cell) && structure_.dimension(cell) == 0) {
    left_.add_g(structure_.lazy().family(id_).apex, factor, out);
  }
}

template <Ring R>
void ConeMaps<R>::add_G(GeneratorId /*generator*/, const Element& /*factor*/, RawTerms<R, CellId>& /*out*/) const {
  sparse::expects(false, "a cone has no generators of its own");
}

template <Ring R>
std::uint64_t ConeMaps<R>::terms_of_G(GeneratorId /*generator*/) const {
  sparse::expects(false, "a cone has no generators of its own");
  return 0;
}

template <Ring R>
void ConeMaps<R>::add_K(CellId cell, const Element& factor, RawTerms<R, CellId>& out) const {
  if (is_of_base(cell)) {
    const CellId coned = structure_.lazy().cell(id_, ops::LazyPart::coned, structure_.lazy().of(cell)->key.left);
    out.push_back({coned, structure_.dimension(cell) % 2 == 0 ? ring_.negate(factor) : factor});
  }
}

#define SESAME_INSTANTIATE(R) template class ConeMaps<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
