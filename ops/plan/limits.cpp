#include "ops/plan/limits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "ops/cells/name_reader.hpp"

namespace sesame::ops {

bool has_bad_entry(const CellType& type) {
  return std::any_of(type.begin(), type.end(), [](int a) { return a < 1; });
}

Status check_room(std::int64_t new_cells, const Structure& structure, const Limits& limits) {
  if (new_cells > limits.cells_per_step) {
    return Error{Errc::refused, fmt::format("this step would make {} cells; the limit for one step is {}", new_cells,
                                            limits.cells_per_step)};
  }
  if (new_cells + structure.cells().size() > limits.cells) {
    return Error{Errc::refused, fmt::format("this step would bring the workspace to {} cells; the limit is {}",
                                            new_cells + structure.cells().size(), limits.cells)};
  }
  return Done{};
}

Status check_size(const CellType& type, const Limits& limits) {
  if (has_bad_entry(type)) {
    return Error{Errc::bad_input,
                 fmt::format("there is no simploid of type [{}]: dimensions are >= 0, and the entries of a type >= 1",
                             fmt::join(type, ","))};
  }
  const std::int64_t cells = standard_cell_count(type);
  if (cells > limits.cells_of_standard) {
    return Error{Errc::refused,
                 fmt::format("a {} has {} cells; the limit is {}", describe(type), cells, limits.cells_of_standard)};
  }
  return Done{};
}

Status check_standard(const CellType& type, const Structure& structure, const Limits& limits) {
  const Status s = check_size(type, limits);
  return s ? check_room(standard_cell_count(type), structure, limits) : s;
}

Status check_family(const NewFamily& family, const Structure& structure) {
  if (static_cast<int>(family.counts.size()) - 1 > largest_dimension) {
    return Error{Errc::refused, fmt::format("\"{}\" would have cells of dimension {}; the limit is {}", family.name,
                                            family.counts.size() - 1, largest_dimension)};
  }
  constexpr int most_nested = NameReader::most_nested - largest_dimension;  // cones that are written out come to that
  for (const BodyId body : family.bodies) {
    if (structure.bodies().nesting(body) >= most_nested) {
      return Error{Errc::refused, fmt::format("\"{}\" would be made of {} products and cones that are made of one "
                                              "another, the limit",
                                              family.name, most_nested)};
    }
  }
  const auto others = structure.counts();
  std::uint64_t sum = std::accumulate(others.begin(), others.end(), std::uint64_t{0});
  for (const std::uint64_t count : family.counts) {
    if (count > largest_count || (sum += count) > largest_count) {
      return Error{Errc::refused,
                   fmt::format("with \"{}\" there would be more than {} cells, the limit", family.name, largest_count)};
    }
  }
  return Done{};
}

}  // namespace sesame::ops
