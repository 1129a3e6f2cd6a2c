/// \file
/// The cones that were made, lazy or written out: what their cells are called after.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>

#include "ops/cells/moment.hpp"
#include "ops/ids.hpp"
#include "sparse/archive.hpp"

namespace sesame::ops {

/// A cone as it was made: over which cells follows from the moment and, when it is written out, from its cells.
struct Cone {
  CellId apex;
  CellId end;       ///< of a cone that is written out: its cells come between the apex and this
  Instant made;     ///< what happened before
  LinkId links;     ///< of that, removals
  FamilyId family;  ///< of a lazy cone, else none
  bool by_edges;    ///< as in NewFamily
};

/// Cones in the order in which they were made, which is that of their apexes.
class Cones {
 public:
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(cones_.size()); }
  /// The cone that has a cell as its apex, or null. Cost: the logarithm of their number.
  [[nodiscard]] const Cone* from(CellId apex) const {
    const auto found = std::lower_bound(cones_.begin(), cones_.end(), apex,
                                        [](const Cone& cone, CellId cell) { return cone.apex < cell; });
    return found != cones_.end() && found->apex == apex ? &*found : nullptr;
  }
  [[nodiscard]] auto begin() const { return cones_.begin(); }
  [[nodiscard]] auto end() const { return cones_.end(); }

  void add(const Cone& cone) { cones_.push_back(cone); }
  void pop_back() { cones_.pop_back(); }

  // ---- to an archive, and into a new list from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  void load(sparse::ArchiveReader& from, const Moment& now);

 private:
  std::deque<Cone> cones_;
};

}  // namespace sesame::ops
