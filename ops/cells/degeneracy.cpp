#include "ops/cells/degeneracy.hpp"

#include <bit>

namespace sesame::ops {
namespace {

Degeneracy low_bits(int n) { return (Degeneracy{1} << n) - 1; }

}  // namespace

Degeneracy compose(Degeneracy outer, Degeneracy inner) {
  Degeneracy result = outer;
  for (Degeneracy left = ~outer; inner != 0; inner >>= 1, left &= left - 1) {
    if ((inner & 1) != 0) {
      result |= left & (~left + 1);
    }
  }
  return result;
}

Degeneracy without(Degeneracy collapsed, Degeneracy dropped) {
  Degeneracy result = 0;
  int place = 0;
  for (int d = 0; d <= largest_dimension; ++d) {
    if ((dropped >> d & 1) == 0) {
      result |= (collapsed >> d & 1) << place++;
    }
  }
  return result;
}

std::uint32_t face_number(const CellType& type, int component, int vertex) {
  int number = vertex;
  for (int i = 0; i < component; ++i) {
    number += type[static_cast<std::size_t>(i)] + 1;
  }
  return static_cast<std::uint32_t>(number);
}

int direction_number(const CellType& type, int component, int j) {
  int number = j;
  for (int i = 0; i < component; ++i) {
    number += type[static_cast<std::size_t>(i)];
  }
  return number;
}

DegenerateFace face_of_degenerate(const TypeInfo& type, Degeneracy collapsed, std::uint32_t k) {
  const FaceOperator& face = type.faces[k];
  const int size = type.type[static_cast<std::size_t>(face.component)];
  const int first = direction_number(type.type, face.component, 0);
  const int at = first + face.vertex;
  const bool is_first = face.vertex == 0;
  const bool is_last = face.vertex == size;
  const auto is_collapsed = [collapsed](int direction) { return (collapsed >> direction & 1) != 0; };
  // Without vertex j the directions on its two sides become one; at an end one goes.
  const bool keeps_cell = is_first  ? is_collapsed(at)
                          : is_last ? is_collapsed(at - 1)
                                    : is_collapsed(at - 1) || is_collapsed(at);
  const int dropped = is_last ? at - 1 : at;
  Degeneracy merged = (collapsed & low_bits(dropped)) | (collapsed >> (dropped + 1) << dropped);
  if (!is_first && !is_last) {
    const Degeneracy bit = Degeneracy{1} << (at - 1);
    merged = is_collapsed(at - 1) && is_collapsed(at) ? merged | bit : merged & ~bit;
  }
  if (keeps_cell) {
    return {face.type, merged, DegenerateFace::itself};
  }
  // The vertex of the cell underneath: its component among those that are left, and the steps that move before it.
  std::uint32_t number = 0;
  int begin = 0;
  for (int i = 0; i < face.component; ++i) {
    const int a = type.type[static_cast<std::size_t>(i)];
    const int left = a - std::popcount(collapsed >> begin & low_bits(a));
    number += left == 0 ? 0U : static_cast<std::uint32_t>(left) + 1;
    begin += a;
  }
  const int moved = face.vertex - std::popcount(collapsed >> first & low_bits(face.vertex));
  return {face.type, merged, number + static_cast<std::uint32_t>(moved)};
}

}  // namespace sesame::ops
