#include "ops/plan/simplices_of_darts.hpp"

#include <fmt/format.h>

#include <bit>

#include "ops/cells/dart_simplices.hpp"
#include "ops/plan/sewing.hpp"
#include "ops/plan/step_names.hpp"

namespace sesame::ops {

std::string SimplicesOfDarts::name(IndexSet numbers, Dart dart) const {
  return name_of_simplex(structure_, dimension_, numbers, dart);
}

Result<CellId> SimplicesOfDarts::made(Dart dart) const {
  const std::string called = name(all(), dart);
  if (const auto named = structure_.directory().find(called); named && named->cell != none) {
    return named->cell;
  }
  return Error{Errc::refused, fmt::format("the simplex of \"{}\", \"{}\", is not there any more",
                                          name_of_dart(dimension_, dart, structure_), called)};
}

Result<Value> SimplicesOfDarts::seen(IndexSet numbers, Dart dart) {
  const auto [at, is_new] = largest_.try_emplace(dart);
  if (is_new) {
    const Result<CellId> node = made(dart);
    const Result<Value> now =
        node ? what_is_now(structure_.values().plain(*node), name(all(), dart), structure_) : node.error();
    if (!now) {
      largest_.erase(at);
      return Error{Errc::refused,
                   fmt::format("\"{}\": {}", name_of_dart(dimension_, dart, structure_), now.error().what)};
    }
    at->second = *now;
  }
  Value value = at->second;
  for (IndexSet rest = all() & ~numbers; rest != 0;) {  // the largest first, so that the others keep their places
    const int number = static_cast<int>(std::bit_width(rest)) - 1;
    rest &= ~(IndexSet{1} << number);
    value = structure_.values().face(value, static_cast<std::uint32_t>(number));
  }
  return value;
}

}  // namespace sesame::ops
