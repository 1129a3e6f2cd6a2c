/// \file
/// Whether the answers of a method are right, after every step of a construction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/homology_tracker.hpp"
#include "ops/plan/workspace.hpp"
#include "ops/vocabulary/operation.hpp"
#include "tools/bench/method.hpp"
#include "tools/bench/scenarios.hpp"

namespace sesame::tools {

/// n_0 - n_1 + n_2 - ...
template <class Numbers>
[[nodiscard]] std::int64_t alternating_sum(const Numbers& numbers) {
  std::int64_t sum = 0, sign = 1;
  for (const auto number : numbers) {
    sum += sign * static_cast<std::int64_t>(number);
    sign = -sign;
  }
  return sum;
}

/// Whether groups are those of the answer. Errors, expectation: what differs.
[[nodiscard]] Status check(const engine::Homology& found, const Answer& answer);
/// The same of Betti numbers over a field.
[[nodiscard]] Status check(const std::vector<std::uint64_t>& betti, const Answer& answer);

/// Follows a run of a method and compares its answers.
///
/// After every step the Betti numbers must have the Euler characteristic that the numbers of cells have. The groups are
/// compared after every step at which the construction says what they are; when it says nothing, with those that
/// another method finds: `recompute`, or `live` when that is the method itself. That one is asked as often as an effort
/// of `most_cells`, the sum of the cells that are there when it is asked, allows: after every step of a small
/// construction, after some of a large one, spread over it by effort. After the last step the answer is that of the
/// scenario.
class AnswerCheck {
 public:
  static constexpr double most_cells = 8e6;

  /// Of a scenario that is a construction, of so many steps.
  AnswerCheck(const Scenario& scenario, std::uint64_t size, const std::string& method, std::size_t steps);

  /// What is wrong after the next step, with this answer. Errors: expectation, or why the step cannot be followed.
  Status after(const ops::Operation& operation, const engine::Homology& homology);
  /// After so many steps the groups were compared.
  [[nodiscard]] std::uint64_t compared() const { return compared_; }

 private:
  Status follow(const ops::Operation& operation);
  [[nodiscard]] Status check_euler(const engine::Homology& homology) const;
  Status check_groups(const engine::Homology& homology);

  AnswerAfter known_;
  std::optional<Answer> last_;
  ops::Workspace object_{written_out};
  std::unique_ptr<Method> other_;  ///< null when it is not needed
  std::size_t steps_, done_ = 0;
  double effort_ = 0;  ///< that may be spent now
  std::uint64_t compared_ = 0;
};

}  // namespace sesame::tools
