// A soak, measured: bench_soak [--steps N] [--cells N] [--undo-limit N] [--seed N] [--samples N] [--ring R] [--forget
// 0|1]. Random steps over all operations on an object that keeps its size; a row for each tenth of them says what they
// took. Exit status 1 when a law or a group is wrong.
#include <fmt/format.h>
#include <charconv>
#include <iostream>
#include <map>
#include <string>
#include <string_view>

#include "tools/bench/soak.hpp"

namespace {

using namespace sesame;

constexpr const char* usage =
    "usage: bench_soak [--steps N] [--cells N] [--undo-limit N] [--seed N] [--samples N] [--ring Z|Q|Z/p] [--forget "
    "0|1]\n";

int complain(std::string_view what) {
  std::cerr << "bench_soak: " << what << '\n';
  return 1;
}

double megabytes(std::uint64_t bytes) { return static_cast<double>(bytes) / 1e6; }

void print(const tools::SoakTenth& tenth, std::uint64_t steps_before) {
  std::string betti;
  for (const std::int64_t rank : tenth.betti) {
    betti += (betti.empty() ? "" : " ") + std::to_string(rank);
  }
  const auto steps = static_cast<double>(tenth.steps - steps_before);
  std::cout << fmt::format(
                   "{:>10} {:>8.1f} {:>8.0f} {:>6.0f}% {:>6} {:>9} {:>8.1f} {:>8.1f} {:>7} {:>8} {:>7.1f}  {}\n",
                   tenth.steps, tenth.seconds, steps / tenth.seconds, 100 * (1 - tenth.engine_seconds / tenth.seconds),
                   tenth.cells, tenth.nodes, megabytes(tenth.resident_bytes), megabytes(tenth.heap_bytes),
                   tenth.rebases, tenth.renewals, tenth.check_seconds, betti)
            << std::flush;
}

int run(const tools::SoakPlan& plan) {
  std::cout << fmt::format("{} steps on some {} cells, the last {} of which can be undone; seed {}\n", plan.steps,
                           plan.cells, plan.undo_limit, plan.seed)
            << fmt::format("{:>10} {:>8} {:>8} {:>7} {:>6} {:>9} {:>8} {:>8} {:>7} {:>8} {:>7}  {}\n", "steps",
                           "seconds", "steps/s", "drawing", "cells", "nodes", "MB res.", "MB heap", "rebases",
                           "renewals", "checks", "Betti");
  std::uint64_t steps_before = 0;
  const auto outcome = tools::soak(plan, [&](const tools::SoakTenth& tenth) {
    print(tenth, steps_before);
    steps_before = tenth.steps;
  });
  if (!outcome) {
    return complain(outcome.error().what);
  }
  for (const auto& [operation, count] : outcome->counts) {
    std::cout << fmt::format("{:<12} {:>10} accepted {:>10} refused\n", operation, count.accepted, count.refused);
  }
  const auto& second = outcome->tenths[1];
  const auto& last = outcome->tenths.back();
  std::cout << fmt::format("last tenth / second tenth: {:.2f} of the time, {:.2f} of the heap; {:.0f} bytes a step\n",
                           last.seconds / second.seconds,
                           static_cast<double>(last.heap_bytes) / static_cast<double>(second.heap_bytes),
                           (static_cast<double>(last.heap_bytes) - static_cast<double>(second.heap_bytes)) /
                               static_cast<double>(last.steps - second.steps));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  tools::SoakPlan plan;
  const std::map<std::string_view, std::uint64_t*> numbers{{"--steps", &plan.steps},
                                                           {"--cells", &plan.cells},
                                                           {"--undo-limit", &plan.undo_limit},
                                                           {"--seed", &plan.seed},
                                                           {"--samples", &plan.samples}};
  for (int k = 1; k < argc; k += 2) {
    const std::string_view option = argv[k];
    const std::string_view value = k + 1 < argc ? argv[k + 1] : "";
    if (option == "--ring") {
      const auto ring = sparse::parse_ring(value);
      if (!ring) {
        return complain(ring.error().what);
      }
      plan.ring = *ring;
      continue;
    }
    if (option == "--forget" && (value == "0" || value == "1")) {
      plan.forgets_cells = value == "1";
      continue;
    }
    const auto number = numbers.find(option);
    const char* const end = value.data() + value.size();
    if (number == numbers.end() || value.empty() || std::from_chars(value.data(), end, *number->second).ptr != end) {
      std::cerr << usage;
      return 1;
    }
  }
  if (plan.steps < 10) {
    return complain("a soak has ten tenths: --steps takes 10 at least");
  }
  return run(plan);
}
