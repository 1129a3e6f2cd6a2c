#include "ops/maps/cell_surgery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "ops/maps/cell_insertion.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// Takes a cell out of a map, or of its dual.
class CellRemoval {
 public:
  CellRemoval(const IndexedView& map, int i) : map_{map}, i_{i} {}

  Result<CellSurgery> run(Dart d) {
    gather(d);
    if (Status s = check(d); !s) {
      return s.error();
    }
    CellSurgery surgery;
    for (const Dart b : cell_) {
      if (const Dart outside = map_.alpha(i_, b); !is_inside(outside)) {
        surgery.images.push_back({map_.index(i_), outside, beyond(b)});
      }
    }
    surgery.gone = std::move(cell_);
    return surgery;
  }

 private:
  [[nodiscard]] bool is_inside(Dart d) const { return inside_.contains(d); }

  void gather(Dart d) {
    cell_.assign(1, d);
    inside_.insert(d);
    for (std::size_t at = 0; at < cell_.size(); ++at) {
      for (int k = 0; k <= map_.dimension(); ++k) {
        if (const Dart next = map_.alpha(k, cell_[at]); k != i_ && inside_.insert(next).second) {
          cell_.push_back(next);
        }
      }
    }
  }

  [[nodiscard]] Status check(Dart d) const {
    const int up = map_.index(i_ + 1), far = map_.index(i_ + 2);
    for (const Dart b : cell_) {
      if (i_ + 2 <= map_.dimension() &&
          map_.alpha(i_ + 2, map_.alpha(i_ + 1, b)) != map_.alpha(i_ + 1, map_.alpha(i_ + 2, b))) {
        return Error{Errc::refused,
                     fmt::format("the {}-cell of {} cannot be {}: at {} alpha_{} and alpha_{} do not commute, so it "
                                 "lies between more than two {}-cells",
                                 map_.index(i_), map_.name(d), map_.is_dual() ? "contracted" : "removed", map_.name(b),
                                 up, far, up)};
      }
    }
    if (std::ranges::all_of(cell_, [&](Dart b) { return is_inside(map_.alpha(i_, b)); })) {
      return Error{Errc::refused, fmt::format("the {}-cell of {} cannot be {}: all darts that belong together are in "
                                              "it, and nothing would be left of them",
                                              map_.index(i_), map_.name(d), map_.is_dual() ? "contracted" : "removed")};
    }
    return Done{};
  }

  /// The walk ends, since it is that of a permutation from a dart outside.
  [[nodiscard]] Dart beyond(Dart b) const {
    do {
      b = map_.alpha(i_, map_.alpha(i_ + 1, b));
    } while (is_inside(b));
    return b;
  }

  const IndexedView& map_;
  int i_;
  std::vector<Dart> cell_;
  std::unordered_set<Dart> inside_;
};

Result<GMap> applied(const GMap& map, const Result<CellSurgery>& surgery) {
  return surgery ? Result<GMap>{after_surgery(map, *surgery)} : surgery.error();
}

Error no_dimension(std::string_view what, int lowest, int highest, int i) {
  return {Errc::refused,
          fmt::format("cells of the dimensions {} to {} can be {}, not of {}", lowest, highest, what, i)};
}

}  // namespace

DartView view_of(const GMap& map) {
  return {map.dimension(), map.size(), [&map](int i, Dart d) { return map.alpha(i, d); },
          [](Dart d) { return fmt::format("dart {}", d); }};
}

Result<CellSurgery> removal_of_cell(const DartView& map, int i, Dart d) {
  if (i < 0 || i >= map.dimension) {
    return no_dimension("removed", 0, map.dimension - 1, i);
  }
  return CellRemoval(IndexedView(map, false), i).run(d);
}

Result<CellSurgery> contraction_of_cell(const DartView& map, int i, Dart d) {
  if (i < 1 || i > map.dimension) {
    return no_dimension("contracted", 1, map.dimension, i);
  }
  return CellRemoval(IndexedView(map, true), map.dimension - i).run(d);
}

Result<CellSurgery> insertion_of_cell(const DartView& map, int i, std::span<const Dart> darts) {
  const int highest = std::min(2, map.dimension - 1);
  if (i < 0 || i > highest) {
    return no_dimension("inserted", 0, highest, i);
  }
  return CellInsertion(IndexedView(map, false), i).run(darts);
}

Result<CellSurgery> splitting_of_cell(const DartView& map, int i, std::span<const Dart> darts) {
  const int lowest = std::max(1, map.dimension - 2);
  if (i < lowest || i > map.dimension) {
    return no_dimension("made by splitting", lowest, map.dimension, i);
  }
  return CellInsertion(IndexedView(map, true), map.dimension - i).run(darts);
}

GMap after_surgery(const GMap& map, const CellSurgery& surgery) {
  const Dart size = map.size() + surgery.made;
  std::vector<std::vector<Dart>> alpha = map.involutions();
  for (std::vector<Dart>& images : alpha) {
    for (Dart d = map.size(); d < size; ++d) {
      images.push_back(d);
    }
  }
  for (const auto& [i, dart, image] : surgery.images) {
    alpha[static_cast<std::size_t>(i)][dart] = image;
  }
  std::vector<bool> is_gone(size, false);
  for (const Dart d : surgery.gone) {
    is_gone[d] = true;
  }
  std::vector<Dart> number(size, no_dart);
  Dart next = 0;
  for (Dart d = 0; d < size; ++d) {
    number[d] = is_gone[d] ? no_dart : next++;
  }
  std::vector<std::vector<Dart>> kept(alpha.size());
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    for (Dart d = 0; d < size; ++d) {
      if (!is_gone[d]) {
        kept[i].push_back(number[alpha[i][d]]);
      }
    }
  }
  Result<GMap> result = GMap::make(std::move(kept));
  sparse::expects(result.has_value(), "local operations lead from map to map");
  return std::move(*result);
}

Result<GMap> removed(const GMap& map, int i, Dart d) { return applied(map, removal_of_cell(view_of(map), i, d)); }

Result<GMap> contracted(const GMap& map, int i, Dart d) {
  return applied(map, contraction_of_cell(view_of(map), i, d));
}

Result<GMap> inserted(const GMap& map, int i, std::span<const Dart> darts) {
  return applied(map, insertion_of_cell(view_of(map), i, darts));
}

Result<GMap> split(const GMap& map, int i, std::span<const Dart> darts) {
  return applied(map, splitting_of_cell(view_of(map), i, darts));
}

}  // namespace sesame::ops
