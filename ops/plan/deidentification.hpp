/// \file
/// What a de-identification does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ops/cells/plan.hpp"
#include "ops/cells/structure.hpp"
#include "ops/plan/limits.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/hash_index.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// Works out de-identifications: copies under ids of their own, faces as they would be, and the laws between them.
/// Keeps its memory between calls.
///
/// Threads: one at a time, for queries too.
class SplitPlanner {
 public:
  explicit SplitPlanner(const Structure& structure) : structure_{structure} {}

  /// Writes the effect of the operation into a plan that says nothing yet.
  ///
  /// Errors    unknown_name; bad_input (names, faces that there are not); refused (too many cells, what is degenerate,
  ///           a face law that would be broken).
  /// Cost      Proportional to the faces of the cells that are split, that have moves, and of the cofaces of these.
  Status plan(const Deidentify& operation, const Limits& limits, Plan& plan);

 private:
  struct NewCopy {
    CellId source;
    const std::string* name;
    std::uint64_t name_hash;
    OrderId order;  ///< in which the name of the cell that is split has its vertices; that of the copy has them so too
  };

  /// Copies have the ids that follow those in use, in the order of the operation until the plan is written.
  [[nodiscard]] bool is_copy(CellId c) const { return !is_asked_for(c) && c >= first_copy_; }
  [[nodiscard]] CellId source_of(CellId c) const { return is_copy(c) ? copies_[c - first_copy_].source : c; }
  [[nodiscard]] std::string name_of(CellId c) const;
  /// The number of the copy with a name, or HashIndex::nothing.
  [[nodiscard]] std::uint32_t copy_named(const std::string& name) const;

  void forget();
  Status add_copy(const Deidentify::Split& split);
  Status add_move(const Deidentify::Split& split, std::size_t number, const std::string& name, std::int64_t face,
                  Plan& plan);
  /// What a name denotes in a list of moves: a copy, or a cell that is not degenerate. With the order in which the name
  /// stands for its vertices, by which its faces are counted.
  [[nodiscard]] Result<Incidence> movable(const std::string& name) const;
  /// The place of a cell in `cells_`; `nothing` if it is not there.
  [[nodiscard]] std::uint32_t place_of(CellId c) const;
  /// Puts a cell there, if it is not. Returns whether it was not.
  bool add_cell_to_check(CellId c);
  /// The faces of a cell that is split or whose incidences move. Valid until they are asked for of another.
  std::span<Value> faces_of(CellId c);
  [[nodiscard]] std::span<const Value> changed_faces(std::size_t place) const;
  [[nodiscard]] Value face(const Value& v, std::uint32_t k) const;
  void add_cofaces();
  [[nodiscard]] Status check_boundary(CellId c) const;
  [[nodiscard]] Status check_laws(CellId c) const;
  void write(Plan& plan);

  const Structure& structure_;
  CellId first_copy_ = 0;
  std::vector<NewCopy> copies_;
  sparse::HashIndex copy_index_;         ///< of the copies by name
  std::vector<CellId> cells_;            ///< the changed ones: copies, and cells with moves; then the cofaces of these
  sparse::HashIndex cell_index_;         ///< of `cells_`
  std::vector<std::size_t> faces_ends_;  ///< per changed cell, where its faces end
  std::vector<Value> faces_;             ///< of the changed cells, as they will be
  std::vector<std::size_t> order_;       ///< scratch of `write`
  std::vector<CellId> final_ids_;        ///< the same
};

}  // namespace sesame::ops
