/// \file
/// A way of keeping the homology of an object current while it is built. To compare your own, derive a class and add
/// it to the list in methods.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/engine.hpp"
#include "ops/plan/workspace.hpp"
#include "ops/vocabulary/operation.hpp"

namespace sesame::tools {

/// The limits of methods that know no lazy cones.
inline constexpr ops::Limits written_out{.cells_of_explicit_cone = std::numeric_limits<std::int64_t>::max()};

class Method {
 public:
  Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  /// Applies a step, after which `homology` can be asked for. What is timed is this and `homology`.
  /// Errors: those of the step; refused when the method cannot do it, with a sentence.
  virtual Status apply(const ops::Operation& operation) = 0;
  /// Betti numbers and torsion of the present object.
  virtual engine::Homology homology() = 0;
  /// Maps the generators of all homology groups back to the object; returns the number of terms of their cycles.
  virtual std::uint64_t generators() = 0;
  /// What it has done so far, as numbers that are the same in every run: terms touched, entries held, ...
  [[nodiscard]] virtual std::vector<std::pair<std::string, std::uint64_t>> counts() const = 0;
};

/// A method by its name.
struct MethodEntry {
  std::string name;
  std::string what;  ///< one line for people
  std::function<std::unique_ptr<Method>(const sparse::AnyRing& ring)> make;
  bool only_when_named = false;  ///< too slow to be measured by default
};

/// All methods, the live one first.
[[nodiscard]] const std::vector<MethodEntry>& methods();

}  // namespace sesame::tools
