/// \file
/// Which copies and which moves split cells off: plans for de-identification, for the tests of what uses it.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ops/cells/cofaces.hpp"
#include "ops/cells/structure.hpp"
#include "ops/vocabulary/operation.hpp"

namespace sesame::tests {

/// Collects the splits of one step: copies of cells, and the incidences that go to each.
class SplitPlan {
 public:
  /// Copies are called PREFIX1, PREFIX2, ...
  SplitPlan(const ops::Structure& structure, std::string prefix) : structure_{structure}, prefix_{std::move(prefix)} {}

  /// A copy of a current cell: its number.
  std::size_t copy(ops::CellId cell) {
    const std::string name = prefix_ + std::to_string(splits_.size() + 1);
    splits_.push_back({std::string{structure_.name(cell)}, name, {}});
    return splits_.size() - 1;
  }
  const std::string& name(std::size_t copy) const { return splits_[copy].copy; }
  void move(const std::string& cell, std::size_t slot, std::size_t to_copy) {
    splits_[to_copy].moves.emplace_back(cell, static_cast<std::int64_t>(slot));
  }
  bool is_empty() const { return splits_.empty(); }
  ops::Deidentify take() { return {std::move(splits_)}; }

 private:
  const ops::Structure& structure_;
  std::string prefix_;
  std::vector<ops::Deidentify::Split> splits_;
};

/// A current cell and all cells below it.
inline std::set<ops::CellId> closure_of(const ops::Structure& structure, ops::CellId top) {
  std::set<ops::CellId> closure{top};
  std::vector<ops::CellId> pending{top};
  while (!pending.empty()) {
    const ops::CellId c = pending.back();
    pending.pop_back();
    for (const ops::CellId face : structure.faces().of(c)) {
      if (const ops::CellId below = structure.values().of(face).cell; closure.insert(below).second) {
        pending.push_back(below);
      }
    }
  }
  return closure;
}

/// Cuts the closure of a cell off from everything else; what is glued inside it stays so. Nothing when it is alone, or
/// when a face is degenerate over a cell that it shares: such an incidence goes to no copy.
inline std::optional<ops::Deidentify> isolating_split(const ops::Structure& structure, ops::CellId top,
                                                      const std::string& prefix) {
  const std::set<ops::CellId> closure = closure_of(structure, top);
  std::set<ops::CellId> shared;  // with other cells, and what is below
  for (const ops::CellId x : closure) {
    const std::vector<ops::CellId> users = cofaces(structure, x);
    if (std::any_of(users.begin(), users.end(), [&](ops::CellId user) { return !closure.contains(user); })) {
      const std::set<ops::CellId> below = closure_of(structure, x);
      shared.insert(below.begin(), below.end());
    }
  }
  SplitPlan plan(structure, prefix);
  std::map<ops::CellId, std::size_t> copies;
  for (const ops::CellId x : shared) {
    copies.emplace(x, plan.copy(x));
  }
  for (const ops::CellId t : closure) {
    const std::string name = shared.contains(t) ? plan.name(copies.at(t)) : std::string{structure.name(t)};
    for (std::size_t slot = 0; slot < structure.faces().of(t).size(); ++slot) {
      const ops::Value face = structure.values().of(structure.faces().of(t)[slot]);
      if (!shared.contains(face.cell)) {
        continue;
      }
      if (face.is_degenerate()) {
        return std::nullopt;
      }
      plan.move(name, slot, copies.at(face.cell));
    }
  }
  return plan.is_empty() ? std::nullopt : std::optional{plan.take()};
}

/// Makes a cell a standard simploid of its own: cut off from everything, nothing of its boundary glued. Nothing when it
/// is one, or when a face of it is degenerate, which no splitting mends.
inline std::optional<ops::Deidentify> tearing_split(const ops::Structure& structure, ops::CellId top,
                                                    const std::string& prefix) {
  const ops::StandardCell& standard = structure.types().standard(structure.cells().type_id(top));
  const std::size_t corners = standard.cells.size();
  std::vector<ops::Value> values(corners);
  values.back() = structure.values().of(top);
  for (std::size_t corner = corners; corner-- > 0;) {
    if (values[corner].is_degenerate()) {
      return std::nullopt;
    }
    for (std::uint32_t slot = 0; slot < standard.cells[corner].faces.size(); ++slot) {
      values[standard.cells[corner].faces[slot]] = structure.values().face(values[corner], slot);
    }
  }
  SplitPlan plan(structure, prefix);
  std::map<std::size_t, std::size_t> copies;  // of the corners that cannot keep the cell that they are
  std::set<ops::CellId> kept;
  for (std::size_t corner = corners; corner-- > 0;) {
    const ops::CellId x = values[corner].cell;
    const std::vector<ops::CellId> users = cofaces(structure, x);
    if (!kept.contains(x) && std::all_of(users.begin(), users.end(), [&](ops::CellId u) { return kept.contains(u); })) {
      kept.insert(x);
    } else {
      copies.emplace(corner, plan.copy(x));
    }
  }
  for (std::size_t corner = 0; corner < corners; ++corner) {
    const std::string name =
        copies.contains(corner) ? plan.name(copies.at(corner)) : std::string{structure.name(values[corner].cell)};
    for (std::size_t slot = 0; slot < standard.cells[corner].faces.size(); ++slot) {
      if (const auto below = copies.find(standard.cells[corner].faces[slot]); below != copies.end()) {
        plan.move(name, slot, below->second);
      }
    }
  }
  return plan.is_empty() ? std::nullopt : std::optional{plan.take()};
}

}  // namespace sesame::tests
