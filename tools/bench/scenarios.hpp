/// \file
/// The scenarios as data: what is built, how large, and what its homology is.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"
#include "tools/bench/filtrations.hpp"
#include "tools/bench/towers.hpp"

namespace sesame::tools {

/// Betti numbers and invariant factors by degree; zeros and empty lists at the end may be left out.
struct Answer {
  std::vector<std::int64_t> betti;
  std::vector<std::vector<std::int64_t>> torsion = {};
};

/// The homology after step number `step`, counted from 0, where it is known. To be asked once for each, in order.
using AnswerAfter = std::function<std::optional<Answer>(std::size_t step)>;

/// Steps of construction. A method is asked for the homology after each, and for all generators every so many steps.
struct Construction {
  std::function<std::vector<ops::Operation>(std::uint64_t size)> make;
  /// What the homology is on the way, in closed form or from counting; null: that is not known.
  std::function<AnswerAfter(std::uint64_t size)> follow = nullptr;
  std::uint64_t generators_every = 0;  ///< 0: never
};
/// Cells in order, for methods that compute persistence.
struct CellFiltration {
  std::function<Filtration(std::uint64_t size)> make;
};
/// A tower; the size is the number of operations.
struct RandomTower {
  TowerOptions options;
};

/// A zigzag, written as its operations, one a line.
struct Zigzag {
  std::function<void(std::ostream& out, std::uint64_t size)> write;
};

struct Scenario {
  std::string name, family, what;
  std::string size_name;  ///< what the size is a number of
  std::uint64_t size = 0, quick_size = 0;
  std::variant<Construction, CellFiltration, RandomTower, Zigzag> input;
  /// What is known of the homology at a size; where nothing is, the Euler characteristic is still checked for cell
  /// filtrations, towers and zigzags.
  std::function<std::optional<Answer>(std::uint64_t size)> answer;
  std::string ring = "Z";
  bool all_methods = false;  ///< small enough for every method; else only the first runs unless others are asked for
};

/// All scenarios, in the order in which they are shown.
[[nodiscard]] const std::vector<Scenario>& scenarios();

/// Those with these names or of these families; all when there are no names. Errors: unknown_name, with the list.
Result<std::vector<const Scenario*>> find_scenarios(const std::vector<std::string>& names);

/// The names of the methods that a scenario can be run with, the one first that it is run with when none is named.
[[nodiscard]] std::vector<std::string> methods_of(const Scenario& scenario);
/// Of all scenarios. Errors: unknown_name, with the list.
Status check_method_names(const std::vector<std::string>& names);

}  // namespace sesame::tools
