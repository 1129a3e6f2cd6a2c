/// \file
/// Building structures and looking at them, for the tests of ops/ and engine/.
#pragma once

#include <string>
#include <vector>

#include "ops/operation.hpp"
#include "ops/planner.hpp"
#include "ops/structure.hpp"
#include "sparse/result.hpp"
#include "tests/support/catch.hpp"

namespace sesame::tests {

/// The operation that a line says. A line that cannot be read ends the test.
inline ops::Operation operation(const std::string& line) {
  auto parsed = ops::parse_operation(line);
  if (!parsed) {
    FAIL(line << ": " << parsed.error().what);
  }
  return *parsed;
}

/// A structure and its planner, without any homology.
class Workshop {
 public:
  explicit Workshop(ops::Limits limits = {}) : planner_{structure_, limits} {}

  const ops::Structure& structure() const { return structure_; }
  ops::Structure& structure() { return structure_; }
  ops::Planner& planner() { return planner_; }
  const ops::Plan& last_plan() const { return plan_; }

  Status plan(const ops::Operation& op) {
    return std::visit(
        [this]<class Op>(const Op& construction) -> Status {
          if constexpr (requires { planner_.plan(construction, plan_); }) {
            return planner_.plan(construction, plan_);
          } else {
            return Error{Errc::bad_input, "not a construction"};
          }
        },
        op);
  }
  Status apply(const ops::Operation& op) {
    Status status = plan(op);
    if (status) {
      structure_.apply(plan_);
    }
    return status;
  }
  /// Applies lines that must be legal.
  void build(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      if (const Status status = apply(operation(line)); !status) {
        FAIL(line << ": " << status.error().what);
      }
    }
  }
  ops::CellId cell(const std::string& name) const {
    const auto found = structure_.lookup(name);
    if (!found) {
      FAIL("no cell " << name);
    }
    return structure_.find(*found);
  }

 private:
  ops::Structure structure_;
  ops::Planner planner_;
  ops::Plan plan_;
};

/// Everything that can be seen of a structure, as text. Two states are alike exactly when these are.
inline std::string dump(const ops::Structure& structure) {
  std::string text = "created " + std::to_string(structure.created()) + " links " + std::to_string(structure.links());
  for (const std::uint64_t count : structure.counts()) {
    text += " " + std::to_string(count);
  }
  text += "\n";
  for (ops::CellId c = 0; c < structure.created(); ++c) {
    text += std::to_string(c) + " " + ops::describe(structure.type(c).type);
    for (const ops::CellId face : structure.faces_as_created(c)) {
      text += " " + std::to_string(face);
    }
    text += " is " + std::to_string(structure.find(c)) + " parent " + std::to_string(structure.parent(c)) + " link " +
            std::to_string(structure.link_of(c)) + " of " + std::to_string(structure.members(structure.find(c))) + " " +
            std::string{structure.own_name(c)} + " now " + std::string{structure.name(c)} + " oldest " +
            std::to_string(structure.oldest(c)) + " in " + std::string{structure.body_name(structure.body_of(c))} +
            "\n";
  }
  for (const ops::BodyId body : structure.current_bodies()) {
    text += "body " + std::string{structure.body_name(body)};
    for (const ops::CellId c : structure.cells_of(body)) {
      text += " " + std::to_string(c);
    }
    text += "\n";
  }
  return text;
}

}  // namespace sesame::tests
