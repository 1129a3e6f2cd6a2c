#include "sparse/matrix.hpp"

#include "sparse/matrix_bodies.hpp"

namespace sesame::sparse {

#define SESAME_INSTANTIATE(R)                                                                 \
  template class Matrix<R>;                                                                   \
  template Matrix<R> operator*(const Matrix<R>&, const Matrix<R>&);                           \
  template Matrix<R> operator+(Matrix<R>, const Matrix<R>&);                                  \
  template Matrix<R> operator-(Matrix<R>, const Matrix<R>&);                                  \
  template Matrix<R> operator-(Matrix<R>);                                                    \
  template Matrix<R> blocks(Matrix<R>, const Matrix<R>&, const Matrix<R>&, const Matrix<R>&); \
  template std::optional<Position> first_difference(const Matrix<R>&, const Matrix<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::sparse
