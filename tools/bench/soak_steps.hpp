/// \file
/// Random steps over all operations on an object that keeps its size: what `bench_soak` applies, without end.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/engine.hpp"
#include "ops/vocabulary/operation.hpp"
#include "tools/bench/draws.hpp"

namespace sesame::tools {

/// The processor time of this thread so far, in seconds: what other programs take is not in it.
[[nodiscard]] double processor_seconds();
/// The number of cells, from the numbers of each dimension.
[[nodiscard]] std::uint64_t sum_of(std::span<const std::uint64_t> counts);

/// Draws operations for an engine, applies them, and follows what becomes of the cells.
///
/// The object is held near a size by *patches*, some eighty cells each. A step happens within one of them: it makes
/// cells while there are few, and glues, squashes or collapses when there are many; splits, products, cones, questions
/// and undo come at all times. Every eighth patch is an abstract simplicial complex, for insertions and collapses. So a
/// step is local, as work on a large object is, and neither it nor what is drawn for it costs more in a larger object.
/// Same seed, same steps.
class SoakSteps {
 public:
  struct Count {
    std::uint64_t accepted = 0, refused = 0;
  };

  /// Requires: no step has been applied. The engine must outlive this.
  SoakSteps(engine::Engine& engine, std::uint64_t cells, std::uint64_t seed);

  /// Draws a step and applies it. Whether it was accepted.
  bool step();

  /// By operation.
  [[nodiscard]] const std::map<std::string, Count, std::less<>>& counts() const { return counts_; }
  [[nodiscard]] std::uint64_t accepted() const { return accepted_; }
  /// How often cells have got other ids.
  [[nodiscard]] std::uint64_t renewals() const { return renewals_; }
  /// The time spent in the engine: the rest of a step is what drawing it takes.
  [[nodiscard]] double engine_seconds() const { return engine_seconds_; }
  /// What was wrong in an answer, if anything was: a boundary that was said to bound nothing.
  [[nodiscard]] const std::optional<std::string>& defect() const { return defect_; }

 private:
  using CellId = ops::CellId;
  using PatchId = std::uint32_t;
  static constexpr std::uint64_t cells_of_patch = 80;
  struct Place {
    PatchId patch;
    std::uint32_t position;  ///< in its list
  };
  struct Removed {
    std::string name;
    std::uint64_t step = 0;
  };
  /// What an undo is about to give back: a cell or a body that became part of something.
  struct Returning {
    std::vector<std::pair<CellId, PatchId>> cells;
    std::vector<std::pair<ops::BodyId, PatchId>> bodies;
  };

  [[nodiscard]] const ops::Structure& structure() const { return engine_.structure(); }
  template <class Call>
  auto timed(Call&& call);

  // ---- draws
  [[nodiscard]] std::optional<ops::Operation> draw();
  [[nodiscard]] std::optional<ops::Operation> growth();
  [[nodiscard]] std::optional<ops::Operation> reduction();
  [[nodiscard]] std::optional<ops::Operation> abstract_step(bool is_large);
  [[nodiscard]] std::optional<ops::Operation> abstract_growth();
  [[nodiscard]] std::optional<ops::Operation> identification();
  [[nodiscard]] std::optional<ops::Operation> degeneration();
  [[nodiscard]] std::optional<ops::Operation> removal();
  [[nodiscard]] std::optional<ops::Operation> replacement();
  [[nodiscard]] std::optional<ops::Operation> split();
  [[nodiscard]] std::optional<ops::Operation> tear();
  [[nodiscard]] std::optional<ops::Operation> cone(bool is_suspension);
  [[nodiscard]] std::optional<ops::Operation> product();
  [[nodiscard]] std::optional<ops::Operation> question();
  [[nodiscard]] ops::Operation expectation();
  [[nodiscard]] ops::Operation undo();
  [[nodiscard]] ops::MakeComplex listed();
  [[nodiscard]] CellId pick();
  [[nodiscard]] std::string fresh(std::string_view prefix = "n");
  [[nodiscard]] std::string label_of(CellId cell);
  bool one_in(std::uint32_t n) { return draws_.below(n) == 0; }

  // ---- what becomes of the cells
  void follow(const ops::Moment& before);
  [[nodiscard]] Returning before_undo(const ops::Moment& target) const;
  void after_undo(const Returning& returning);
  void drop_undone(const ops::Moment& target, const ops::Moment& before);
  void drop_stale(PatchId patch);
  void add(CellId cell, PatchId patch);
  void find_all_cells();
  void add_body(ops::BodyId body, PatchId patch);
  void remove(CellId cell);
  [[nodiscard]] bool is_there(CellId cell) const;
  [[nodiscard]] PatchId patch_of(CellId cell) const;

  engine::Engine& engine_;
  std::uint64_t cells_;  ///< wanted
  Draws draws_;
  std::vector<std::vector<CellId>> patches_;
  std::unordered_map<CellId, Place> place_;
  PatchId patch_ = 0;             ///< of this step
  bool bounds_ = false;           ///< the chain that is asked for is a boundary
  std::vector<Removed> removed_;  ///< per patch the cell that became another one last
  std::uint64_t names_ = 0, renewals_ = 0, accepted_ = 0;
  double engine_seconds_ = 0;
  std::map<std::string, Count, std::less<>> counts_;
  std::optional<std::string> defect_;
};

}  // namespace sesame::tools
