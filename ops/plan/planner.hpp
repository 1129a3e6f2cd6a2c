/// \file
/// What an operation would do: the predicate of every construction step.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "ops/cells/name_reader.hpp"
#include "ops/cells/structure.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// How much one step, and a whole workspace, may create: beyond it a step is refused with a sentence.
struct Limits {
  std::int64_t cells_of_standard = std::int64_t{1} << 20;  ///< of one simplex or simploid with its faces
  std::int64_t cells_per_step = 50'000'000;
  std::int64_t cells_of_explicit_cone = 4096;  ///< a cone over whole bodies of more cells is a lazy family
  std::int64_t cells = 1'000'000'000;          ///< ids of cells and of removals share 32 bits in the big complex
};

/// Works out plans; changes nothing. Keeps scratch memory between calls.
class Planner {
 public:
  explicit Planner(const Structure& structure, Limits limits = {}) : structure_{structure}, limits_{limits} {}

  /// The effect of a construction operation on the present state, written into `plan` (cleared first).
  ///
  /// Errors    unknown_name; bad_input (names, types, face laws); refused (cells of different types, too many cells).
  ///           On an error the plan is unspecified, and nothing else has changed.
  /// Cost      Proportional to the cells that the step makes or touches, times their dimension.
  Status plan(const MakeSimplex& operation, Plan& plan);
  Status plan(const MakeSimploid& operation, Plan& plan);
  Status plan(const MakeComplex& operation, Plan& plan);
  Status plan(const MakeCone& operation, Plan& plan);
  Status plan(const MakeSuspension& operation, Plan& plan);
  Status plan(const MakeProduct& operation, Plan& plan);
  Status plan(const Identify& operation, Plan& plan);
  Status plan(const Degenerate& operation, Plan& plan);
  Status plan(const Deidentify& operation, Plan& plan);
  Status plan(const Insert& operation, Plan& plan);
  /// Cost: the smaller of the two stars, times the square of the dimension.
  Status plan(const Collapse& operation, Plan& plan);

  [[nodiscard]] const Limits& limits() const { return limits_; }
  /// What a name denotes, of a cell of the object, in normal form: its vertices in the order in which the name stands
  /// for them. Or unknown_name, with what would be right.
  [[nodiscard]] Result<Value> resolve(const std::string& name) const;

 private:
  Status check_new_name(const std::string& name) const;
  Status check_new_apex(const std::string& name) const;
  /// The name of a lazy family, whose cells' names begin with it.
  Status check_new_prefix(const std::string& name) const;
  [[nodiscard]] std::string why_unreadable(const std::string& name, NameReader::Failure failure) const;
  Status check_room(std::int64_t new_cells) const;
  Status check_size(const CellType& type) const;
  Status check_standard(const CellType& type) const;
  /// For a product that is triangulated.
  [[nodiscard]] Status check_orders(BodyId body) const;
  /// The vertex map of a pair as an order of the vertices of a type.
  [[nodiscard]] Result<OrderId> order_of(const Identify::Map& map, TypeId type) const;
  Status plan_standard(const std::string& name, TypeId type, Plan& plan);

  [[nodiscard]] Result<BodyId> resolve_body(const std::string& name) const;
  [[nodiscard]] Result<LabelId> resolve_label(const std::string& text) const;
  [[nodiscard]] Result<BodyId> abstract_body(LabelId label) const;
  [[nodiscard]] Status check_simplex(std::vector<std::string> simplex) const;

  /// The bodies that a cone is taken over wholly, or nothing when it is taken over listed cells.
  [[nodiscard]] Result<std::optional<std::vector<BodyId>>> coned_bodies(const ConeBase& over) const;
  [[nodiscard]] std::uint64_t cells_in(const std::vector<BodyId>& bodies) const;
  /// The cells of the bodies; or, when there are none, the closure of the cells listed.
  [[nodiscard]] Result<std::vector<CellId>> coned_cells(const std::optional<std::vector<BodyId>>& bodies,
                                                        const ConeBase& over) const;
  /// The closure of the listed cells.
  [[nodiscard]] Result<std::vector<CellId>> closure(const std::vector<std::string>& names) const;
  /// The cones over the same cells from each apex, one after the other.
  Status plan_explicit_cones(std::span<const std::string> apexes, std::vector<CellId> coned, Plan& plan);
  Status plan_lazy_cone(const MakeCone& operation, const std::vector<BodyId>& bodies, Plan& plan);
  Status check_family(const NewFamily& family) const;
  /// The new cells belong to the body that they are built over, which several bodies become; to a new one over nothing.
  void place_in_bodies(const std::string& name, const std::vector<CellId>& coned, Plan& plan) const;

  /// Makes two values of one type equal, with all that this entails, and writes the merges.
  Status plan_equation(std::vector<std::pair<Value, Value>> equations, Plan& plan);
  /// The cell that a class of cells goes by, with the order in which it has the vertices of c. It may be degenerate.
  [[nodiscard]] Value overlay_root(CellId c);
  [[nodiscard]] Value overlay_value(Value v);
  void touch(CellId c);
  /// The cell of a value becomes another value, but for the faces of the two.
  void equate(const Value& cell, const Value& becomes);
  /// An error when a cell would be one with itself in another order; if it is degenerate by now, an equation.
  Status settle_foldings(std::vector<std::pair<Value, Value>>& pending);
  /// The equation of two degenerate values, restricted to sections of the degeneracies of the first.
  void add_restrictions(const Value& one, const Value& other, std::vector<std::pair<Value, Value>>& out) const;
  [[nodiscard]] std::vector<Merge> merges_of_overlay();

  const Structure& structure_;
  Limits limits_;
  struct Overlay {
    CellId parent;  ///< itself, or none: it becomes degenerate
    Value becomes;  ///< the parent in an order, or what is degenerate
  };
  std::unordered_map<CellId, Overlay> overlay_;    // union-find over the current cells that a step touches
  std::vector<CellId> touched_;                    // its keys in the order in which they came
  std::set<std::pair<CellId, OrderId>> foldings_;  // cells that would be themselves in another order
};

}  // namespace sesame::ops
