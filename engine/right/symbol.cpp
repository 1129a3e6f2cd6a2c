#include "engine/right/symbol.hpp"

#include "sparse/chain_bodies.hpp"
#include "sparse/column_store_bodies.hpp"

namespace sesame::sparse {

#define SESAME_INSTANTIATE(R)                       \
  SESAME_INSTANTIATE_CHAINS(R, ops::CellId)         \
  SESAME_INSTANTIATE_CHAINS(R, engine::GeneratorId) \
  SESAME_INSTANTIATE_CHAINS(R, engine::Symbol)      \
  template class ColumnStore<R, engine::GeneratorId>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::sparse
