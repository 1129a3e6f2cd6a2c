#include "sparse/column_store.hpp"

#include "sparse/column_store_bodies.hpp"

namespace sesame::sparse {

#define SESAME_INSTANTIATE(R) template class ColumnStore<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::sparse
